// The light of a clear sky after sunset, against what has been measured.
#include <gtest/gtest.h>

#include "formulas/light/atmosphere.h"

namespace petrichor::shared {
namespace {

// On level ground, lux: the sky's radiance over the hemisphere.
double sky_lux(double sun_elevation_degrees)
{
    const auto e = static_cast<float>(sun_elevation_degrees * 0.01745329);
    const float sun_up = std::sin(e), sun_level = std::cos(e);
    double sum = 0.0;
    const int n = 20;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const float up = (static_cast<float>(i) + 0.5f) / n;
            const float level = std::sqrt(1.0f - up * up);
            const float azimuth = (static_cast<float>(j) + 0.5f) / n * 3.14159265f;
            const glm::vec3 l =
                air_radiance(up, sun_up, up * sun_up + level * sun_level * std::cos(azimuth),
                             glm::vec3(100000.0f), 2.5f);
            sum += static_cast<double>(up * (0.2126f * l.x + 0.7152f * l.y + 0.0722f * l.z)) * 2.0 *
                   3.14159265 / (n * n);
        }
    }
    return sum;
}

// Illuminance of clear skies (Electro-Optics Handbook, RCA 1974), each within a factor of three.
TEST(Twilight, FadesAsMeasured)
{
    const double table[][2] = {{0.0, 732.0}, {-6.0, 3.40}, {-8.0, 0.52}, {-12.0, 0.00831}};
    for (const auto& [degrees, lux] : table) {
        EXPECT_GT(sky_lux(degrees), lux / 3.2) << degrees;
        EXPECT_LT(sky_lux(degrees), lux * 3.2) << degrees;
    }
    double before = 1e9;
    for (double degrees = 8.0; degrees > -14.0; degrees -= 0.5) {
        EXPECT_LT(sky_lux(degrees), before) << degrees;
        before = sky_lux(degrees);
    }
}

}  // namespace
}  // namespace petrichor::shared
