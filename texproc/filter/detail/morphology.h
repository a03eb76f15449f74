#ifndef PETRICHOR_TEXPROC_FILTER_DETAIL_MORPHOLOGY_H
#define PETRICHOR_TEXPROC_FILTER_DETAIL_MORPHOLOGY_H

#include "base/image.h"

namespace petrichor::texproc::detail {

/// The largest (sign 1) or smallest (sign -1) value of a one-channel map that tiles, within an
/// octagon of the given radius in texels: a square of half of it widened by a diamond of the other
/// half. Costs the same for every radius.
Image extreme_within(const Image& map, int radius, float sign, int threads);

}  // namespace petrichor::texproc::detail

#endif
