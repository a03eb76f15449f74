// Metering by the picture: its histogram, and what a frame of a scene is metered to.
#include "gpu/frame/metering.h"

#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "formulas/light/exposure.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

void add_pixels(std::vector<std::uint16_t>& picture, int count, float luminance,
                bool surface = true)
{
    const std::uint16_t level = glm::packHalf1x16(luminance);
    for (int i = 0; i < count; ++i) {
        picture.insert(picture.end(),
                       {level, level, level, glm::packHalf1x16(surface ? 1.0f : 0.0f)});
    }
}

TEST(Metering, OneLuminanceIsItsEv100)
{
    for (const float luminance : {0.001f, 0.05f, 1.0f, 250.0f, 8000.0f, 60000.0f}) {
        std::vector<std::uint16_t> picture;
        add_pixels(picture, 10, luminance);
        const auto ev100 = metered_ev100(picture);
        ASSERT_TRUE(ev100);
        // By day a stop lower, since it is as flat as can be. To half a step of the histogram, and the
        // rounding to halves.
        const float meant = shared::ev100_of_luminance(luminance);
        const float flat = std::clamp((meant - 4.0f) / 6.0f, 0.0f, 1.0f);
        EXPECT_NEAR(*ev100, meant - flat, 0.0626f + 0.01f) << luminance;
    }
}

TEST(Metering, FollowsTheScaleOfThePictureExactly)
{
    std::vector<std::uint16_t> dim, bright;
    for (int i = 1; i <= 400; ++i) {
        add_pixels(dim, 1, 0.0003125f * static_cast<float>(i));
        add_pixels(bright, 1, 0.01f * static_cast<float>(i));  // five stops more, in halves too
    }
    EXPECT_FLOAT_EQ(*metered_ev100(bright), *metered_ev100(dim) + 5.0f);
    // And has no order.
    std::vector<std::uint16_t> turned;
    for (std::size_t i = dim.size(); i > 0; i -= 4)
        turned.insert(turned.end(), dim.begin() + static_cast<std::ptrdiff_t>(i - 4),
                      dim.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(metered_ev100(turned), metered_ev100(dim));
}

TEST(MeteredLight, IsTheLightOnMostOfWhatIsSeen)
{
    const glm::vec3 sky(0.9f, 1.0f, 1.29f), lamp(1.5f, 0.95f, 0.1f);
    std::vector<float> direct, indirect, base, snow;
    const auto add = [&](int count, glm::vec3 light, glm::vec3 albedo, float white = 0.0f) {
        for (int i = 0; i < count; ++i) {
            const glm::vec3 seen = light * glm::mix(albedo, glm::vec3(0.9f), white);
            for (int c = 0; c < 3; ++c) {
                direct.push_back(0.25f * seen[c]);
                indirect.push_back(0.75f * seen[c]);
                base.push_back(albedo[c]);
            }
            snow.push_back(white);
        }
    };
    const auto metered = [&] {
        return metered_light({.scattered_direct = direct, .scattered_indirect = indirect, .base_color = base, .snow = snow});
    };
    EXPECT_FALSE(metered()) << "of nothing";
    add(50, glm::vec3(7.0f), glm::vec3(0.5f, 0.5f, 0.01f));
    EXPECT_FALSE(metered()) << "what is black in a channel tells nothing of it";
    add(300, 40.0f * sky, glm::vec3(0.5f, 0.2f, 0.1f));
    add(300, 40.0f * sky, glm::vec3(0.1f, 0.2f, 0.3f), 1.0f);
    const glm::vec3 unit = sky / (0.2126f * sky.x + 0.7152f * sky.y + 0.0722f * sky.z);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR((*metered())[i], unit[i], 1e-3f);
    const glm::vec3 before = *metered();
    add(6, 40000.0f * lamp, glm::vec3(0.5f));
    EXPECT_NEAR(metered()->x, before.x, 0.15f) << "one pixel in a hundred, a thousand times as bright";
    add(1, glm::vec3(std::numeric_limits<float>::infinity()), glm::vec3(0.5f));
    add(1, glm::vec3(std::numeric_limits<float>::quiet_NaN()), glm::vec3(0.5f));
    EXPECT_TRUE(std::isfinite(metered()->x));
}

TEST(Metering, AFewLampsAndHolesDoNotCount)
{
    std::vector<std::uint16_t> street;
    add_pixels(street, 960, 2.0f);
    const auto plain = metered_ev100(street);
    add_pixels(street, 40, 20000.0f);
    EXPECT_NEAR(*metered_ev100(street), *plain, 1e-5f) << "4 % of lamps";
    add_pixels(street, 500, 0.0f);
    EXPECT_NEAR(*metered_ev100(street), *plain, 1e-5f) << "black is no light at all";
    std::vector<std::uint16_t> lit;
    add_pixels(lit, 500, 2.0f);
    add_pixels(lit, 500, 20000.0f);
    EXPECT_GT(*metered_ev100(lit), *plain + 5.0f) << "half of it does count";
}

TEST(Metering, SkyCountsAQuarterOfASurface)
{
    std::vector<std::uint16_t> picture;
    add_pixels(picture, 200, 1.0f);
    add_pixels(picture, 800, 1.0f, false);
    std::vector<std::uint16_t> half;
    add_pixels(half, 200, 64.0f);
    add_pixels(half, 800, 1.0f, false);
    // Of equal weight: the mean lies in the middle, three of the six stops up; the cut takes both
    // ends alike.
    EXPECT_NEAR(*metered_ev100(half), *metered_ev100(picture) + 3.0f, 1e-4f);
}

// White is not taken for grey, by day; the darker it is, the less.
TEST(Metering, SnowIsWhite)
{
    float before = -30.0f;
    for (float luminance = 1e-3f; luminance < 6e4f; luminance *= 1.37f) {
        std::vector<std::uint16_t> picture;
        add_pixels(picture, 100, luminance);
        const float plain = *metered_ev100(picture);
        EXPECT_EQ(*metered_ev100(picture, std::vector<float>(100, 0.0f)), plain);
        const float white = *metered_ev100(picture, std::vector<float>(100, 1.0f));
        if (plain > 9.1f) { EXPECT_NEAR(white, plain - 2.0f, 1e-4f); }
        if (plain < 4.0f) { EXPECT_EQ(white, plain); }
        EXPECT_GE(white, before) << "monotone";
        before = white;
        std::vector<float> half(100, 0.0f);
        std::fill_n(half.begin(), 50, 1.0f);
        // 1.3 stops and a half of 0.7 more, for the half.
        EXPECT_NEAR(*metered_ev100(picture, half), plain + 0.5f * (1.65f / 2.0f) * (white - plain), 1e-4f);
    }
}

// A sky two stops over the ground is what a clear day has; one as grey as the ground asks for a stop.
TEST(Metering, FlatDaysAreExposedMore)
{
    const auto over = [](float stops) {
        std::vector<std::uint16_t> picture;
        add_pixels(picture, 900, 1000.0f);
        add_pixels(picture, 100, 1000.0f * std::exp2(stops));
        // The mean of the logarithms without the darkest and the brightest 5 %: 5 of the 90 left.
        return *metered_ev100(picture) - shared::ev100_of_luminance(1000.0f) - stops / 18.0f;
    };
    EXPECT_NEAR(over(0.0f), -1.0f, 0.08f);
    EXPECT_NEAR(over(1.0f), -0.6f * (2.0f - 17.0f / 18.0f), 0.08f);
    EXPECT_NEAR(over(3.0f), 0.0f, 0.08f);
    EXPECT_LE(over(0.5f), over(1.5f));
}

// A plain in the sun is as even as a grey day, and is no grey day.
TEST(Metering, WhatIsFlatUnderAClearSkyIsHardlyExposedMore)
{
    std::vector<std::uint16_t> picture;
    add_pixels(picture, 1000, 1000.0f);
    const float is = shared::ev100_of_luminance(1000.0f);
    EXPECT_NEAR(*metered_ev100(picture, {}, 0.0f), is - 0.4f, 0.0626f);
    EXPECT_NEAR(*metered_ev100(picture, {}, 1.0f), is - 1.0f, 0.0626f);
    float before = is + 1.0f;
    for (int k = 0; k <= 20; ++k) {
        const float now = *metered_ev100(picture, {}, 0.05f * static_cast<float>(k));
        EXPECT_LE(now, before);
        before = now;
    }
}

// A storm by day is dark; a shower in the sun is not, nor is it darker by night.
TEST(Metering, RainFromAClosedLayerIsExposedLess)
{
    for (const float nits : {1000.0f, 1.0f}) {
        std::vector<std::uint16_t> picture;
        add_pixels(picture, 1000, nits);
        const float plain = *metered_ev100(picture, {}, 1.0f);
        const float day = nits > 100.0f ? 1.0f : 0.0f;
        EXPECT_NEAR(*metered_ev100(picture, {}, 1.0f, 1.0f), plain + 0.7f * day, 1e-5f);
        EXPECT_NEAR(*metered_ev100(picture, {}, 1.0f, 0.5f), plain + 0.35f * day, 1e-5f);
        EXPECT_EQ(*metered_ev100(picture, {}, 0.2f, 1.0f), *metered_ev100(picture, {}, 0.2f, 0.0f));
    }
}

TEST(Metering, NothingToSeeIsNoNumber)
{
    std::vector<std::uint16_t> black;
    add_pixels(black, 50, 0.0f);
    EXPECT_FALSE(metered_ev100(black));
    black[0] = 0x7c00;  // infinite
    EXPECT_FALSE(metered_ev100(black));
    EXPECT_FALSE(metered_ev100({}));
}

TEST(MeteringFrame, IsSmallAndOfTheSameShape)
{
    Frame frame;
    frame.settings.width = 1280;
    frame.settings.height = 720;
    frame.settings.samples = 64;
    frame.settings.aovs = {"depth"};
    const Frame small = metering_frame(frame);
    EXPECT_EQ(small.settings.width, 96);
    EXPECT_EQ(small.settings.height, 54);
    EXPECT_EQ(small.settings.samples, 1);
    EXPECT_EQ(small.settings.aovs, std::vector<std::string>{"snow"});
    frame.settings.width = 3;
    frame.settings.height = 16384;
    EXPECT_EQ(metering_frame(frame).settings.width, 1);
}

using MeterTest = GpuTest;

Frame lamp_at_night(float candela)
{
    Frame frame;
    frame.camera = look({0, 2, 3}, {0, 0, 0});
    frame.sky.sun_elevation_rad = -0.3f;
    frame.settings.width = 48;
    frame.settings.height = 27;
    Light lamp;
    lamp.position_m = {0, 2, 0};
    lamp.intensity = candela;
    frame.extra_lights.push_back(lamp);
    return frame;
}

Scene grey_floor()
{
    return scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, {plain_material(glm::vec3(0.4f))});
}

TEST_F(MeterTest, ALampAtNightIsMeteredWhichSunAndSkyAreNot)
{
    renderer->load(grey_floor(), {});
    const auto dim = renderer->meter(lamp_at_night(6.0f)).ev100;
    const auto bright = renderer->meter(lamp_at_night(48.0f)).ev100;
    ASSERT_TRUE(dim && bright);
    EXPECT_NEAR(*bright - *dim, 3.0f, 0.15f) << "the night sky adds a little to both";
    // The light that falls in from the sky does not know of it.
    const float incident = renderer->render(lamp_at_night(100.0f)).exposure;
    EXPECT_EQ(renderer->render(lamp_at_night(3200.0f)).exposure, incident);
}

TEST_F(MeterTest, IsAFunctionOfTheFrameAlone)
{
    renderer->load(grey_floor(), {});
    const auto first = renderer->meter(lamp_at_night(100.0f)).ev100;
    Frame other = lamp_at_night(5000.0f);
    other.sky.sun_elevation_rad = 0.6f;
    other.settings.exposure = 3.0f;
    renderer->render(other);
    renderer->meter(other);
    EXPECT_EQ(renderer->meter(lamp_at_night(100.0f)).ev100, first);
    Renderer fresh({.device = "", .validation = true});
    fresh.load(grey_floor(), {});
    EXPECT_EQ(fresh.meter(lamp_at_night(100.0f)).ev100, first);
    // Neither does metering leave anything in the next picture.
    Frame shown = lamp_at_night(100.0f);
    shown.settings.exposure = 0.05f;
    EXPECT_EQ(renderer->render(shown).display, fresh.render(shown).display);
}

// What it had made is given up then; it may be asked for again.
TEST_F(MeterTest, PicturesAreTheSameOnceItHasEnded)
{
    renderer->load(grey_floor(), {});
    Frame shown = lamp_at_night(100.0f);
    shown.settings.exposure = 0.05f;
    shown.weather.rain = 0.7f;
    shown.weather.flood_puddles = 0.5f;
    const auto metered = renderer->meter(lamp_at_night(100.0f)).ev100;
    const auto before = renderer->render(shown).display;
    renderer->end_metering();
    EXPECT_EQ(renderer->render(shown).display, before);
    EXPECT_EQ(renderer->render(shown).display, before);
    EXPECT_EQ(renderer->meter(lamp_at_night(100.0f)).ev100, metered);
    EXPECT_EQ(renderer->render(shown).display, before);
}

TEST_F(MeterTest, TheColourOfTheLightIsFoundWhateverItFallsOn)
{
    // Green grass and red brick in the light of one warm lamp: the lamp's colour, neither of theirs.
    Scene scene = scene_of({quad({-4, 0, 4}, {4, 0, 0}, {0, 0, -8}), quad({0, 0, 4}, {4, 0, 0}, {0, 0, -8}, 1)},
                           {plain_material(glm::vec3(0.1f, 0.4f, 0.08f)), plain_material(glm::vec3(0.5f, 0.15f, 0.1f))});
    renderer->load(scene, {});
    Frame frame = lamp_at_night(100.0f);
    frame.settings.draw_sky = false;
    frame.settings.image_based_light = false;
    for (scene::Light& light : frame.extra_lights) light.color = {1.0f, 0.6f, 0.3f};
    EXPECT_FALSE(renderer->meter(frame).light) << "not asked for";
    const MeterReading reading = renderer->meter(frame, MeterOf::ExposureAndLight);
    ASSERT_TRUE(reading.light);
    const glm::vec3 lamp = glm::vec3(1.0f, 0.6f, 0.3f) / (0.2126f + 0.7152f * 0.6f + 0.0722f * 0.3f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR((*reading.light)[i], lamp[i], 0.02f) << i;
    EXPECT_EQ(reading.ev100, renderer->meter(frame).ev100) << "and nothing else changes";
}

// The light is read through one pipeline for any weather: it shows what those of the weather show.
TEST_F(MeterTest, OnePipelineForAnyLightShowsTheSame)
{
    Material wall = plain_material(glm::vec3(0.5f, 0.3f, 0.2f), 0.6f);
    renderer->load(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), quad({-4, 0, -2}, {8, 0, 0}, {0, 3, 0})}, {wall}), {});
    const auto frame_of = [](float sun_rad, float film, float snow) {
        Frame frame = lamp_at_night(100.0f);
        frame.camera = look({0, 2, 5}, {0, 1, -2});
        frame.sky.analytic_sun = true;
        frame.sky.sun_elevation_rad = sun_rad;
        frame.weather.film_albedo = frame.weather.film_smoothness = film;
        frame.weather.snow_amount = snow;
        frame.look.snow_sparkle = 1.0f;
        return metering_frame(frame, MeterOf::ExposureAndLight);
    };
    for (const float sun_rad : {0.5f, -0.3f}) {
        for (const glm::vec2 weather : {glm::vec2(0.0f), glm::vec2(0.9f, 0.0f), glm::vec2(0.0f, 0.7f)}) {
            Frame frame = frame_of(sun_rad, weather.x, weather.y);
            ASSERT_TRUE(frame.settings.any_light);
            const RenderResult any = renderer->render(frame);
            frame.settings.any_light = false;
            const RenderResult own = renderer->render(frame);
            for (std::size_t k = 0; k < any.aovs.size(); ++k) {
                ASSERT_EQ(any.aovs[k].pixels.size(), own.aovs[k].pixels.size());
                for (std::size_t i = 0; i < any.aovs[k].pixels.size(); ++i)
                    ASSERT_NEAR(any.aovs[k].pixels[i], own.aovs[k].pixels[i], 1e-3f * std::abs(own.aovs[k].pixels[i]) + 1e-6f)
                        << any.aovs[k].name << " under a sun at " << sun_rad << ", film and snow " << weather.x << ' ' << weather.y;
            }
        }
    }
}

// What is metered has the pipelines of a picture with weather of places, and none of that weather.
TEST_F(MeterTest, NoPlacesShowTheSame)
{
    // Half of the floor lies under a roof.
    renderer->load(scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), quad({-4, 2, 4}, {4, 0, 0}, {0, 0, -8})},
                            {plain_material(glm::vec3(0.5f, 0.3f, 0.2f), 0.6f)}), {});
    std::vector<std::vector<float>> seen;
    for (const auto& [film, snow, frost] : {std::array{0.9f, 0.0f, 0.0f}, {0.0f, 0.7f, 0.0f}, {0.5f, 0.0f, 0.8f}}) {
        Frame frame = lamp_at_night(100.0f);
        frame.camera = look({0, 1.5f, 5}, {0, 0.5f, -2});
        frame.sky.analytic_sun = true;
        frame.sky.sun_elevation_rad = 0.5f;
        frame.weather.film_albedo = frame.weather.film_smoothness = film;
        frame.weather.flood_puddles = frame.weather.rain = film;
        frame.weather.snow_amount = snow;
        frame.weather.frost = frost;
        frame = metering_frame(frame, MeterOf::ExposureAndLight);
        const RenderResult own = renderer->render(frame);
        frame.place = no_places();
        const RenderResult beside = renderer->render(frame);
        for (std::size_t k = 0; k < own.aovs.size(); ++k) {
            ASSERT_EQ(beside.aovs[k].pixels.size(), own.aovs[k].pixels.size());
            for (std::size_t i = 0; i < own.aovs[k].pixels.size(); ++i)
                ASSERT_NEAR(beside.aovs[k].pixels[i], own.aovs[k].pixels[i], 1e-3f * std::abs(own.aovs[k].pixels[i]) + 1e-6f)
                    << own.aovs[k].name << " at " << i << ", film, snow, frost " << film << ' ' << snow << ' ' << frost;
        }
        seen.push_back(own.aovs[3].pixels);
        EXPECT_EQ(renderer->meter(frame).ev100.has_value(), true);
    }
    EXPECT_NE(seen[0], seen[1]) << "there is weather";
    EXPECT_NE(seen[0], seen[2]);
}

TEST_F(MeterTest, WhatIsUnlitDoesNotMeterItself)
{
    Scene scene = grey_floor();
    const auto alone = (renderer->load(scene, {}), renderer->meter(lamp_at_night(100.0f)).ev100);
    scene.materials.push_back(plain_material(glm::vec3(1.0f)));
    scene.materials[1].unlit = true;
    scene.meshes[0].primitives.push_back(
        quad({-0.2f, 0.01f, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f}, 1));
    renderer->load(scene, {});
    EXPECT_NEAR(*renderer->meter(lamp_at_night(100.0f)).ev100, *alone, 0.4f);
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin());
    renderer->load(scene, {});
    Frame no_sky = lamp_at_night(100.0f);
    no_sky.settings.draw_sky = false;
    no_sky.settings.image_based_light = false;  // nor haze
    EXPECT_FALSE(renderer->meter(no_sky).ev100);
}

}  // namespace
}  // namespace petrichor::gpu
