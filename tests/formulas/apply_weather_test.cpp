// Water and snow on a material, ripples and flow: laws and table values.
// tests/gpu/parity_test.cpp shows that the device computes the same.
#include <gtest/gtest.h>


#include "formulas/weather/apply_weather.h"
#include "formulas/weather/ripple.h"

namespace petrichor::shared {
namespace {

TEST(ApplyWater, DarkensPorousNotSmooth)
{
    WeatheredMaterial dry{glm::vec3(0.4f), glm::vec3(0.04f), 0.3f, 0.5f, 1.0f, 0.0f, 0.0f};
    const WeatheredMaterial porous = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 1.0f);
    EXPECT_NEAR(porous.albedo.x, 0.2432f, 1e-4f);
    const WeatheredMaterial dense = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 0.0f);
    EXPECT_EQ(dense.albedo.x, 0.4f);
    const WeatheredMaterial flooded =
        apply_water(dry, glm::vec2(0.0f), 1.0f, glm::vec4(0.1f, 0.1f, 0.1f, 0.5f), 0.0f);
    EXPECT_NEAR(flooded.smoothness, 0.9f, 1e-6f);
    EXPECT_NEAR(flooded.specular.x, 0.02f, 1e-6f);
    EXPECT_NEAR(flooded.albedo.x, 0.25f, 1e-6f);
    EXPECT_NEAR(flooded.emission_scale, 0.5f, 1e-6f);
    EXPECT_NEAR(flooded.occlusion, 0.75f, 1e-6f);
    const WeatheredMaterial same = apply_water(dry, glm::vec2(0.0f), 0.0f, glm::vec4(0.0f), 1.0f);
    EXPECT_EQ(same.albedo, dry.albedo);
    EXPECT_EQ(same.smoothness, dry.smoothness);
}

TEST(ApplyWater, DarkensAsAFilmOverAMattGroundDoes)
{
    // Lekner & Dorf 1988, n = 1.33.
    const glm::vec2 known[] = {{0.1f, 0.0518f}, {0.2f, 0.1089f}, {0.3f, 0.1724f}, {0.4f, 0.2432f},
                               {0.5f, 0.3228f}, {0.6f, 0.4128f}, {0.8f, 0.6339f}};
    for (const glm::vec2& k : known) {
        const WeatheredMaterial dry{glm::vec3(k.x), glm::vec3(0.04f), 0.1f, 1.0f, 1.0f, 0.0f, 0.0f};
        const auto wet = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 1.0f);
        EXPECT_NEAR(wet.albedo.x, k.y, 1e-4f) << k.x;
    }
}

// What was measured is what a whole film leaves; of paint and glaze it takes little.
TEST(ApplyWater, SettsDarkenAsMuchAsIsMeasured)
{
    const auto left = [](float albedo, float porosity) {
        DryMaterial dry{};
        dry.base_color = glm::vec3(albedo);
        dry.f0 = glm::vec3(0.04f);
        dry.roughness = 0.8f;
        dry.porosity = porosity;
        WeatherMoment moment{};
        moment.film_albedo = 0.85f;
        const SurfaceState state{1.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.0f, kMeanWaterWay};
        return apply_weather(dry, state, moment, {}).albedo.x / albedo;
    };
    // Angstrom 1925: sand .18 to .09, mould .14 to .08.
    EXPECT_NEAR(left(0.18f, 1.0f), 0.5f, 0.12f);
    EXPECT_NEAR(left(0.14f, 1.0f), 0.57f, 0.06f);
    // Wet over dry of the energy balance's own surfaces: setts, brick, concrete.
    EXPECT_NEAR(left(0.20f, 0.45f), 0.65f, 0.03f);
    EXPECT_NEAR(left(0.28f, 0.75f), 0.61f, 0.05f);
    EXPECT_NEAR(left(0.30f, 0.70f), 0.67f, 0.05f);
    EXPECT_GT(left(0.30f, 0.05f), 0.95f);
}

TEST(ApplyWater, AMetalKeepsItsReflectanceBelowWater)
{
    for (const float metallic : {0.0f, 1.0f}) {
        // Dark iron: its F0 alone does not tell that it is a metal.
        const glm::vec3 f0 = metallic > 0.0f ? glm::vec3(0.45f, 0.44f, 0.42f) : glm::vec3(0.04f);
        const WeatheredMaterial dry{glm::vec3(0.0f), f0, 0.2f, 1.0f, 1.0f, 0.0f, metallic};
        const auto wet = apply_water(dry, glm::vec2(1.0f), 1.0f, glm::vec4(0.0f), 1.0f);
        EXPECT_NEAR(wet.specular.x, metallic > 0.0f ? f0.x : 0.02f, 1e-6f);
        EXPECT_NEAR(wet.smoothness, 0.9f, 1e-6f) << "the film is as smooth on both";
    }
}

DryMaterial dry_stone()
{
    DryMaterial dry{};
    dry.base_color = glm::vec3(0.4f);
    dry.f0 = glm::vec3(0.04f);
    dry.roughness = 0.8f;
    dry.occlusion = 1.0f;
    dry.porosity = 1.0f;
    return dry;
}

// Section 12: the albedo is darkened, then tinted, so that the tint is as bright as it was given.
TEST(ApplyWeather, WaterDarkensThenTints)
{
    DryMaterial dry = dry_stone();
    dry.water_color = {0.3f, 0.2f, 0.1f, 0.5f};
    SurfaceState flooded{};
    flooded.water = 1.0f;
    const WeatheredMaterial wet = apply_weather(dry, flooded, {}, {});
    EXPECT_NEAR(wet.albedo.x, 0.5f * 0.2432f + 0.5f * 0.3f, 1e-4f);
    EXPECT_NEAR(wet.albedo.z, 0.5f * 0.2432f + 0.5f * 0.1f, 1e-4f);
    EXPECT_NEAR(wet.emission_scale, 0.5f, 1e-6f);
    EXPECT_NEAR(wet.occlusion, 1.0f, 1e-6f);
}

TEST(ApplyWeather, DryStaysDry)
{
    const DryMaterial dry = dry_stone();
    const WeatheredMaterial same = apply_weather(dry, {}, {}, {});
    EXPECT_EQ(same.albedo, dry.base_color);
    EXPECT_EQ(same.specular, dry.f0);
    EXPECT_FLOAT_EQ(same.smoothness, 1.0f - dry.roughness);
    EXPECT_EQ(same.normal_mix, 0.0f);
    EXPECT_EQ(same.emission_scale, 1.0f);
}

// Neither a film nor standing water takes a metal's reflectance: it is seen through them.
TEST(ApplyWeather, AWetMetalKeepsItsReflectance)
{
    DryMaterial metal = dry_stone();
    metal.base_color = {0.95f, 0.64f, 0.54f};
    metal.metallic = 1.0f;
    SurfaceState state{};
    state.film = 1.0f;
    WeatherMoment rain;
    rain.film_albedo = 0.85f;
    rain.film_smoothness = 0.5f;
    const WeatheredMaterial wet = apply_weather(metal, state, rain, {});
    EXPECT_EQ(wet.specular, metal.base_color);
    state.water = 1.0f;
    EXPECT_EQ(apply_weather(metal, state, rain, {}).specular, metal.base_color);
}

// Fresh snow 0.95, old 0.40 (Oke 1987): what melts lies between, the darker the thinner, and no jump as the thaw begins.
TEST(ApplyWeather, MeltingSnowIsGreyAndWetWhereItIsThin)
{
    for (float cover = 0.0f; cover <= 1.0f; cover += 0.1f) EXPECT_EQ(melting_snow(cover, 0.0f), 1.0f);
    for (float melt = 0.1f; melt <= 1.0f; melt += 0.1f) {
        for (float cover = 0.1f; cover <= 1.0f; cover += 0.1f) {
            EXPECT_LT(melting_snow(cover, melt), melting_snow(cover, melt - 0.1f));
            EXPECT_LE(melting_snow(cover - 0.1f, melt), melting_snow(cover, melt));
            EXPECT_GT(0.95f * melting_snow(cover, melt), 0.40f);
            EXPECT_GE(melting_smoothness(0.3f, cover, melt), 0.3f);
            EXPECT_GE(melting_smoothness(0.3f, cover - 0.1f, melt), melting_smoothness(0.3f, cover, melt));
        }
    }
    EXPECT_LT(melting_snow(0.3f, 1.0f), 0.7f * melting_snow(1.0f, 1.0f));
    WeatherMoment moment;
    WeatherLook look;
    look.snow_color = glm::vec3(0.9f);
    DryMaterial dry{};
    dry.base_color = glm::vec3(0.3f);
    dry.f0 = glm::vec3(0.04f);
    dry.roughness = 0.9f;
    dry.occlusion = 1.0f;
    SurfaceState state{};
    state.snow = 1.0f;
    state.snow_smoothness = 0.3f;
    const float cold = apply_weather(dry, state, moment, look).albedo.x;
    moment.melt_exp = 1.0f;
    EXPECT_NEAR(apply_weather(dry, state, moment, look).albedo.x, 0.8f * cold, 1e-5f);
}

// Snow swallows emission by its opacity, over what murky water has left of it.
TEST(ApplyWeather, SnowAndMurkDimWhatGlows)
{
    DryMaterial lamp = dry_stone();
    lamp.water_color = {0, 0, 0, 0.4f};
    lamp.snow_opacity = 0.9f;
    SurfaceState state{};
    state.water = 1.0f;
    EXPECT_NEAR(apply_weather(lamp, state, {}, {}).emission_scale, 0.6f, 1e-6f);
    state.snow = 1.0f;
    EXPECT_NEAR(apply_weather(lamp, state, {}, {}).emission_scale, 0.1f, 1e-6f);
}

TEST(ApplySnow, CoversWhatIsUnder)
{
    const WeatheredMaterial under{glm::vec3(0.1f), glm::vec3(0.04f), 0.3f, 0.5f, 1.0f, 0.0f, 0.0f};
    const WeatheredMaterial full =
        apply_snow(under, 1.0f, glm::vec3(0.9f), glm::vec3(0.02f), 0.4f, 0.5f);
    EXPECT_EQ(full.albedo, glm::vec3(0.9f));
    EXPECT_FLOAT_EQ(full.emission_scale, 0.5f);
    EXPECT_FLOAT_EQ(full.occlusion, 1.0f);
    const WeatheredMaterial none =
        apply_snow(under, 0.0f, glm::vec3(0.9f), glm::vec3(0.02f), 0.4f, 0.5f);
    EXPECT_EQ(none.albedo, under.albedo);
}

TEST(Ripple, DryWeatherIsFlatAndLayersJoinOneByOne)
{
    for (int i = 0; i < kRippleLayers; ++i)
        EXPECT_EQ(ripple_layer(i, 0.0f, 1.0f, 1.0f).weight, 0.0f);
    EXPECT_EQ(ripple_layer(1, 0.25f, 1.0f, 1.0f).weight, 0.0f);
    EXPECT_FLOAT_EQ(ripple_layer(0, 0.25f, 1.0f, 1.0f).weight, 1.0f);
    EXPECT_FLOAT_EQ(ripple_layer(3, 1.0f, 1.0f, 1.0f).weight, 1.0f);
    EXPECT_EQ(ripple_slope(glm::vec4(0.0f, 0.8f, 0.2f, 0.3f), 0.4f, 1.0f), glm::vec2(0.0f))
        << "outside every drop";
}

TEST(Flow, APhaseJumpsOnlyWhereItDoesNotShow)
{
    for (float t = 0.0f; t < 3.0f; t += 0.001f) {
        const FlowPhases p = flow_phases(t, 1.0f);
        if (p.first < 0.002f) {
            EXPECT_GT(p.blend, 0.99f);  // only the second shows
        }
        if (p.second < 0.002f) {
            EXPECT_LT(p.blend, 0.01f);  // only the first shows
        }
    }
    EXPECT_EQ(flow_phases(5.0f, 0.0f).first, 0.0f) << "interval 0 is a still surface";
}

}  // namespace
}  // namespace petrichor::shared
