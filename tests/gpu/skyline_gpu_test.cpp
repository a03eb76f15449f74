// What stands where the land of the computed sky ends.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class SkylineTest : public GpuTest {
protected:
    void load() { renderer->load(scene_of({quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20})}, {plain_material(glm::vec3(0.2f), 0.9f)}), {}); }
    // An eye near the ground; the horizon is in the middle.
    static Frame frame(float from_m)
    {
        Frame f;
        f.camera = look({0, 1.6f, 0}, {0, 1.6f, -20}, 0.4f);
        f.settings.width = 192;
        f.settings.height = 96;
        f.weather.visibility_m = 30000.0f;
        f.sky.skyline_from_m = from_m;
        return f;
    }
    // Luminance in a band of rows over that without a skyline there.
    static double beside(const RenderResult& r, const RenderResult& bare, int first, int end)
    {
        double sum = 0.0, of = 0.0;
        for (int y = first; y < end; ++y)
            for (int x = 0; x < r.width; ++x) {
                sum += static_cast<double>(luminance(pixel(r, x, y)));
                of += static_cast<double>(luminance(pixel(bare, x, y)));
            }
        return sum / of;
    }
};

TEST_F(SkylineTest, StandsAtTheHorizonAndLeavesTheSkyAboveIt)
{
    load();
    const RenderResult bare = renderer->render(frame(-1.0f)), stands = renderer->render(frame(0.0f));
    EXPECT_LT(beside(stands, bare, 44, 48), 0.9);
    EXPECT_GT(beside(stands, bare, 44, 48), 0.3);
    EXPECT_EQ(beside(stands, bare, 0, 32), 1.0) << "16 rows of 0.24 degrees above the horizon";
}

TEST_F(SkylineTest, BeginsBehindTheScene)
{
    load();
    const RenderResult bare = renderer->render(frame(-1.0f)), all = renderer->render(frame(0.0f));
    const double near = beside(all, bare, 44, 48), far = beside(renderer->render(frame(3000.0f)), bare, 44, 48);
    EXPECT_GT(far, near + 0.02);
    EXPECT_NEAR(beside(renderer->render(frame(20000.0f)), bare, 44, 48), 1.0, 1e-3) << "nothing stands so far off";
}

TEST_F(SkylineTest, FogHidesItAndSnowWhitensIt)
{
    load();
    const auto seen = [&](float visibility_m, float snow) {
        Frame f = frame(-1.0f);
        f.weather.visibility_m = visibility_m;
        f.weather.snow_amount = snow;
        const RenderResult bare = renderer->render(f);
        f.sky.skyline_from_m = 0.0f;
        return beside(renderer->render(f), bare, 45, 48);
    };
    const double clear = seen(30000.0f, 0.0f);
    EXPECT_NEAR(seen(200.0f, 0.0f), 1.0, 0.01);
    EXPECT_GT(seen(1000.0f, 0.0f), clear + 0.05);
    EXPECT_GT(seen(30000.0f, 1.0f), clear + 0.05);
}

TEST_F(SkylineTest, IsNotBeforeAnEnvironment)
{
    EnvironmentMap map;
    map.width = 8;
    map.height = 4;
    map.rgb.assign(std::size_t{8} * 4 * 3, 0.5f);
    load();
    renderer->set_environment(map);
    EXPECT_EQ(renderer->render(frame(0.0f)).beauty, renderer->render(frame(-1.0f)).beauty);
}

}  // namespace
}  // namespace petrichor::gpu
