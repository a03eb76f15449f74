// What bends in the wind, as it is seen: itself, its shadow, and nothing in calm air.
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

class WindTest : public GpuTest {};

// A pole of 1 m on the ground, cut into eight.
Scene pole(float bend, float flutter_m = 0.0f)
{
    Primitive p;
    for (int i = 0; i <= 8; ++i) {
        for (const float x : {-0.05f, 0.05f}) {
            p.positions.emplace_back(x, static_cast<float>(i) / 8.0f, 0.0f);
            p.normals.emplace_back(0, 0, 1);
            p.tangents.emplace_back(1, 0, 0, 1);
            p.uv0.emplace_back(x, 0.0f);
        }
        if (i == 0) continue;
        const auto at = static_cast<std::uint32_t>(2 * i);
        for (const std::uint32_t v : {at - 2, at - 1, at + 1, at - 2, at + 1, at}) p.indices.push_back(v);
    }
    p.material = 1;
    Material plant = plain_material(glm::vec3(0.05f, 0.5f, 0.05f));
    plant.double_sided = true;
    plant.wind.bend = bend;
    plant.wind.flutter_m = flutter_m;
    return scene_of({quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), p},
                    {plain_material(glm::vec3(0.5f)), plant});
}

Frame in_wind(float speed_m_s, double time_s = 0.4)
{
    Frame frame;
    frame.camera = look({0, 1.2f, 3.0f}, {0, 0.4f, 0}, 0.7f);
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.time_s = time_s;
    frame.settings.aovs = {"base_color", "depth"};
    frame.sky.sun_elevation_rad = 0.7f;
    frame.sky.sun_azimuth_rad = 0.0f;  // its shadow falls towards the eye
    frame.weather.wind_m_s = {speed_m_s, 0.0f};
    frame.falling.air_m = {static_cast<double>(speed_m_s) * time_s, 0.0};
    return frame;
}

// Mean column of the plant's pixels in a row; 0: none.
double column(const RenderResult& r, int y)
{
    double sum = 0.0, count = 0.0;
    for (int x = 0; x < r.width; ++x) {
        if (aov(r, "base_color", x, y, 1) - aov(r, "base_color", x, y, 0) < 0.2f) continue;
        sum += x;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// And of the darkest fifth of the ground in a row.
double shadow_column(const RenderResult& r, int y)
{
    float brightest = 0.0f;
    for (int x = 0; x < r.width; ++x) brightest = std::max(brightest, luminance(pixel(r, x, y)));
    double sum = 0.0, count = 0.0;
    for (int x = 0; x < r.width; ++x) {
        if (luminance(pixel(r, x, y)) > 0.7f * brightest) continue;
        sum += x;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

TEST_F(WindTest, CalmAirIsAsIfThereWereNone)
{
    renderer->load(pole(0.8f, 0.1f), {});
    const RenderResult calm = renderer->render(in_wind(0.0f));
    renderer->render(in_wind(12.0f));
    EXPECT_EQ(renderer->render(in_wind(0.0f, 7.0)).beauty, calm.beauty) << "it stays bent";
    renderer->load(pole(0.0f), {});
    EXPECT_EQ(renderer->render(in_wind(0.0f)).beauty, calm.beauty);
    EXPECT_EQ(renderer->render(in_wind(12.0f)).beauty, calm.beauty);
}

TEST_F(WindTest, APlantLeansAndItsShadowWithIt)
{
    renderer->load(pole(0.4f), {});
    const RenderResult calm = renderer->render(in_wind(0.0f));
    const RenderResult blown = renderer->render(in_wind(15.0f));
    const int top = 24, root = 40;
    EXPECT_NEAR(column(calm, top), 47.5, 1.0);
    EXPECT_GT(column(blown, top), column(calm, top) + 3.0);
    EXPECT_NEAR(column(blown, root), column(calm, root), 1.0);
    const int shade = 50;
    ASSERT_GT(shadow_column(calm, shade), 0.0);
    EXPECT_GT(shadow_column(blown, shade), shadow_column(calm, shade) + 2.0);
}

TEST_F(WindTest, AFrameAloneIsTheFrameOfARun)
{
    renderer->load(pole(0.6f, 0.05f), {});
    for (const double t : {0.0, 0.1, 0.2}) renderer->render(in_wind(9.0f, t));
    const RenderResult run = renderer->render(in_wind(9.0f, 0.3));
    renderer->load(pole(0.6f, 0.05f), {});
    EXPECT_EQ(renderer->render(in_wind(9.0f, 0.3)).beauty, run.beauty);
    EXPECT_NE(renderer->render(in_wind(9.0f, 0.5)).beauty, run.beauty);
}

TEST_F(WindTest, BothSurfacePathsBend)
{
    renderer->load(pole(0.8f), {});
    Frame frame = in_wind(15.0f);
    frame.settings.surface_path = SurfacePath::Fragment;
    const RenderResult fragment = renderer->render(frame);
    frame.settings.surface_path = SurfacePath::Visibility;
    const RenderResult visibility = renderer->render(frame);
    int other = 0;
    for (int y = 0; y < fragment.height; ++y) {
        for (int x = 0; x < fragment.width; ++x)
            other += std::abs(aov(fragment, "depth", x, y) - aov(visibility, "depth", x, y)) > 0.01f ? 1 : 0;
    }
    EXPECT_LE(other, 2);
}

}  // namespace
}  // namespace petrichor::gpu
