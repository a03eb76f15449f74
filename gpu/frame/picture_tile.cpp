#include "gpu/frame/picture_tile.h"

#include <cmath>

namespace petrichor::gpu {

Camera tile_camera(const Camera& camera, int width, int height, const PictureTile& tile)
{
    const auto w = static_cast<double>(width), h = static_cast<double>(height);
    const auto tile_w = static_cast<double>(tile.width), tile_h = static_cast<double>(tile.height);
    Camera part = camera;
    const double share = tile_h / h;
    part.orthographic_height_m = static_cast<float>(static_cast<double>(camera.orthographic_height_m) * share);
    part.vertical_fov_rad = static_cast<float>(
        2.0 * std::atan(std::tan(0.5 * static_cast<double>(camera.vertical_fov_rad)) * share));
    // From the axis to the middles of picture and window, in halves of a pixel.
    part.shift.x = static_cast<float>((static_cast<double>(camera.shift.x) * w + 2.0 * tile.x + tile_w - w) / tile_w);
    part.shift.y = static_cast<float>((static_cast<double>(camera.shift.y) * h - 2.0 * tile.y - tile_h + h) / tile_h);
    return part;
}

Frame tile_frame(const Frame& whole, const PictureTile& tile)
{
    const int width = whole.settings.width, height = whole.settings.height;
    Frame part = whole;
    part.camera = tile_camera(whole.camera, width, height, tile);
    for (ShutterMoment& moment : part.shutter) moment.camera = tile_camera(moment.camera, width, height, tile);
    part.settings.width = tile.width;
    part.settings.height = tile.height;
    return part;
}

}  // namespace petrichor::gpu
