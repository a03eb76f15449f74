#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_CHAIN_FIT_H

#include <functional>

#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// Fits normals and roughness of a chain, texel by texel, to what pixels should show: the filter of
/// an engine and one shading a pixel against the mean light of what the pixel covers, in thousands
/// of views drawn from a seed (every direction and height of the eye, low ones more often where two
/// lobes are fitted to anything but metal; sizes between the levels, one tap and up to 16; eight lights
/// each: suns ahead, beside and behind, a window, metal under the sun; of metal, 16 views about one
/// direction are a picture with one exposure). Each pixel is seen twice, from places less than a pixel
/// apart, and what changes between them counts once more: it flickers.
///
/// Levels of more than 256 x 256 texels stay, as those below 8 texels do; so does the share of the
/// base colour of paint, with which the pictures are taken, where there is one lobe, or it is not written
/// (PrefilterOptions::base_colors). Else it is fitted too: a wide second lobe is a haze on what is diffuse.
///
///   plain  plain_levels() of the maps
///   chain  its normals and roughness are changed, and what else is said above
///   bold   of metal, called when the chain holds what is best in the mean, where some pictures may
///          be worse than those of plain mips; then the chain gets what is fitted on from there with
///          those counted more. Anything else is fitted once, and this is not called.
/// Whether there was anything to fit. Same numbers at any thread count.
bool fit_chain(const Levels& plain, const PrefilterOptions& options, Prefiltered& chain,
               const std::function<void()>& bold = {});

/// Whether a level of this size is fitted.
bool is_fitted(int width, int height);

}  // namespace petrichor::texproc::detail

#endif
