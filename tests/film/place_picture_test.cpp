// The weather of places in the picture: of a house in wind the wall that it blows on is dark.
#include "film/weather/artist_places.h"
#include "film/weather/patch_weather.h"
#include "scene/patches/surfaces.h"
#include "scene/patches/tracer.h"
#include "tests/film/rain_table.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/scene/patch_scenes.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using namespace scene::patch_scenes;

// A box of plaster on ground of asphalt, and its places.
struct House {
    scene::Scene scene = made();
    scene::Triangles triangles{scene, {}};
    scene::Tracer tracer{triangles};
    scene::Patches patches = cut();
    std::vector<scene::PatchSurface> surfaces = scene::patch_surfaces(patches, triangles, {});
    SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));

    static scene::Scene made()
    {
        scene::Scene scene = empty_scene();
        scene.materials[0] = gpu::plain_material(glm::vec3(0.3f), 0.9f);
        scene.materials[0].name = "asphalt";
        scene.materials[0].weather.porosity = 0.7f;
        add_face(scene, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0});
        scene::Material plaster = scene.materials[0];
        plaster.name = "plaster";
        add_box(scene, {-2, 0, -2}, {2, 3, 2}, false, add_material(scene, plaster));
        return scene;
    }
    scene::Patches cut() const
    {
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 64;
        return scene::build_patches(tracer, options);
    }
};

WeatherScript storm(double from_deg, double wetness)
{
    return read_weather_script(
        "[weather]\nkeys = [{ time_s = 0, temperature_c = 9, rainfall = 0.0, wind_m_s = 5, "
        "wind_from_deg = " +
            std::to_string(from_deg) + ", cloud_cover = 1, script_controlled = 0, wetness = " +
            std::to_string(wetness) + ", cracks = 0, puddles = 0 }]",
        "test");
}

class PlacePicture : public gpu::GpuTest {
protected:
    // Luminance of the middle of a wall, `side` 1 the east one, or of the ground before it.
    float seen(const House& house, const WeatherScript& script, float side, bool ground = false)
    {
        gpu::Frame frame;
        frame.camera = ground ? gpu::look({7.0f * side, 4, 0}, {6.5f * side, 0, 0}, 0.3f)
                              : gpu::look({8.0f * side, 1.5f, 0}, {2.0f * side, 1.5f, 0}, 0.3f);
        frame.sky.sun_illuminance = 0.0f;
        frame.settings.width = frame.settings.height = 32;
        frame.settings.samples = 4;
        frame.settings.film_lobe = false;  // what is mirrored is no darkening
        frame.weather.visibility_m = 1e9f;
        frame.place = ArtistPlaces(house.sites, script, 50.0, 0.0).at(0.0);
        const gpu::RenderResult r = renderer->render(frame);
        float sum = 0.0f;
        for (int y = 12; y < 20; ++y)
            for (int x = 12; x < 20; ++x) sum += gpu::luminance(gpu::pixel(r, x, y)) / 64.0f;
        return sum;
    }
};

// A fifth of the rain that falls in the open wets a wall as it wets a pixel without patches: all but.
TEST_F(PlacePicture, TheWallThatTheStormBlowsOnIsDarkAndTheOtherIsDry)
{
    const House house;
    renderer->load(house.scene, {});
    renderer->set_environment(gpu::constant_environment(1.0f));
    for (const float east : {1.0f, -1.0f}) {
        const double from = east > 0.0f ? 90.0 : 270.0;
        const WeatherScript wet = storm(from, 1.0), dry = storm(from, 0.0);
        EXPECT_LT(seen(house, wet, east), 0.86f * seen(house, dry, east)) << from;
        EXPECT_NEAR(seen(house, wet, -east), seen(house, dry, -east), 0.01f) << from;
        EXPECT_LT(seen(house, wet, east, true), 0.86f * seen(house, dry, east, true)) << from;
    }
}

// A road with a film of .84 looks wet.
TEST_F(PlacePicture, AFilmOnTheRoadDarkensIt)
{
    const House house;
    renderer->load(house.scene, {});
    renderer->set_environment(gpu::constant_environment(1.0f));
    const float dry = seen(house, storm(270.0, 0.0), 1.0f, true);
    const float half = seen(house, storm(90.0, 0.42), 1.0f, true);
    const float wet = seen(house, storm(90.0, 0.84), 1.0f, true);
    EXPECT_LT(half, 0.94f * dry);
    EXPECT_LT(wet, 0.86f * dry);
}

// An eye below the ground, under every sun and none, in calm and in a hurricane: a picture of numbers.
TEST_F(PlacePicture, AnEyeBelowTheGroundAndASunBelowTheHorizonAreDefined)
{
    const House house;
    renderer->load(house.scene, {});
    auto lit = std::make_shared<gpu::PatchScene>();
    lit->patches = house.patches;
    lit->surfaces = house.surfaces;
    lit->materials = house.scene.materials;
    renderer->set_patches(lit);
    for (const float eye_m : {-3.0f, 1.5f}) {
        for (const float sun_rad : {0.7f, 0.0f, -0.4f, -1.5f}) {
            for (const double wind : {0.0, 60.0}) {
                SCOPED_TRACE(eye_m);
                SCOPED_TRACE(sun_rad);
                gpu::Frame frame;
                frame.camera = gpu::look({6, eye_m, 5}, {0, eye_m + 0.5f, 0}, 0.8f);
                frame.sky.sun_elevation_rad = sun_rad;
                frame.settings.width = frame.settings.height = 32;
                frame.settings.samples = 1;
                frame.settings.aovs = {"depth"};
                frame.weather.wind_m_s = glm::vec2(static_cast<float>(wind), 0.0f);
                const auto table = rain_table(4, 6.0, wind, 270.0);
                PlaceWeatherOfFile run(house.sites, table, {}, table.time_us.front());
                frame.place = run.at(table.time_us[3]);
                const gpu::RenderResult r = renderer->render(frame);
                int surfaces = 0;
                for (int y = 0; y < 32; ++y) {
                    for (int x = 0; x < 32; ++x) {
                        const glm::vec3 c = gpu::pixel(r, x, y);
                        for (int k = 0; k < 3; ++k) {
                            ASSERT_TRUE(std::isfinite(c[k])) << x << " " << y;
                            ASSERT_GE(c[k], 0.0f) << x << " " << y;
                        }
                        surfaces += std::isfinite(gpu::aov(r, "depth", x, y)) ? 1 : 0;
                    }
                }
                EXPECT_GT(surfaces, 0);
            }
        }
    }
    renderer->set_patches(nullptr);
}

// Setts whose relief has four levels, seen from above: a road without hollows of its geometry.
struct Setts {
    scene::Scene scene = made();
    scene::Triangles triangles{scene, {}};
    scene::Tracer tracer{triangles};
    scene::Patches patches = cut();
    std::vector<scene::PatchSurface> surfaces = scene::patch_surfaces(patches, triangles, {});
    SceneSites sites =
        scene_sites(scene, patches, tracer, surfaces, {}, weather::surface_preset("asphalt"));

    static scene::Scene made()
    {
        scene::Scene scene = empty_scene();
        add_face(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
        std::vector<std::uint8_t> grey;
        for (int i = 0; i < kTexels * kTexels; ++i) grey.push_back(height_of(i));
        scene::EncodedImage image;
        image.name = "heights";
        image.bytes = texproc::encode_png8(kTexels, kTexels, 1, grey);
        scene.textures.push_back(image);
        scene.materials[0] = gpu::plain_material(glm::vec3(0.3f), 0.9f);
        scene.materials[0].name = "cobble";
        scene.materials[0].weather.height.texture = 0;
        scene.materials[0].weather.height.scale = glm::vec2(7.0f);
        return scene;
    }
    static constexpr int kTexels = 64;
    static std::uint8_t height_of(int texel)
    {
        return static_cast<std::uint8_t>(85 * (texel / kTexels * 4 / kTexels));
    }
    // The same as the renderer reads it.
    gpu::Texture heights() const
    {
        gpu::Texture texture;
        texture.name = "heights";
        texture.format = gpu::TexelFormat::Rgba8Unorm;
        texture.width = texture.height = kTexels;
        texture.mips.emplace_back();
        for (int i = 0; i < kTexels * kTexels; ++i)
            for (int c = 0; c < 4; ++c)
                texture.mips[0].push_back(static_cast<std::byte>(height_of(i)));
        return texture;
    }
    scene::Patches cut() const
    {
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 64;
        return scene::build_patches(tracer, options);
    }
};

// An hour after a thunderstorm what the patches still hold stands in the joints of the stones: as much of
// the road is under water as that volume reaches, and the label adds up to it.
TEST_F(PlacePicture, WhatPatchesHoldStandsInTheirRelief)
{
    const Setts setts;
    renderer->load(setts.scene, {setts.heights()});
    const auto table = rain_table(12, 20.0, 1.0, 90.0, 2);
    PlaceWeatherOfFile run(setts.sites, table, {}, table.time_us.front());
    gpu::Frame frame;
    frame.camera = gpu::look({0, 10, 0}, {0, 0, 0}, 0.6f);
    frame.settings.width = frame.settings.height = 96;
    frame.settings.samples = 1;
    frame.settings.aovs = {"water", "water_depth"};
    frame.place = run.at(table.time_us[3]);
    const PlaceSums sums = run.sums();
    const double mean_mm = sums.standing_kg / sums.area_m2;
    ASSERT_GT(mean_mm, 0.7) << "setts do not drink it";
    const gpu::RenderResult r = renderer->render(frame);
    double label_mm = 0.0, under = 0.0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            label_mm += 1e3 * static_cast<double>(gpu::aov(r, "water_depth", x, y)) / (96.0 * 96.0);
            under += gpu::aov(r, "water", x, y) > 0.5f ? 1.0 / (96.0 * 96.0) : 0.0;
        }
    }
    EXPECT_NEAR(label_mm, mean_mm, 0.02 * mean_mm);
    const WaterRelief& relief = setts.sites.relief.at(0);
    const float share = drowned_share(relief, relief_level(relief, mean_mm));
    EXPECT_GT(share, 0.15f);
    EXPECT_LT(share, 0.6f);
    EXPECT_NEAR(under, static_cast<double>(share), 0.1);
    // A day later it is gone.
    frame.place = run.at(table.time_us.back());
    EXPECT_LT(run.sums().standing_kg, sums.standing_kg);
}

}  // namespace
}  // namespace petrichor::film
