#ifndef PETRICHOR_FILM_TILES_TILE_PLAN_H
#define PETRICHOR_FILM_TILES_TILE_PLAN_H

#include <cstdint>

#include "gpu/frame/picture_tile.h"

namespace petrichor::film {

/// Pictures of more pixels are rendered in tiles unless the scenario says otherwise.
inline constexpr std::int64_t kMostWhole = 16 << 20;
/// Pixels a side of a tile where nothing else is asked for.
inline constexpr int kUsualTile = 2048;

/// How a picture is cut. Every tile is rendered with what lies around it, which is then cut off: what is found on the screen
/// (occlusion, mirrors of the picture) is found there as far as the border reaches.
struct TilePlan {
    int width = 0, height = 0;  ///< of the picture
    int tile = 0;               ///< pixels a side that are kept
    int border = 0;             ///< around them
    int columns = 0, rows = 0;

    int count() const { return columns * rows; }
    /// Pixels that are rendered at a time, all windows alike.
    int window_width() const;
    int window_height() const;
};

/// Tiles of `asked` pixels a side; 0: of kUsualTile where the picture has more than kMostWhole pixels, else none. No tiles: one
/// that is the picture, without a border.
TilePlan plan_tiles(int width, int height, int asked);
bool is_tiled(int width, int height, int asked);

/// What is rendered for a tile and what of it is kept, both in the picture's pixels.
struct PlannedTile {
    gpu::PictureTile window, kept;
};
PlannedTile tile_at(const TilePlan& plan, int column, int row);

}  // namespace petrichor::film

#endif
