#ifndef PETRICHOR_TEXPROC_FILTER_RESAMPLE_H
#define PETRICHOR_TEXPROC_FILTER_RESAMPLE_H

#include "base/image.h"

namespace petrichor::texproc {

/// An image in another size: a side that shrinks is the mean over exact areas, one that grows is
/// bilinear, and what lies past an edge is the edge. Values are taken as they are.
Image resized(const Image& image, int width, int height, int threads = 0);

}  // namespace petrichor::texproc

#endif
