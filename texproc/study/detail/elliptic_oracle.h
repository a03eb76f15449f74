#ifndef PETRICHOR_TEXPROC_STUDY_DETAIL_ELLIPTIC_ORACLE_H
#define PETRICHOR_TEXPROC_STUDY_DETAIL_ELLIPTIC_ORACLE_H

#include <array>

#include "texproc/study/detail/yardstick.h"

namespace petrichor::texproc::detail {

/// The elliptic lobe of least error on these points: its normal (two numbers), both alphas and its
/// angle, searched all over: a lattice of lobes about the mean normal and about normals of the
/// footprint, then a simplex from each of the best that differ. Thousands of lobes a texel: for
/// judging rules, not for filtering.
///
///   narrowest   the smallest alpha worth a try
EllipticLobe best_elliptic(Samples& samples, const std::array<double, kViews>& mass,
                           const Cells& cells, const Direction& mean, double narrowest);

}  // namespace petrichor::texproc::detail

#endif
