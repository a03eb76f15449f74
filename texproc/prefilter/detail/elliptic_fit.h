#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_ELLIPTIC_FIT_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_ELLIPTIC_FIT_H

#include <array>
#include <utility>

#include "texproc/prefilter/detail/lobe_cost.h"

namespace petrichor::texproc::detail {

/// x: lean along both axes of the frame, log alpha^2 of both, and the turn from `axis` (cosine,
/// sine) about the normal.
EllipticLobe elliptic_lobe(const Frame& frame, const std::array<float, 2>& axis,
                           const std::array<float, 5>& x);

/// The elliptic lobe of least cost and its cost: five parameters, searched from the elliptic robust
/// fit and from the isotropic result, `budget` evaluations each.
std::pair<EllipticLobe, float> fit_elliptic(const LobeCost& cost, const Candidate& from,
                                            const RobustFit& robust, int budget);

}  // namespace petrichor::texproc::detail

#endif
