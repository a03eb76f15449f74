// GGX stands three times: for shaders and renderers in formulas/light/brdf.h, in lanes of eight for
// the fit, in doubles for the yardstick. Here the three are one (a fourth, chain_fit_kernel.inc, in chain_fit_test.cpp).
#include <gtest/gtest.h>

#include <cmath>

#include "formulas/light/brdf.h"
#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/lobe_tools.h"
#include "texproc/study/detail/yardstick.h"

namespace petrichor::texproc {
namespace {

using namespace detail;

struct Surface {
    const char* name;
    float x, y, z, alpha;
};
void PrintTo(const Surface& s, std::ostream* out)
{
    *out << s.name;
}

class LobeTwins : public testing::TestWithParam<Surface> {};

// The formula of brdf.h takes 1 - (n.h)^2 from 1 in single precision and loses 1e-7 / alpha^2 of
// it; the twins take it from |n - h|. Hence 1e-4 for alphas of 0.1 and up.
constexpr double kAgreement = 1e-4;

TEST_P(LobeTwins, LanesShadeAsTheRendererDoes)
{
    const Surface s = GetParam();
    Cells cells;
    cells.add(s.x, s.y, s.z, s.alpha * s.alpha, 1.0f);
    Samples samples;
    samples.draw(cells.view(), kViews * 64, 7, lobe_kernel());
    const SamplesView at = samples.view();
    int lit = 0;
    for (int v = 0; v < kViews; ++v) {
        const float* view = kViewDirections[v];
        const float nv = s.x * view[0] + s.y * view[1] + s.z * view[2];
        if (!(nv > 0.0f)) continue;
        for (int k = v * at.per_view; k < (v + 1) * at.per_view; ++k) {
            const float nh = s.x * at.hx[k] + s.y * at.hy[k] + s.z * at.hz[k];
            const float nl = at.vh2[k] * nh - nv;
            if (!(nl > 0.02f && nh > 0.0f)) continue;
            const float distribution = shared::ggx_distribution(nh, s.alpha);
            const float light = distribution * shared::ggx_visibility(nl, nv, s.alpha) * nl;
            EXPECT_NEAR(at.radiance[k] / light, 1.0, kAgreement) << "view " << v;
            EXPECT_NEAR(at.density[k] / (distribution * nh), 1.0, kAgreement) << "view " << v;
            ++lit;
        }
    }
    EXPECT_GT(lit, 100);
}

TEST_P(LobeTwins, TheYardstickHasTheSameDensity)
{
    const Surface s = GetParam();
    for (int i = 0; i <= 40; ++i) {
        // Half-vectors from the normal to the horizon, in the plane of the normal and another axis.
        const Frame f = frame_about({s.x, s.y, s.z});
        const double tilt = 0.039 * i;
        const auto c = static_cast<float>(std::cos(tilt)), r = static_cast<float>(std::sin(tilt));
        const float h[3] = {f.n.x * c + f.t.x * r, f.n.y * c + f.t.y * r, f.n.z * c + f.t.z * r};
        const float nh = s.x * h[0] + s.y * h[1] + s.z * h[2];
        const double expected =
            static_cast<double>(shared::ggx_distribution(nh, s.alpha)) * static_cast<double>(nh);
        const double density = lobe_density(static_cast<double>(s.alpha * s.alpha), {s.x, s.y, s.z},
                                            static_cast<double>(h[0]), static_cast<double>(h[1]),
                                            static_cast<double>(h[2]));
        EXPECT_NEAR(density / expected, 1.0, kAgreement) << "tilt " << tilt;
    }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, LobeTwins,
                         testing::Values(Surface{"glossy", 0.0f, 0.0f, 1.0f, 0.1f},
                                         Surface{"satin", 0.6f, 0.0f, 0.8f, 0.3f},
                                         Surface{"rough", -0.36f, 0.48f, 0.8f, 0.9f}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace petrichor::texproc
