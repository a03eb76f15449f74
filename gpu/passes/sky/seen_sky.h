#ifndef PETRICHOR_GPU_PASSES_SKY_SEEN_SKY_H
#define PETRICHOR_GPU_PASSES_SKY_SEEN_SKY_H

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/frame/frame_io.h"

namespace petrichor::gpu {

/// Side of the sky's cube map, texels, and of the tiles of it that are drawn.
inline constexpr int kSkyCubeSide = 384;
inline constexpr int kSkyTile = 8;
inline constexpr int kSkyTilesAcross = kSkyCubeSide / kSkyTile;

/// A tile by its number: face, row and place in it.
constexpr std::uint32_t sky_tile(int face, int row, int at)
{
    return static_cast<std::uint32_t>(face) << 16 | static_cast<std::uint32_t>(row) << 8 |
           static_cast<std::uint32_t>(at);
}

/// The tiles with every texel that the background of a picture reads, at the edges of pixels too: those that a
/// view sees, and with `horizon` those at the horizon on the sides that it sees. Some more than that; all of them for
/// parallel rays.
///
///   views   the cameras of all samples; only their rays count
std::vector<std::uint32_t> seen_sky(std::span<const shared::FrameConstants> views, bool horizon);

}  // namespace petrichor::gpu

#endif
