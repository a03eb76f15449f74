#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_CELLS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_CELLS_H

#include <vector>

#include "texproc/filter/area.h"
#include "texproc/prefilter/detail/lobe_kernel.h"
#include "texproc/prefilter/detail/map_surface.h"

namespace petrichor::texproc::detail {

/// What a footprint holds, as weighted lobes: each a texel of level 0 or several that are alike.
struct Cells {
    std::vector<float> nx, ny, nz;  ///< unit normals
    std::vector<float> alpha2;
    std::vector<float> weight;

    int count() const { return static_cast<int>(nx.size()); }
    void clear();
    void resize(std::size_t count);
    void add(float x, float y, float z, float a2, float w);
    CellsView view() const
    {
        return {nx.data(), ny.data(), nz.data(), alpha2.data(), weight.data(), count()};
    }
};

/// The exact means of a footprint.
struct Means {
    float nx = 0, ny = 0, nz = 0;  ///< mean of the unit normals: shorter than 1 where they differ
    float p = 0;                   ///< perceptual roughness: the plain mip
    float alpha2 = 0;
    float vx = 0, vy = 0, vz = 0;  ///< normals shortened by their own lobe (vMF)
};

/// The texels of a footprint with their exact area weights, which sum to 1. `rows` holds the
/// decoded rows from y.first on.
void gather(const std::vector<SurfaceRow>& rows, std::size_t first_row, const Footprint& x,
            const Footprint& y, Cells& cells, Means& means);

/// Joins cells that share a place in a grid of (n_x, n_y, p) until at most `limit` are left; its
/// edge is a growing share, from 0.2 (0.3 in large steps), of the alpha that lies there (at least
/// 0.001), and 0.02 in p. Weight is conserved, and what normals differ within a cell is added to
/// its alpha^2. Narrow lobes that lie apart, which that would blur into what they are not, are left
/// apart up to `most`; 0: none, and in larger steps, which are sooner done and lose a little more.
void merge(Cells& cells, int limit, int most = 0);

/// The mean resultant length of a lobe of this width (coth l - 1 / l, l = 2 / alpha^2).
float lobe_length(float alpha2);

}  // namespace petrichor::texproc::detail

#endif
