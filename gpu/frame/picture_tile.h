#ifndef PETRICHOR_GPU_FRAME_PICTURE_TILE_H
#define PETRICHOR_GPU_FRAME_PICTURE_TILE_H

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// A window of a picture, in its pixels; it may reach past the picture's edges.
struct PictureTile {
    int x = 0, y = 0;
    int width = 0, height = 0;
};

/// Windows begin at multiples of it: blocks of pixels that share light, occlusion or glow are then those of the picture.
inline constexpr int kTileStep = 32;

/// The camera that sees what `camera` sees in that window of its picture of width x height: the same eye and way, another
/// field of view and shift.
Camera tile_camera(const Camera& camera, int width, int height, const PictureTile& tile);

/// The frame that is rendered for the window. What a picture decides as a whole (cascades of shadows, levels of detail,
/// what falls, which lamps throw shadows) is still to be taken from `whole`.
Frame tile_frame(const Frame& whole, const PictureTile& tile);

}  // namespace petrichor::gpu

#endif
