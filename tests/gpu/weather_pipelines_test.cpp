// Pipelines that are made for more kinds of weather than a frame has draw it as those of its own do.
#include <algorithm>

#include "gpu/frame/falls.h"
#include "gpu/frame/view.h"
#include "scene/patches/tracer.h"
#include "scene/snow/snow_caps.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

// Ground, and a roof over half of it.
Scene roofed_ground()
{
    return scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), quad({-3, 1, 1}, {3, 0, 0}, {0, 0, -4})},
                    {plain_material(glm::vec3(0.2f))});
}

Frame seen_from_the_side()
{
    Frame f;
    f.camera = look({0, 2.5f, 6}, {0, 0.3f, 0});
    f.settings.width = f.settings.height = 64;
    f.settings.samples = 1;
    f.settings.aovs = {"rain_exposure", "snow"};
    return f;
}

Frame rain_in(float wind_m_s)
{
    Frame f = seen_from_the_side();
    f.weather.rain = 0.6f;
    f.weather.rain_kg_m2_s = 5.0f / 3600.0f;
    f.weather.wind_m_s = {wind_m_s, 0.3f};
    f.weather.film_albedo = f.weather.film_smoothness = 0.8f;
    f.weather.flood_cracks = f.weather.flood_puddles = 0.6f;
    return f;
}

std::size_t directions_of(const Frame& frame)
{
    std::array<glm::vec3, SKY_DIRECTIONS> sky;
    for (int i = 0; i < SKY_DIRECTIONS; ++i) sky[static_cast<std::size_t>(i)] = sky_direction(i);
    std::size_t rain = 0;
    for (const Fall& fall : falls(frame.weather, sky)) rain += fall.rain > 0.0f ? 1 : 0;
    return rain;
}

// The first wind with rain along so many directions.
std::optional<Frame> rain_along(std::size_t directions)
{
    for (int i = 0; i < 400; ++i) {
        const Frame frame = rain_in(0.05f * static_cast<float>(i));
        if (directions_of(frame) == directions) return frame;
    }
    return std::nullopt;
}

using WeatherPipelines = GpuTest;

TEST_F(WeatherPipelines, RainThatTheWindLeavesIsAsItWouldBeAlone)
{
    const auto windy = rain_along(4);
    const auto steady = rain_along(3);
    ASSERT_TRUE(windy && steady);
    renderer->load(roofed_ground(), {});
    const RenderResult alone = renderer->render(*steady);
    const RenderResult other = renderer->render(*windy);
    EXPECT_NE(alone.aovs[0].pixels, other.aovs[0].pixels) << "the roof keeps off what the wind turns";
    renderer->render(seen_from_the_side());  // dry
    const RenderResult behind = renderer->render(*steady);
    EXPECT_EQ(behind.beauty, alone.beauty);
    EXPECT_EQ(behind.aovs[0].pixels, alone.aovs[0].pixels);
}

TEST_F(WeatherPipelines, RainAloneIsKeptInHalfTheBytesAndSaysTheSame)
{
    // A material whose number needs both of its bytes.
    const std::vector<Material> many(258, plain_material(glm::vec3(0.2f)));
    const Scene scene = scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 255), quad({-3, 1, 1}, {3, 0, 0}, {0, 0, -4}, 257)}, many);
    renderer->load(scene, {});
    Frame rain = rain_in(6.0f);
    rain.weather.flood_cracks = rain.weather.flood_puddles = 1.0f;
    rain.settings.aovs = {"film", "water", "snow", "frost", "material"};
    rain.settings.surface_path = SurfacePath::Visibility;
    const RenderResult half = renderer->render(rain);
    Frame hoar = rain;
    hoar.weather.frost = 1.0e-4f;  // too little to be seen, but kept
    const RenderResult whole = renderer->render(hoar);
    EXPECT_EQ(aov(half, "material", 20, 25), 257.0f);
    EXPECT_EQ(aov(half, "material", 50, 50), 255.0f);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_GT(*std::max_element(half.aovs[i].pixels.begin(), half.aovs[i].pixels.end()), 0.3f) << half.aovs[i].name;
    }
    for (std::size_t i = 0; i < half.aovs.size(); ++i) {
        ASSERT_EQ(half.aovs[i].pixels.size(), whole.aovs[i].pixels.size());
        for (std::size_t k = 0; k < half.aovs[i].pixels.size(); ++k) {
            ASSERT_NEAR(half.aovs[i].pixels[k], whole.aovs[i].pixels[k], 1.01f / 255.0f) << half.aovs[i].name << " " << k;
        }
    }
    // Snow is kept whole again, and rain behind it is as it was.
    Frame snow = rain;
    snow.weather.snow_amount = 0.8f;
    EXPECT_GT(aov(renderer->render(snow), "snow", 50, 50), 0.3f);
    EXPECT_EQ(renderer->render(rain).beauty, half.beauty);
}

TEST_F(WeatherPipelines, ThinSnowKnowsNothingOfTheBodyThatItMayHave)
{
    const Scene scene = roofed_ground();
    const scene::Triangles triangles(scene, {});
    const scene::Tracer tracer(triangles);
    const auto caps = std::make_shared<const scene::SnowCaps>(scene::build_snow_caps(tracer, {}));
    for (const float melt : {0.0f, 0.5f}) {
        Frame thin = seen_from_the_side();
        thin.weather.snow_amount = 0.2f;
        thin.weather.snow_depth_m = 0.006f;
        thin.weather.water_to_snow = 1.0f - melt;
        thin.weather.melt = melt;
        thin.weather.melt_exp = melt > 0.0f ? 1.0f - std::exp2(-10.0f * melt) : 0.0f;
        renderer->load(scene, {});
        const RenderResult without = renderer->render(thin);
        renderer->load(scene, {}, caps);
        const RenderResult with = renderer->render(thin);
        EXPECT_GT(aov(with, "snow", 40, 50), 0.0f);
        EXPECT_EQ(with.beauty, without.beauty) << melt;
        EXPECT_EQ(with.aovs[1].pixels, without.aovs[1].pixels) << melt;
    }
}

}  // namespace
}  // namespace petrichor::gpu
