#ifndef PETRICHOR_TEXPROC_STUDY_FRESH_MAPS_H
#define PETRICHOR_TEXPROC_STUDY_FRESH_MAPS_H

#include <cstdint>
#include <vector>

#include "texproc/study/scored_maps.h"

namespace petrichor::texproc {

/// Materials that no rule was chosen on: fourteen surfaces whose sizes, slopes and glosses are
/// drawn from a seed, so that a new seed is a new set (scratched lacquer, rivets, gravel with
/// puddles, cloth, hammered metal, checkers of two glosses, ...). 16 bits; half of them are not
/// square, some of odd sizes. size: about how large, >= 32. The same seed, the same maps.
std::vector<ScoredMaps> fresh_maps(int size, std::uint32_t seed);

/// Patches of two materials in a checker, b repeated over the extent of a. patch: edge in texels.
ScoredMaps patchwork(const ScoredMaps& a, const ScoredMaps& b, int patch);

}  // namespace petrichor::texproc

#endif
