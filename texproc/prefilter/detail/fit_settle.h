#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_SETTLE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_SETTLE_H

#include <vector>

#include "texproc/prefilter/detail/fit_parts.h"
#include "texproc/prefilter/picture.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

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

/// Fits a chain (chain_fit.h), keeps of it what pictures like best, and looks again at two lobes on anything but
/// metal (second_look.h).
void settle_fit(const PictureBench& bench, const PrefilterOptions& options, Prefiltered& chain);

}  // namespace petrichor::texproc::detail

#endif
