#ifndef PETRICHOR_TEXPROC_DETAIL_ELLIPTIC_FIT_H
#define PETRICHOR_TEXPROC_DETAIL_ELLIPTIC_FIT_H

#include <utility>

#include "texproc/prefilter/detail/lobe_cost.h"

namespace petrichor::texproc::detail {

/// The elliptic lobe of least cost and its cost: five parameters, searched from the elliptic robust
/// fit and from the isotropic result, `budget` evaluations each.
std::pair<EllipticLobe, float> fit_elliptic(const LobeCost& cost, const Candidate& from,
                                            const RobustFit& robust, int budget);

}  // namespace petrichor::texproc::detail

#endif
