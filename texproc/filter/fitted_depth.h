#ifndef PETRICHOR_TEXPROC_FILTER_FITTED_DEPTH_H
#define PETRICHOR_TEXPROC_FILTER_FITTED_DEPTH_H

#include "base/image.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {

/// How deep a height map is by the normals of the same surface.
struct FittedDepth {
    float depth = 0.0f;      ///< height 1 in units of the width; <= 0: the two do not go together
    float agreement = 0.0f;  ///< correlation of the height with the one that the normals have
};

/// Integrates the normals (green up) and takes the depth with which the height map follows that
/// surface best in the mean square. Heights are compared, not slopes: the noise of a height map of
/// 8 bits is mostly slope. Throws Error when the sizes differ.
FittedDepth fitted_depth(const Image& height, const Image& normal, Edge edge_u = Edge::Wrap,
                         Edge edge_v = Edge::Wrap);

/// Pearson's correlation of the first channels of two images of one size; 0 where one is level.
double correlation(const Image& a, const Image& b);

}  // namespace petrichor::texproc

#endif
