#ifndef PETRICHOR_TEXPROC_FILTER_PIXEL_LENGTH_H
#define PETRICHOR_TEXPROC_FILTER_PIXEL_LENGTH_H

#include "base/image.h"

namespace petrichor::texproc {

/// How long the mean of the normals is that a pixel blends: 1 channel, 0..1. A pixel takes its normal from
/// several texels (bilinear, and more than one sample where it is long), and makes the mean unit length
/// again: what slopes differ from texel to texel is lost there, as inside a texel. Of each texel and its
/// eight neighbours, 1 2 1 times 1 2 1: variance of a half along each axis, a quarter of bilinear reading,
/// a quarter of two samples.
///
/// Past an edge lie the texels this side of it, mirrored, so that maps that wrap, mirror and clamp are one.
///   normals  3 channels, 0.5 + 0.5 n, unit length
Image pixel_lengths(const Image& normals, int threads = 0);

}  // namespace petrichor::texproc

#endif
