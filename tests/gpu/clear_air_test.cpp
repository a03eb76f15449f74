// The light of a clear sky, against what has been measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gpu/passes/sky/scattered_again.h"
#include "tests/gpu/spectral_air.h"

namespace petrichor::gpu {
namespace {

constexpr float kTurbidity = 2.5f;
constexpr double kDegree = 0.017453292519943;

double luminance(const glm::vec3& c)
{
    return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) +
           0.0722 * static_cast<double>(c.z);
}

// On level ground, for a sun of 100 000 lux above the air.
glm::vec3 sky_lux(const ScatteredAgain& scattered, double sun_elevation_degrees, float albedo = 0.2f)
{
    const auto table = scattered.table(albedo);
    return 100000.0f * ClearAir(table).on_level_ground(
                           static_cast<float>(std::sin(sun_elevation_degrees * kDegree)), kTurbidity);
}

// Electro-Optics Handbook, RCA 1974: clear sky, the sun's centre below the horizon.
TEST(Twilight, FadesAsMeasured)
{
    const ScatteredAgain scattered(kTurbidity);
    const double table[][2] = {{0.0, 732.0}, {-6.0, 3.40}, {-8.0, 0.52}, {-12.0, 0.00831}};
    for (const auto& [degrees, lux] : table) {
        EXPECT_GT(luminance(sky_lux(scattered, degrees)), lux / 1.5) << degrees;
        EXPECT_LT(luminance(sky_lux(scattered, degrees)), lux * 1.5) << degrees;
    }
    double before = 1e9;
    for (double degrees = 8.0; degrees > -14.0; degrees -= 0.5) {
        const double now = luminance(sky_lux(scattered, degrees));
        EXPECT_LT(now, before) << degrees;
        before = now;
    }
}

// The blue hour: ozone takes the red and the yellow of light that comes flat through the air (Hulburt 1953).
TEST(Twilight, IsBlueAboveAndRedAtTheHorizon)
{
    const ScatteredAgain scattered(kTurbidity);
    for (const double degrees : {-4.0, -6.0, -8.0, -10.0}) {
        const glm::vec3 level = sky_lux(scattered, degrees);
        EXPECT_LT(level.x, level.y) << degrees;
        EXPECT_GT(level.z, 1.5f * level.y) << degrees;
    }
    const auto table = scattered.table(0.2f);
    const auto sun_up = static_cast<float>(std::sin(-4.0 * kDegree));
    const float up = 0.03f;
    const glm::vec3 glow = ClearAir(table).radiance(up, sun_up, 0.995f, glm::vec3(1.0f), kTurbidity);
    EXPECT_GT(glow.x, 1.5f * glow.y);
    EXPECT_GT(glow.y, 1.5f * glow.z);
}

TEST(ClearAir, IsBlueOverhead)
{
    const ScatteredAgain scattered(kTurbidity);
    const auto table = scattered.table(0.2f);
    const glm::vec3 zenith = ClearAir(table).radiance(1.0f, 0.7f, 0.7f, glm::vec3(100000.0f), kTurbidity);
    EXPECT_GT(zenith.b, 1.5f * zenith.r);
    EXPECT_GT(zenith.g, 500.0f);
    EXPECT_LT(zenith.g, 8000.0f);
}

// Under a high sun about a tenth of the light on level ground is the sky's, more over snow, less over water.
TEST(ClearAir, IsASmallShareOfTheLightAtNoon)
{
    const ScatteredAgain scattered(kTurbidity);
    const float sun_up = std::sin(static_cast<float>(60.0 * kDegree));
    const double sun =
        100000.0 * luminance(shared::air_transmittance(2.0f, sun_up, kTurbidity)) * static_cast<double>(sun_up);
    const double sky = luminance(sky_lux(scattered, 60.0));
    EXPECT_GT(sky, 0.05 * sun);
    EXPECT_LT(sky, 0.20 * sun);
    EXPECT_GT(luminance(sky_lux(scattered, 60.0, 0.8f)), 1.03 * sky);
    EXPECT_LT(luminance(sky_lux(scattered, 60.0, 0.0f)), sky);
}

// Scattering without absorption loses nothing: what one square metre of sunlight brings in leaves again or
// reaches the ground. Over black ground light on it is below what the sun sent.
TEST(ClearAir, SendsNoMoreThanTheSunBrings)
{
    for (const float turbidity : {1.0f, 2.5f, 6.0f, 10.0f}) {
        const ScatteredAgain scattered(turbidity);
        const auto table = scattered.table(0.0f);
        for (const double degrees : {90.0, 45.0, 15.0, 5.0}) {
            const float sun_up = std::sin(static_cast<float>(degrees * kDegree));
            const glm::vec3 sky = ClearAir(table).on_level_ground(sun_up, turbidity);
            const glm::vec3 sun = shared::air_transmittance(2.0f, sun_up, turbidity) * sun_up;
            EXPECT_LT(luminance(sky + sun), static_cast<double>(sun_up) * 1.02) << turbidity << " " << degrees;
            EXPECT_GT(sky.x, 0.0f);
        }
    }
}

glm::dvec2 chromaticity(const glm::dvec3& c)
{
    const glm::dvec3 xyz(0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                         0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z);
    return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

// Of formulas/light/atmosphere.h: within 0.003 in CIE xy and 3 % of luminance of the sums over 80 wavelengths, for
// suns and a haze that its bands and matrix were not fitted to.
TEST(ClearAir, HasTheColoursOfManyBands)
{
    const SpectralAir truth(kTurbidity, 0.2);
    const ScatteredAgain scattered(kTurbidity);
    const auto table = scattered.table(0.2f);
    const ClearAir air(table);
    const auto compare = [](const char* what, double degrees, const glm::vec3& bands, const glm::dvec3& many) {
        const glm::dvec3 shown = glm::max(many, glm::dvec3(0.0));  // sRGB has no colour as red as a sun at 0 degrees
        const glm::dvec2 d = chromaticity(glm::dvec3(bands)) - chromaticity(shown);
        EXPECT_LT(std::hypot(d.x, d.y), 0.003) << what << " " << degrees;
        EXPECT_NEAR(luminance(bands) / luminance(glm::vec3(shown)), 1.0, 0.03) << what << " " << degrees;
    };
    for (const double degrees : {90.0, 10.0, 5.0, 2.0, 0.0, -2.0, -4.0}) {
        const double sun_up = std::sin(degrees * kDegree), sun_level = std::cos(degrees * kDegree);
        const auto up_f = static_cast<float>(sun_up);
        if (degrees >= 0.0)
            compare("sun", degrees, shared::air_transmittance(2.0f, up_f, kTurbidity), truth.sun(sun_up));
        compare("level", degrees, air.on_level_ground(up_f, kTurbidity), truth.level(sun_up));
        const auto look = [&](const char* what, double up, double side) {
            const double angle = up * sun_up + std::sqrt(1.0 - up * up) * sun_level * side;
            compare(what, degrees,
                    air.radiance(static_cast<float>(up), up_f, static_cast<float>(angle), glm::vec3(1.0f), kTurbidity),
                    truth.radiance(up, sun_up, angle));
        };
        look("zenith", 1.0, 0.0);
        look("under the sun", 0.05, 0.99);
        look("opposite", 0.05, -0.99);
    }
}

}  // namespace
}  // namespace petrichor::gpu
