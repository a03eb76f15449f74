// Samples that are left out: what they would have shown is there all the same.
#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 80;

using AdaptiveTest = GpuTest;

Frame frame_of(float adaptive)
{
    Frame frame;
    frame.camera = look({0, 1.5f, 4}, {0, 0.5f, 0}, 0.9f);
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 8;
    frame.settings.adaptive = adaptive;
    frame.settings.surface_path = SurfacePath::Visibility;
    frame.settings.image_based_light = false;
    frame.settings.ambient_occlusion = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 0.5f;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.emissive_lights = false;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

Material glow(float radiance)
{
    Material m = plain_material(glm::vec3(0.0f));
    m.specular = 0.0f;
    m.emissive = glm::vec3(radiance);
    return m;
}

// Thin bars of several lights, crossed: edges at all angles, parts of pixels, bars behind bars.
Scene bars(float pane)
{
    std::vector<Primitive> primitives;
    std::vector<Material> materials;
    for (int i = 0; i < 24; ++i) {
        const auto k = static_cast<float>(i);
        const float turn = 0.37f * k;
        const glm::vec3 along(2.6f * std::cos(turn), 2.6f * std::sin(turn), 0.0f);
        const glm::vec3 across = 0.03f * glm::vec3(-std::sin(turn), std::cos(turn), 0.0f);
        const glm::vec3 corner(-1.0f + 0.09f * k, 0.8f, -0.05f * k);
        primitives.push_back(quad(corner - 0.5f * along, along, across, static_cast<std::uint32_t>(i)));
        materials.push_back(glow(0.2f + 0.15f * k));
    }
    if (pane > 0.0f) {
        primitives.push_back(quad({-0.8f, 0.1f, 1.0f}, {1.4f, 0, 0}, {0.2f, 1.2f, 0}, 24));
        Material glass = plain_material({0.2f, 0.5f, 0.4f});
        glass.base_color.a = pane;
        glass.alpha_mode = AlphaMode::Blend;
        materials.push_back(glass);
    }
    // Each bar is an instance, and so a draw, of its own.
    Scene scene;
    scene.materials = std::move(materials);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        scene.meshes.push_back({"bar", {primitives[i]}});
        scene.instances.push_back({"bar", static_cast<std::uint32_t>(i), glm::mat4(1.0f)});
    }
    return scene;
}

// A floor in the light of a lamp and of the sun, with the shadow of a board.
Scene lit_floor()
{
    Scene scene = scene_of({quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}),
                            quad({-0.7f, 1.0f, 0.0f}, {1.1f, 0.2f, 0}, {0.1f, 0, -0.9f})},
                           {plain_material(glm::vec3(0.5f))});
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.position_m = {1.5f, 0.8f, 1.0f};
    lamp.intensity = 3.0f;
    lamp.range_m = 20.0f;
    scene.lights.push_back(lamp);
    return scene;
}

Frame sunny(float adaptive)
{
    Frame frame = frame_of(adaptive);
    frame.sky.sun_elevation_rad = 0.8f;
    frame.settings.exposure = 2.0e-5f;
    return frame;
}

float shown(float radiance, float exposure)
{
    const float x = std::max(radiance, 0.0f) * exposure;
    return std::sqrt(x / (1.0f + x));
}

struct Difference {
    float mean = 0.0f;
    float most = 0.0f;
};

// On the display.
Difference difference(const RenderResult& a, const RenderResult& b, float exposure)
{
    Difference d;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float now = std::abs(shown(pixel(a, x, y).g, exposure) - shown(pixel(b, x, y).g, exposure));
            d.mean += now / static_cast<float>(kSize * kSize);
            d.most = std::max(d.most, now);
        }
    }
    return d;
}

// Where light does not change over a surface, each sample is known from the first of its surface: the
// picture is that of all samples, at every edge.
TEST_F(AdaptiveTest, EdgesTakeTheSamplesThatSeeAnotherSurface)
{
    renderer->load(bars(0.0f), {});
    const RenderResult all = renderer->render(frame_of(0.0f));
    const RenderResult some = renderer->render(frame_of(0.02f));
    const Difference d = difference(all, some, 0.5f);
    EXPECT_LT(d.most, 2.0e-3f);
    // Taken at the first sample alone it is another picture.
    Frame one = frame_of(0.0f);
    one.settings.samples = 2;
    EXPECT_GT(difference(all, renderer->render(one), 0.5f).most, 0.05f);
}

TEST_F(AdaptiveTest, WhatIsSeenThroughAPaneTakesThemToo)
{
    renderer->load(bars(0.4f), {});
    const RenderResult all = renderer->render(frame_of(0.0f));
    const RenderResult some = renderer->render(frame_of(0.02f));
    EXPECT_LT(difference(all, some, 0.5f).most, 2.0e-3f);
}

TEST_F(AdaptiveTest, ShadowsKeepTheirEdges)
{
    renderer->load(lit_floor(), {});
    const RenderResult all = renderer->render(sunny(0.0f));
    const RenderResult some = renderer->render(sunny(0.02f));
    const float exposure = sunny(0.0f).settings.exposure;
    const Difference d = difference(all, some, exposure);
    EXPECT_LT(d.mean, 1.0e-3f);
    EXPECT_LT(d.most, 0.05f);
    // Less is shaded: not every sum is that of all samples.
    EXPECT_NE(all.beauty, some.beauty);
    Frame two = sunny(0.0f);
    two.settings.samples = 2;
    EXPECT_GT(difference(all, renderer->render(two), exposure).most, 2.0f * d.most);
}

TEST_F(AdaptiveTest, AFrameDoesNotDependOnOthers)
{
    renderer->load(lit_floor(), {});
    const RenderResult first = renderer->render(sunny(0.02f));
    Frame other = sunny(0.02f);
    other.camera = look({2, 1.0f, 3}, {0, 0.5f, 0}, 0.9f);
    renderer->render(other);
    EXPECT_EQ(renderer->render(sunny(0.02f)).beauty, first.beauty);
}

// Few samples, and those that look from elsewhere, are all taken.
TEST_F(AdaptiveTest, SamplesOfALensAreAllTaken)
{
    renderer->load(lit_floor(), {});
    Frame all = sunny(0.0f);
    all.lens = {.radius_m = 0.05f, .focus_m = 2.0f};
    Frame some = all;
    some.settings.adaptive = 0.02f;
    EXPECT_EQ(renderer->render(all).beauty, renderer->render(some).beauty);
    all.lens = some.lens = {};
    all.settings.samples = some.settings.samples = 3;
    EXPECT_EQ(renderer->render(all).beauty, renderer->render(some).beauty);
}

}  // namespace
}  // namespace petrichor::gpu
