// What moves is drawn as the same scene standing there would be, by either way of shading, whatever
// was drawn before.
#include <cmath>

#include "scene/animation/rig.h"
#include "scene/animation/settle.h"
#include "scene/gltf/gltf.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/support/gltf_builder.h"

namespace petrichor::gpu {
namespace {

using testing_gltf::GltfBuilder;

Scene settled(const GltfBuilder& b)
{
    Scene scene = scene::load_gltf(b.glb(), "moving.glb", nullptr);
    scene::settle_animation(scene, {});
    return scene;
}

Frame frame_of(const glm::vec3& eye, const glm::vec3& target, SurfacePath path)
{
    Frame frame;
    frame.camera = look(eye, target);
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.surface_path = path;
    frame.settings.aovs = {"normal", "position"};
    // The maps of shadows are laid around all of a scene, which is more of one that moves; fog lies on its lowest point.
    frame.settings.shadows = false;
    frame.fog.mode = FogMode::Off;
    frame.settings.ambient_occlusion = false;
    return frame;
}

void expect_same(const RenderResult& a, const RenderResult& b)
{
    EXPECT_EQ(a.display, b.display);
    for (std::size_t i = 0; i < a.aovs.size(); ++i) EXPECT_EQ(a.aovs[i].pixels, b.aovs[i].pixels);
}

class AnimationTest : public GpuTest {
protected:
    // The scene at a moment against a still one, drawn both ways.
    void expect_stands(const Scene& moving, double time_s, const Scene& still, Frame frame)
    {
        for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
            frame.settings.surface_path = path;
            renderer->load(still, {});
            const RenderResult wanted = renderer->render(frame);
            renderer->load(moving, {});
            frame.animation_s = 0.05;
            const RenderResult before = renderer->render(frame);
            EXPECT_NE(before.display, wanted.display);
            frame.animation_s = time_s;
            expect_same(renderer->render(frame), wanted);
            renderer->load(moving, {});
            expect_same(renderer->render(frame), wanted);
        }
    }
};

TEST_F(AnimationTest, ATurningNodeIsWhereItsKeysSay)
{
    const Scene moving = settled(testing_gltf::turning_quad());
    GltfBuilder there = testing_gltf::turning_quad();
    there.document.erase("animations");
    // Half way: 45 degrees, as the posture has it to the bit.
    Scene still = settled(there);
    still.instances[0].to_world =
        scene::place_of(moving.instances[0], scene::posture_at(*moving.rig, 0.5));
    expect_stands(moving, 0.5, still, frame_of({2, 0.5f, 3}, {2, 0, 0}, SurfacePath::Auto));
}

TEST_F(AnimationTest, ABendingBarIsDrawnAsOneThatIsBent)
{
    GltfBuilder b = testing_gltf::bending_bar();
    // Ends bent, so that the end is a key.
    Scene moving = scene::load_gltf(b.glb(), "bar.glb", nullptr);
    scene::settle_animation(moving, {.animation = "all", .loop = false});
    const Scene still = settled(testing_gltf::bending_bar(false));
    expect_stands(moving, 1.0, still, frame_of({0, 1, 4}, {0, 1, 0}, SurfacePath::Auto));
}

TEST_F(AnimationTest, AMorphedQuadIsDrawnInItsShape)
{
    const Scene moving = settled(testing_gltf::morphing_quad());
    GltfBuilder there = testing_gltf::morphing_quad();
    there.document.erase("animations");
    there.document["meshes"][0]["weights"] = {0.5f, 0.25f};
    expect_stands(moving, 0.5, settled(there), frame_of({0, 0.5f, 4}, {0, 0, 0}, SurfacePath::Auto));
}

// A plate that slides over the ground: its shadow is below it in every frame, in any order.
TEST_F(AnimationTest, ShadowsAndShelterFollow)
{
    GltfBuilder b;
    const int mesh = b.mesh(testing_gltf::quad_of(b));
    const double s = std::sqrt(0.5);
    b.node({{"mesh", mesh}, {"rotation", {-s, 0, 0, s}}, {"scale", {12, 6, 1}}});
    b.node({{"mesh", mesh}, {"rotation", {-s, 0, 0, s}}, {"translation", {-2, 1, 0}}});
    b.animate("slide", 1, "translation", {0, 2}, "VEC3", {-2, 1, 0, 2, 1, 0});
    const Scene scene = settled(b);
    Frame frame = frame_of({0, 3, 6}, {0, 0, 0}, SurfacePath::Auto);
    frame.settings.shadows = true;
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = 1.5707f;
    frame.settings.aovs = {"position", "film"};
    frame.weather.rain = frame.weather.film_albedo = frame.weather.film_smoothness = 1.0f;
    renderer->load(scene, {});
    const auto means = [&](double time_s, float x) {
        frame.animation_s = time_s;
        const RenderResult r = renderer->render(frame);
        glm::vec3 sum(0.0f);  // light, film of water, pixels
        for (int py = 0; py < r.height; ++py) {
            for (int px = 0; px < r.width; ++px) {
                const glm::vec3 p(aov(r, "position", px, py, 0), aov(r, "position", px, py, 1),
                                  aov(r, "position", px, py, 2));
                const glm::vec3 off = glm::abs(p - glm::vec3(x, 0, 0));
                if (off.x > 0.3f || off.y > 0.01f || off.z > 0.3f) continue;
                sum += glm::vec3(luminance(pixel(r, px, py)), aov(r, "film", px, py), 1.0f);
            }
        }
        EXPECT_GT(sum.z, 10.0f);
        return sum / sum.z;
    };
    for (const double time_s : {1.9, 0.1, 1.9}) {
        const auto below = static_cast<float>(-2.0 + 2.0 * time_s);
        const glm::vec3 dark = means(time_s, below), lit = means(time_s, -below);
        EXPECT_LT(dark.x, 0.2f * lit.x) << time_s;
        EXPECT_LT(dark.y, 0.5f * lit.y) << time_s;
        EXPECT_GT(lit.y, 0.9f) << time_s;
    }
}

TEST_F(AnimationTest, ALampOnANodeLightsWhereItIs)
{
    GltfBuilder b;
    const int mesh = b.mesh(testing_gltf::quad_of(b));
    const double s = std::sqrt(0.5);
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 100}}};
    b.node({{"mesh", mesh}, {"rotation", {-s, 0, 0, s}}, {"scale", {12, 6, 1}}});
    b.node({{"translation", {-2, 1, 0}},
            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.animate("slide", 1, "translation", {0, 2}, "VEC3", {-2, 1, 0, 2, 1, 0});
    const Scene scene = settled(b);
    Frame frame = frame_of({0, 5, 0.01f}, {0, 0, 0}, SurfacePath::Auto);
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = -1.0f;
    renderer->load(scene, {});
    const auto light = [&](double time_s, int x) {
        frame.animation_s = time_s;
        return luminance(pixel(renderer->render(frame), x, 32));
    };
    EXPECT_GT(light(0.1, 14), 4.0f * light(0.1, 81));
    EXPECT_GT(light(1.9, 81), 4.0f * light(1.9, 14));
}

// A plate that slides 2 m a second: while the shutter is open it is as much wider as its way, and
// afterwards it stands where it did.
TEST_F(AnimationTest, WhatMovesBlursByItsWay)
{
    GltfBuilder b;
    const int mesh = b.mesh(testing_gltf::quad_of(b));
    b.node({{"mesh", mesh}, {"scale", {0.2, 2, 1}}});
    b.animate("slide", 0, "translation", {0, 2}, "VEC3", {-2, 0, 0, 2, 0, 0});
    const Scene scene = settled(b);
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        Frame frame = frame_of({0, 0, 4}, {0, 0, 0}, path);
        frame.settings.aovs.clear();
        frame.settings.samples = 32;
        frame.settings.draw_sky = false;
        frame.animation_s = 1.0;
        const auto width = [&](const RenderResult& r) {
            int seen = 0;
            for (int x = 0; x < r.width; ++x) seen += pixel(r, x, r.height / 2).g > 0.0f ? 1 : 0;
            return static_cast<float>(seen);
        };
        renderer->load(scene, {});
        const RenderResult still = renderer->render(frame);
        Frame open = frame;
        for (int i = 0; i < 32; ++i) {
            const double u = 0.5 + 0.618033988749895 * i;
            const double off_s = i == 0 ? 0.0 : (u - std::floor(u) - 0.5) * 0.25;
            open.shutter.push_back({frame.camera, 1.0 + off_s, off_s});
        }
        const float blurred = width(renderer->render(open));
        // 0.5 m, 4 m away.
        const float way = 0.5f / 4.0f * 32.0f / std::tan(0.4f);
        EXPECT_NEAR(blurred - width(still), way, 1.6f);
        EXPECT_EQ(renderer->render(frame).display, still.display);
    }
}

}  // namespace
}  // namespace petrichor::gpu
