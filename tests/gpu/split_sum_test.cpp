// What a surface mirrors of an even sky: the split-sum table, as pictures have it, against a sum over the lobe.
#include <cmath>

#include "tests/gpu/furnace_frame.h"

namespace petrichor::gpu {
namespace {

constexpr double kPi = 3.14159265358979;

// Share of light from all sides that facets of GGX mirror towards an eye, with F0 = `f0`: the midpoint rule over
// directions of the light, in double (Walter 2007; correlated Smith, Heitz 2014; Schlick 1994).
double mirrored(double nv, double roughness, double f0)
{
    const double a2 = std::pow(roughness, 4.0);
    const double v[2] = {std::sqrt(1.0 - nv * nv), nv};
    constexpr int kUp = 1000, kAround = 1000;
    double sum = 0.0;
    for (int i = 0; i < kUp; ++i) {
        const double nl = (i + 0.5) / kUp, flat = std::sqrt(1.0 - nl * nl);
        for (int k = 0; k < kAround; ++k) {
            const double turn = kPi * (k + 0.5) / kAround;  // one half is the other's mirror image
            const double hx = v[0] + flat * std::cos(turn), hy = flat * std::sin(turn), hz = v[1] + nl;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            const double nh = hz / length, vh = (v[0] * hx + v[1] * hz) / length;
            const double d = nh * nh * (a2 - 1.0) + 1.0;
            const double masked = nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2);
            sum += a2 / (kPi * d * d) * 0.5 / masked * (f0 + (1.0 - f0) * std::pow(1.0 - vh, 5.0)) * nl;
        }
    }
    return sum * 2.0 * kPi / (kUp * kAround);
}

class SplitSum : public GpuTest {};

// The model of Lux mirrors by scale and offset of F0 alone: no light is sent on between facets.
TEST_F(SplitSum, IsTheSumOverTheLobe)
{
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        for (const float f0 : {0.2f, 1.0f}) {
            Material metal = plain_material(glm::vec3(f0), roughness, 1.0f);
            metal.lighting_model = "lux";
            renderer->load(scene_of({quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})}, {metal}), {});
            renderer->set_environment(constant_environment(1.0f));
            for (const float up : {1.0f, 0.5f, 0.2f}) {
                const Frame frame = furnace_frame(up);
                const double expected = mirrored(static_cast<double>(up), static_cast<double>(roughness), static_cast<double>(f0));
                EXPECT_NEAR(static_cast<double>(pixel(renderer->render(frame), 8, 8).g) / expected, 1.0, 0.015)
                    << "roughness " << roughness << ", F0 " << f0 << ", cosine " << up << ": " << expected;
            }
        }
    }
}

}  // namespace
}  // namespace petrichor::gpu
