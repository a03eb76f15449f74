// A thin film against Airy's sum over all wavelengths, seen by the eye.
#include "formulas/light/iridescence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace petrichor::shared {
namespace {

// Colour matching functions of CIE 1931 as Wyman, Sloan and Shirley 2013 have them.
glm::dvec3 eye(double nm)
{
    const auto g = [nm](double mean, double low, double high) {
        const double t = (nm - mean) * (nm < mean ? low : high);
        return std::exp(-0.5 * t * t);
    };
    return {0.362 * g(442.0, 0.0624, 0.0374) + 1.056 * g(599.8, 0.0264, 0.0323) -
                0.065 * g(501.1, 0.0490, 0.0382),
            0.821 * g(568.8, 0.0213, 0.0247) + 0.286 * g(530.9, 0.0613, 0.0322),
            1.217 * g(437.0, 0.0845, 0.0278) + 0.681 * g(459.0, 0.0385, 0.0725)};
}

// Reflectance of a film over a dielectric, straight on.
double airy(double nm, double film, double base, double thickness_nm)
{
    const double r12 = (1.0 - film) / (1.0 + film);
    const double r23 = (film - base) / (film + base);
    const double phase = 4.0 * 3.14159265358979 * film * thickness_nm / nm;
    const std::complex<double> turn = std::polar(1.0, phase);
    return std::norm((r12 + r23 * turn) / (1.0 + r12 * r23 * turn));
}

double luminance_of_airy(double film, double base, double thickness_nm)
{
    double sum = 0.0, all = 0.0;
    for (double nm = 380.0; nm <= 780.0; nm += 1.0) {
        sum += airy(nm, film, base, thickness_nm) * eye(nm).y;
        all += eye(nm).y;
    }
    return sum / all;
}

float f0_of(float index)
{
    return boundary_f0(index, 1.0f);
}

TEST(Iridescence, AFilmOfNoThicknessIsNone)
{
    for (const float f0 : {0.02f, 0.04f, 0.3f, 0.9f}) {
        for (const float cosine : {0.1f, 0.5f, 1.0f}) {
            const vec3 f = thin_film_fresnel(1.4f, 0.0f, vec3(f0), cosine);
            EXPECT_NEAR(f.x, schlick_fresnel(vec3(f0), cosine).x, 2e-3f) << f0 << " " << cosine;
            EXPECT_NEAR(thin_film_f0(1.4f, 0.0f, vec3(f0), cosine).y, f0, 3e-3f);
        }
    }
}

// Straight on, where Schlick's law is exact. The eye's curves differ a little from Gaussians.
TEST(Iridescence, IsAirysReflectanceAsTheEyeSeesIt)
{
    for (const auto& [film, base] : {std::pair{1.33f, 1.5f}, {1.8f, 1.5f}, {2.0f, 1.3f}}) {
        double worst = 0.0, largest = 0.0;
        for (float nm = 60.0f; nm < 700.0f; nm += 20.0f) {
            const vec3 f = thin_film_fresnel(film, nm, vec3(f0_of(base)), 1.0f);
            const double y = static_cast<double>(0.2126f * f.x + 0.7152f * f.y + 0.0722f * f.z);
            const double wanted = luminance_of_airy(film, base, nm);
            worst = std::max(worst, std::abs(y - wanted));
            largest = std::max(largest, wanted);
        }
        EXPECT_LT(worst, 0.08 * largest) << film << " over " << base;
    }
}

TEST(Iridescence, FringesFadeInThickFilmsAndNeverSendMoreThanComesIn)
{
    const vec3 thick = thin_film_fresnel(1.5f, 20000.0f, vec3(0.3f), 0.8f);
    EXPECT_NEAR(thick.x, thick.y, 1e-3f);
    EXPECT_NEAR(thick.y, thick.z, 1e-3f);
    for (float nm = 0.0f; nm < 1200.0f; nm += 25.0f) {
        for (const float cosine : {0.02f, 0.3f, 0.7f, 1.0f}) {
            const vec3 f = thin_film_f0(1.8f, nm, vec3(0.95f, 0.6f, 0.1f), cosine);
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(f[c], 0.0f);
                EXPECT_LE(f[c], 1.0f);
            }
        }
    }
}

// What light has that goes on between facets.
TEST(Iridescence, ItsMeanIsThatOfAllCosines)
{
    for (const float ior : {1.3f, 1.6f, 2.0f}) {
        for (float nm = 100.0f; nm <= 1200.0f; nm += 50.0f) {
            const vec3 base(0.04f, 0.3f, 0.8f);
            vec3 sum(0.0f);
            for (int i = 0; i < 2000; ++i) {
                const float cosine = (static_cast<float>(i) + 0.5f) / 2000.0f;
                sum += thin_film_fresnel(ior, nm, base, cosine) * (2.0f * cosine / 2000.0f);
            }
            const vec3 told = filmed_mean_f0({1.0f, ior, nm, base});
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(told[c] + (1.0f - told[c]) / 21.0f, sum[c], 0.014f) << ior << " " << nm << " " << c;
            const vec3 half = filmed_mean_f0({0.5f, ior, nm, base});
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5f * (base[c] + told[c]), 1e-6f);
        }
    }
}

}  // namespace
}  // namespace petrichor::shared
