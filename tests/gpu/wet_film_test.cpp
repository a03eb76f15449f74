// A film of rain on the road: its own highlight over that of the stones, and no more light than comes in.
#include <algorithm>
#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class WetFilmTest : public GpuTest {};

constexpr int kSide = 64;

Frame wet(float film)
{
    Frame frame;
    frame.settings.width = frame.settings.height = kSide;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.settings.shelter = false;
    frame.settings.shadows = false;
    frame.settings.ambient_occlusion = false;
    frame.fog.mode = FogMode::Off;
    frame.weather.film_albedo = film > 0.0f ? 0.85f : 0.0f;
    frame.weather.film_smoothness = film;
    return frame;
}

// A lamp ahead over a rough road by night: where its highlight is at least a quarter of the brightest.
TEST_F(WetFilmTest, ALampOverAWetRoadIsALongStreak)
{
    Scene scene = scene_of({quad({-10, 0, 2}, {20, 0, 0}, {0, 0, -40})},
                           {plain_material(glm::vec3(0.1f), 0.85f)});
    scene.materials[0].weather.porosity = 0.3f;
    Light lamp;
    lamp.position_m = {0, 3.0f, -24};
    lamp.intensity = 1000.0f;
    scene.lights = {lamp};
    renderer->load(scene, {});
    struct Streak {
        int wide = 0, tall = 0;
        float most = 0.0f;
    };
    const auto streak = [&](float film, bool lobe) {
        Frame frame = wet(film);
        frame.camera = look({0, 1.6f, 0}, {0, 0.3f, -8}, 0.9f);
        frame.sky.sun_elevation_rad = -1.0f;
        frame.settings.image_based_light = false;
        frame.settings.film_lobe = lobe;
        frame.settings.aovs = {"specular_direct"};
        const RenderResult r = renderer->render(frame);
        Streak s;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) s.most = std::max(s.most, aov(r, "specular_direct", x, y, 1));
        }
        for (int y = 0; y < kSide; ++y) {
            int across = 0;
            for (int x = 0; x < kSide; ++x) {
                across += aov(r, "specular_direct", x, y, 1) > 0.25f * s.most ? 1 : 0;
            }
            s.wide = std::max(s.wide, across);
            s.tall += across > 0 ? 1 : 0;
        }
        return s;
    };
    const Streak dry = streak(0.0f, true), film = streak(0.5f, true), mixed = streak(0.5f, false);
    RecordProperty("film", std::to_string(film.wide) + " x " + std::to_string(film.tall));
    RecordProperty("mixed", std::to_string(mixed.wide) + " x " + std::to_string(mixed.tall));
    EXPECT_GT(film.tall, 3 * film.wide) << film.wide << " x " << film.tall;
    EXPECT_LT(film.wide, dry.wide);
    EXPECT_GT(film.most, 4.0f * dry.most);
    EXPECT_GT(film.most, 2.0f * mixed.most) << "one lobe for both is a blob of " << mixed.wide << " x "
                                            << mixed.tall;
}

// Under an even sky: a wall of plaster that has drunk rain is darker by a quarter and more and hardly mirrors, while glaze keeps
// its film.
TEST_F(WetFilmTest, AWallThatDrinksIsDarkerAndHasLittleFilm)
{
    renderer->set_environment(constant_environment(1.0f));
    struct Seen {
        float light, mirrored;
    };
    const auto seen = [&](float porosity, float film) {
        Scene scene = scene_of({quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0})}, {plain_material(glm::vec3(0.45f), 0.9f)});
        scene.materials[0].weather.porosity = porosity;
        scene.materials[0].weather.water_slope_damp = 0.0f;
        renderer->load(scene, {});
        Frame frame = wet(film);
        frame.sky.sun_illuminance = 0.0f;
        frame.camera = look({-4.0f, 0, 1.0f}, {0, 0, 0}, 0.3f);
        frame.settings.aovs = {"specular_indirect", "reflection", "film"};
        const RenderResult r = renderer->render(frame);
        EXPECT_GT(aov(r, "film", kSide / 2, kSide / 2, 0), film > 0.0f ? 0.5f : -1.0f);
        return Seen{pixel(r, kSide / 2, kSide / 2).g, aov(r, "reflection", kSide / 2, kSide / 2, 1)};
    };
    const Seen dry = seen(0.8f, 0.0f), drunk = seen(0.8f, 0.5f), glazed = seen(0.0f, 0.5f);
    EXPECT_LT(drunk.light, 0.8f * dry.light);
    EXPECT_GT(glazed.light, drunk.light);
    EXPECT_LT(drunk.mirrored, 0.6f * glazed.mirrored) << drunk.mirrored << " " << glazed.mirrored;
}

// In a furnace nothing is brighter than its walls, and a white ground keeps most of it.
TEST_F(WetFilmTest, AFurnaceIsNotOutshone)
{
    renderer->set_environment(constant_environment(1.0f));
    for (const float metallic : {0.0f, 1.0f}) {
        renderer->load(scene_of({quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18})},
                                {plain_material(glm::vec3(1.0f), 0.5f, metallic)}),
                       {});
        for (const float film : {0.0f, 0.2f, 0.35f, 0.5f}) {
            Frame frame = wet(film);
            frame.sky.sun_illuminance = 0.0f;
            for (const float height : {0.5f, 3.0f}) {
                frame.camera = look({0, height, 3}, {0, 0, 0}, 0.4f);
                const float light = pixel(renderer->render(frame), kSide / 2, kSide / 2 + 8).g;
                EXPECT_LT(light, 1.03f) << metallic << " " << film << " " << height;
                // Metals keep their reflectance below water; stones darken by their pores alone.
                EXPECT_GT(light, 0.9f * (metallic > 0.5f ? 0.95f : 0.9f))
                    << metallic << " " << film << " " << height;
            }
        }
    }
}

TEST_F(WetFilmTest, DryNothingChanges)
{
    renderer->load(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {plain_material({0.4f, 0.3f, 0.2f})}),
                   {});
    Frame frame = wet(0.0f);
    frame.weather.snow_amount = 0.3f;
    frame.camera = look({0, 2, 3}, {0, 0, 0});
    const RenderResult with = renderer->render(frame);
    frame.settings.film_lobe = false;
    EXPECT_EQ(with.beauty, renderer->render(frame).beauty);
    frame.weather.film_smoothness = frame.weather.film_albedo = 0.5f;
    const RenderResult mixed = renderer->render(frame);
    frame.settings.film_lobe = true;
    EXPECT_NE(mixed.beauty, renderer->render(frame).beauty);
}

}  // namespace
}  // namespace petrichor::gpu
