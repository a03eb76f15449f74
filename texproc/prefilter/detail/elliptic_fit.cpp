#include "texproc/prefilter/detail/elliptic_fit.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "texproc/prefilter/detail/simplex.h"

namespace petrichor::texproc::detail {

EllipticLobe elliptic_lobe(const Frame& frame, const std::array<float, 2>& axis,
                           const std::array<float, 5>& x)
{
    const Direction n = leaned(frame, x[0], x[1]);
    const Frame about = frame_about(n);
    const float turn_c = portable_cos(x[4]), turn_s = portable_sin(x[4]);
    const float c = axis[0] * turn_c - axis[1] * turn_s, s = axis[1] * turn_c + axis[0] * turn_s;
    const auto clamped = [](float log2) {
        return std::clamp(portable_exp(log2), kMinAlpha2, 1.0f);
    };
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

std::pair<EllipticLobe, float> fit_elliptic(const LobeCost& cost, const Candidate& from,
                                            const RobustFit& robust, int budget)
{
    const float mean = 0.5f * (robust.a_xx + robust.a_yy);
    const float half =
        std::sqrt(std::max(0.0f, 0.25f * (robust.a_xx - robust.a_yy) * (robust.a_xx - robust.a_yy) +
                                     robust.a_xy * robust.a_xy));
    // Half of the angle whose cosine is (a_xx - a_yy) / (2 half).
    const float cosine2 =
        half > 0.0f ? std::clamp(0.5f * (robust.a_xx - robust.a_yy) / half, -1.0f, 1.0f) : 1.0f;
    const std::array<float, 2> axis{std::sqrt(0.5f + 0.5f * cosine2),
                                    std::copysign(std::sqrt(0.5f - 0.5f * cosine2), robust.a_xy)};
    const float wide = std::clamp(mean + half, kMinAlpha2, 1.0f);
    const float slim = std::clamp(mean - half, kMinAlpha2, 1.0f);
    std::pair<EllipticLobe, float> best{{}, 3.0f};
    const float mine = portable_log(from.alpha2);
    const float lean = 0.35f * std::sqrt(from.alpha2);
    const std::array<std::pair<Direction, std::array<float, 5>>, 2> starts{{
        {robust.normal, {0.0f, 0.0f, portable_log(wide), portable_log(slim), 0.0f}},
        {from.normal, {0.0f, 0.0f, mine + 0.3f, mine - 0.3f, 0.0f}},
    }};
    for (const auto& [normal, start] : starts) {
        const Frame frame = frame_about(normal);
        const auto f = [&](const std::array<float, 5>& x) {
            const EllipticLobe e = elliptic_lobe(frame, axis, x);
            return e.nz < 0.05f ? 2.0f : cost(e);
        };
        const auto [x, value] =
            simplex<5>(start, f(start), {lean, lean, 0.4f, -0.4f, 0.3f}, budget, 2e-4f, f);
        if (value < best.second) best = {elliptic_lobe(frame, axis, x), value};
    }
    return best;
}

}  // namespace petrichor::texproc::detail
