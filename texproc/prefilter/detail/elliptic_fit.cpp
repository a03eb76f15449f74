#include "texproc/prefilter/detail/elliptic_fit.h"

#include <algorithm>
#include <cmath>

#include "texproc/prefilter/detail/simplex.h"

namespace petrichor::texproc::detail {

namespace {

EllipticLobe elliptic(const Frame& frame, const std::array<float, 5>& x)
{
    const Direction n = leaned(frame, x[0], x[1]);
    const Frame about = frame_about(n);
    const float c = std::cos(x[4]), s = std::sin(x[4]);
    const auto clamped = [](float log2) { return std::clamp(std::exp(log2), kMinAlpha2, 1.0f); };
    return {n.x,
            n.y,
            n.z,
            c * about.t.x + s * about.b.x,
            c * about.t.y + s * about.b.y,
            c * about.t.z + s * about.b.z,
            c * about.b.x - s * about.t.x,
            c * about.b.y - s * about.t.y,
            c * about.b.z - s * about.t.z,
            clamped(x[2]),
            clamped(x[3])};
}

}  // namespace

std::pair<EllipticLobe, float> fit_elliptic(const LobeCost& cost, const Candidate& from,
                                            const RobustFit& robust, int budget)
{
    const float mean = 0.5f * (robust.a_xx + robust.a_yy);
    const float half =
        std::sqrt(std::max(0.0f, 0.25f * (robust.a_xx - robust.a_yy) * (robust.a_xx - robust.a_yy) +
                                     robust.a_xy * robust.a_xy));
    const float angle = 0.5f * std::atan2(2.0f * robust.a_xy, robust.a_xx - robust.a_yy);
    const float wide = std::clamp(mean + half, kMinAlpha2, 1.0f);
    const float slim = std::clamp(mean - half, kMinAlpha2, 1.0f);
    std::pair<EllipticLobe, float> best{{}, 3.0f};
    const float mine = std::log(from.alpha2);
    const float lean = 0.35f * std::sqrt(from.alpha2);
    const std::array<std::pair<Direction, std::array<float, 5>>, 2> starts{{
        {robust.normal, {0.0f, 0.0f, std::log(wide), std::log(slim), angle}},
        {from.normal, {0.0f, 0.0f, mine + 0.3f, mine - 0.3f, angle}},
    }};
    for (const auto& [normal, start] : starts) {
        const Frame frame = frame_about(normal);
        const auto f = [&](const std::array<float, 5>& x) {
            const EllipticLobe e = elliptic(frame, x);
            return e.nz < 0.05f ? 2.0f : cost(e);
        };
        const auto [x, value] =
            simplex<5>(start, f(start), {lean, lean, 0.4f, -0.4f, 0.3f}, budget, 2e-4f, f);
        if (value < best.second) best = {elliptic(frame, x), value};
    }
    return best;
}

}  // namespace petrichor::texproc::detail
