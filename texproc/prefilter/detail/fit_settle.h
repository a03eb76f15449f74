#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_SETTLE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_SETTLE_H

#include <array>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/picture.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// What a fit changes of a level: roughness, normal, share of metal's base colour, of the second lobe
/// normal, roughness and share, and the share of paint's base colour. Empty: the chain has none, or the level
/// is not fitted.
using FitParts = std::array<Image, 7>;
using FitLevels = std::vector<FitParts>;

/// A chain before it is fitted, and fits of it to choose from.
struct Fits {
    FitLevels before;
    std::vector<FitLevels> after;
};

/// Keeps of the fits, level by level, what pictures like best: which fit, how much of it and of metal's
/// share. The pictures of `bench` are to be near to the truth in the mean, and none of them farther from it
/// than with plain mips, as far as that can be had. Two lobes on anything but metal are guarded: those of
/// guard_pictures() are to be no farther from it either, and how dark the base colour is, how much of the
/// second lobe's share is kept and how far what was before goes back to plain mips are chosen with them.
///
///   chain  as it was before the fits, with parts of the right sizes; changed to what is kept
void keep_of_fits(const PictureBench& bench, const Fits& fits, const PrefilterOptions& options,
                  Prefiltered& chain);

/// Fits a chain (chain_fit.h), and keeps of it what pictures like best.
void settle_fit(const PictureBench& bench, const PrefilterOptions& options, Prefiltered& chain);

}  // namespace petrichor::texproc::detail

#endif
