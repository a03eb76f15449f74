// Skin, hair, fibres, light that comes through, painted grounds: in pictures of one plate or ball.
#include <cmath>

#include "formulas/light/other_lobes.h"
#include "formulas/light/skin.h"
#include "tests/gpu/ball.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using LightModels = GpuTest;

constexpr float kLux = 1000.0f;

Light sun(const glm::vec3& from)
{
    Light light;
    light.kind = LightKind::Directional;
    light.intensity = kLux;
    light.direction = -glm::normalize(from);
    return light;
}

// The ball from the front under one light of kLux and nothing else; 4 cm a pixel.
Frame of_ball(const glm::vec3& from)
{
    Frame frame;
    frame.camera = look({0, 0, 5}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.56f;
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1.0f;
    frame.sky.analytic_sun = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.weather.visibility_m = 1e9f;
    frame.extra_lights = {sun({0, 0, 1}), sun(from)};
    frame.extra_lights[0].intensity = 0.0f;
    return frame;
}

glm::vec3 seen(const RenderResult& r, float x, float y)
{
    return pixel(r, static_cast<int>(32.0f + 25.0f * x), static_cast<int>(32.0f - 25.0f * y));
}

TEST_F(LightModels, SkinBleedsRedPastTheTerminatorAndOnlyThere)
{
    Material skin = plain_material(glm::vec3(0.6f), 1.0f);
    skin.specular = 0.0f;
    const Frame frame = of_ball({1, 0, 0});
    renderer->load(scene_of({ball()}, {skin}), {});
    const RenderResult plain = renderer->render(frame);
    skin.lighting_model = "skin";
    skin.skin_curvature = 1.0f;
    renderer->load(scene_of({ball()}, {skin}), {});
    const RenderResult round = renderer->render(frame);
    EXPECT_EQ(seen(plain, -0.2f, 0.0f).r, 0.0f);
    const glm::vec3 past = seen(round, -0.2f, 0.0f);
    const float nl = -0.18f;  // of the pixel's middle
    EXPECT_NEAR(past.r, 0.6f / 3.14159f * kLux * shared::skin_ring(nl, 1.0f).x, 2.0f);
    EXPECT_GT(past.r, 5.0f * past.b);
    const glm::vec3 lit = seen(round, 0.8f, 0.0f), before = seen(plain, 0.8f, 0.0f);
    EXPECT_NEAR(lit.g, before.g, 0.05f * before.g);
    skin.skin_curvature = 0.0f;
    renderer->load(scene_of({ball()}, {skin}), {});
    const RenderResult flat = renderer->render(frame);
    EXPECT_NEAR(seen(flat, 0.5f, 0.3f).g, seen(plain, 0.5f, 0.3f).g, 0.01f * seen(plain, 0.5f, 0.3f).g);
    // The bend of the ball itself: 1 a metre.
    skin.skin_curvature_scale = 1.0f;
    renderer->load(scene_of({ball()}, {skin}), {});
    EXPECT_NEAR(seen(renderer->render(frame), -0.2f, 0.0f).r, past.r, 0.2f * past.r);
}

TEST_F(LightModels, SkinIsNotCutOffByItsOwnShadow)
{
    Material skin = plain_material(glm::vec3(0.6f), 1.0f);
    skin.specular = 0.0f;
    skin.lighting_model = "skin";
    skin.skin_curvature = 1.0f;
    renderer->load(scene_of({ball()}, {skin}), {});
    Frame frame = of_ball({1, 0, 0});
    Light lamp;
    lamp.position_m = {20, 0, 0};
    lamp.intensity = 400000.0f;
    frame.extra_lights = {lamp};
    const RenderResult open = renderer->render(frame);
    frame.settings.shadows = true;
    const RenderResult shadowed = renderer->render(frame);
    EXPECT_GT(seen(open, -0.2f, 0.0f).r, 5.0f);
    EXPECT_NEAR(seen(shadowed, -0.2f, 0.0f).r, seen(open, -0.2f, 0.0f).r, 0.02f * seen(open, -0.2f, 0.0f).r);
    // A wall before the lamp still is one.
    renderer->load(scene_of({ball(), quad({2, -2, 2}, {0, 0, -4}, {0, 4, 0})}, {skin}), {});
    EXPECT_EQ(seen(renderer->render(frame), 0.6f, 0.0f).r, 0.0f);
}

TEST_F(LightModels, SkinFarAwayIsTheStandardModel)
{
    Material skin = plain_material(glm::vec3(0.6f), 0.5f);
    Frame frame = of_ball({1, 0.2f, 0.4f});
    frame.camera.to_world[3] = glm::vec4(0, 0, 24, 1);
    renderer->load(scene_of({ball()}, {skin}), {});
    const RenderResult plain = renderer->render(frame);
    skin.lighting_model = "skin";
    skin.skin_curvature = 1.0f;
    skin.translucency = 1.0f;
    renderer->load(scene_of({ball()}, {skin}), {});
    const RenderResult far = renderer->render(frame);
    for (const float x : {-0.3f, 0.2f, 0.6f})
        EXPECT_NEAR(seen(far, x, 0.1f).r, seen(plain, x, 0.1f).r, 0.01f * kLux * 0.2f) << x;
}

TEST_F(LightModels, LightComesThroughTowardsTheEyeAndIsShadowedByChoice)
{
    Material leaf = plain_material(glm::vec3(0.5f), 1.0f);
    leaf.specular = 0.0f;
    leaf.translucency = 0.5f;
    leaf.translucency_distortion = 0.0f;
    Frame frame = of_ball({0, 0, -1});
    const auto middle = [&](const Material& material) {
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {material}), {});
        return seen(renderer->render(frame), 0, 0).g;
    };
    // T 2^0 times a scale of 4, times the albedo, over pi.
    EXPECT_NEAR(middle(leaf), 0.5f * 0.5f * 4.0f / 3.14159265f * kLux, 3.0f);
    Material none = leaf;
    none.translucency = 0.0f;
    EXPECT_EQ(middle(none), 0.0f);
    leaf.translucency_color = {1.0f, 0.5f, 0.2f};
    EXPECT_NEAR(middle(leaf), 0.25f * 0.5f * 4.0f / 3.14159265f * kLux, 3.0f);
    // A lamp behind a wall: its shadow lies on what comes through as translucency_shadow says.
    Light lamp;
    lamp.position_m = {0, 0, -3};
    lamp.intensity = 900.0f;
    frame.extra_lights = {lamp};
    frame.settings.shadows = true;
    const auto shaded = [&](float shadow) {
        leaf.translucency_shadow = shadow;
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                                 quad({1, -1, -1}, {-2, 0, 0}, {0, 2, 0}, 1)},
                                {leaf, none}),
                       {});
        return seen(renderer->render(frame), 0, 0).g;
    };
    EXPECT_NEAR(shaded(1.0f), 0.0f, 0.01f);
    EXPECT_GT(shaded(0.0f), 5.0f);
}

// As it dims what glows: by the opacity of the snow, by the colour of the water.
TEST_F(LightModels, SnowAndMurkDimWhatComesThrough)
{
    Material leaf = plain_material(glm::vec3(0.9f), 1.0f);
    leaf.translucency = 0.5f;
    leaf.translucency_distortion = 0.0f;
    Frame frame = of_ball({0, -1, 0});
    frame.camera = look({0, 5, 0.001f}, {0, 0, 0});
    frame.camera.orthographic_height_m = 2.56f;
    const auto middle = [&] {
        renderer->load(scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {leaf}), {});
        return pixel(renderer->render(frame), 32, 32).g;
    };
    const float dry = middle();
    ASSERT_GT(dry, 1.0f);
    leaf.weather.snow_accumulation = {2.0f, 0.0f};
    leaf.weather.snow_opacity = 0.9f;
    const float thick = middle();
    leaf.weather.snow_opacity = 0.2f;
    const float thin = middle();
    EXPECT_NEAR(thick / thin, 0.1f / 0.8f, 0.02f);
    EXPECT_LT(thick, 0.2f * dry);
    leaf.weather.snow_accumulation = {0.0f, 0.0f};
    leaf.weather.water_accumulation = {2.0f, 0.0f, 2.0f, 0.0f};
    const float clear = middle();
    leaf.weather.water_color = {0.9f, 0.9f, 0.9f, 0.6f};  // as bright as the leaf: murk alone tells
    EXPECT_LT(middle(), 0.65f * clear);
}

TEST_F(LightModels, EarsGlowInTheirOwnColour)
{
    Material ear = plain_material(glm::vec3(0.0f, 0.5f, 0.0f), 1.0f);
    ear.specular = 0.0f;
    ear.lighting_model = "skin";
    ear.skin_curvature = 0.0f;
    ear.translucency = 0.5f;
    ear.translucency_distortion = 0.0f;
    ear.translucency_scale = 2.0f;
    ear.translucency_color = {1.0f, 0.4f, 0.25f};
    renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {ear}), {});
    // Not times the albedo: it is the light of what lies below.
    const glm::vec3 got = seen(renderer->render(of_ball({0, 0, -1})), 0, 0);
    const glm::vec3 expected = ear.translucency_color * (0.5f * 2.0f / 3.14159265f * kLux);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 0.01f * expected[c]);
}

TEST_F(LightModels, FibresBrightenTheRimAndSnowAndWaterHideThem)
{
    Material velvet = plain_material(glm::vec3(0.1f), 1.0f);
    velvet.specular = 0.0f;
    Frame frame = of_ball({0, 0, 1});
    const auto rim = [&](const Material& material) {
        renderer->load(scene_of({ball()}, {material}), {});
        const RenderResult r = renderer->render(frame);
        return seen(r, 0.9f, 0.0f).r / seen(r, 0.0f, 0.0f).r;
    };
    const float plain = rim(velvet);
    velvet.scatter_color = {0.52f, 0.13f, 0.28f};
    velvet.scatter_power = 6.0f;
    EXPECT_GT(rim(velvet), 2.0f * plain);
    // Snow lies on top.
    frame.weather.snow_amount = 4.0f;
    const auto top = [&](const Material& material) {
        renderer->load(scene_of({ball()}, {material}), {});
        return seen(renderer->render(frame), 0.0f, 0.9f).r;
    };
    const float snowed = top(velvet);
    velvet.scatter_color = glm::vec3(0.0f);
    EXPECT_NEAR(snowed, top(velvet), 0.1f * snowed) << "snow has none of them";
}

TEST_F(LightModels, HairIsBrightAcrossItsStrands)
{
    Material hair = plain_material(glm::vec3(0.1f, 0.06f, 0.03f), 0.35f);
    hair.lighting_model = "hair";
    const auto middle = [&](const glm::vec3& from, float rotation) {
        hair.anisotropy_rotation_rad = rotation;
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {hair}), {});
        return seen(renderer->render(of_ball(from)), 0, 0).r;
    };
    // Strands along x.
    EXPECT_GT(middle({0, 0.7f, 0.7f}, 0.0f), 2.0f * middle({0.7f, 0, 0.7f}, 0.0f));
    EXPECT_GT(middle({0.7f, 0, 0.7f}, 1.5707963f), 2.0f * middle({0, 0.7f, 0.7f}, 1.5707963f)) << "turned";
}

TEST_F(LightModels, ParityModelsFollowTheirFormulas)
{
    const glm::vec3 from = glm::normalize(glm::vec3(0.5f, 0.2f, 0.8f));
    const glm::vec3 n(0, 0, 1), v(0, 0, 1);
    for (const std::string name : {"lwrp", "lux", "burley"}) {
        Material material = plain_material(glm::vec3(0.5f), 0.5f);
        material.lighting_model = name;
        renderer->load(scene_of({quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, {material}), {});
        const float got = seen(renderer->render(of_ball(from)), 0, 0).g;
        const glm::vec3 diffuse(0.5f * 0.96f), f0(0.04f);
        const glm::vec3 expected = name == "lwrp"  ? shared::shade_lwrp(n, v, from, diffuse, f0, 0.25f)
                                   : name == "lux" ? shared::shade_lux(n, v, from, diffuse, f0, 0.5f)
                                                   : shared::shade_burley(n, v, from, diffuse, f0, 0.5f);
        EXPECT_NEAR(got, kLux * expected.g, 0.02f * kLux * expected.g) << name;
    }
}

TEST_F(LightModels, LazarovsFitIsASwitch)
{
    Material metal = plain_material(glm::vec3(1.0f), 0.6f, 1.0f);
    metal.lighting_model = "lux";  // one bounce: the fit alone is seen
    renderer->load(scene_of({quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0})}, {metal}), {});
    renderer->set_environment(constant_environment(1.0f));
    Frame frame = of_ball({0, 0, 1});
    frame.extra_lights.clear();
    frame.settings.image_based_light = true;
    frame.settings.ambient_occlusion = false;
    const float table = seen(renderer->render(frame), 0, 0).g;
    frame.settings.lazarov = true;
    const float fit = seen(renderer->render(frame), 0, 0).g;
    const glm::vec2 ab = shared::lazarov_split_sum(1.0f, 0.6f);
    EXPECT_NEAR(fit, ab.x + ab.y, 0.02f);
    EXPECT_GT(table, fit + 0.03f);
    renderer->set_environment({});
}

TEST_F(LightModels, TheHorizonOfTheMeshDarkensMirrors)
{
    // A normal map tilts the plate by half a right angle: mirrored rays go into it.
    Texture tilt;
    tilt.format = TexelFormat::Rgba8Unorm;
    tilt.width = tilt.height = 1;
    tilt.mips = {{std::byte{235}, std::byte{128}, std::byte{194}, std::byte{255}}};
    Material metal = plain_material(glm::vec3(1.0f), 0.1f, 1.0f);
    metal.normal_texture.texture = 0;
    Scene scene = scene_of({quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0})}, {metal});
    scene.textures.resize(1);
    renderer->load(scene, {tilt});
    renderer->set_environment(constant_environment(1.0f));
    Frame frame = of_ball({0, 0, 1});
    frame.extra_lights.clear();
    frame.settings.image_based_light = true;
    frame.settings.ambient_occlusion = false;
    frame.camera = look({-4, 0, 1.5f}, {0, 0, 0}, 0.3f);
    const auto mean = [&] {
        const RenderResult r = renderer->render(frame);
        float sum = 0.0f;
        for (int y = 24; y < 40; ++y) {
            for (int x = 24; x < 40; ++x) sum += pixel(r, x, y).g / 256.0f;
        }
        return sum;
    };
    const float without = mean();
    frame.settings.horizon_fade = 1.3f;
    const float with = mean();
    frame.camera = look({4, 0, 1.5f}, {0, 0, 0}, 0.3f);
    const float facing = mean();
    frame.settings.horizon_fade = 0.0f;
    // R . Ng is -0.31 there.
    EXPECT_LT(with / without, 0.85f);
    EXPECT_NEAR(facing / mean(), 1.0f, 0.02f) << "rays that leave the mesh stay";

    renderer->set_environment({});
}

TEST_F(LightModels, SpecularAntiAliasingWidensWhatBendsInAPixel)
{
    Material shiny = plain_material(glm::vec3(0.2f), 0.15f);
    renderer->load(scene_of({ball()}, {shiny}), {});
    Frame frame = of_ball({0, 0, 1});
    frame.settings.aovs = {"roughness"};
    const auto roughness = [&] { return aov(renderer->render(frame), "roughness", 32, 32); };
    // Normals turn by a pixel over a metre, both ways: half the sum of their squares on alpha squared.
    const float bend = 2.56f / 64.0f;
    const float alpha2 = std::pow(0.15f, 4.0f);
    EXPECT_NEAR(roughness(), std::pow(alpha2 + bend * bend, 0.25f), 0.01f);
    frame.settings.specular_aa = 0.0f;
    EXPECT_NEAR(roughness(), 0.15f, 0.003f);
    frame.settings.specular_aa = 4.0f;
    frame.settings.specular_aa_limit = 0.0004f;
    EXPECT_NEAR(roughness(), std::pow(alpha2 + 0.0004f, 0.25f), 0.003f) << "no more than its limit";
}

// N samples show what normals do between them: what is left to each is the variance inside an N-th of the pixel.
TEST_F(LightModels, SamplesShareTheVarianceOfNormals)
{
    renderer->load(scene_of({ball()}, {plain_material(glm::vec3(0.2f), 0.15f)}), {});
    Frame frame = of_ball({0, 0, 1});
    frame.settings.aovs = {"roughness"};
    const float bend = 2.56f / 64.0f;
    for (const int samples : {1, 4, 16}) {
        frame.settings.samples = samples;
        EXPECT_NEAR(aov(renderer->render(frame), "roughness", 32, 32), std::pow(std::pow(0.15f, 4.0f) + bend * bend / static_cast<float>(samples), 0.25f), 0.01f) << samples;
    }
}

// --- unlit

// A plate above a floor, under the sun from straight above.
Scene plate_over_floor(const Material& plate, const Material& floor)
{
    return scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1)},
                    {floor, plate});
}

Frame from_beside()
{
    Frame frame;
    frame.camera = look({0, 0.8f, 4}, {0, 0, 0}, 0.5f);
    frame.settings.width = frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.image_based_light = false;
    frame.settings.exposure = 1e-4f;
    frame.sky.sun_elevation_rad = 1.5707f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

TEST_F(LightModels, UnlitThingsCastShadowsAndCutoutsTheirHoles)
{
    Material floor = plain_material(glm::vec3(0.5f), 1.0f);
    Material plate = plain_material(glm::vec3(0.5f));
    plate.unlit = true;
    plate.double_sided = true;
    renderer->load(plate_over_floor(plate, floor), {});
    const Frame frame = from_beside();
    const RenderResult cast = renderer->render(frame);
    EXPECT_LT(pixel(cast, 32, 32).g, 0.05f * pixel(cast, 4, 32).g);
    plate.alpha_mode = AlphaMode::Mask;
    plate.base_color.a = 0.2f;  // all of it is a hole
    renderer->load(plate_over_floor(plate, floor), {});
    const RenderResult hole = renderer->render(frame);
    EXPECT_NEAR(pixel(hole, 32, 32).g, pixel(hole, 4, 32).g, 0.05f * pixel(hole, 4, 32).g);
}

TEST_F(LightModels, UnlitGroundsReceiveShadowsByChoice)
{
    Material plate = plain_material(glm::vec3(0.5f));
    Material floor = plain_material(glm::vec3(0.5f));
    floor.lighting_model = "unlit_shadowed";
    renderer->load(plate_over_floor(plate, floor), {});
    const RenderResult r = renderer->render(from_beside());
    EXPECT_NEAR(pixel(r, 4, 32).g * r.exposure, 0.5f, 0.01f);
    EXPECT_NEAR(pixel(r, 32, 32).g * r.exposure, 0.15f, 0.02f);
    floor.lighting_model = "unlit";
    renderer->load(plate_over_floor(plate, floor), {});
    EXPECT_NEAR(pixel(renderer->render(from_beside()), 32, 32).g * r.exposure, 0.5f, 0.01f);
    // With holes of its own.
    floor.lighting_model = "unlit_shadowed";
    floor.alpha_mode = AlphaMode::Mask;
    floor.base_color.a = 0.2f;
    renderer->load(plate_over_floor(plate, floor), {});
    Frame frame = from_beside();
    frame.settings.draw_sky = false;
    EXPECT_EQ(pixel(renderer->render(frame), 4, 40).g, 0.0f);
}

// A lamp's shadow darkens them as the sun's: by its share of all that would fall there.
TEST_F(LightModels, UnlitGroundsReceiveShadowsOfLamps)
{
    Material floor = plain_material(glm::vec3(0.5f));
    floor.lighting_model = "unlit_shadowed";
    renderer->load(plate_over_floor(plain_material(glm::vec3(0.5f)), floor), {});
    Frame frame = from_beside();
    frame.sky.sun_illuminance = 0.0f;
    Light lamp;
    lamp.position_m = {0, 20, 0};
    lamp.intensity = 1e5f;
    lamp.range_m = 100.0f;
    frame.extra_lights = {lamp};
    const auto below_the_plate = [&] {
        const RenderResult r = renderer->render(frame);
        EXPECT_NEAR(pixel(r, 4, 32).g * r.exposure, 0.5f, 0.01f);
        return pixel(r, 32, 32).g * r.exposure;
    };
    EXPECT_NEAR(below_the_plate(), 0.15f, 0.01f);
    frame.extra_lights[0].radius_m = 0.05f;
    for (const AreaLights area : {AreaLights::Ltc, AreaLights::Nearest}) {
        frame.settings.area_lights = area;
        EXPECT_NEAR(below_the_plate(), 0.15f, 0.01f);
    }
    frame.extra_lights[0].radius_m = 0.0f;
    frame.extra_lights[0].shadow_strength = 0.5f;
    EXPECT_NEAR(below_the_plate(), 0.325f, 0.01f);
    frame.extra_lights[0].shadow_strength = 1.0f;
    // As much light from another lamp, which throws none; then from the noon's sun, which throws its own.
    frame.extra_lights.push_back(frame.extra_lights[0]);
    frame.extra_lights[1].shadow_strength = 0.0f;
    EXPECT_NEAR(below_the_plate(), 0.325f, 0.01f);
    frame.extra_lights.pop_back();
    frame.sky.sun_illuminance = 1e6f;
    frame.sky.sun_elevation_rad = 0.6f;
    EXPECT_NEAR(below_the_plate(), 0.5f, 0.01f) << "what the lamp lacks is nothing beside the sun";
    frame.sky.sun_illuminance = 0.0f;
    frame.extra_lights.clear();
    EXPECT_NEAR(below_the_plate(), 0.5f, 0.01f) << "no light, no shadow";
    // Of many lamps, whose lists are sifted.
    frame.extra_lights.assign(200, lamp);
    for (Light& light : frame.extra_lights) light.shadow_strength = 0.0f;
    frame.extra_lights[7].shadow_strength = 1.0f;
    frame.extra_lights[7].intensity *= 199.0f;
    EXPECT_NEAR(below_the_plate(), 0.325f, 0.01f);
}

// --- profiles

TEST_F(LightModels, ADistributionAndAPictureShapeALamp)
{
    LightProfile half;  // light on one side of the lamp alone
    LightProfile window;
    window.picture = true;
    for (int y = 0; y < kLightProfileSide; ++y) {
        for (int x = 0; x < kLightProfileSide; ++x) {
            half.texels.emplace_back(x < kLightProfileSide / 2 ? 1.0f : 0.0f);
            window.texels.push_back(x < kLightProfileSide / 2 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
        }
    }
    Material matt = plain_material(glm::vec3(0.5f), 1.0f);
    Scene scene = scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {matt});
    scene.light_profiles = {half, window};
    renderer->load(scene, {});
    Frame frame = from_beside();
    frame.camera = look({0, 8, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 6.4f;
    frame.sky.analytic_sun = false;
    frame.settings.shadows = false;
    Light lamp;
    lamp.position_m = {0, 2, 0};
    lamp.intensity = 1000.0f;
    lamp.range_m = 50.0f;
    lamp.direction = {0, -1, 0};
    lamp.up = {0, 0, -1};
    frame.extra_lights = {lamp};
    const RenderResult plain = renderer->render(frame);
    frame.extra_lights[0].profile = 0;
    const RenderResult one = renderer->render(frame);
    // From above: right of the lamp is cross(direction, up) = x.
    EXPECT_NEAR(pixel(one, 42, 32).g, pixel(plain, 42, 32).g, 0.01f * pixel(plain, 42, 32).g);
    EXPECT_EQ(pixel(one, 22, 32).g, 0.0f);
    frame.extra_lights[0].kind = LightKind::Spot;
    frame.extra_lights[0].outer_cone_rad = 0.9f;
    frame.extra_lights[0].profile = 1;
    const RenderResult glass = renderer->render(frame);
    EXPECT_GT(pixel(glass, 22, 32).r, 1.0f);
    EXPECT_EQ(pixel(glass, 22, 32).g, 0.0f);
    EXPECT_GT(pixel(glass, 42, 32).g, 1.0f);
    EXPECT_EQ(pixel(glass, 42, 32).r, 0.0f);
}

}  // namespace
}  // namespace petrichor::gpu
