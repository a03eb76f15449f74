// Lamps: their shadows, and surfaces that glow.
#include <algorithm>
#include <span>

#include "gpu/upload/emissive_lights.h"
#include "scene/patches/lanterns.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using LampTest = GpuTest;

Light lamp(const glm::vec3& at, float candela)
{
    Light light;
    light.position_m = at;
    light.intensity = candela;
    return light;
}

// Seen from above, without sun and sky: one pixel is 0.1 m.
Frame from_above()
{
    Frame frame;
    frame.camera = look({0, 8, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 6.4f;
    frame.sky.analytic_sun = false;
    frame.settings.width = 64;
    frame.settings.height = 64;
    frame.settings.samples = 4;
    frame.settings.image_based_light = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1.0f;
    return frame;
}

float at(const RenderResult& r, float x, float z)
{
    return luminance(
        pixel(r, static_cast<int>(32.0f + 10.0f * x), static_cast<int>(32.0f + 10.0f * z)));
}

Scene floor_and(std::vector<Primitive> more)
{
    std::vector<Primitive> all{quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})};
    all.insert(all.end(), more.begin(), more.end());
    Material grey = plain_material(glm::vec3(0.5f), 1.0f);
    grey.double_sided = true;
    return scene_of(std::move(all), {grey, grey});
}

// Four bars around a lamp: at one sample a floor is lit nearly as by 64 points of the ball, where a point throws
// four black beams.
TEST_F(LampTest, ALanternShadesAsTheBallInIt)
{
    std::vector<Primitive> bars;
    for (const float s : {-0.14f, 0.14f}) {
        for (const float t : {-0.14f, 0.14f}) {
            bars.push_back(quad({s - 0.015f, 1.0f, t}, {0.03f, 0, 0}, {0, 0.4f, 0}, 1));
            bars.push_back(quad({s, 1.0f, t - 0.015f}, {0, 0, 0.03f}, {0, 0.4f, 0}, 1));
        }
    }
    Scene scene = floor_and(bars);
    Light light = lamp({0, 1.2f, 0}, 100.0f);
    light.radius_m = 0.1f;
    scene.lights = {light};
    Frame frame = from_above();
    frame.settings.area_lights = AreaLights::Off;
    frame.settings.samples = 1;
    renderer->load(scene, {});
    const RenderResult point = renderer->render(frame);
    frame.settings.soft_shadows = true;
    frame.settings.samples = 64;
    const RenderResult ball = renderer->render(frame);
    frame.settings.soft_shadows = false;
    frame.settings.samples = 1;
    ASSERT_EQ(scene::shade_by_lanterns(scene).size(), 1u);
    renderer->load(scene, {});
    const RenderResult lantern = renderer->render(frame);
    double of_point = 0.0, of_lantern = 0.0, mean = 0.0;
    int pixels = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (std::hypot(static_cast<float>(x) - 31.5f, static_cast<float>(y) - 31.5f) < 5.0f) continue;  // the bars
            const auto expected = static_cast<double>(luminance(pixel(ball, x, y)));
            of_point += std::pow(static_cast<double>(luminance(pixel(point, x, y))) - expected, 2.0);
            of_lantern += std::pow(static_cast<double>(luminance(pixel(lantern, x, y))) - expected, 2.0);
            mean += expected;
            ++pixels;
        }
    }
    mean /= pixels;
    EXPECT_LT(std::sqrt(of_lantern / pixels), 0.06 * mean);
    EXPECT_LT(of_lantern, 0.1 * of_point);
}

// Within its lantern a lamp lights what lies before the first thing, and not what lies behind.
TEST_F(LampTest, NoLightLeaksThroughAWallBehindTheLamp)
{
    Scene scene = floor_and({quad({-0.15f, 0, -2}, {0, 0, 4}, {0, 3, 0}, 1), quad({-0.3f, 0, -2}, {0, 0, 4}, {0, 3, 0}, 1)});
    scene.lights = {lamp({0, 1.0f, 0}, 100.0f)};
    ASSERT_EQ(scene::shade_by_lanterns(scene).size(), 1u);
    renderer->load(scene, {});
    Frame frame = from_above();
    const auto on_wall = [&](float eye_x, float wall_x) {
        frame.camera = look({eye_x, 1.0f, 0.0f}, {wall_x, 1.0f, 0.0f});
        frame.camera.orthographic_height_m = 0.4f;
        return luminance(pixel(renderer->render(frame), 32, 32));
    };
    EXPECT_GT(on_wall(0.1f, -0.15f), 100.0f);
    EXPECT_LT(on_wall(-0.2f, -0.3f), 1.0f);   // what faces the back of the first
    EXPECT_LT(on_wall(-0.6f, -0.3f), 1.0f);   // the other side
}

TEST_F(LampTest, AFrameSaysWhatLightsIt)
{
    Scene scene = floor_and({});
    Light sun = lamp({0, 5, 0}, 700.0f);
    sun.kind = LightKind::Directional;
    sun.direction = {0, -1, 0};
    scene.lights = {sun, lamp({0, 2, 0}, 100.0f)};
    renderer->load(scene, {});
    Frame frame = from_above();
    LightFacts light = renderer->render(frame).light;
    EXPECT_EQ(light.direct, LightFacts::Direct::Scene);
    EXPECT_EQ(light.lux, glm::vec3(700.0f));
    EXPECT_EQ(light.lamps, 1u);
    frame.sky.analytic_sun = true;
    frame.sky.cloud_cover = 0.0f;
    light = renderer->render(frame).light;
    EXPECT_EQ(light.direct, LightFacts::Direct::Sun);
    EXPECT_GT(light.lux.r, 50000.0f);
    frame.sky.cloud_cover = 1.0f;
    EXPECT_EQ(renderer->render(frame).light.direct, LightFacts::Direct::None);
    frame.sky.cloud_cover = 0.0f;
    frame.sky.sun_elevation_rad = -0.5f;
    frame.sky.moon_elevation_rad = 0.5f;
    frame.sky.moon_lux = 0.3f;
    light = renderer->render(frame).light;
    EXPECT_EQ(light.direct, LightFacts::Direct::Moon);
    EXPECT_LT(light.lux.r, 0.3f);
}

TEST_F(LampTest, APlateBelowALampThrowsAShadowOfTheRightSize)
{
    // A plate of 1 m, halfway between the lamp and the floor: a shadow of 2 m.
    const Scene scene = floor_and({quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1)});
    Frame frame = from_above();
    frame.camera.to_world[3] = glm::vec4(0, 0.9f, 0, 1);  // below the plate
    frame.extra_lights.push_back(lamp({0, 2, 0}, 100.0f));
    renderer->load(scene, {});
    const RenderResult shadowed = renderer->render(frame);
    frame.settings.lamp_shadows = 0;
    const RenderResult lit = renderer->render(frame);
    EXPECT_EQ(at(shadowed, 0, 0), 0.0f);
    EXPECT_EQ(at(shadowed, 0.85f, 0.85f), 0.0f);
    EXPECT_GT(at(lit, 0, 0), 1.0f);
    EXPECT_NEAR(at(shadowed, 1.2f, 0.0f), at(lit, 1.2f, 0.0f), 1e-3f * at(lit, 1.2f, 0.0f));
    frame.settings.lamp_shadows = 4;
    frame.settings.shadows = false;
    EXPECT_EQ(renderer->render(frame).beauty, lit.beauty);
}

TEST_F(LampTest, WhatIsLitHasNoAcneInAnyDirection)
{
    // A closed room around the lamp: every face of the map, every slope of light.
    std::vector<Primitive> walls{
        quad({-3, -3, 3}, {6, 0, 0}, {0, 0, -6}), quad({-3, 3, -3}, {6, 0, 0}, {0, 0, 6}),
        quad({-3, -3, -3}, {6, 0, 0}, {0, 6, 0}), quad({3, -3, 3}, {-6, 0, 0}, {0, 6, 0}),
        quad({-3, -3, 3}, {0, 0, -6}, {0, 6, 0}), quad({3, -3, -3}, {0, 0, 6}, {0, 6, 0})};
    renderer->load(scene_of(walls, {plain_material(glm::vec3(0.5f), 1.0f)}), {});
    for (const glm::vec3 target :
         {glm::vec3(3, 0.1f, 0), glm::vec3(-3, 0, 0.2f), glm::vec3(0.1f, 3, 0),
          glm::vec3(0, -3, 0.1f), glm::vec3(0.2f, 0, 3), glm::vec3(0, 0.2f, -3)}) {
        Frame frame = from_above();
        frame.camera = look({0, 0, 0}, target, 1.8f);
        frame.extra_lights.push_back(lamp({0.4f, -0.9f, 0.3f}, 100.0f));
        const RenderResult shadowed = renderer->render(frame);
        frame.settings.lamp_shadows = 0;
        const RenderResult lit = renderer->render(frame);
        int darker = 0;
        float darkest = 1.0f;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const float share = luminance(pixel(shadowed, x, y)) / luminance(pixel(lit, x, y));
                if (share < 0.97f) ++darker;
                darkest = std::min(darkest, share);
            }
        }
        // Along the edges of the room the filter reaches into the next wall.
        EXPECT_LT(darker, 64 * 64 / 32)
            << darkest << " at " << target.x << " " << target.y << " " << target.z;
    }
}

TEST_F(LampTest, TheBrightestOwnTheShadowsAndTheOrderOfLampsDoesNotMatter)
{
    const Scene scene = floor_and({quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1)});
    renderer->load(scene, {});
    Frame frame = from_above();
    frame.camera.to_world[3] = glm::vec4(0, 0.9f, 0, 1);
    frame.settings.lamp_shadows = 1;
    frame.extra_lights = {lamp({0.3f, 2, 0}, 5.0f), lamp({0, 2, 0}, 100.0f)};
    const float centre = at(renderer->render(frame), 0, 0);
    frame.extra_lights.pop_back();
    EXPECT_NEAR(at(renderer->render(frame), 0, 0), 0.0f, 1e-6f)
        << "alone, the faint one has the shadow";
    EXPECT_GT(centre, 0.0f) << "the faint one shines through, the bright one does not";
    EXPECT_LT(centre, 1.0f);
    Frame bad = frame;
    bad.settings.lamp_shadows = 17;
    EXPECT_THROW(renderer->render(bad), Error);
}

TEST_F(LampTest, ASpotsShadowIsThatOfItsCone)
{
    const Scene scene = floor_and({quad({-0.25f, 1, 0.25f}, {0.5f, 0, 0}, {0, 0, -0.5f}, 1)});
    renderer->load(scene, {});
    Frame frame = from_above();
    frame.camera.to_world[3] = glm::vec4(0, 0.9f, 0, 1);
    Light spot = lamp({0, 2, 0}, 100.0f);
    spot.kind = LightKind::Spot;
    spot.direction = {0, -1, 0};
    spot.outer_cone_rad = 0.7f;
    frame.extra_lights.push_back(spot);
    const RenderResult r = renderer->render(frame);
    EXPECT_EQ(at(r, 0, 0), 0.0f);
    EXPECT_GT(at(r, 0.8f, 0), 0.1f);
    EXPECT_EQ(at(r, 2.2f, 0), 0.0f) << "out of the cone";
}

// --- what glows

Scene glowing(std::vector<Primitive> primitives, float radiance)
{
    Material glow = plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(radiance, radiance, 0.5f * radiance);
    return scene_of(std::move(primitives), {glow});
}

TEST(EmissiveLights, APaneIsARectangleOfItsAreaAndDirection)
{
    const auto lights =
        emissive_lights(glowing({quad({1, 2, 3}, {1.2f, 0, 0}, {0, 0.5f, 0})}, 40.0f), {});
    ASSERT_EQ(lights.size(), 1u);
    const Light& l = lights[0];
    EXPECT_EQ(l.kind, LightKind::Rectangle);
    EXPECT_NEAR(4.0f * glm::length(l.half_u_m) * glm::length(l.half_v_m), 0.6f, 1e-4f);
    EXPECT_NEAR(l.position_m.x, 1.6f, 1e-4f);
    EXPECT_NEAR(l.direction.z, 1.0f, 1e-5f);
    EXPECT_GT(glm::cross(l.half_u_m, l.half_v_m).z, 0.0f);
    EXPECT_NEAR(l.intensity * l.color.b, 20.0f, 1e-4f);
    EXPECT_FALSE(l.both_sides);
    EXPECT_NEAR(std::max(glm::length(l.half_u_m), glm::length(l.half_v_m)), 0.6f, 0.02f);
}

TEST(EmissiveLights, PanesOfAWindowAreOneAndWindowsApartAreTwo)
{
    std::vector<Primitive> panes;
    for (const float x : {0.0f, 0.55f, 6.0f})
        panes.push_back(quad({x, 1, 0}, {0.5f, 0, 0}, {0, 0.8f, 0}));
    Primitive all = panes[0];
    for (std::size_t i = 1; i < panes.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), panes[i].positions.begin(),
                             panes[i].positions.end());
        all.uv0.insert(all.uv0.end(), panes[i].uv0.begin(), panes[i].uv0.end());
        for (const std::uint32_t k : panes[i].indices) all.indices.push_back(first + k);
    }
    const auto lights = emissive_lights(glowing({all}, 40.0f), {});
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_NEAR(4.0f * glm::length(lights[0].half_u_m) * glm::length(lights[0].half_v_m), 0.8f,
                1e-3f);
    EXPECT_NEAR(4.0f * glm::length(lights[1].half_u_m) * glm::length(lights[1].half_v_m), 0.4f,
                1e-3f);
}

Primitive joined(std::span<const Primitive> faces)
{
    Primitive box;
    for (const Primitive& face : faces) {
        const auto first = static_cast<std::uint32_t>(box.positions.size());
        box.positions.insert(box.positions.end(), face.positions.begin(), face.positions.end());
        box.uv0.insert(box.uv0.end(), face.uv0.begin(), face.uv0.end());
        for (const std::uint32_t k : face.indices) box.indices.push_back(first + k);
    }
    return box;
}

// Near enough to be one, but not one rectangle: a door and a low window beside it.
TEST(EmissiveLights, PanesThatMakeNoRectangleStayApart)
{
    const Primitive both[] = {quad({0, 0, 0}, {0.8f, 0, 0}, {0, 2.2f, 0}), quad({1.3f, 1.2f, 0}, {1.6f, 0, 0}, {0, 0.5f, 0})};
    const auto lights = emissive_lights(glowing({joined(both)}, 40.0f), {});
    ASSERT_EQ(lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const float longer = std::max(glm::length(lights[i].half_u_m), glm::length(lights[i].half_v_m));
        EXPECT_NEAR(longer, i == 0 ? 1.1f : 0.8f, 1e-3f);
    }
}

std::vector<Primitive> box_faces(float h, float d)
{
    return {quad({-h, -h, d}, {2 * h, 0, 0}, {0, 2 * h, 0}),   quad({h, -h, d}, {0, 0, -2 * d}, {0, 2 * h, 0}),
            quad({-h, -h, -d}, {0, 0, 2 * d}, {0, 2 * h, 0}),  quad({-h, h, d}, {2 * h, 0, 0}, {0, 0, -2 * d}),
            quad({-h, -h, -d}, {2 * h, 0, 0}, {0, 0, 2 * d}),  quad({h, -h, -d}, {-2 * h, 0, 0}, {0, 2 * h, 0})};
}

// A pane with edges of 5 cm and no back is what its front is.
TEST(EmissiveLights, APaneWithEdgesIsARectangle)
{
    const auto faces = box_faces(0.5f, 0.025f);
    const auto lights = emissive_lights(glowing({joined(std::span(faces).first(5))}, 40.0f), {});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].kind, LightKind::Rectangle);
    EXPECT_NEAR(lights[0].direction.z, 1.0f, 1e-5f);
    EXPECT_NEAR(4.0f * glm::length(lights[0].half_u_m) * glm::length(lights[0].half_v_m), 1.0f, 1e-3f);
    EXPECT_TRUE(lights[0].glows);
}

TEST(EmissiveLights, ALanternIsABallUnlessALampStandsInIt)
{
    Scene scene = glowing({joined(box_faces(0.1f, 0.1f))}, 1000.0f);
    const auto lights = emissive_lights(scene, {});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].kind, LightKind::Point);
    EXPECT_NEAR(lights[0].intensity, 1000.0f * 0.24f / 4.0f, 0.1f) << "a quarter of its surface";
    EXPECT_NEAR(4.0f * 3.14159265f * lights[0].radius_m * lights[0].radius_m, 0.24f, 1e-4f);
    scene.lights.push_back(lamp({0.02f, 0, 0}, 60.0f));
    EXPECT_TRUE(emissive_lights(scene, {}).empty());
    scene.lights[0].position_m.x = 3.0f;
    EXPECT_EQ(emissive_lights(scene, {}).size(), 1u);
}

TEST(EmissiveLights, DarkPartsOfATextureSendNothing)
{
    Primitive pane = quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Primitive two = pane;
    for (const Primitive& other : {quad({5, 0, 0}, {1, 0, 0}, {0, 1, 0})}) {
        for (std::size_t i = 0; i < 4; ++i) {
            two.positions.push_back(other.positions[i]);
            two.uv0.push_back({0.75f, 0.5f});
        }
        for (const std::uint32_t k : other.indices) two.indices.push_back(4 + k);
    }
    for (std::size_t i = 0; i < 4; ++i) two.uv0[i] = {0.25f, 0.5f};
    Scene scene = glowing({two}, 100.0f);
    scene.materials[0].emissive_texture.texture = 0;
    Texture half;  // left half dark, right half grey
    half.format = TexelFormat::Rgba8Unorm;
    half.width = 2;
    half.height = 1;
    half.mips = {{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{255}, std::byte{128},
                  std::byte{128}, std::byte{128}, std::byte{255}}};
    const auto lights = emissive_lights(scene, {half});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_NEAR(lights[0].position_m.x, 5.5f, 1e-4f);
    EXPECT_NEAR(lights[0].intensity, 100.0f * 128.0f / 255.0f, 0.1f);
}

TEST_F(LampTest, AWindowLightsTheGroundAsItsFormFactorSays)
{
    // A unit square 1 m over the floor, looking down: 0.23946 pi L below its middle.
    Material glow = plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(50.0f);
    Material matt = plain_material(glm::vec3(0.5f), 1.0f);
    matt.lighting_model = "lambert";
    const Scene scene = scene_of(
        {quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1)},
        {matt, glow});
    renderer->load(scene, {});
    Frame frame = from_above();
    frame.camera.to_world[3] = glm::vec4(0, 0.5f, 0, 1);
    const RenderResult r = renderer->render(frame);
    EXPECT_NEAR(at(r, 0.05f, 0.05f), 0.5f * 50.0f * 0.23946f, 0.02f * 6.0f);
    EXPECT_GT(at(r, 2.0f, 0.0f), 0.0f);
    EXPECT_LT(at(r, 2.0f, 0.0f), 0.2f * at(r, 0, 0));
    frame.emissive_scale = 0.5f;
    EXPECT_NEAR(at(renderer->render(frame), 0.05f, 0.05f), 0.25f * 50.0f * 0.23946f, 0.02f * 3.0f);
    frame.emissive_lights = false;
    EXPECT_EQ(at(renderer->render(frame), 0, 0), 0.0f);
}

// Light of a pane that a metal floor sends to the eye: by rays through the picture where it is smooth, as of
// a lamp where it is rough, and no less in between.
TEST_F(LampTest, AWindowStandsInFloorsOfAnySmoothness)
{
    Material glow = plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(50.0f);
    Frame frame;
    frame.camera = look({0, 1, 3}, {0, 0, 0}, 0.9f);
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 8;
    frame.settings.exposure = 1.0f;
    frame.settings.draw_sky = false;
    frame.sky.sun_illuminance = 0.0f;
    const auto mirrored = [&](float roughness, bool reflections) {
        renderer->load(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), quad({-0.5f, 0.1f, -1}, {1, 0, 0}, {0, 1, 0}, 1)},
                                {plain_material(glm::vec3(0.8f), roughness, 1.0f), glow}),
                       {});
        frame.settings.reflections = reflections;
        const RenderResult r = renderer->render(frame);
        float sum = 0.0f;
        for (int y = 36; y < 64; ++y) {
            for (int x = 0; x < 96; ++x) sum += luminance(pixel(r, x, y));
        }
        return sum;
    };
    const float smooth = mirrored(0.1f, true), rough = mirrored(0.45f, true);
    ASSERT_GT(smooth, 0.0f);
    for (const float roughness : {0.12f, 0.16f, 0.2f, 0.24f, 0.29f, 0.31f}) {
        const float between = mirrored(roughness, true);
        EXPECT_NEAR(between / mirrored(roughness, false), 1.0f, 0.35f) << roughness << ": once, not twice";
        std::printf("  %.2f: %.0f, smooth %.0f, rough %.0f\n", static_cast<double>(roughness),
                    static_cast<double>(between), static_cast<double>(smooth), static_cast<double>(rough));
        EXPECT_GT(between, 0.75f * std::min(smooth, rough)) << roughness;
        EXPECT_LT(between, 1.35f * std::max(smooth, rough)) << roughness;
    }
    // Without the picture they stand there all the same.
    EXPECT_GT(mirrored(0.2f, false), 0.5f * smooth);
}

// A pane that glows lights floors of any roughness as a lamp of its size and radiance does, which is held to sums
// over the lobe (area_lights_test): highlights included, stretched towards the eye.
TEST_F(LampTest, APaneIsMirroredAsTheRectangleThatItIs)
{
    const float radiance = 50.0f;
    Material glow = plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(radiance);
    Frame frame;
    frame.camera = look({0, 1, 3}, {0, 0, 0}, 0.9f);
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.settings.draw_sky = false;
    frame.settings.reflections = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.settings.image_based_light = false;
    frame.settings.lamp_shadows = 0;
    frame.settings.least_lux = 1.0e-4f;
    const Primitive floor = quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    for (const float metallic : {0.0f, 1.0f}) {
        for (const float roughness : {0.15f, 0.3f, 0.5f, 0.8f}) {
            const Material ground = plain_material(glm::vec3(0.8f), roughness, metallic);
            renderer->load(scene_of({floor, quad({-0.5f, 0.3f, -1}, {1, 0, 0}, {0, 0.6f, 0}, 1)}, {ground, glow}), {});
            frame.extra_lights.clear();
            const RenderResult pane = renderer->render(frame);
            renderer->load(scene_of({floor}, {ground}), {});
            Light lamp;
            lamp.kind = LightKind::Rectangle;
            lamp.shaped = true;
            lamp.position_m = {0, 0.6f, -1};
            lamp.direction = {0, 0, 1};
            lamp.half_u_m = {0.5f, 0, 0};
            lamp.half_v_m = {0, 0.3f, 0};
            lamp.intensity = radiance;
            frame.extra_lights = {lamp};
            const RenderResult by_lamp = renderer->render(frame);
            float brightest = 0.0f, apart = 0.0f;
            for (int y = 36; y < 64; ++y) {
                for (int x = 0; x < 96; ++x) {
                    const float a = pixel(pane, x, y).g, b = pixel(by_lamp, x, y).g;
                    brightest = std::max(brightest, b);
                    apart = std::max(apart, std::abs(a - b));
                }
            }
            ASSERT_GT(brightest, 0.3f);
            EXPECT_LT(apart, 0.01f * brightest) << roughness << " " << metallic;
        }
    }
}

}  // namespace
}  // namespace petrichor::gpu
