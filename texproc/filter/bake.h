#ifndef PETRICHOR_TEXPROC_FILTER_BAKE_H
#define PETRICHOR_TEXPROC_FILTER_BAKE_H

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {

// Masks from a height map (first channel, 0..1, white is high). All results are one
// channel in 0..1 unless said otherwise; same bytes at any thread count.

struct BakeOptions {
    float depth = 0.05f;  ///< height 1 in units of the width of the map
    float reach = 0.05f;  ///< how far occlusion and hollows look, in units of the width
    int threads = 0;
    Edge edge_u = Edge::Wrap;  ///< what lies past the left and right edge
    Edge edge_v = Edge::Wrap;  ///< above and below
};

/// Share of the sky that a texel sees, cosine-weighted: the horizon in 16 directions.
Image ambient_occlusion(const Image& height, const BakeOptions& options = {});
/// 0.5 flat, darker in hollows, brighter on ridges, against the mean within `reach`.
Image cavity(const Image& height, const BakeOptions& options = {});
/// 0.5 flat, darker where the surface is concave, brighter where it is convex: edges of three
/// widths, the finest of a texel (of two, three, ... in maps of 2048, 3072, ...).
Image curvature(const Image& height, const BakeOptions& options = {});

/// Depth of standing water that the hollows narrower than twice `reach` can hold: the closing of
/// the height by an octagon, less the height, relative to the deepest (that 0.5 % of the wet texels
/// exceed).
struct Hollows {
    Image depth;        ///< 0 where no water stands, 1 at the deepest
    float deepest = 0;  ///< in units of the height map
    /// Share of the map under water when the water stands at k / 64 of the deepest below its brim:
    /// 65 values, falling from the brim (k = 0).
    std::vector<float> covered;
};
Hollows puddles(const Image& height, const BakeOptions& options = {});
/// The same for narrow hollows (a fifth of `reach`): joints and cracks.
Hollows cracks(const Image& height, const BakeOptions& options = {});

/// R G = 0.5 + 0.5 the direction (u, v) in which water runs, B = slope, 1 at 45 degrees. 3
/// channels.
Image flow_direction(const Image& height, const BakeOptions& options = {});

/// How much water the material drinks, from perceptual roughness (docs/lux.md, 9): sat((p - 0.5) /
/// 0.4), 0 where metallic is 1. metallic may be empty. Throws Error when the sizes differ.
Image porosity(const Image& roughness, const Image& metallic = {});

// The textures that the weather passes sample (docs/lux.md, 6 and 7), tileable, from a seed.

/// 4 channels: envelope of a drop, direction away from its centre (2), its time offset.
Image ripple_drops(int size, std::uint32_t seed);
/// 4 channels: 0, detail normal y, mask, detail normal x. The mask has mean 0.715 and its 5 % and
/// 95 % quantiles at 0.51 and 0.85.
Image snow_mask(int size, std::uint32_t seed);
/// 4 channels: 0, normal y, snow smoothness, normal x.
Image snow_water_bump(int size, std::uint32_t seed);
/// 3 channels, linear: diffuse light of skin by 0.5 + 0.5 n.l (to the right) and curvature 0..1
/// (downwards). Curvature 1 is a radius of 1.6 mm; at 0 it is max(0, n.l).
Image skin_ring(int size);

}  // namespace petrichor::texproc

#endif
