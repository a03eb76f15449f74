#ifndef PETRICHOR_TEXPROC_FILTER_AREA_H
#define PETRICHOR_TEXPROC_FILTER_AREA_H

#include <cstdint>
#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

struct LevelSize {
    int width = 0, height = 0;
    bool operator==(const LevelSize&) const = default;
};

/// Sizes of a whole chain: level 0 first, each next level floor(half), at least 1, down to 1 x 1.
std::vector<LevelSize> level_sizes(int width, int height);

/// The part of one axis of the base that a texel of a smaller level covers: base texels first ..
/// first + weights.size() - 1; the weights sum to 1.
struct Footprint {
    int first = 0;
    std::vector<float> weights;
};

/// The exact footprints of all `count` texels of a level over `base` texels, base >= count.
std::vector<Footprint> footprints(int base, int count);

/// The mean of every channel over the exact area of each texel of a smaller grid; at most the size
/// of `image`. Values are taken as they are. Same bytes at any thread count (0: all cores).
Image area_reduced(const Image& image, int width, int height, int threads = 0);

/// All levels from 1 on, every one exactly over the texels of level 0: from the last level whose
/// texels it covers whole, which makes powers of two cost 4/3 N.
std::vector<Image> area_levels(const Image& image, int threads = 0);

}  // namespace petrichor::texproc

#endif
