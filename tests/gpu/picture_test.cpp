// What the display sees of a picture: glare, white balance, curves; and what veils the sky.
#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "formulas/color/tone_map.h"
#include "formulas/noise/noise.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using PictureTest = GpuTest;

int byte_at(const RenderResult& r, int x, int y, int channel = 1)
{
    const std::size_t i = (static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) +
                           static_cast<std::size_t>(x)) *
                          4;
    return r.display[i + static_cast<std::size_t>(channel)];
}

float linear_at(const RenderResult& r, int x, int y, int channel = 1)
{
    const float code = static_cast<float>(byte_at(r, x, y, channel)) / 255.0f;
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

// A glowing plate in the dark, 16 x 16 of 128 x 96 pixels.
Frame dark_plate()
{
    Frame frame;
    frame.camera = look({0, 0, 6}, {0, 0, 0});
    frame.camera.orthographic_height_m = 6.0f;
    frame.sky.analytic_sun = false;
    FrameSettings& s = frame.settings;
    s.width = 128;
    s.height = 96;
    s.samples = 2;
    s.image_based_light = false;
    s.draw_sky = false;
    s.tone_map = ToneMap::Linear;
    s.exposure = 1.0f;
    return frame;
}

Scene plate(float radiance)
{
    Material glow = plain_material(glm::vec3(0.0f));
    glow.emissive = glm::vec3(radiance);
    return scene_of({quad({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0})}, {glow});
}

TEST_F(PictureTest, GlareKeepsTheLightAndSpreadsIt)
{
    renderer->load(plate(0.98f), {});
    Frame frame = dark_plate();
    const RenderResult sharp = renderer->render(frame);
    frame.settings.bloom = 0.5f;
    const RenderResult soft = renderer->render(frame);
    EXPECT_EQ(sharp.beauty, soft.beauty) << "the scene's own light stays as it is";
    double before = 0.0;
    double after = 0.0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 128; ++x) {
            before += static_cast<double>(linear_at(sharp, x, y));
            after += static_cast<double>(linear_at(soft, x, y));
        }
    }
    EXPECT_NEAR(after / before, 1.0, 0.04);
    // Less and less, the farther from the plate.
    int last = 256;
    for (const int x : {64, 74, 80, 88, 100}) {
        EXPECT_LT(byte_at(soft, x, 48), last) << x;
        last = byte_at(soft, x, 48);
    }
    EXPECT_GT(last, 0);
    EXPECT_EQ(byte_at(sharp, 88, 48), 0);
}

TEST_F(PictureTest, GlareLeavesAnEvenPictureAlone)
{
    Scene scene = plate(0.5f);
    scene.meshes[0].primitives[0] = quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
    renderer->load(scene, {});
    Frame frame = dark_plate();
    frame.settings.width = 61;  // odd sizes: edges count like the middle
    frame.settings.height = 37;
    frame.settings.dither = false;
    frame.settings.bloom = 1.0f;
    const RenderResult r = renderer->render(frame);
    for (int y = 0; y < 37; ++y) {
        for (int x = 0; x < 61; ++x) ASSERT_EQ(byte_at(r, x, y), 188) << x << " " << y;
    }
}

// Left half bright: drops show the other half in place of their own, and nothing else changes.
TEST_F(PictureTest, DropsOnTheLensTurnThePictureRound)
{
    Scene scene = plate(0.8f);
    scene.meshes[0].primitives[0] = quad({-50, -50, 0}, {50, 0, 0}, {0, 100, 0});
    renderer->load(scene, {});
    Frame frame = dark_plate();
    frame.settings.dither = false;
    const RenderResult dry = renderer->render(frame);
    frame.settings.wet_lens = 1.0f;
    EXPECT_EQ(renderer->render(frame).display, dry.display) << "it does not rain";
    frame.weather.rain = 0.8f;
    frame.weather.film_albedo = 1.0f;
    frame.settings.time_s = 2.0;
    const RenderResult wet = renderer->render(frame);
    EXPECT_EQ(wet.display, renderer->render(frame).display);
    int changed = 0, turned = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 128; ++x) {
            const int before = byte_at(dry, x, y), now = byte_at(wet, x, y);
            changed += before != now;
            turned += before == 0 && now > 100;
        }
    }
    EXPECT_GT(changed, 128 * 96 / 100);
    EXPECT_LT(changed, 128 * 96 / 2);
    EXPECT_GT(turned, 10);
    frame.settings.time_s = 4.5;
    EXPECT_NE(wet.display, renderer->render(frame).display) << "others have come";
}

TEST_F(PictureTest, CurvesAndWhiteBalanceChangeTheDisplayAlone)
{
    renderer->load(plate(0.3f), {});
    Frame frame = dark_plate();
    frame.settings.dither = false;
    const RenderResult plain = renderer->render(frame);
    const auto level = [&](ToneMap curve) {
        frame.settings.tone_map = curve;
        const RenderResult r = renderer->render(frame);
        EXPECT_EQ(r.beauty, plain.beauty);
        return linear_at(r, 64, 48);
    };
    EXPECT_NEAR(level(ToneMap::Linear), 0.3f, 0.003f);
    EXPECT_NEAR(level(ToneMap::Neutral), 0.26f, 0.003f);
    EXPECT_NEAR(level(ToneMap::Aces), 0.2131f, 0.003f);
    EXPECT_NEAR(level(ToneMap::Agx), 0.27f, 0.02f);
    EXPECT_NEAR(level(ToneMap::Filmic), 0.27f, 0.03f);
    frame.settings.tone_map = ToneMap::Linear;
    frame.settings.white_balance_k = 3200.0f;
    const RenderResult cold = renderer->render(frame);
    EXPECT_EQ(cold.beauty, plain.beauty);
    EXPECT_GT(byte_at(cold, 64, 48, 2), byte_at(cold, 64, 48, 0) + 40) << "white under lamplight";
}

// What a curve of the host is given: through our own curve it is our picture.
TEST_F(PictureTest, ExposedLightIsWhatTheDisplayIsMadeOf)
{
    renderer->load(plate(3.0f), {});
    Frame frame = dark_plate();
    frame.settings.tone_map = ToneMap::Agx;
    frame.settings.bloom = 0.4f;
    frame.settings.white_balance_k = 4500.0f;
    frame.settings.exposure = 0.7f;
    const RenderResult shown = renderer->render(frame);
    frame.settings.exposed_light = true;
    const RenderResult handed = renderer->render(frame);
    EXPECT_EQ(shown.beauty, handed.beauty);
    EXPECT_TRUE(shown.exposed.empty());
    EXPECT_TRUE(handed.display.empty());
    ASSERT_EQ(handed.exposed.size(), shown.display.size());
    int most = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 128; ++x) {
            const std::size_t at = 4 * (static_cast<std::size_t>(y) * 128 + static_cast<std::size_t>(x));
            const glm::vec3 light(glm::unpackHalf1x16(handed.exposed[at]), glm::unpackHalf1x16(handed.exposed[at + 1]),
                                  glm::unpackHalf1x16(handed.exposed[at + 2]));
            EXPECT_EQ(handed.exposed[at + 3], 0x3c00);
            const glm::vec3 mapped = shared::agx(light);
            for (int c = 0; c < 3; ++c) {
                const float code = shared::srgb_encode(mapped[c]) * 255.0f + 0.5f + shared::dither({x, y}, 0u) - 0.5f;
                most = std::max(most, std::abs(static_cast<int>(code) - byte_at(shown, x, y, c)));
            }
        }
    }
    EXPECT_LE(most, 1);
    frame.settings.exposed_light = false;
    EXPECT_EQ(renderer->render(frame).display, shown.display) << "and the next frame has its display again";
    frame.settings.exposed_light = true;
    frame.settings.exposure = 1e6f;
    const RenderResult glaring = renderer->render(frame);
    EXPECT_EQ(*std::max_element(glaring.exposed.begin(), glaring.exposed.end()), 0x7bff) << "65504, not infinite";
}

// Level land, looked at level: the horizon runs through the middle of the picture.
Frame open_land()
{
    Frame frame;
    frame.camera = look({0, 1.7f, 0}, {0, 1.7f, -10}, 1.2f);
    frame.sky.sun_elevation_rad = 0.6f;
    frame.sky.sun_azimuth_rad = 3.0f;  // behind
    frame.weather.visibility_m = 50000.0f;
    frame.settings.width = 96;
    frame.settings.height = 96;
    frame.settings.samples = 1;
    return frame;
}

Scene land()
{
    return scene_of({quad({-4000, 0, 10}, {8000, 0, 0}, {0, 0, -8000})},
                    {plain_material(glm::vec3(0.2f), 1.0f)});
}

TEST_F(PictureTest, FogReachesTheSky)
{
    renderer->load(land(), {});
    Frame frame = open_land();
    const auto blueness = [](const glm::vec3& c) { return c.b / c.r; };
    const RenderResult clear = renderer->render(frame);
    EXPECT_GT(blueness(pixel(clear, 48, 4)), 1.5f);
    frame.weather.visibility_m = 60.0f;
    const RenderResult fog = renderer->render(frame);
    EXPECT_LT(blueness(pixel(fog, 48, 4)), 1.25f) << "30 degrees up";
    // No seam: above and below the horizon the same veil.
    const float above = luminance(pixel(fog, 48, 46));
    const float below = luminance(pixel(fog, 48, 50));
    EXPECT_NEAR(below / above, 1.0f, 0.06f);
    const float clear_seam = luminance(pixel(clear, 48, 52)) / luminance(pixel(clear, 48, 46));
    EXPECT_GT(std::abs(clear_seam - 1.0f), 0.1f);
}

TEST_F(PictureTest, FogHidesTheLandBeyondAGroundThatIsSeenFromAbove)
{
    // The ground ends before the horizon; what lies behind its edge is as far away as it looks.
    renderer->load(scene_of({quad({-60, 0, -20}, {120, 0, 0}, {0, 0, -120})},
                            {plain_material(glm::vec3(0.2f), 1.0f)}),
                   {});
    Frame frame = open_land();
    frame.camera = look({0, 60.0f, 0}, {0, 40.0f, -60}, 1.2f);
    const auto seam = [&](float visibility_m) {
        frame.weather.visibility_m = visibility_m;
        const RenderResult r = renderer->render(frame);
        float step = 0.0f;
        for (int y = 20; y < 40; ++y)
            step = std::max(step, std::abs(luminance(pixel(r, 90, y + 1)) / luminance(pixel(r, 90, y)) - 1.0f));
        return step;
    };
    EXPECT_LT(seam(100.0f), 0.02f) << "no line between the sky and the land behind fog";
    EXPECT_GT(seam(50000.0f), 0.1f);
}

TEST_F(PictureTest, FogThatIsAskedForStaysWithoutImageBasedLight)
{
    renderer->load(land(), {});
    Frame frame = open_land();
    frame.settings.image_based_light = false;
    const float clear = luminance(pixel(renderer->render(frame), 48, 52));
    frame.fog = {.mode = FogMode::Exp, .per_m = 1.0f};
    const RenderResult fog = renderer->render(frame);
    EXPECT_NEAR(luminance(pixel(fog, 48, 52)) / luminance(pixel(fog, 48, 46)), 1.0f, 0.06f) << "no seam";
    EXPECT_GT(std::abs(luminance(pixel(fog, 48, 52)) / clear - 1.0f), 0.1f);
}

TEST_F(PictureTest, EveryNumberOfTheFogCounts)
{
    renderer->load(land(), {});
    const auto far_light = [&](const Fog& fog) {
        Frame frame = open_land();
        frame.fog = fog;
        frame.camera.near_m = 0.3f;
        return luminance(pixel(renderer->render(frame), 48, 56));
    };
    const float off = far_light({.mode = FogMode::Off});
    EXPECT_NE(far_light({.mode = FogMode::Exp, .per_m = 0.01f}), off);
    EXPECT_NE(far_light({.mode = FogMode::Exp, .per_m = 0.02f}),
              far_light({.mode = FogMode::Exp, .per_m = 0.01f}));
    EXPECT_NE(far_light({.mode = FogMode::Exp2, .per_m = 0.02f}),
              far_light({.mode = FogMode::Exp, .per_m = 0.02f}));
    const Fog linear{.mode = FogMode::Linear, .start_m = 2.0f, .end_m = 60.0f};
    EXPECT_NE(far_light(linear), off);
    Fog other = linear;
    other.start_m = 8.0f;
    EXPECT_NE(far_light(other), far_light(linear));
    other = linear;
    other.end_m = 90.0f;
    EXPECT_NE(far_light(other), far_light(linear));
    other = {.mode = FogMode::Exp, .per_m = 0.02f, .height_m = 1.0f};
    EXPECT_NE(far_light(other), far_light({.mode = FogMode::Exp, .per_m = 0.02f}));
}

TEST_F(PictureTest, AnOvercastHorizonHasNoBars)
{
    renderer->load(land(), {});
    Frame frame = open_land();
    frame.sky.cloud_cover = 0.97f;
    frame.settings.width = 256;
    frame.settings.height = 192;
    const RenderResult r = renderer->render(frame);
    // From one to five degrees over the horizon: how much neighbours along a row differ.
    for (int y = 94 - 13; y < 94 - 3; ++y) {
        float mean = 0.0f;
        float step = 0.0f;
        for (int x = 4; x < 252; ++x) {
            mean += luminance(pixel(r, x, y)) / 248.0f;
            step = std::max(
                step, std::abs(luminance(pixel(r, x + 2, y)) - luminance(pixel(r, x - 2, y))));
        }
        EXPECT_LT(step / mean, 0.02f) << "row " << y;
    }
}

// --- the night

Frame open_night()
{
    Frame frame = open_land();
    frame.sky.sun_elevation_rad = -0.5f;
    frame.sky.sidereal_rad = 1.0f;
    return frame;
}

TEST_F(PictureTest, MoonlightComesFromTheMoonAndThrowsShadows)
{
    Scene scene = land();
    Material wall = plain_material(glm::vec3(0.2f));
    wall.double_sided = true;
    scene.materials.push_back(wall);
    scene.meshes[0].primitives.push_back(quad({-30, 0, -12}, {30, 0, 0}, {0, 8, 0}, 1));
    renderer->load(scene, {});
    Frame frame = open_night();
    frame.look.ground_variation = 0.0f;  // an albedo of 0.2 everywhere
    const auto ground = [&](int x) { return luminance(pixel(renderer->render(frame), x, 70)); };
    const float dark = ground(80);
    frame.sky.moon_lux = 0.26f;
    frame.sky.moon_elevation_rad = 0.7f;
    frame.sky.moon_azimuth_rad = 0.0f;  // behind the wall
    const float lit = ground(80);
    // 0.26 lux, less the air, on ground of albedo 0.2.
    EXPECT_NEAR(lit - dark, 0.26f * 0.72f * std::sin(0.7f) * 0.2f / 3.14159f, 0.003f);
    EXPECT_LT(ground(20) - dark, 0.3f * (lit - dark)) << "in the wall's shadow";
    frame.sky.sun_elevation_rad = 0.6f;
    const float day = ground(80);
    frame.sky.moon_lux = 0.0f;
    EXPECT_EQ(ground(80), day) << "by day the sun is the light";
}

TEST_F(PictureTest, StarsTurnAndCloudsHideThem)
{
    renderer->load(land(), {});
    Frame frame = open_night();
    frame.camera = look({0, 1.7f, 0}, {0, 11.7f, -8}, 0.6f);
    frame.settings.width = 256;
    frame.settings.height = 192;
    const auto points = [&](const RenderResult& r) {  // brighter than what is around
        std::vector<int> found;
        for (int y = 1; y < 191; ++y) {
            for (int x = 2; x < 254; ++x) {
                const float here = luminance(pixel(r, x, y));
                if (here > 1.25f * luminance(pixel(r, x - 2, y)) &&
                    here > 1.25f * luminance(pixel(r, x + 2, y)))
                    found.push_back(256 * y + x);
            }
        }
        return found;
    };
    const auto stars = points(renderer->render(frame));
    EXPECT_GT(stars.size(), 10u);
    frame.sky.sidereal_rad += 0.05f;
    EXPECT_NE(points(renderer->render(frame)), stars);
    frame.sky.sidereal_rad -= 0.05f;
    frame.sky.cloud_cover = 1.0f;
    EXPECT_TRUE(points(renderer->render(frame)).empty());
    frame.sky.cloud_cover = 0.0f;
    frame.sky.sun_elevation_rad = 0.4f;
    EXPECT_TRUE(points(renderer->render(frame)).empty()) << "by day";
}

TEST_F(PictureTest, ThePoleStandsAsHighAsThePlaceLiesNorth)
{
    renderer->load(land(), {});
    Frame frame = open_night();
    frame.sky.latitude_rad = 0.6f;
    frame.camera = look({0, 1.7f, 0}, {0, 1.7f + 10 * std::tan(0.6f), -10}, 0.2f);
    // Polaris is the brightest thing within six degrees of the pole, less than one from it, at any
    // hour.
    for (const float turned : {0.0f, 2.0f, 4.5f}) {
        frame.sky.sidereal_rad = turned;
        const RenderResult r = renderer->render(frame);
        int at = 0;
        float brightest = 0.0f;
        for (int i = 0; i < 96 * 96; ++i) {
            const float l = luminance(pixel(r, i % 96, i / 96));
            if (l > brightest) brightest = l, at = i;
        }
        const float away =
            std::hypot(static_cast<float>(at % 96) - 47.5f, static_cast<float>(at / 96) - 47.5f);
        EXPECT_LT(away * 0.2f / 96.0f, 0.017f) << turned;
    }
}

}  // namespace
}  // namespace petrichor::gpu
