#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_SETTLE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_SETTLE_H

#include "texproc/prefilter/detail/map_surface.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// The last look of the rule picture: texels were fitted one by one, a pixel is a blend of many and
/// of two levels. Renders the material small (design_pictures()) and keeps that share of what was
/// fitted, from none to all, with which the pictures are nearest to the truth and none is farther
/// from it than with plain mips, where that can be had. Full quality then fits normals and roughness of small
/// levels to pixels (chain_fit.h), and keeps of it what pictures like best (fit_settle.h).
///
///   chain  its roughness and base_share are changed, its normals in full quality where options.joint says so
void settle_picture(const MapSurface& surface, const PrefilterOptions& options, Prefiltered& chain);

}  // namespace petrichor::texproc::detail

#endif
