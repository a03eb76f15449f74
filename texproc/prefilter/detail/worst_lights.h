#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_WORST_LIGHTS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_WORST_LIGHTS_H

#include <cstdint>

#include "texproc/prefilter/picture.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// The lights under which a chain loses most against plain mips, or gains least: suns some seven degrees apart over the
/// sky that held_out_pictures() draw from, and windows ahead, are looked at from kHeldOutViews of their views each, and
/// the worst come back with these views, one light after another, none near to another. Those that gain clearly in the
/// mean of their views are left out, so there may be none at all.
///
///   of_maps  holds the maps
///   floors   held_out_pictures(): views, threads
///   seed     where the suns stand; another one for every time
/// Same pictures at any thread count.
PictureOptions worst_lights(const PictureBench& of_maps, const PictureOptions& floors, const PrefilterOptions& options,
                            const Prefiltered& chain, std::uint32_t seed);

}  // namespace petrichor::texproc::detail

#endif
