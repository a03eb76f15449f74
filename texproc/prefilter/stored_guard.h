#ifndef PETRICHOR_TEXPROC_PREFILTER_STORED_GUARD_H
#define PETRICHOR_TEXPROC_PREFILTER_STORED_GUARD_H

#include <vector>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc {

// The rule picture is chosen on floats. Blocks and codes add an error of their own, which on nearly
// flat maps is larger than what the filter gains: so what is stored is looked at once more.

/// Small pictures of the reference cases: what builds report and guard with. Of paint, its four; of
/// metal, the same lights on metal.
PictureOptions build_pictures(int threads, SurfaceClass surface = SurfaceClass::Both);

/// Mean of the cases.
PictureScore mean_score(const std::vector<PictureScore>& scores);

/// Which levels are better plain, as files hold them.
struct StoredGuard {
    std::vector<char> plain;          ///< by level of the chain; empty: none
    bool darken = true;               ///< the base colour may carry what the normals lose
    PictureScore plain_score, score;  ///< of the plain mips and of what was chosen, both as stored
};

/// Replaces levels of the roughness by those of the plain mips in the same files, those that cost
/// most first, until mean RMSE and mean flicker are no larger than those of plain mips. At the last
/// nothing is left of the chain, so this always holds.
///
///   ours   the chain as a reader gets it: normals (empty: the mean ones), roughness, base shares
///   plain  roughness of the plain mips as a reader gets it
StoredGuard guard_stored(const PictureBench& bench, const Prefiltered& ours,
                         const std::vector<Image>& plain);

}  // namespace petrichor::texproc

#endif
