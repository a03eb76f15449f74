#ifndef PETRICHOR_TEXPROC_STUDY_DETAIL_CODES_ORACLE_H
#define PETRICHOR_TEXPROC_STUDY_DETAIL_CODES_ORACLE_H

#include <array>
#include <vector>

#include "texproc/prefilter/detail/codes.h"
#include "texproc/study/detail/yardstick.h"

namespace petrichor::texproc::detail {

/// The least errors that files of integers can have on these points.
struct CodeErrors {
    double any = 2.0;   ///< of normals of any length
    double kept = 2.0;  ///< of normals as long as rules write them (kShortestNormal)
};

/// Looks at every code of x, y and z whose direction is within two and a half steps of a code from
/// one of `about`, each with three roughness codes, and at the best of them with every roughness
/// code near the best one. For judging rules, not for filtering.
///
///   narrowest   the smallest alpha worth a try
///   light2      added to alpha^2 on reading
CodeErrors best_codes(Samples& samples, const std::array<double, kViews>& mass,
                      const std::vector<EllipticLobe>& about, double narrowest, float light2,
                      const StoredAs& as);

}  // namespace petrichor::texproc::detail

#endif
