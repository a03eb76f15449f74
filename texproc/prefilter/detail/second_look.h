#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_SECOND_LOOK_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_SECOND_LOOK_H

#include <cstdint>

#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/picture.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// Weighs fitted levels once more, with pictures of whole floors that nothing was fitted to or chosen with
/// (held_out_pictures(), drawn from floors_seed()): of each level how far it goes back to plain mips, as a whole, in
/// its roughness or in either normal, how wide its lobes are, how much the second one counts, and how dark the base
/// colour is where it is written (PrefilterOptions::base_colors). All of these numbers move at once, downhill on forms
/// of the squared errors and of what moves, and stay where the pictures agree. The mean of the pictures is to be
/// small, and under no light the mean of its views worse than with plain mips, as far as that can be had: a price, no
/// promise (look_price()). Then the lights under which the chain is worst are sought, anew each time, and it goes on
/// with these (worst_lights(), worst_price()).
///
///   of_maps  holds the maps, and their plain mips
///   chain    its levels that are fitted are changed
/// Whether it changed something. Same numbers at any thread count.
bool look_again(const PictureBench& of_maps, const PrefilterOptions& options, Prefiltered& chain);

/// A seed of the material itself.
std::uint32_t floors_seed(const Levels& plain);

}  // namespace petrichor::texproc::detail

#endif
