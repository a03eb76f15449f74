#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_PARTS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_PARTS_H

#include <array>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// What a fit changes of a level: roughness, normal, share of metal's base colour, of the second lobe
/// normal, roughness and share, and the share of paint's base colour. Empty: the chain has none, or the level
/// is not fitted.
using FitParts = std::array<Image, 7>;
using FitLevels = std::vector<FitParts>;
enum FitPart : std::size_t { kRoughness, kNormal, kMetalShare, kSecondNormal, kSecondRoughness, kSecondShare, kBaseShare };

/// The same as levels of a chain.
std::array<std::vector<Image>*, 7> parts_of(Prefiltered& chain);

/// A copy of the levels of a chain that are fitted.
FitLevels fitted_levels(Prefiltered& chain);

/// A level between two: 0 the first, 1 the second. Normals are made unit length again.
void mix(const Image& from, const Image& to, float share, Image& mixed);

}  // namespace petrichor::texproc::detail

#endif
