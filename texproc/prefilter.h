#ifndef PETRICHOR_TEXPROC_PREFILTER_H
#define PETRICHOR_TEXPROC_PREFILTER_H

#include <string>
#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

struct PrefilterOptions {
    std::string rule = "moments";  ///< "moments" (alpha squared, correct), "lux" (compatible), ...
    bool wrap_u = true;            ///< tileable along u
    bool wrap_v = true;
    bool smoothness = false;  ///< the second map holds smoothness instead of perceptual roughness
    int threads = 0;          ///< 0: all cores
};

/// The names that PrefilterOptions::rule accepts.
const std::vector<std::string>& prefilter_rules();

/// Mip chains that agree: level k of normal and of roughness belong together.
struct Prefiltered {
    std::vector<Image> normal;     ///< 3 channels, unit length, encoded 0.5 + 0.5 n, +y up
    std::vector<Image> roughness;  ///< 1 channel, same meaning as the input
};

/// Builds both chains down to 1 x 1 so that what minification takes from the normals is added to the
/// roughness. normal: 3 channels encoded 0.5 + 0.5 n; roughness: 1 channel of the same size.
/// Throws Error when the sizes differ or a channel is missing. Same bytes at any thread count.
Prefiltered prefilter(const Image& normal, const Image& roughness,
                      const PrefilterOptions& options = {});

}  // namespace petrichor::texproc

#endif
