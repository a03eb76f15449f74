#ifndef PETRICHOR_TEXPROC_FILTER_BUMP_SLOPES_H
#define PETRICHOR_TEXPROC_FILTER_BUMP_SLOPES_H

#include "base/image.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {

/// What film renderers turn into roughness as bumps get small, the channels of maketx --bumpslopes:
/// height h, dh/ds, dh/dt, their squares and their product, per texel, t down. The mean of the
/// squares less the square of the mean, on a level, is the variance of the slopes below it.
///
///   map  1 channel: heights, slopes by Sobel; 3: normals 0.5 + 0.5 n, +t down as stored, slopes
///        -n_x / n_z and -n_y / n_z (n_z at least 0.001), h is -1
///   u, v what lies past an edge of heights
/// Throws Error for other numbers of channels.
Image bump_slopes(const Image& map, Edge u, Edge v);

}  // namespace petrichor::texproc

#endif
