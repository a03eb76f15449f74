// A film of water over a surface: never more light than comes in, none where it is dry.
#include "formulas/light/water_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace petrichor::shared {
namespace {

using glm::vec3;

vec3 direction(float up, float turn)
{
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    return {level * std::cos(turn), level * std::sin(turn), up};
}

DryMaterial stone(float metallic = 0.0f)
{
    DryMaterial dry{};
    dry.base_color = vec3(1.0f);
    dry.metallic = metallic;
    dry.f0 = vec3(0.04f);
    dry.roughness = 0.8f;
    dry.occlusion = 1.0f;
    dry.porosity = 0.5f;
    return dry;
}

WaterFilm film_of(float wetness, float rain, SurfaceState state = {1.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.0f, kMeanWaterWay})
{
    WeatherMoment moment{};
    moment.film_smoothness = wetness;
    moment.rain = rain;
    WaterFilm film = water_film(stone(), state, moment);
    film.normal = vec3(0, 0, 1);
    return film;
}

TEST(WaterFilm, SendsOutNoMoreThanComesIn)
{
    const int rows = 200, columns = 200;
    float most = 0.0f;
    for (const float wet : {0.0f, 0.2f, 0.35f, 0.5f}) {
        for (const float rain : {0.0f, 1.0f}) {
            for (const float metallic : {0.0f, 1.0f}) {
                for (const float lean : {0.0f, 0.3f}) {
                    for (const float nv : {0.05f, 0.2f, 0.5f, 1.0f}) {
                        WaterFilm film = film_of(wet, rain);
                        film.normal = glm::normalize(vec3(lean, 0.0f, 1.0f));
                        const vec3 v = direction(nv, 0.7f);
                        const WeatheredMaterial m = below_film(dry_material(stone(metallic)), film.share);
                        double sum = 0.0, dry = 0.0;
                        for (int i = 0; i < rows; ++i) {
                            for (int j = 0; j < columns; ++j) {
                                const vec3 l =
                                    direction((static_cast<float>(i) + 0.5f) / rows,
                                              (static_cast<float>(j) + 0.5f) / columns * 6.2831853f);
                                const vec3 base = shade_direct(
                                    vec3(0, 0, 1), v, l, m.albedo * (1.0f - m.specular.x),
                                    m.specular, 0.8f * 0.8f);
                                sum += static_cast<double>(under_film(base, film, v, l).x);
                                dry += static_cast<double>(base.x);
                            }
                        }
                        const auto albedo = static_cast<float>(sum * 6.28318530718 / (rows * columns));
                        most = std::max(most, albedo);
                        // The lobe below may be over one by itself, where the eye grazes what is white.
                        const auto below = static_cast<float>(dry * 6.28318530718 / (rows * columns));
                        EXPECT_LT(albedo, std::max(1.0f, below) + 0.005f)
                            << wet << " " << rain << " " << metallic << " " << lean
                                                 << " " << nv;
                    }
                }
            }
        }
    }
    EXPECT_GT(most, 0.8f) << "the base shines through";
}

TEST(WaterFilm, IsNotThereWhereItIsDryOrBuriedOrFrozen)
{
    EXPECT_EQ(film_of(0.0f, 0.0f).share, 0.0f);
    EXPECT_EQ(film_of(0.0f, 1.0f).share, 0.0f) << "it rains elsewhere";
    EXPECT_GT(film_of(0.5f, 0.0f).share, 0.95f);
    EXPECT_EQ(film_of(0.5f, 0.0f, {0.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.0f, 0.0f}).share, 0.0f) << "under a roof";
    EXPECT_EQ(film_of(0.5f, 0.0f, {1.0f, 1.0f, 0.0f, 0.0f, 0.4f, 0.0f, 0.0f}).share, 0.0f) << "in a puddle";
    EXPECT_EQ(film_of(0.5f, 0.0f, {1.0f, 0.0f, 1.0f, 0.0f, 0.4f, 0.0f, 0.0f}).share, 0.0f) << "below snow";
    EXPECT_EQ(film_of(0.5f, 0.0f, {1.0f, 0.0f, 0.0f, 1.0f, 0.4f, 0.0f, 0.0f}).share, 0.0f) << "below hoar";
    // What is frozen is taken out of the film once, by whoever says how much there is: a patch's may be thawed.
    WeatherMoment half{};
    half.film_smoothness = 0.5f;
    half.water_to_snow = 0.6f;
    EXPECT_EQ(water_film(stone(), {1.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.0f, 0.0f}, half).share, film_of(0.5f, 0.0f).share);
    const vec3 v = direction(0.4f, 0.0f), l = direction(0.6f, 2.0f), base(0.2f, 0.3f, 0.4f);
    const WaterFilm none = film_of(0.0f, 0.0f);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(under_film(base, none, v, l)[c], base[c]);
    const WeatheredMaterial dry = dry_material(stone());
    EXPECT_EQ(below_film(dry, 0.0f).specular.x, dry.specular.x);
}

TEST(WaterFilm, GrowsSmoothAndLevelAndLeavesMetalsTheirReflectance)
{
    float share = 0.0f, rough = 1.0f, level = 0.0f;
    for (float wet = 0.0f; wet <= 0.5f; wet += 0.01f) {
        const WaterFilm film = film_of(wet, 0.0f);
        EXPECT_GE(film.share, share);
        EXPECT_LE(film.roughness, rough);
        EXPECT_GE(film.level, level);
        share = film.share;
        rough = film.roughness;
        level = film.level;
    }
    EXPECT_LT(rough, 0.3f);
    EXPECT_NEAR(level, 0.35f, 0.01f) << "grain is levelled, stones are not";
    // Glass in water, n = 1.5 against 1.33; water in water mirrors nothing.
    EXPECT_NEAR(immersed_f0(0.04f), 0.0036f, 1e-4f);
    EXPECT_NEAR(immersed_f0(0.02006f), 0.0f, 1e-5f);
    WeatheredMaterial metal = dry_material(stone(1.0f));
    EXPECT_EQ(below_film(metal, 1.0f).specular.x, metal.specular.x);
}

}  // namespace
}  // namespace petrichor::shared
