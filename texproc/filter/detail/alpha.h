// Colour that counts by its alpha.
#ifndef PETRICHOR_TEXPROC_FILTER_DETAIL_ALPHA_H
#define PETRICHOR_TEXPROC_FILTER_DETAIL_ALPHA_H

#include "base/image.h"

namespace petrichor::texproc::detail {

/// The channel that holds alpha: 1 of 2, 3 of 4 or more; -1: none.
int alpha_channel(int channels);

/// True when some texel is not fully opaque.
bool has_holes(const Image& image);

/// Colour times alpha; alpha stays.
Image premultiplied(const Image& image);

/// Turns a filtered premultiplied image back. `plain` is the same filtered without alpha: texels
/// without any alpha take the colour of the neighbours that have some (a bilinear tap reaches one
/// texel into a hole), and where there are none its colour.
Image straight(const Image& filtered, const Image& plain, bool wrap_u, bool wrap_v);

}  // namespace petrichor::texproc::detail

#endif
