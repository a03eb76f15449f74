// Rules and maps of snow that a material chooses.
#include <algorithm>
#include <cmath>
#include <functional>

#include "formulas/weather/apply_weather.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 48;

class SnowRules : public GpuTest {
protected:
    RenderResult shot(const Scene& scene, const Frame& frame, const std::vector<Texture>& textures = {})
    {
        renderer->load(scene, textures);
        return renderer->render(frame);
    }
};

Texture even(glm::ivec4 code)
{
    Texture texture;
    texture.name = "even";
    texture.width = texture.height = 4;
    texture.mips.emplace_back();
    for (int i = 0; i < 64; ++i) texture.mips[0].push_back(static_cast<std::byte>(code[i % 4]));
    return texture;
}

Frame from_above(std::vector<std::string> aovs, float amount)
{
    Frame frame;
    frame.camera = look({0, 2, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.0f;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = std::move(aovs);
    frame.settings.shelter = false;
    frame.weather.snow_amount = amount;
    frame.weather.water_to_snow = amount;
    return frame;
}

Primitive ground(float uv_scale = 1.0f)
{
    Primitive p = quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    for (glm::vec2& uv : p.uv0) uv *= uv_scale;
    return p;
}

float mean(const RenderResult& r, const std::string& name, int channel = 0)
{
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) sum += static_cast<double>(aov(r, name, x, y, channel));
    }
    return static_cast<float>(sum / (kSize * kSize));
}

// On blades it lies whatever their slope, and thicker where the vertices are light: at the tips.
TEST_F(SnowRules, GrassGetsItAtItsTips)
{
    Primitive blade = quad({-1, 0, 0}, {2, 0, 0}, {0, 2, 0});
    blade.colors = {{0.1f, 1, 1, 1}, {0.1f, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}};
    Material m = plain_material(glm::vec3(0.3f));
    Frame frame = from_above({"snow"}, 0.8f);
    frame.camera = look({0, 1, 2}, {0, 1, 0});
    frame.camera.orthographic_height_m = 2.0f;
    EXPECT_EQ(mean(shot(scene_of({blade}, {m}), frame), "snow"), 0.0f) << "none on a wall";
    m.weather.snow_rule = scene::SnowRule::Grass;
    const auto r = shot(scene_of({blade}, {m}), frame);
    float tip = 0.0f, root = 0.0f;
    for (int x = 0; x < kSize; ++x) {
        tip += aov(r, "snow", x, 2) / kSize;
        root += aov(r, "snow", x, kSize - 3) / kSize;
    }
    EXPECT_GT(tip, 0.3f);
    EXPECT_LT(root, 0.1f * tip);
    m.weather.snow_accumulation = {0.0f, 0.0f};
    EXPECT_EQ(mean(shot(scene_of({blade}, {m}), frame), "snow"), 0.0f);
}

TEST_F(SnowRules, OfVerticesKnowNoMaskAndNoHeight)
{
    Material m = plain_material(glm::vec3(0.3f));
    m.weather.snow_mask.texture = 0;
    Frame frame = from_above({"snow"}, 1.0f);
    frame.weather.snow_start_height_m = 100.0f;
    const std::vector<Texture> none{even({0, 0, 0, 0})};
    EXPECT_EQ(mean(shot(scene_of({ground()}, {m}), frame, none), "snow"), 0.0f);
    m.weather.snow_rule = scene::SnowRule::Vertex;
    EXPECT_GT(mean(shot(scene_of({ground()}, {m}), frame, none), "snow"), 0.95f);
    // The steeper the less, by Lux's other law of the slope.
    EXPECT_FLOAT_EQ(shared::snow_cover_of_vertices(0.5f, 0.2f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f).snow,
              shared::snow_cover_of_slope(0.075f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f).snow);
}

// Smoothed normals at the upper edge of a wall look half up, and yet it is a wall: no streaks run down from there.
TEST_F(SnowRules, AWallIsBareWhateverItsNormalsSay)
{
    Frame frame = from_above({"snow"}, 0.8f);
    frame.camera = look({0, 1, 2}, {0, 1, 0});
    frame.camera.orthographic_height_m = 2.0f;
    const Material m = plain_material(glm::vec3(0.3f));
    const auto leaning = [&](float back_m) {
        Primitive p = quad({-1, 0, back_m}, {2, 0, 0}, {0, 2, -2.0f * back_m});
        p.normals.assign(4, glm::normalize(glm::vec3(0, 0.75f, 0.66f)));
        return mean(shot(scene_of({p}, {m}), frame), "snow");
    };
    EXPECT_EQ(leaning(0.0f), 0.0f);
    EXPECT_GT(leaning(0.8f), 0.2f) << "a slope with these normals is none";
}

// What of the relief of a wall looks up, as tops of its stones, holds it; the same map on level ground takes nothing away.
TEST_F(SnowRules, LiesOnTheLedgesOfAWall)
{
    Frame frame = from_above({"snow"}, 0.8f);
    frame.camera = look({0, 1, 2}, {0, 1, 0});
    frame.camera.orthographic_height_m = 2.0f;
    Material m = plain_material(glm::vec3(0.3f));
    m.normal_texture = {.texture = 0};
    const auto of = [&](int green, int blue) {
        return mean(shot(scene_of({quad({-1, 0, 0}, {2, 0, 0}, {0, 2, 0})}, {m}), frame, {even({128, green, blue, 255})}), "snow");
    };
    EXPECT_EQ(of(128, 255), 0.0f);
    EXPECT_EQ(of(12, 186), 0.0f) << "what looks down";
    EXPECT_GT(of(244, 186), 0.2f) << "what looks up";
}

// Local maps move with the texture coordinates and not with the world; those of the world the other
// way round.
TEST_F(SnowRules, MapsLieInTheWorldOrOnTheSurface)
{
    const Frame frame = from_above({"snow", "cover_normal"}, 0.5f);
    Material m = plain_material(glm::vec3(0.3f));
    const auto of = [&](scene::SnowMapping mapping, float uv_scale, float moved_m) {
        m.weather.snow_mapping = mapping;
        Scene scene = scene_of({ground(uv_scale)}, {m});
        Frame there = frame;
        scene.instances[0].to_world = glm::translate(glm::mat4(1.0f), glm::vec3(moved_m, 0, 0));
        there.camera.to_world = scene.instances[0].to_world * there.camera.to_world;
        const auto r = shot(scene, there);
        std::vector<float> seen;
        for (int i = 0; i < kSize; ++i) {
            for (const char* name : {"snow", "cover_normal"}) seen.push_back(aov(r, name, i, 21));
        }
        return seen;
    };
    const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
        float most = 0.0f;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
        return most;
    };
    const auto local = of(scene::SnowMapping::Local, 1.0f, 0.0f);
    EXPECT_LT(apart(local, of(scene::SnowMapping::Local, 1.0f, 3.7f)), 0.02f);
    EXPECT_GT(apart(local, of(scene::SnowMapping::Local, 2.3f, 0.0f)), 0.05f);
    const auto world = of(scene::SnowMapping::World, 1.0f, 0.0f);
    EXPECT_EQ(world, of(scene::SnowMapping::World, 2.3f, 0.0f));
    EXPECT_GT(apart(world, of(scene::SnowMapping::World, 1.0f, 3.7f)), 0.05f);
}

// What is trodden into the snow has a normal of its own where the mask is low, while it is cold.
TEST_F(SnowRules, TheMaskHasANormalOfItsOwn)
{
    Material m = plain_material(glm::vec3(0.3f));
    m.weather.snow_mask.texture = 0;
    m.weather.snow_mask_normal.texture = 1;
    m.weather.snow_normal_strength = m.weather.snow_detail_strength = 0.0f;
    const Texture lean = even({210, 128, 255, 255});
    Frame frame = from_above({"cover_normal", "snow"}, 1.0f);
    const auto leaning = [&](int mask) {
        return mean(shot(scene_of({ground()}, {m}), frame, {even({mask, mask, mask, 255}), lean}),
                    "cover_normal");
    };
    const float all = 2.0f * 210.0f / 255.0f - 1.0f;
    EXPECT_NEAR(leaning(255), 0.0f, 0.01f);
    EXPECT_NEAR(leaning(30), all, 0.08f);
    const float half = leaning(128);
    EXPECT_GT(half, 0.15f);
    EXPECT_LT(half, all - 0.1f);
    frame.weather.water_to_snow = 0.0f;
    EXPECT_NEAR(leaning(30), 0.0f, 0.01f) << "lost as it melts";
}

// Where something went, snow is thinner and leans; other heights of the world do not know of it.
TEST_F(SnowRules, WhatIsTroddenIsThinnerAndHasASlope)
{
    WeatherMaps maps;
    maps.tracks.width = maps.tracks.height = 64;
    maps.tracks.texel_m = 4.0f / 64.0f;
    maps.tracks.corner_m = {-2.0f, -2.0f};
    maps.tracks.low_m = -0.5f;
    maps.tracks.high_m = 0.5f;
    for (int i = 0; i < 64 * 64; ++i) {  // the right half is pressed and rises along x
        const bool right = i % 64 >= 32;
        for (const int byte : {right ? 200 : 0, right ? 160 : 128, 128, 255})
            maps.tracks.rgba.push_back(static_cast<std::byte>(byte));
    }
    Renderer own({.device = "", .validation = true}, maps);
    Material m = plain_material(glm::vec3(0.3f));
    m.weather.snow_normal_strength = m.weather.snow_detail_strength = 0.0f;
    const auto seen = [&](float amount, float y) {
        Primitive p = ground();
        for (glm::vec3& position : p.positions) position.y = y;
        own.load(scene_of({p}, {m}), {});
        Frame frame = from_above({"snow", "cover_normal"}, amount);
        frame.camera = look({0, y + 2, 0}, {0, y, 0});
        frame.camera.orthographic_height_m = 2.0f;
        return own.render(frame);
    };
    const auto half = [](const RenderResult& r, const char* name, bool right) {
        float sum = 0.0f;
        for (int y = 0; y < kSize; ++y) {
            for (int x = right ? 30 : 0; x < (right ? kSize : 18); ++x) sum += aov(r, name, x, y);
        }
        return sum / (18.0f * kSize);
    };
    const auto thin = seen(0.5f, 0.0f);
    EXPECT_LT(half(thin, "snow", true), 0.3f * half(thin, "snow", false));
    const auto deep = seen(1.0f, 0.0f);
    EXPECT_GT(half(deep, "snow", true), 0.6f);
    EXPECT_LT(half(deep, "cover_normal", true), -0.2f);
    EXPECT_NEAR(half(deep, "cover_normal", false), 0.0f, 0.02f);
    const auto elsewhere = seen(1.0f, 3.0f);
    EXPECT_NEAR(half(elsewhere, "cover_normal", true), 0.0f, 0.02f);
    EXPECT_TRUE(own.validation_messages().empty());
}

// Smoothness comes from the map of the snow, a user's own included.
TEST_F(SnowRules, SmoothnessComesFromTheMap)
{
    const Material m = plain_material(glm::vec3(0.3f));
    const Frame frame = from_above({"roughness"}, 1.0f);
    const auto highlight = [&](int smoothness) {
        WeatherMaps maps;
        maps.snow.size = 16;
        for (int i = 0; i < 16 * 16; ++i) {
            for (const int byte : {128, 128, 255, smoothness})
                maps.snow.rgba.push_back(static_cast<std::byte>(byte));
        }
        Renderer own({.device = "", .validation = true}, maps);
        own.load(scene_of({ground()}, {m}), {});
        Frame sunny = frame;
        sunny.settings.exposure = 1.0f;
        sunny.sky.sun_elevation_rad = 1.5707f;  // mirrored to the eye
        const auto r = own.render(sunny);
        EXPECT_TRUE(own.validation_messages().empty());
        float most = 0.0f;
        for (int i = 0; i < kSize; ++i) most = std::max(most, luminance(pixel(r, i, kSize / 2)));
        return most;
    };
    EXPECT_GT(std::abs(highlight(250) / highlight(20) - 1.0f), 0.02f);
}

// Snow fills a relief as it grows: at last the ground is seen where the geometry is.
TEST_F(SnowRules, SnowLiftsWhatIsSeenOverParallax)
{
    Texture ramp = even({0, 0, 0, 255});
    ramp.width = ramp.height = 64;
    ramp.mips[0].clear();
    for (int i = 0; i < 64 * 64; ++i) {
        for (const int byte : {4 * (i % 64), 4 * (i % 64), 4 * (i % 64), 255})
            ramp.mips[0].push_back(static_cast<std::byte>(byte));
    }
    const auto seen = [&](scene::Parallax parallax, float amount) {
        Material m = plain_material(glm::vec3(1.0f));
        m.base_color_texture.texture = 0;
        m.base_color_texture.scale = glm::vec2(2.0f);
        m.weather.height.texture = 1;
        m.weather.parallax = parallax;
        m.weather.height_scale_m = 0.4f;
        Frame frame = from_above({"base_color"}, amount);
        frame.camera = look({0.9f, 2.6f, 0.0f}, {0, 0, 0}, 0.25f);
        return shot(scene_of({quad({-1.5f, 0, 2}, {4, 0, 0}, {0, 0, -4})}, {m}), frame,
                    {ramp, even({0, 0, 0, 255})});
    };
    const auto apart = [](const RenderResult& a, const RenderResult& b) {
        double sum = 0.0;
        for (int x = 0; x < kSize; ++x) {
            sum += std::abs(static_cast<double>(aov(a, "base_color", x, 24) -
                                                aov(b, "base_color", x, 24)));
        }
        return sum / kSize;
    };
    const auto flat = seen(scene::Parallax::None, 0.0f);
    const double bare = apart(seen(scene::Parallax::Occlusion, 0.0f), flat);
    const double thin = apart(seen(scene::Parallax::Occlusion, 0.5f), flat);
    const double deep = apart(seen(scene::Parallax::Occlusion, 1.0f), flat);
    EXPECT_GT(bare, 0.05);
    EXPECT_LT(thin, 0.8 * bare);
    EXPECT_LT(deep, 0.01);
}

// Around snow that melts the ground is wet; while it is cold it is not.
TEST_F(SnowRules, MeltingSnowWetsTheGround)
{
    const Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.3f))});
    Frame frame = from_above({"water", "snow"}, 0.35f);
    EXPECT_EQ(mean(shot(scene, frame), "water"), 0.0f);
    frame.weather.melt = frame.weather.melt_exp = 1.0f;
    const auto melting = shot(scene, frame);
    float beside = 0.0f;  // wettest bare ground
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (aov(melting, "snow", x, y) < 0.05f)
                beside = std::max(beside, aov(melting, "water", x, y));
        }
    }
    EXPECT_GT(mean(melting, "water"), 0.1f);
    EXPECT_GT(beside, 0.2f);
}

// Snow is brighter towards grazing eyes by its scatter, and only snow is.
TEST_F(SnowRules, SnowScattersTowardsGrazingEyes)
{
    const Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.3f))});
    const auto ratio = [&](float height_m, float amount) {
        Frame frame = from_above({}, amount);
        frame.camera = look({0, height_m, 2}, {0, 0, 0}, 0.2f);
        frame.settings.exposure = 1.0f;
        const float without = luminance(pixel(shot(scene, frame), kSize / 2, kSize / 2));
        frame.look.snow_scatter_color = glm::vec3(0.3f);
        return luminance(pixel(shot(scene, frame), kSize / 2, kSize / 2)) / without;
    };
    EXPECT_NEAR(ratio(8.0f, 1.0f), 1.0f, 0.02f);
    EXPECT_GT(ratio(0.5f, 1.0f), 1.1f);
    EXPECT_EQ(ratio(0.5f, 0.0f), 1.0f);
    shared::WeatherLook look;
    look.snow_scatter_color = glm::vec3(1.0f);
    look.snow_scatter_bias = 0.25f;
    look.snow_scatter_contraction = 2.0f;
    EXPECT_FLOAT_EQ(shared::snow_scattered(glm::vec3(0.5f), look, 0.5f, 1.0f).x,
                    0.5f + std::exp2(-0.5f) + 0.25f);
}

}  // namespace
}  // namespace petrichor::gpu
