#ifndef PETRICHOR_TEXPROC_MIPS_H
#define PETRICHOR_TEXPROC_MIPS_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

struct MipOptions {
    bool wrap_u = true;
    bool wrap_v = true;
    float alpha_cutoff = -1.0f;  ///< >= 0: keep the coverage of alpha > cutoff in every level
    bool normals = false;        ///< channels 0..2 hold 0.5 + 0.5 n: renormalise each level
};

/// Level 0 is the input; each next level is floor(half), at least 1, down to 1 x 1. A texel is the
/// mean over its exact area (fractional edge weights for odd sizes). Colour is filtered as it is:
/// linear light.
std::vector<Image> mip_chain(const Image& image, const MipOptions& options = {});

}  // namespace petrichor::texproc

#endif
