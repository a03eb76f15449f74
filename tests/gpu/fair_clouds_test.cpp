// Heaps of a fair sky: lit on their flanks, grey below.
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <vector>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using FairClouds = GpuTest;

// Of clouds in a picture of the sky, which are hardly blue: the luminance of the lower third of what a column shows of one over that of the
// upper third, in the mean.
double below_over_above(const RenderResult& r)
{
    double sum = 0.0;
    int clouds = 0;
    for (int x = 0; x < r.width; ++x) {
        std::vector<double> run;
        for (int y = 0; y <= r.height; ++y) {
            if (y < r.height) {
                const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) + static_cast<std::size_t>(x));
                const float red = glm::unpackHalf1x16(r.beauty[i]), green = glm::unpackHalf1x16(r.beauty[i + 1]);
                const float blue = glm::unpackHalf1x16(r.beauty[i + 2]);
                if (red > 0.8f * blue) {
                    run.push_back(static_cast<double>(0.2126f * red + 0.7152f * green + 0.0722f * blue));
                    continue;
                }
            }
            if (const std::size_t third = run.size() / 3; third >= 3) {
                const auto end = static_cast<std::ptrdiff_t>(third);
                sum += std::accumulate(run.end() - end, run.end(), 0.0) / std::accumulate(run.begin(), run.begin() + end, 0.0);
                ++clouds;
            }
            run.clear();
        }
    }
    EXPECT_GT(clouds, 30) << "clouds are there";
    return sum / clouds;
}

TEST_F(FairClouds, AreGreyBelowAndLitOnTheirFlanks)
{
    renderer->load(scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {plain_material(glm::vec3(0.2f), 1.0f)}), {});
    double mean = 0.0;
    for (const float time_s : {0.0f, 700.0f, 1900.0f}) {
        Frame frame;
        frame.camera = look({0, 1.7f, 0}, {-10, 6.7f, 3}, 0.7f);
        frame.sky.sun_elevation_rad = 0.6f;
        frame.sky.cloud_cover = 0.35f;
        frame.weather.wind_m_s = {12.0f, 5.0f};
        frame.weather.visibility_m = 50000.0f;
        frame.settings.time_s = static_cast<double>(time_s);
        frame.settings.width = 120;
        frame.settings.height = 80;
        frame.settings.samples = 1;
        mean += below_over_above(renderer->render(frame)) / 3.0;
    }
    EXPECT_LT(mean, 0.70);
    EXPECT_GT(mean, 0.3);
}

}  // namespace
}  // namespace petrichor::gpu
