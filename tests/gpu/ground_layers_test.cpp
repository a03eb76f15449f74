// The ground of a terrain: four materials by the weights of a control map, another four laid over them, one colour
// from afar.
#include <cmath>
#include <functional>

#include "formulas/weather/mix_sets.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;
const glm::vec4 kColors(0.1f, 0.3f, 0.5f, 0.8f);
const glm::vec4 kRoughness(0.2f, 0.4f, 0.6f, 0.9f);

Texture texture_of(const std::function<glm::ivec4(int, int)>& texel, int size = 8)
{
    Texture texture;
    texture.name = "made up";
    texture.width = texture.height = size;
    texture.nearest = true;
    texture.mips.emplace_back();
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (int c = 0; c < 4; ++c) texture.mips[0].push_back(static_cast<std::byte>(texel(x, y)[c]));
        }
    }
    return texture;
}

// Weight of layer k in the k-th quarter from left to right.
Texture quarters()
{
    return texture_of([](int x, int) {
        glm::ivec4 weights(0);
        weights[x / 2] = 255;
        return weights;
    });
}

Texture even(const glm::ivec4& code)
{
    return texture_of([=](int, int) { return code; });
}

Frame from_above(std::vector<std::string> aovs)
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = std::move(aovs);
    return frame;
}

Primitive ground(std::uint32_t material = 0)
{
    return quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, material);
}

// Texture 0 is the control map.
Material layered(const glm::vec4& colors = kColors)
{
    Material m = plain_material(glm::vec3(colors.x), kRoughness.x);
    m.second.use = scene::SecondSetUse::Layers;
    m.second.mix_mask.texture = 0;
    m.second.color = glm::vec3(colors.y);
    m.second.roughness = kRoughness.y;
    m.second.third.color = glm::vec3(colors.z);
    m.second.third.roughness = kRoughness.z;
    m.second.fourth.color = glm::vec3(colors.w);
    m.second.fourth.roughness = kRoughness.w;
    return m;
}

class GroundLayers : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame, const std::vector<Texture>& textures)
    {
        renderer->load(scene, textures);
        return renderer->render(frame);
    }
};

TEST_F(GroundLayers, EachIsWhereItsWeightIs)
{
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        Frame frame = from_above({"base_color", "roughness"});
        frame.settings.surface_path = path;
        const auto r = shot(scene_of({ground()}, {layered()}), frame, {quarters()});
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(aov(r, "base_color", 6 + 12 * k, 20), kColors[k], 0.01f) << k;
            EXPECT_NEAR(aov(r, "roughness", 6 + 12 * k, 20), kRoughness[k], 0.01f) << k;
        }
    }
}

TEST_F(GroundLayers, WeightsAreShares)
{
    for (const glm::ivec4 codes : {glm::ivec4(60, 60, 60, 60), glm::ivec4(200, 100, 0, 0), glm::ivec4(30, 0, 5, 90)}) {
        const auto r = shot(scene_of({ground()}, {layered()}), from_above({"base_color"}), {even(codes)});
        const glm::vec4 w = glm::vec4(codes) / glm::dot(glm::vec4(codes), glm::vec4(1.0f));
        EXPECT_NEAR(aov(r, "base_color", 24, 24), glm::dot(w, kColors), 0.01f);
    }
    // Where nothing has weight the first is seen, not black.
    const auto none = shot(scene_of({ground()}, {layered()}), from_above({"base_color"}), {even(glm::ivec4(0))});
    EXPECT_NEAR(aov(none, "base_color", 24, 24), kColors.x, 0.01f);
}

// Blue of a layer's colour is its height; the first two may have maps of their own.
TEST_F(GroundLayers, WhatStandsHigherWinsWhereItIsAsked)
{
    Material m = layered(glm::vec4(1.0f));
    m.base_color_texture.texture = 1;
    m.second.third.base_color_texture.texture = 2;
    const std::vector<Texture> textures{even({127, 0, 127, 0}), even({60, 60, 60, 255}), even({180, 180, 180, 255})};
    m.second.by_height = 0.0f;
    EXPECT_NEAR(aov(shot(scene_of({ground()}, {m}), from_above({"base_color"}), textures), "base_color", 24, 24),
                0.5f * (60.0f + 180.0f) / 255.0f, 0.01f);
    m.second.by_height = 1.0f;
    EXPECT_NEAR(aov(shot(scene_of({ground()}, {m}), from_above({"base_color"}), textures), "base_color", 24, 24),
                180.0f / 255.0f, 0.02f);
    m.weather.height.texture = 2;  // now the first stands as high: even again
    EXPECT_NEAR(aov(shot(scene_of({ground()}, {m}), from_above({"base_color"}), textures), "base_color", 24, 24),
                0.5f * (60.0f + 180.0f) / 255.0f, 0.01f);
    const glm::vec4 shares = shared::ground_shares(glm::vec4(0.5f, 0.0f, 0.5f, 0.0f), glm::vec4(0.2f, 1.0f, 0.7f, 1.0f), 1.0f);
    EXPECT_EQ(shares.y, 0.0f) << "nothing of what has no weight";
    EXPECT_NEAR(shares.x + shares.z, 1.0f, 1e-6f);
}

TEST_F(GroundLayers, NormalsAndTilingAreOfTheLayer)
{
    Material m = layered();
    m.second.third.normal_texture.texture = 1;
    m.second.fourth.base_color_texture.texture = 2;
    m.second.fourth.tiling = glm::vec2(8.0f, 1.0f);
    const Texture stripes = texture_of([](int x, int) { return glm::ivec4(x < 4 ? 0 : 255); });
    const auto r = shot(scene_of({ground()}, {m}), from_above({"base_color", "normal"}),
                        {quarters(), even({200, 128, 230, 255}), stripes});
    const float lean = 2.0f * 200.0f / 255.0f - 1.0f;
    EXPECT_NEAR(aov(r, "normal", 30, 20, 0), lean, 0.02f);
    for (const int x : {6, 18, 42}) EXPECT_NEAR(aov(r, "normal", x, 20, 0), 0.0f, 0.01f) << x;
    // Eight repeats over the whole: two in the last quarter, so four edges in twelve pixels.
    int edges = 0;
    for (int x = 37; x < 48; ++x)
        edges += std::abs(aov(r, "base_color", x, 20) - aov(r, "base_color", x - 1, 20)) > 0.3f ? 1 : 0;
    EXPECT_GE(edges, 3);
    EXPECT_LE(edges, 4);
}

TEST_F(GroundLayers, FromAfarItIsOneColor)
{
    Material m = layered();
    m.second.far_texture.texture = 1;
    m.second.far_start_m = 10.0f;
    m.second.far_fade_m = 10.0f;
    Frame frame = from_above({"base_color"});
    const auto at = [&](float height_m) {
        frame.camera = look({0, height_m, 0}, {0, 0, 0});
        frame.camera.orthographic_height_m = 2.0f;
        return aov(shot(scene_of({ground()}, {m}), frame, {quarters(), even({230, 230, 230, 255})}), "base_color", 6, 24);
    };
    const float far = 230.0f / 255.0f;
    EXPECT_NEAR(at(2.0f), kColors.x, 0.01f);
    EXPECT_NEAR(at(15.0f), 0.5f * (kColors.x + far), 0.03f);
    EXPECT_NEAR(at(30.0f), far, 0.01f);
}

// What the bumps of layers lose to each other and from afar is roughness.
TEST_F(GroundLayers, LostSlopesAreRoughness)
{
    Material m = layered();
    m.second.third.normal_texture.texture = 1;
    m.second.fourth.normal_texture.texture = 2;
    m.second.third.roughness = m.second.fourth.roughness = 0.3f;
    m.second.far_texture.texture = 3;
    const float lean = 2.0f * 178.0f / 255.0f - 1.0f;
    const float slope_2 = lean * lean / (1.0f - lean * lean);
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        const auto seen = [&](const glm::ivec4& weights, float far_start_m) {
            m.second.far_start_m = far_start_m;
            m.second.far_fade_m = 0.0f;
            Frame frame = from_above({"normal", "roughness"});
            frame.settings.surface_path = path;
            const auto r = shot(scene_of({ground()}, {m}), frame,
                                {even(weights), even({178, 128, 230, 255}), even({77, 128, 230, 255}), even({90, 90, 90, 255})});
            return glm::vec2(aov(r, "normal", 24, 24, 0), aov(r, "roughness", 24, 24));
        };
        const glm::vec2 one = seen({0, 0, 255, 0}, 100.0f), both = seen({0, 0, 128, 128}, 100.0f), far = seen({0, 0, 255, 0}, 0.0f);
        EXPECT_NEAR(one.x, lean, 0.02f);
        EXPECT_NEAR(one.y, 0.3f, 0.01f) << "nothing is lost of what is seen";
        const float rough = std::pow(std::pow(0.3f, 4.0f) + slope_2, 0.25f);
        EXPECT_NEAR(both.x, 0.0f, 0.02f);
        EXPECT_NEAR(both.y, rough, 0.02f);
        EXPECT_NEAR(far.x, 0.0f, 0.01f);
        EXPECT_NEAR(far.y, rough, 0.02f);
    }
}

// So that a wet valley keeps its light where its bumps fade: over the whole of a highlight it is what the bumps mirrored.
TEST_F(GroundLayers, AHighlightKeepsItsLightFromAfar)
{
    // Bumps that lean in all directions, finer than the pixels are wide, so that samples see all of them.
    const Texture bumps = texture_of([](int x, int y) {
        const float angle = 6.2831853f * static_cast<float>((5 * x + 3 * y) % 8) / 8.0f;
        const float lean = 0.12f + 0.3f * static_cast<float>((3 * x + y) % 4) / 3.0f;
        return glm::ivec4(std::lround(127.5f * (1.0f + lean * std::cos(angle))), std::lround(127.5f * (1.0f + lean * std::sin(angle))), 230, 255);
    });
    Material m = layered(glm::vec4(0.0f));
    m.second.third.normal_texture.texture = 1;
    m.second.third.roughness = 0.25f;
    m.second.third.tiling = glm::vec2(48.0f);
    m.second.far_texture.texture = 2;
    m.second.far_fade_m = 0.0f;
    const auto light = [&](float far_start_m) {
        m.second.far_start_m = far_start_m;
        Frame frame;
        frame.camera = look({0, 1, 0}, {0, 0, 0}, 2.2f);
        frame.settings.width = frame.settings.height = kSize;
        frame.settings.samples = 16;
        frame.settings.aovs = {"specular_direct"};
        frame.sky.sun_elevation_rad = 1.5707f;
        frame.settings.shelter = false;
        const auto r = shot(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {m}), frame, {even({0, 0, 255, 0}), bumps, even({0, 0, 0, 255})});
        double sum = 0.0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) sum += static_cast<double>(aov(r, "specular_direct", x, y, 1));
        return sum;
    };
    const double near = light(1000.0f), far = light(0.0f);
    EXPECT_NEAR(far / near, 1.0, 0.3);
}

// Lux draws a terrain again for the next four layers; here their mesh is a decal on it.
TEST_F(GroundLayers, FourMoreLieOverThem)
{
    Material more = layered(glm::vec4(0.9f, 0.05f, 0.9f, 0.05f));
    more.second.mix_mask.texture = 1;
    more.alpha_mode = AlphaMode::Blend;
    more.decal.on = true;
    // Nothing, all of the first, half of the second, nothing.
    const Texture control = texture_of([](int x, int) {
        return x / 2 == 1 ? glm::ivec4(255, 0, 0, 0) : x / 2 == 2 ? glm::ivec4(0, 128, 0, 0) : glm::ivec4(0);
    });
    const auto r = shot(scene_of({ground(), ground(1)}, {layered(), more}), from_above({"base_color", "roughness"}),
                        {quarters(), control});
    EXPECT_NEAR(aov(r, "base_color", 6, 20), kColors.x, 0.02f);
    EXPECT_NEAR(aov(r, "base_color", 18, 20), 0.9f, 0.02f);
    EXPECT_NEAR(aov(r, "base_color", 30, 20), 0.5f * (kColors.z + 0.05f), 0.04f);
    EXPECT_NEAR(aov(r, "base_color", 42, 20), kColors.w, 0.02f);
    EXPECT_NEAR(aov(r, "roughness", 18, 20), kRoughness.x, 0.02f);
}

// Snow and water come to layers as to all ground, after what they are of.
TEST_F(GroundLayers, WeatherLiesOnAllOfThem)
{
    Frame frame = from_above({"snow", "base_color"});
    frame.weather.snow_amount = 1.0f;
    frame.weather.snow_start_height_m = -100.0f;
    const auto r = shot(scene_of({ground()}, {layered()}), frame, {quarters()});
    for (int k = 0; k < 4; ++k) {
        EXPECT_GT(aov(r, "snow", 6 + 12 * k, 20), 0.9f) << k;
        EXPECT_NEAR(aov(r, "base_color", 6 + 12 * k, 20), kColors[k], 0.01f) << "dry below it";
    }
}

}  // namespace
}  // namespace petrichor::gpu
