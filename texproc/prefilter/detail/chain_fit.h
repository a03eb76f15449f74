#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_H

#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// Fits normals and roughness of a chain, texel by texel, to what pixels should show: the filter of
/// an engine and one shading a pixel against the mean light of what the pixel covers, in thousands
/// of views drawn from a seed (every direction and height of the eye, sizes between the levels, one
/// tap and up to 16; eight lights each: suns ahead, beside and behind, a window, metal under the
/// sun). Each pixel is seen twice, from places less than a pixel apart, and what changes between
/// them counts once more: it flickers.
///
/// Levels of more than 256 x 256 texels stay, as those below 8 texels do; so does the share of the
/// base colour, with which the pictures are taken.
///
///   plain  plain_levels() of the maps
///   chain  its normals and roughness are changed
/// Same numbers at any thread count.
void fit_chain(const Levels& plain, const PrefilterOptions& options, Prefiltered& chain);

/// Whether a level of this size is fitted.
bool is_fitted(int width, int height);

}  // namespace petrichor::texproc::detail

#endif
