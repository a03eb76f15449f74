#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_TWO_LOBE_START_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_TWO_LOBE_START_H

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "texproc/prefilter/detail/lit_floor.h"

namespace petrichor::texproc::detail {

/// What a fit of two lobes of a texel starts from: normals of unit length, perceptual roughness.
struct TwoLobeStart {
    glm::vec3 n[2];
    float p[2];
    float second;  ///< share of the second
};

/// Of all texels of a level: the two parts (lobe_split.h) of what lies under a pixel about them, or, where
/// one lobe shows it as well, that of the texel made narrower and wider. Of neighbours those lobes are
/// the first that are alike.
///
///   one  of each texel the lobe that is best alone: it says how much of the variance of normals is
///        roughness to the eye
///   Same numbers at any thread count.
std::vector<TwoLobeStart> start_two_lobes(const Levels& plain, std::size_t level, const std::vector<Texel>& one,
                                          const PrefilterOptions& options);

}  // namespace petrichor::texproc::detail

#endif
