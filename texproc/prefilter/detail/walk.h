#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_WALK_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_WALK_H

#include <functional>

#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/map_surface.h"

namespace petrichor::texproc::detail {

/// What a rule sees of one mip texel. `cells` is null when the walk carries no cells.
struct MipTexel {
    int level, x, y;
    const Means& means;
    const Cells* cells;
};

/// WalkOptions::apart of rules that fit lobes.
inline constexpr int kApart = 4;

struct WalkOptions {
    bool cells = false;      ///< hand over the footprints
    bool own_lobes = false;  ///< fill Means::vx.. (vMF)
    /// So many times as long lists may be to keep narrow lobes apart; 0: coarser lists, soon
    /// merged, for rules that look at the spread alone.
    int apart = 0;
    std::function<bool(int level, int x, int y)> wanted{};  ///< visit only these; empty: all
    int threads = 0;
    std::function<void(double)> progress{};
};

/// Calls visit for every texel of levels 1.., rows in parallel. Levels 1 to 5 see every texel of
/// level 0; from there on the lists of cells are joined and merged, so that the whole is O(N). The
/// means are exact on every level.
void walk(const MapSurface& surface, const WalkOptions& options,
          const std::function<void(const MipTexel&)>& visit);

}  // namespace petrichor::texproc::detail

#endif
