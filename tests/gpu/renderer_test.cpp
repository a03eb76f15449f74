// Whole small frames: laws of light and weather, determinism, light lists, bad input.
#include "tests/gpu/gpu_fixture.h"

#include <random>

namespace petrichor::gpu {
namespace {

constexpr float kGround = 6.0f;

Primitive ground(std::uint32_t material = 0)
{
    return quad({-kGround, 0, kGround}, {2 * kGround, 0, 0}, {0, 0, -2 * kGround}, material);
}

Frame small_frame(const Camera& camera, int width = 64, int height = 36, int samples = 2)
{
    Frame frame;
    frame.camera = camera;
    frame.settings.width = width;
    frame.settings.height = height;
    frame.settings.samples = samples;
    return frame;
}

shared::WeatherMoment downpour()
{
    shared::WeatherMoment w;
    w.rain = 1.0f;
    w.flood_cracks = 0.8f;
    w.flood_puddles = 1.0f;
    w.film_albedo = 0.85f;
    w.film_smoothness = 0.5f;
    return w;
}

shared::WeatherMoment deep_snow()
{
    shared::WeatherMoment w;
    w.snow_amount = 1.0f;
    w.water_to_snow = 1.0f;
    w.freeze_exp = 0.999f;
    return w;
}

class RendererTest : public GpuTest {};

// A white, rough, unshadowed plate under a constant sky sends out what it receives.
TEST_F(RendererTest, WhiteFurnace)
{
    for (const float roughness : {0.2f, 0.6f, 1.0f}) {
        for (const float metallic : {0.0f, 1.0f}) {
            renderer->load(
                scene_of({ground()}, {plain_material(glm::vec3(1.0f), roughness, metallic)}), {});
            renderer->set_environment(constant_environment(1.0f));
            Frame frame = small_frame(look({0, 3, 0.1f}, {0, 0, 0}, 0.4f));
            frame.sky.sun_illuminance = 0.0f;
            frame.settings.ambient_occlusion = false;
            frame.weather.visibility_m = 1e9f;
            const glm::vec3 out = pixel(renderer->render(frame), 32, 18);
            EXPECT_NEAR(out.g, 1.0f, 0.02f)
                << "roughness " << roughness << " metallic " << metallic;
        }
    }
}

// A Lambert plate facing a lone light: E rho / pi, and 1 / d^2.
TEST_F(RendererTest, PointLightFollowsTheInverseSquare)
{
    Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.5f), 1.0f)});
    Frame frame = small_frame(look({0, 5, 0.1f}, {0, 0, 0}, 0.2f), 33, 33, 1);
    frame.sky.analytic_sun = false;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    float seen[2];
    for (int i = 0; i < 2; ++i) {
        Light light;
        light.intensity = 100.0f;
        light.position_m = {0.0f, i == 0 ? 1.0f : 2.0f, 0.0f};
        scene.lights = {light};
        renderer->load(scene, {});
        seen[i] = pixel(renderer->render(frame), 16, 16).g;
    }
    EXPECT_NEAR(seen[0] / seen[1], 4.0f, 0.05f);
    EXPECT_NEAR(seen[1], 100.0f / 4.0f * 0.5f * 0.96f / 3.14159f, 0.35f);
}

TEST_F(RendererTest, ASunBehindAWallGivesShadow)
{
    const Primitive wall = quad({-kGround, 0, 1}, {2 * kGround, 0, 0}, {0, 4, 0});
    renderer->load(scene_of({ground(), wall}, {plain_material(glm::vec3(0.5f))}), {});
    Frame frame = small_frame(look({0, 6, 0.1f}, {0, 0, 0}, 0.9f), 64, 64, 4);
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = 0.6f;
    frame.sky.sun_azimuth_rad = 3.14159f;  // from +z: the wall stands between
    const float shadow = luminance(pixel(renderer->render(frame), 32, 24));
    frame.sky.sun_azimuth_rad = 0.0f;
    const float lit = luminance(pixel(renderer->render(frame), 32, 24));
    EXPECT_GT(lit, 5000.0f);
    EXPECT_LT(shadow, 0.01f * lit);
}

// A pane takes away as much light as it is opaque; rain falls past it as before.
TEST_F(RendererTest, ABlendedPaneCastsAPartOfAShadow)
{
    Material pane = plain_material(glm::vec3(0.5f));
    pane.alpha_mode = AlphaMode::Blend;
    const Primitive roof = quad({-2, 2, 2}, {4, 0, 0}, {0, 0, -4}, 1);
    float lit[3];
    const float alphas[] = {0.0f, 0.5f, 1.0f};
    for (int i = 0; i < 3; ++i) {
        pane.base_color.a = alphas[i];
        renderer->load(scene_of({ground(), roof}, {plain_material(glm::vec3(0.5f)), pane}), {});
        Frame frame = small_frame(look({0, 1.2f, 1.2f}, {0, 0, 0}, 0.3f), 32, 32, 16);
        frame.settings.image_based_light = false;
        frame.sky.sun_elevation_rad = 1.5f;
        const RenderResult result = renderer->render(frame);
        lit[i] = 0.0f;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) lit[i] += luminance(pixel(result, x, y)) / 1024.0f;
        }
    }
    EXPECT_NEAR(lit[1] / lit[0], 0.5f, 0.06f);
    EXPECT_LT(lit[2], 0.02f * lit[0]);
}

TEST_F(RendererTest, RainDarkensPorousGroundAndSnowBrightensIt)
{
    Material porous = plain_material(glm::vec3(0.35f), 0.9f);
    renderer->load(scene_of({ground()}, {porous}), {});
    Frame frame = small_frame(look({0, 4, 0.1f}, {0, 0, 0}, 0.5f));
    const float dry = luminance(pixel(renderer->render(frame), 32, 18));
    frame.weather.film_albedo = 0.85f;
    frame.weather.film_smoothness = 0.5f;
    const float wet = luminance(pixel(renderer->render(frame), 32, 18));
    frame.weather = deep_snow();
    const float snowy = luminance(pixel(renderer->render(frame), 32, 18));
    EXPECT_LT(wet, 0.78f * dry);  // 0.35 below a film: 0.21 (Lekner & Dorf 1988)
    EXPECT_GT(wet, 0.45f * dry);
    EXPECT_GT(snowy, 1.8f * dry);
}

TEST_F(RendererTest, ARoofKeepsTheGroundDryAndFreeOfSnow)
{
    const Primitive roof = quad({-kGround, 2, 0}, {2 * kGround, 0, 0}, {0, 0, -kGround});
    renderer->load(scene_of({ground(), roof}, {plain_material(glm::vec3(0.4f))}), {});
    Frame frame = small_frame(look({0, 1.0f, 5}, {0, 0.2f, 0}, 1.2f), 64, 64);
    frame.settings.aovs = {"film", "water", "snow", "position"};
    frame.weather = downpour();
    RenderResult rain = renderer->render(frame);
    frame.weather = deep_snow();
    RenderResult snow = renderer->render(frame);
    int open = 0;
    int sheltered = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (aov(rain, "position", x, y, 1) > 0.1f) continue;            // the roof itself
            if (std::abs(aov(rain, "position", x, y, 0)) > 4.5f) continue;  // the ends of the roof
            const float z = aov(rain, "position", x, y, 2);
            // Drops and flakes come from up to 40 degrees beside the vertical.
            if (z > 2.0f && z < 5.0f) {
                ++open;
                EXPECT_GT(aov(rain, "film", x, y), 0.9f) << x << " " << y;
                EXPECT_GT(aov(snow, "snow", x, y), 0.5f) << x << " " << y;
            } else if (z < -2.0f && z > -5.0f) {
                ++sheltered;
                EXPECT_EQ(aov(rain, "film", x, y), 0.0f) << x << " " << y;
                EXPECT_EQ(aov(rain, "water", x, y), 0.0f) << x << " " << y;
                EXPECT_EQ(aov(snow, "snow", x, y), 0.0f) << x << " " << y;
            }
        }
    }
    EXPECT_GT(open, 50);
    EXPECT_GT(sheltered, 50);
}

TEST_F(RendererTest, SnowGrowsWithTheAmount)
{
    renderer->load(scene_of({ground()}, {plain_material(glm::vec3(0.4f))}), {});
    Frame frame = small_frame(look({0, 4, 0.1f}, {0, 0, 0}, 0.5f));
    frame.settings.aovs = {"snow"};
    float before = -1.0f;
    for (const float amount : {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
        frame.weather.snow_amount = amount;
        const RenderResult result = renderer->render(frame);
        float mean = 0.0f;
        for (const float v : result.aovs[0].pixels) mean += v;
        mean /= static_cast<float>(result.aovs[0].pixels.size());
        EXPECT_GE(mean, before);
        before = mean;
    }
    EXPECT_GT(before, 0.98f);
}

// Snow and rain in one picture; each number of the look is turned, and its picture is another.
TEST_F(RendererTest, EveryNumberOfTheLookChangesThePicture)
{
    Material stone = plain_material(glm::vec3(0.3f), 0.7f);
    stone.weather.default_height = 0.0f;
    stone.weather.snow_detail_strength = 1.0f;
    stone.base_color_texture.texture =
        0;  // what lies below the rings must differ from place to place
    // Of two hectares, so that its colour varies over the land.
    Scene scene = scene_of({ground(), quad({-100, 0, -10}, {200, 0, 0}, {0, 0, -200})}, {stone});
    scene.textures.resize(1);
    Texture stripes;
    stripes.width = stripes.height = 64;
    stripes.mips.emplace_back(64 * 64 * 4, std::byte{255});
    for (std::size_t i = 0; i < stripes.mips[0].size(); ++i) {
        if (i % 4 != 3 && i / 4 % 2 == 0) stripes.mips[0][i] = std::byte{40};
    }
    renderer->load(scene, {stripes});
    Frame rain = small_frame(look({0, 1.2f, 3}, {0, 0, 0}));
    rain.weather = downpour();
    rain.settings.time_s = 1.3;
    Frame snow = rain;
    snow.weather = deep_snow();
    snow.weather.snow_amount = 0.6f;
    snow.weather.snow_start_height_m = -0.5f;  // the line runs over the ground
    snow.weather.snow_height_blend_m = 1.0f;
    snow.look.snow_scatter_color = glm::vec3(0.2f);
    const std::size_t numbers = sizeof(shared::WeatherLook) / sizeof(float);
    const auto rain_before = renderer->render(rain).beauty;
    const auto snow_before = renderer->render(snow).beauty;
    for (std::size_t i = 0; i < numbers; ++i) {
        Frame changed[] = {rain, snow};
        for (Frame& frame : changed) {
            float* look_numbers = reinterpret_cast<float*>(&frame.look);
            // The distance of detail comes before the camera, its fade beyond the scene.
            const float old = look_numbers[i];
            look_numbers[i] =
                old > 10.0f ? (old > 20.0f ? 3.2f : 60.0f) : old > 0.0f ? old * 2.5f : 0.4f;
        }
        EXPECT_TRUE(renderer->render(changed[0]).beauty != rain_before ||
                    renderer->render(changed[1]).beauty != snow_before)
            << "number " << i << " of WeatherLook";
    }
}

TEST_F(RendererTest, RingsHaveTheTexelsThatAreAskedFor)
{
    Renderer coarse({.device = "", .validation = true, .ripple_texture_size = 64});
    Frame frame = small_frame(look({0, 1.2f, 3}, {0, 0, 0}));
    frame.weather = downpour();
    Material stone = plain_material(glm::vec3(0.3f), 0.7f);
    stone.weather.default_height = 0.0f;
    const Scene scene = scene_of({ground()}, {stone});
    renderer->load(scene, {});
    coarse.load(scene, {});
    EXPECT_NE(renderer->render(frame).beauty, coarse.render(frame).beauty);
    EXPECT_TRUE(coarse.validation_messages().empty());
}

// A frame never depends on what was rendered before it.
TEST_F(RendererTest, AFrameAloneIsTheFrameOfASequence)
{
    const Primitive wall = quad({-kGround, 0, -3}, {2 * kGround, 0, 0}, {0, 4, 0});
    const Scene scene = scene_of({ground(), wall}, {plain_material(glm::vec3(0.4f))});
    const auto frame_at = [&](int i) {
        Frame frame = small_frame(look({0.1f * static_cast<float>(i), 2, 5}, {0, 0, 0}), 64, 36, 4);
        frame.weather = i < 2 ? downpour() : deep_snow();
        frame.sky.cloud_cover = 0.3f;
        frame.sky.sun_elevation_rad = 0.8f - 0.1f * static_cast<float>(i);
        frame.settings.time_s = 0.5 * i;
        return frame;
    };
    renderer->load(scene, {});
    RenderResult last;
    for (int i = 0; i < 4; ++i) last = renderer->render(frame_at(i));
    Renderer fresh(RendererOptions{});
    fresh.load(scene, {});
    const RenderResult alone = fresh.render(frame_at(3));
    EXPECT_EQ(alone.beauty, last.beauty);
    EXPECT_EQ(alone.display, last.display);
    EXPECT_EQ(alone.exposure, last.exposure);
}

// Of the sky only what a picture shows is drawn as fine as it is shown.
TEST_F(RendererTest, ATurnedCameraSeesAllOfItsSky)
{
    const Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.4f))});
    const auto toward = [&](const glm::vec3& way, bool fog) {
        Frame frame = small_frame(look({0, 2, 5}, glm::vec3(0, 2, 5) + way), 96, 54, 2);
        frame.sky.cloud_cover = 0.5f;
        frame.sky.sun_elevation_rad = 0.6f;
        if (fog) frame.fog.mode = FogMode::Metres;
        return frame;
    };
    renderer->load(scene, {});
    std::vector<Frame> frames;
    for (const bool fog : {false, true})
        for (const glm::vec3 way : {glm::vec3(0, 0.4f, -1), glm::vec3(1, 0.1f, 0.2f), glm::vec3(-0.6f, 2, 1), glm::vec3(0.3f, -0.6f, 1)})
            frames.push_back(toward(way, fog));
    frames.push_back(frames.front());
    for (const Frame& frame : frames) {
        const RenderResult after = renderer->render(frame);
        Renderer fresh(RendererOptions{});
        fresh.load(scene, {});
        const RenderResult alone = fresh.render(frame);
        EXPECT_EQ(alone.beauty, after.beauty);
        // Light does not depend on where one looks.
        EXPECT_EQ(alone.exposure, after.exposure);
    }
}

// No light that reaches a pixel is missing from its list, and sums keep their order: the same bits
// as asking every light.
TEST_F(RendererTest, LightListsLoseNothing)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    Scene scene = scene_of({ground(), quad({-kGround, 0, -3}, {2 * kGround, 0, 0}, {0, 4, 0})},
                           {plain_material(glm::vec3(0.6f), 0.3f)});
    for (int i = 0; i < 200; ++i) {
        Light light;
        light.kind = i % 3 == 0 ? LightKind::Spot : LightKind::Point;
        light.color = {unit(random), unit(random), unit(random)};
        light.intensity = 1.0f + 4.0f * unit(random);
        light.range_m = 0.3f + 2.0f * unit(random);
        light.position_m = {10.0f * (unit(random) - 0.5f), 2.0f * unit(random),
                            10.0f * (unit(random) - 0.5f)};
        scene.lights.push_back(light);
    }
    renderer->load(scene, {});
    for (const bool orthographic : {false, true}) {
        Frame frame = small_frame(look({1, 2, 5}, {0, 0.5f, 0}), 200, 120, 2);
        if (orthographic) frame.camera.orthographic_height_m = 6.0f;
        frame.sky.analytic_sun = false;
        frame.settings.image_based_light = false;
        const RenderResult listed = renderer->render(frame);
        frame.settings.all_lights = true;
        const RenderResult brute = renderer->render(frame);
        EXPECT_EQ(listed.beauty, brute.beauty) << (orthographic ? "orthographic" : "perspective");
        EXPECT_GT(luminance(pixel(listed, 100, 90)), 0.0f);
    }
}

// Far more lights on one spot than a fixed list would hold.
TEST_F(RendererTest, NoLightIsDroppedWhereManyMeet)
{
    Scene scene = scene_of({ground()}, {plain_material(glm::vec3(0.6f), 0.5f)});
    for (int i = 0; i < 900; ++i) {
        Light light;
        light.intensity = 1.0f;
        light.range_m = 20.0f;
        light.position_m = {0.004f * static_cast<float>(i % 30), 2.0f,
                            0.004f * static_cast<float>(i / 30)};
        scene.lights.push_back(light);
    }
    renderer->load(scene, {});
    Frame frame = small_frame(look({0, 3, 2}, {0, 0, 0}), 48, 32, 1);
    frame.sky.analytic_sun = false;
    frame.settings.image_based_light = false;
    const RenderResult listed = renderer->render(frame);
    frame.settings.all_lights = true;
    const RenderResult brute = renderer->render(frame);
    EXPECT_EQ(listed.beauty, brute.beauty);
    EXPECT_GT(pixel(listed, 24, 16).g, 255 * 0.6f / 3.14159f / 4.0f) << "more than 255 lamps";
    scene.lights.resize(60001, scene.lights[0]);
    renderer->load(scene, {});
    frame.settings.all_lights = false;
    EXPECT_THROW(renderer->render(frame), Error);
}

// The index of refraction of a dielectric decides how much it mirrors: ((n - 1) / (n + 1))^2.
TEST_F(RendererTest, AHigherIndexOfRefractionMirrorsMore)
{
    float mirrored[3];
    int i = 0;
    for (const float ior : {1.33f, 1.5f, 2.0f}) {
        Material black = plain_material(glm::vec3(0.0f), 0.05f);
        black.ior = ior;
        renderer->load(scene_of({ground()}, {black}), {});
        renderer->set_environment(constant_environment(1.0f));
        Frame frame = small_frame(look({0, 3, 0.1f}, {0, 0, 0}, 0.4f));
        frame.sky.sun_illuminance = 0.0f;
        frame.settings.ambient_occlusion = false;
        frame.weather.visibility_m = 1e9f;
        mirrored[i++] = pixel(renderer->render(frame), 32, 18).g;
    }
    EXPECT_NEAR(mirrored[0], 0.0201f, 0.003f);
    EXPECT_NEAR(mirrored[1], 0.04f, 0.003f);
    EXPECT_NEAR(mirrored[2], 0.111f, 0.005f);
}

// Snow hides a lamp by the opacity of its material.
TEST_F(RendererTest, SnowDimsWhatGlows)
{
    Material lamp = plain_material(glm::vec3(0.0f));
    lamp.emissive = glm::vec3(10.0f);
    float seen[2];
    for (int i = 0; i < 2; ++i) {
        lamp.weather.snow_opacity = i == 0 ? 0.2f : 0.9f;
        renderer->load(scene_of({ground()}, {lamp}), {});
        Frame frame = small_frame(look({0, 4, 0.1f}, {0, 0, 0}, 0.5f));
        frame.settings.image_based_light = false;
        frame.sky.sun_illuminance = 0.0f;
        frame.weather = deep_snow();
        seen[i] = pixel(renderer->render(frame), 32, 18).g;
    }
    EXPECT_NEAR(seen[0], 8.0f, 0.2f);
    EXPECT_NEAR(seen[1], 1.0f, 0.2f);
}

// The picture is right way up and right way round.
TEST_F(RendererTest, AxesAreWhereTheyBelong)
{
    const Primitive right_up = quad({1, 1, 0}, {1, 0, 0}, {0, 1, 0}, 1);
    renderer->load(scene_of({ground(), right_up},
                            {plain_material(glm::vec3(0.2f)), plain_material(glm::vec3(1, 0, 0))}),
                   {});
    Frame frame = small_frame(look({0, 1, 6}, {0, 1, 0}, 0.9f), 90, 60);
    frame.settings.aovs = {"base_color", "depth", "normal"};
    const RenderResult r = renderer->render(frame);
    EXPECT_GT(aov(r, "base_color", 60, 25, 0), 0.9f) << "a red plate right of and above the centre";
    EXPECT_NEAR(aov(r, "depth", 60, 25), 6.0f, 1e-3f);
    EXPECT_NEAR(aov(r, "normal", 60, 25, 2), 1.0f, 1e-3f);
    EXPECT_TRUE(std::isinf(aov(r, "depth", 20, 5))) << "sky";
    EXPECT_GT(aov(r, "normal", 45, 55, 1), 0.99f) << "ground below";
}

TEST_F(RendererTest, BadFramesAreRefused)
{
    renderer->load(scene_of({ground()}, {plain_material(glm::vec3(0.5f))}), {});
    const Frame good = small_frame(look({0, 2, 5}, {0, 0, 0}));
    const auto refused = [&](auto change) {
        Frame frame = good;
        change(frame);
        EXPECT_THROW(renderer->render(frame), Error);
    };
    refused([](Frame& f) { f.settings.width = 0; });
    refused([](Frame& f) { f.settings.height = 1 << 20; });
    refused([](Frame& f) { f.settings.samples = 0; });
    refused([](Frame& f) { f.settings.aovs = {"weight"}; });
    refused([](Frame& f) { f.camera.vertical_fov_rad = 4.0f; });
    refused([](Frame& f) { f.camera.near_m = 0.0f; });
    refused([](Frame& f) { f.sky.sun_elevation_rad = NAN; });
    EXPECT_NO_THROW(renderer->render(good));
    Renderer empty(RendererOptions{});
    EXPECT_THROW(empty.render(good), Error);
}

TEST_F(RendererTest, AnUnknownDeviceIsRefusedByName)
{
    try {
        Renderer none(RendererOptions{.device = "no such device", .validation = false});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no such device"), std::string::npos);
    }
}

// An empty scene is a picture of the sky.
TEST_F(RendererTest, AnEmptySceneShowsTheSky)
{
    renderer->load(scene_of({}, {plain_material(glm::vec3(0.5f))}), {});
    const RenderResult r = renderer->render(small_frame(look({0, 1, 0}, {0, 1.5f, -1})));
    EXPECT_GT(pixel(r, 32, 10).b, pixel(r, 32, 10).r);
}

}  // namespace
}  // namespace petrichor::gpu
