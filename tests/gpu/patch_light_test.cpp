// Light between surfaces in whole frames: the device looks up what the CPU does; laws of a room, an
// arch, snow, a lamp round the corner.
#include <numbers>

#include "formulas/weather/surface_weather.h"
#include "formulas/weather/weather_maps.h"
#include "gpu/frame/patch_points_io.h"
#include "gpu/passes/patch_light/patch_albedo.h"
#include "scene/patches/lookup.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr float kPi = 3.14159265f;

Material lambert(const glm::vec3& color)
{
    Material m = plain_material(color, 1.0f);
    m.lighting_model = "lambert";
    m.ior = 1.0f;  // nothing is mirrored
    return m;
}

// A box of six faces, seen from within or outside.
void add_box(std::vector<Primitive>& to, glm::vec3 low, glm::vec3 high, bool within,
             std::uint32_t material)
{
    const glm::vec3 d = high - low;
    const glm::vec3 x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
    const glm::vec3 faces[6][3] = {{low, z, x},     {low + y, x, z}, {low, y, z},
                                   {low + x, z, y}, {low, x, y},     {low + z, y, x}};
    for (const auto& f : faces)
        to.push_back(within ? quad(f[0], f[1], f[2], material) : quad(f[0], f[2], f[1], material));
}

std::shared_ptr<PatchScene> traced(const Scene& scene, float cell_m = 0.3f)
{
    auto made = std::make_shared<PatchScene>();
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    scene::PatchOptions options;
    options.cell_m = cell_m;
    made->patches = scene::build_patches(tracer, options);
    made->surfaces = scene::patch_surfaces(made->patches, triangles, {});
    made->materials = scene.materials;
    for (const Light& light : scene.lights)
        made->lamp_reach.push_back(
            scene::trace_lamp(made->patches, tracer, light.position_m, 5000.0f));
    made->glow = scene::trace_glow(made->patches, tracer,
                                   scene::glowing_patches(made->patches, made->surfaces));
    made->near = scene::trace_near(made->patches, tracer, &made->glow);
    made->near_surfaces = scene::near_surfaces(made->near, triangles, {});
    for (const Light& light : scene.lights)
        made->near_reach.push_back(
            scene::trace_near_lamp(made->near, tracer, cell_m, light.position_m, 5000.0f));
    return made;
}

Frame frame_from(const Camera& camera, int width = 96, int height = 64)
{
    Frame frame;
    frame.camera = camera;
    frame.sky.sun_illuminance = 0.0f;
    frame.settings.width = width;
    frame.settings.height = height;
    frame.settings.samples = 1;
    frame.settings.ambient_occlusion = false;
    frame.weather.visibility_m = 1e9f;
    frame.settings.aovs = {"depth", "position", "normal"};
    return frame;
}

// A yard: ground, a house, a low wall.
Scene yard(const Material& material)
{
    std::vector<Primitive> p{quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16})};
    add_box(p, {-3, 0, -4}, {1, 3, -2}, false, 0);
    add_box(p, {1.5f, 0, -1}, {1.7f, 1, 3}, false, 0);
    return scene_of(std::move(p), {material});
}

class PatchLightTest : public GpuTest {};

// Where the scene's ground ends before the horizon the land beyond goes on from it, of one colour and one brightness,
// unless something else is asked for.
TEST_F(PatchLightTest, LandBeyondGoesOnFromTheGroundAtTheRim)
{
    const Scene scene = scene_of({quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40})}, {lambert({0.1f, 0.4f, 0.05f})});
    renderer->load(scene, {});
    renderer->set_patches(traced(scene, 2.0f));
    Frame frame = frame_from(look({0, 12, 10}, {0, 0, -20}, 0.6f));
    frame.sky.sun_illuminance = 100000.0f;
    frame.sky.cloud_cover = 1.0f;
    const auto beside_the_rim = [&](bool land_as_ground) {
        frame.sky.land_as_ground = land_as_ground;
        const RenderResult r = renderer->render(frame);
        const int x = r.width / 2;
        int rim = 0;  // first row of ground
        while (rim < r.height && !std::isfinite(aov(r, "depth", x, rim, 0))) ++rim;
        EXPECT_GT(rim, 3);
        EXPECT_LT(rim, r.height - 3);
        return std::pair(glm::vec3(pixel(r, x, rim - 3)), glm::vec3(pixel(r, x, rim + 2)));
    };
    const auto [land, ground] = beside_the_rim(true);
    const auto [asked, same] = beside_the_rim(false);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(land[k], ground[k], 0.08f * ground[k]) << k;
        EXPECT_NEAR(same[k], ground[k], 1e-3f * ground[k]) << k;
    }
    EXPECT_GT(asked.x, 1.5f * ground.x) << "of an albedo of 0.2";
}

// Low light at the horizon, of 4 degrees: level ground gets a fourteenth of what a wall has that faces it. With patches
// and without, every pixel alike: rays of a patch meet it by chance, three bands of harmonics let half as much again in.
TEST_F(PatchLightTest, AGlowAtTheHorizonFallsOnLevelGroundAsItsCosineSays)
{
    EnvironmentMap map;
    map.width = 256;
    map.height = 128;
    map.rgb.assign(std::size_t{256} * 128 * 3, 0.0f);
    double up = 0.0;
    for (int y = 0; y < 128; ++y) {
        const double elevation = (0.5 - (y + 0.5) / 128.0) * std::numbers::pi;
        for (int x = 0; x < 256; ++x) {
            const bool glow = x >= 100 && x < 130 && elevation > 0.03 && elevation < 0.11;
            const float radiance = glow ? 50.0f : elevation > 0.0 ? 0.4f : 0.0f;
            for (std::size_t c = 0; c < 3; ++c)
                map.rgb[(static_cast<std::size_t>(y) * 256 + static_cast<std::size_t>(x)) * 3 + c] = radiance;
            const double area = std::cos(elevation) * (std::numbers::pi / 128.0) * (std::numbers::pi / 128.0);
            up += static_cast<double>(radiance) * area * std::max(std::sin(elevation), 0.0);
        }
    }
    const auto expected = static_cast<float>(0.5 * up / std::numbers::pi);
    const Scene scene = scene_of({quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16})}, {lambert(glm::vec3(0.5f))});
    for (const bool patches : {true, false}) {
        renderer->load(scene, {});
        renderer->set_patches(patches ? traced(scene) : nullptr);
        renderer->set_environment(map);
        const RenderResult r = renderer->render(frame_from(look({0, 6, 5}, {0, 0, 0}, 0.6f)));
        float least = 1e9f, most = 0.0f;
        for (int y = 0; y < r.height; ++y) {
            for (int x = 0; x < r.width; ++x) {
                least = std::min(least, pixel(r, x, y).g);
                most = std::max(most, pixel(r, x, y).g);
            }
        }
        EXPECT_NEAR(least, expected, 0.06f * expected) << patches;
        EXPECT_NEAR(most, least, 0.01f * expected) << patches;
    }
}

// Ground that no patch is near is lit by the sky, up to the outline of what hangs over it.
TEST_F(PatchLightTest, FarGroundBehindANearThingIsNotLitAsThatThing)
{
    std::vector<Primitive> thing;
    add_box(thing, {-1, 4, -1}, {1, 5, 1}, false, 0);
    const Material matt = lambert(glm::vec3(0.5f));
    const auto patches = traced(scene_of(thing, {matt}));
    thing.push_back(quad({-40, -10, 40}, {80, 0, 0}, {0, 0, -80}));
    renderer->load(scene_of(std::move(thing), {matt}), {});
    renderer->set_patches(patches);
    renderer->set_environment(constant_environment(1.0f));
    const RenderResult r = renderer->render(frame_from(look({6, 9, 6}, {0, 4, 0}, 0.7f)));
    int ground = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            if (!(aov(r, "position", x, y, 1) < -9.0f)) continue;
            ++ground;
            EXPECT_NEAR(pixel(r, x, y).g, 0.5f, 0.01f) << x << " " << y;
        }
    }
    EXPECT_GT(ground, 1000);
}

// Below the ground, whose backs are not drawn, everything that is seen has a value.
TEST_F(PatchLightTest, FromUnderTheGroundThePictureIsDefined)
{
    const Scene scene = yard(lambert(glm::vec3(0.5f)));
    renderer->load(scene, {});
    renderer->set_patches(traced(scene, 0.5f));
    renderer->set_environment(constant_environment(1.0f));
    const Frame frame = frame_from(look({0, -1.5f, 2}, {-1, 3, -3}, 1.2f));
    const RenderResult r = renderer->render(frame);
    int seen = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            const glm::vec3 c(pixel(r, x, y));
            EXPECT_TRUE(std::isfinite(c.r + c.g + c.b)) << x << " " << y;
            EXPECT_GE(std::min(c.r, std::min(c.g, c.b)), 0.0f);
            EXPECT_LE(std::max(c.r, std::max(c.g, c.b)), 1.001f) << "more than the sky";
            seen += std::isfinite(aov(r, "position", x, y, 1)) ? 1 : 0;
        }
    }
    EXPECT_GT(seen, 100);
    EXPECT_EQ(renderer->render(frame).beauty, r.beauty);
}

TEST_F(PatchLightTest, TheDeviceLooksUpWhatTheCpuDoes)
{
    const Scene scene = yard(lambert({0.5f, 0.4f, 0.3f}));
    const auto patches = traced(scene);
    renderer->load(scene, {});
    renderer->set_patches(patches);
    renderer->set_environment(constant_environment(1.0f));
    // A block of pixels is about as wide as a cell: light changes over a cell, and between blocks it is a straight line.
    const RenderResult r = renderer->render(frame_from(look({5, 3, 6}, {-1, 0.8f, -1}, 0.9f), 144, 96));

    // The same light on the CPU.
    const scene::Patches& p = patches->patches;
    const PatchLook seen = patch_look(*patches, {}, {}, true);
    const std::vector<glm::vec3> none(p.count, glm::vec3(0.0f));
    const std::vector<glm::vec3> sky(shared::kSkyBins, glm::vec3(kPi));
    scene::Relight input;
    input.albedo = seen.albedo;
    input.direct = none;
    input.sky = sky;
    const std::vector<glm::vec3> near_direct(patches->near.sources(), glm::vec3(0.0f));
    ASSERT_GT(patches->near.entries(), 50u);
    input.near = &patches->near;
    input.near_albedo = seen.near_albedo;
    input.near_direct = near_direct;
    const auto light = scene::relight(p, input);
    const auto planes = scene::lookup_planes(p);
    const scene::LookupWays ways = scene::lookup_ways(p, &patches->near);
    const scene::LitPatches lit{ways.table,     ways.ways, planes,    light.irradiance,
                                light.gradient, ways.grid, light.near};
    // Looked up is one pixel of each block; the others take it from the blocks around.
    int looked_up = 0, different = 0, spread = 0, off = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            if (!std::isfinite(aov(r, "depth", x, y))) continue;
            const auto three = [&](const char* name) {
                return glm::vec3(aov(r, name, x, y, 0), aov(r, name, x, y, 1),
                                 aov(r, name, x, y, 2));
            };
            const glm::vec3 n = glm::normalize(three("normal"));
            const auto at = scene::light_at(lit, three("position"), n);
            ASSERT_GT(at.weight, 0.0f);
            const glm::vec3 radiance =
                at.irradiance *
                (shared::irradiance_towards(at.gradient, glm::normalize(at.normal), n) / kPi) *
                glm::vec3(0.5f, 0.4f, 0.3f);
            const float error = glm::length(pixel(r, x, y) - radiance);
            if (x % PATCH_BLOCK == PATCH_BLOCK / 2 && y % PATCH_BLOCK == PATCH_BLOCK / 2) {
                ++looked_up;
                // Half floats and eight-bit colour; a cell's border may fall to either side.
                if (error > 0.02f * glm::length(radiance) + 0.002f) ++different;
            }
            ++spread;
            if (error > 0.1f * glm::length(radiance) + 0.002f) ++off;
        }
    }
    EXPECT_GT(looked_up, 200);
    EXPECT_LE(different, looked_up / 50);
    EXPECT_LE(off, spread / 50);
}

// A closed white room under a glowing ceiling would be a furnace; here: no light comes in.
TEST_F(PatchLightTest, AClosedRoomIsDarkAndAnOpenOneIsNot)
{
    float inside[2];
    for (int open = 0; open < 2; ++open) {
        std::vector<Primitive> p;
        add_box(p, {-2.2f, -0.2f, -2.2f}, {2.2f, 3.2f, 2.2f}, false, 0);
        add_box(p, {-2, 0, -2}, {2, 3, 2}, true, 0);
        if (open) {  // no ceiling: the top faces of both boxes
            p.erase(p.begin() + 7);
            p.erase(p.begin() + 1);
        }
        const Scene scene = scene_of(std::move(p), {lambert(glm::vec3(0.5f))});
        renderer->load(scene, {});
        renderer->set_patches(traced(scene));
        renderer->set_environment(constant_environment(1.0f));
        const RenderResult r = renderer->render(frame_from(look({-1.8f, 1.5f, 0}, {2, 1, 0}, 1.0f)));
        float sum = 0.0f;
        for (int y = 0; y < r.height; ++y)
            for (int x = 0; x < r.width; ++x) sum += luminance(pixel(r, x, y));
        inside[open] = sum / static_cast<float>(r.width * r.height);
    }
    EXPECT_LT(inside[0], 0.01f);
    EXPECT_GT(inside[1], 0.1f);
}

// Snow on the ground lights what looks down at it.
TEST_F(PatchLightTest, SnowLightsTheCeilingAboveIt)
{
    std::vector<Primitive> p{quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20})};
    add_box(p, {-1.5f, 2.5f, -1.5f}, {1.5f, 2.7f, 1.5f}, false, 0);
    const Scene scene = scene_of(std::move(p), {plain_material(glm::vec3(0.15f), 1.0f)});
    renderer->load(scene, {});
    renderer->set_patches(traced(scene));
    renderer->set_environment(constant_environment(1.0f));
    Frame frame = frame_from(look({0, 1.2f, 4}, {0, 2.5f, 0}, 0.2f));
    const float dry = luminance(pixel(renderer->render(frame), 48, 32));
    frame.weather.snow_amount = 1.0f;
    frame.weather.water_to_snow = 1.0f;
    const float snowy = luminance(pixel(renderer->render(frame), 48, 32));
    EXPECT_GT(snowy, 2.0f * dry);
    frame.settings.patch_light = false;
    frame.weather = {};
    frame.weather.visibility_m = 1e9f;
    const float ambient = luminance(pixel(renderer->render(frame), 48, 32));
    EXPECT_NE(ambient, dry) << "the switch does nothing";
}

// Level ground under an even sky, in pictures that end within a tile or a block of the passes: as light at each edge as in the middle.
TEST_F(PatchLightTest, APictureOfAnyWidthIsLitToItsEdges)
{
    const Scene scene = scene_of({quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40})}, {lambert(glm::vec3(0.5f))});
    renderer->load(scene, {});
    renderer->set_patches(traced(scene));
    renderer->set_environment(constant_environment(1.0f));
    for (const glm::ivec2 size : {glm::ivec2(106, 60), glm::ivec2(97, 61), glm::ivec2(33, 7), glm::ivec2(112, 64)}) {
        for (const bool occlusion : {false, true}) {
            Frame frame = frame_from(look({0, 4, 0.5f}, {0, 0, 0}, 0.5f), size.x, size.y);
            frame.settings.ambient_occlusion = occlusion;
            const RenderResult picture = renderer->render(frame);
            const float middle = luminance(pixel(picture, size.x / 2, size.y / 2));
            EXPECT_GT(middle, 0.1f);
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x)
                    ASSERT_NEAR(luminance(pixel(picture, x, y)), middle, 0.1f * middle) << size.x << " x " << size.y << ": " << x << " " << y << " " << occlusion;
            }
        }
    }
}

TEST_F(PatchLightTest, ALampShinesRoundTheCorner)
{
    std::vector<Primitive> p{quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})};
    add_box(p, {-0.1f, 0, -6}, {0.1f, 3, 1}, false, 0);   // between the lamp and the place
    add_box(p, {-6, 0, 3}, {6, 3, 3.2f}, false, 0);       // sends light back
    Scene scene = scene_of(std::move(p), {lambert(glm::vec3(0.6f))});
    Light lamp;
    lamp.position_m = {2, 2, -1};
    lamp.intensity = 100.0f;
    lamp.range_m = 30.0f;
    scene.lights = {lamp};
    const auto patches = traced(scene);
    renderer->load(scene, {});
    renderer->set_patches(patches);
    renderer->set_environment(constant_environment(0.0f));
    Frame frame = frame_from(look({-3, 2.5f, 2.5f}, {-2, 0, -1}, 0.4f));
    // Lamps cast no shadow of their own here: their direct light is switched off by the pixel's
    // difference to a frame without patches.
    const glm::vec3 with = pixel(renderer->render(frame), 48, 32);
    frame.settings.patch_light = false;
    const glm::vec3 without = pixel(renderer->render(frame), 48, 32);
    EXPECT_GT(luminance(with) - luminance(without), 0.02f);
    frame.settings.patch_light = true;
    frame.scene_light_scale = 0.0f;
    EXPECT_LT(luminance(pixel(renderer->render(frame), 48, 32)), 1e-3f);
}

// A wall that is painted in the course of a film lights what faces it in its new colour.
TEST_F(PatchLightTest, AMaterialThatChangesChangesItsLight)
{
    const Scene scene = yard(lambert(glm::vec3(0.2f)));
    const auto patches = traced(scene, 0.5f);
    const PatchLook before = patch_look(*patches, {}, {}, true);
    const PatchLook after = patch_look(*patches, {}, {}, true,
                                       {{0, "base_color_factor", {0.8f, 0.4f, 0.2f, 1.0f}}});
    for (std::size_t i = 0; i < before.albedo.size(); ++i) {
        ASSERT_NEAR(before.albedo[i].x, 0.2f, 1e-4f);
        ASSERT_NEAR(after.albedo[i].x, 0.8f, 1e-4f);
        ASSERT_NEAR(after.albedo[i].y, 0.4f, 1e-4f);
    }
}

// Hoar grows on crystals first, so that a third of it covers most of a lawn: patches send back what the pixels show.
TEST_F(PatchLightTest, PatchesHaveTheHoarThatPixelsHave)
{
    const Scene scene = scene_of({quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16})}, {lambert(glm::vec3(0.1f))});
    const auto patches = traced(scene);
    renderer->load(scene, {});
    for (const float amount : {0.2f, 0.35f, 0.6f}) {
        shared::WeatherMoment weather{};
        weather.frost = amount;
        Frame frame;
        frame.settings.width = frame.settings.height = 64;
        frame.settings.samples = 1;
        frame.settings.shelter = false;
        frame.settings.aovs = {"frost"};
        frame.weather.frost = amount;
        frame.camera = look({0, 1.5f, 0.01f}, {0, 0, 0}, 0.9f);
        const RenderResult r = renderer->render(frame);
        float cover = 0.0f;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) cover += aov(r, "frost", x, y, 0) / 4096.0f;
        EXPECT_GT(cover, amount + 0.1f);
        const glm::vec3 white = glm::mix(glm::vec3(0.1f), glm::vec3(0.87f, 0.88f, 0.89f), 0.85f * cover);
        const PatchLook hoary = patch_look(*patches, weather, {}, false);
        for (const glm::vec3& albedo : hoary.albedo) EXPECT_NEAR(albedo.x, white.x, 0.07f) << amount << " " << cover;
    }
}

// A white sill on a dark wall is white to the patches it is close to, though the patch below both is the mean of the two;
// snow that lies on it makes what it sends white, rain that a porous stone drinks makes it darker.
TEST_F(PatchLightTest, WhatIsCloseHasItsOwnMaterialUnderItsOwnWeather)
{
    Material stone = lambert(glm::vec3(0.6f, 0.5f, 0.4f));
    stone.weather.porosity = 1.0f;
    std::vector<Primitive> p{quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16})};
    add_box(p, {-3, 0, -3}, {3, 3, -2}, false, 0);
    add_box(p, {-1, 1, -2}, {1, 1.1f, -1.94f}, false, 1);
    const Scene scene = scene_of(std::move(p), {lambert(glm::vec3(0.1f)), stone});
    const auto patches = traced(scene);
    const scene::NearLinks& near = patches->near;
    const PatchLook dry = patch_look(*patches, {}, {}, true);
    shared::WeatherMoment weather{};
    weather.snow_amount = 1.0f;
    weather.water_to_snow = 1.0f;
    const PatchLook snowy = patch_look(*patches, weather, {}, true);
    weather = {};
    weather.film_albedo = 1.0f;
    const PatchLook wet = patch_look(*patches, weather, {}, true);
    ASSERT_EQ(dry.near_albedo.size(), near.sources());
    int tops = 0, sides = 0;
    for (std::size_t s = 0; s < near.sources(); ++s) {
        const bool sill = near.material[s] == 1;
        EXPECT_NEAR(dry.near_albedo[s].x, sill ? 0.6f : 0.1f, 1e-4f);
        EXPECT_NEAR(dry.near_albedo[s].z, sill ? 0.4f : 0.1f, 1e-4f);
        if (!sill) continue;
        const bool top = near.normal[s].y > 0.9f;
        (top ? tops : sides) += 1;
        if (top) {
            EXPECT_GT(snowy.near_albedo[s].z, 0.6f);
            EXPECT_LT(wet.near_albedo[s].x, 0.55f);
        } else if (near.normal[s].y < -0.9f) {
            EXPECT_NEAR(snowy.near_albedo[s].z, 0.4f, 0.02f) << "no snow lies on what faces down";
        }
    }
    EXPECT_GT(tops, 1);
    EXPECT_GT(sides, 3);

    // And sends it: a finger's breadth above the snowy sill there is more light than above the dry one.
    renderer->load(scene, {});
    renderer->set_patches(patches);
    renderer->set_environment(constant_environment(1.0f));
    Frame frame = frame_from(look({0, 1.4f, 0}, {0, 1.13f, -2}, 0.05f));
    const float before = luminance(pixel(renderer->render(frame), 48, 32));
    frame.weather.snow_amount = 1.0f;
    frame.weather.water_to_snow = 1.0f;
    EXPECT_GT(luminance(pixel(renderer->render(frame), 48, 32)), 1.03f * before);
}

// A patch under thin snow is as white as its places are in the mean.
TEST_F(PatchLightTest, ThinSnowOnAPatchIsTheMeanOfItsPlaces)
{
    const auto patches = traced(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {lambert(glm::vec3(0.0f))}), 1.0f);
    const float damp = patches->materials[0].weather.snow_slope_damp;
    for (const float amount : {0.25f, 0.4f, 0.58f, 0.8f}) {
        shared::WeatherMoment weather;
        weather.snow_amount = amount;
        weather.snow_start_height_m = -100.0f;
        weather.snow_height_blend_m = 10.0f;
        const PatchLook look = patch_look(*patches, weather, {}, false);
        double cover = 0.0;
        const int count = 4000;
        for (int i = 0; i < count; ++i) {
            const glm::vec2 at(111.0f * shared::hash_f(static_cast<std::uint32_t>(i)),
                               111.0f * shared::hash_f(static_cast<std::uint32_t>(i) + 77777u));
            const float mask = shared::snow_texel(at * 0.09f, 1.0f / 512.0f).z;
            const float detail = shared::snow_texel(at * 0.83f, 1.0f / 512.0f).z;
            cover += static_cast<double>(shared::snow_cover(amount, 1.0f, 1.0f, damp, 1.0f, mask, detail, 0.0f, 0.0f).snow);
        }
        EXPECT_NEAR(look.albedo.front().x, 0.92 * cover / count, 0.05) << amount;
    }
}

// Snow that lies on some patches alone brightens those, whatever the frame says of the open.
TEST_F(PatchLightTest, PatchesHaveTheirOwnWeather)
{
    const Scene scene = yard(lambert(glm::vec3(0.2f)));
    const auto patches = traced(scene, 0.5f);
    const scene::Patches& p = patches->patches;
    auto shape = std::make_shared<PlaceShape>();
    shape->grid = scene::table_grid(p);
    shape->table = p.table;
    PlaceWeather place;
    place.shape = shape;
    place.states.assign(std::size_t{p.count} * PLACE_STATE_TEXELS, glm::vec4(0.0f));
    const auto snowy = [&](std::size_t i) { return p.normal[i].y > 0.9f && p.position_m[i].x > 2.0f; };
    const auto wet = [&](std::size_t i) { return p.normal[i].x < -0.9f; };
    for (std::size_t i = 0; i < p.count; ++i) {
        if (snowy(i)) place.states[i * PLACE_STATE_TEXELS].w = 1.0f;
        if (wet(i)) place.states[i * PLACE_STATE_TEXELS].x = 1.0f;
    }
    const PatchLook look = patch_look(*patches, {}, {}, true, {}, &place);
    for (std::size_t i = 0; i < p.count; ++i) {
        if (snowy(i)) {
            EXPECT_GT(look.albedo[i].y, 0.6f) << i;
        } else if (wet(i)) {
            EXPECT_LT(look.albedo[i].y, 0.17f) << i;
        } else {
            EXPECT_NEAR(look.albedo[i].y, 0.2f, 1e-3f) << i;
        }
    }
    shared::WeatherMoment white;
    white.snow_amount = 1.0f;
    EXPECT_EQ(patch_look(*patches, white, {}, true, {}, &place).albedo, look.albedo);
    // Of other patches it is not.
    shape->table.pop_back();
    EXPECT_NE(patch_look(*patches, white, {}, true, {}, &place).albedo, look.albedo);
}

// Ground below a pond sends back what water over it does, whichever of the two weathers of a place it is of.
TEST_F(PatchLightTest, GroundBelowAPondIsAsDarkAsItsWater)
{
    const Scene scene = yard(lambert(glm::vec3(0.2f)));
    const auto patches = traced(scene, 0.5f);
    const scene::Patches& p = patches->patches;
    auto shape = std::make_shared<PlaceShape>();
    shape->grid = scene::table_grid(p);
    shape->table = p.table;
    shape->basin_corner_m = {-8.0f, -8.0f};
    shape->basin_width = shape->basin_depth = 16;
    shape->labels.assign(256, 0);
    for (std::size_t k = 0; k < 256; ++k)
        if (k % 16 < 4) shape->labels[k] = 1;  // x from -8 to -4
    PlaceWeather place;
    place.shape = shape;
    place.states.assign(std::size_t{p.count} * PLACE_STATE_TEXELS, glm::vec4(0.0f));
    place.levels_m = {0.0f, 0.02f};
    const auto albedo = patch_look(*patches, {}, {}, true, {}, &place).albedo;
    auto ponds = std::make_shared<PlaceShape>(*shape);
    ponds->grid.levels = 0;
    PlaceWeather alone;
    alone.shape = ponds;
    alone.levels_m = place.levels_m;
    shared::WeatherMoment wet;
    wet.flood_puddles = 1e-3f;
    const auto without_patches = patch_look(*patches, wet, {}, true, {}, &alone).albedo;
    int seen = 0;
    for (std::size_t i = 0; i < p.count; ++i) {
        if (p.normal[i].y < 0.9f || p.position_m[i].y > 0.1f) continue;
        if (p.position_m[i].x < -4.5f) {
            // 0.1089 below the film, 0.02 mirrored.
            EXPECT_NEAR(albedo[i].y, 0.1089f * 0.98f + 0.02f, 2e-3f) << i;
            EXPECT_NEAR(without_patches[i].y, albedo[i].y, 2e-3f) << i;
            ++seen;
        } else if (p.position_m[i].x > -3.5f) {
            EXPECT_NEAR(albedo[i].y, 0.2f, 1e-3f) << i;
        }
    }
    EXPECT_GT(seen, 50);
}

TEST_F(PatchLightTest, TheSameBytesAgain)
{
    const Scene scene = yard(plain_material({0.5f, 0.4f, 0.3f}));
    renderer->load(scene, {});
    renderer->set_patches(traced(scene));
    Frame frame = frame_from(look({5, 3, 6}, {-1, 0.8f, -1}, 0.9f));
    frame.sky.sun_illuminance = 100000.0f;
    const auto first = renderer->render(frame).beauty;
    Frame other = frame;
    other.sky.sun_elevation_rad = 0.2f;
    EXPECT_NE(renderer->render(other).beauty, first);
    EXPECT_EQ(renderer->render(frame).beauty, first) << "no history";
    renderer->load(scene, {});
    EXPECT_NE(renderer->render(frame).beauty, first) << "load() forgets the patches";
}

// A thin wall in the sun with a dark room behind it: what is looked up beside its edges is of either
// side, and neither side shows the other's light.
TEST_F(PatchLightTest, LightDoesNotCrossAThinWall)
{
    std::vector<Primitive> p{quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})};
    add_box(p, {-4, 0, -4}, {4, 2, -3.95f}, false, 0);   // walls of 5 cm
    add_box(p, {-4, 0, -0.05f}, {4, 2, 0}, false, 0);
    add_box(p, {-4, 0, -3.95f}, {-3.95f, 2, -0.05f}, false, 0);
    add_box(p, {-4, 2, -4}, {4, 2.05f, 0}, false, 0);
    const Scene scene = scene_of(std::move(p), {lambert(glm::vec3(0.5f))});
    renderer->load(scene, {});
    renderer->set_patches(traced(scene));
    renderer->set_environment(constant_environment(1.0f));
    // From the open end, past the front wall's edge: room and yard side by side.
    const RenderResult r = renderer->render(
        frame_from(look({7, 1, 0.5f}, {-3.9f, 0.8f, -0.4f}, 0.35f), 160, 96));
    int deep = 0, yard = 0;
    for (int y = 0; y < r.height; ++y) {
        for (int x = 0; x < r.width; ++x) {
            const glm::vec3 at{aov(r, "position", x, y, 0), aov(r, "position", x, y, 1),
                               aov(r, "position", x, y, 2)};
            if (!std::isfinite(aov(r, "depth", x, y)) || at.y > 1.9f || at.x > -1.0f) continue;
            const float seen = luminance(pixel(r, x, y));
            if (at.z < -0.06f && at.x > -3.94f && at.z > -3.9f) {
                ++deep;
                EXPECT_LT(seen, 0.2f) << at.x << " " << at.y << " " << at.z;
            } else if (at.z > 0.1f && at.y < 0.01f) {
                ++yard;
                EXPECT_GT(seen, 0.2f) << at.x << " " << at.y << " " << at.z;
            }
        }
    }
    EXPECT_GT(deep, 100);
    EXPECT_GT(yard, 30);
}

}  // namespace
}  // namespace petrichor::gpu
