#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_MAP_SURFACE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_MAP_SURFACE_H

#include <cstddef>
#include <vector>

#include "texproc/image/raw_image.h"

namespace petrichor::texproc::detail {

/// One channel of an image, in the numbers of its file. Null data: not there.
struct MapPlane {
    const std::byte* data = nullptr;
    PixelType type = PixelType::F32;
    int channels = 1;
    int channel = 0;
};

/// Level 0 of a normal map and its roughness, decoded row by row so that a 4096 x 4096 pair costs
/// no more memory than its files.
struct MapSurface {
    int width = 0, height = 0;
    MapPlane x, y, z;  ///< 0..1 codes of the normal; without z it is rebuilt
    MapPlane rough;    ///< perceptual roughness, or smoothness
    bool smoothness = false;
    bool alpha = false;  ///< the map holds alpha (or 1 - alpha), not its root
    bool green_down = false;
};

/// Unit normals, +y up, perceptual roughness p and p^4 (at least kMinAlpha2), one array each.
struct SurfaceRow {
    std::vector<float> nx, ny, nz, p, alpha2;
};

/// Decodes texels 0..width-1 of row y. A zero normal becomes straight up.
void fetch(const MapSurface& surface, int y, SurfaceRow& row);

/// Texels first .. first + count - 1 of a plane, as stored (integers as 0..1).
void plane_values(const MapPlane& plane, std::size_t first, std::size_t count, float* to);

/// True when every value of the plane is a finite number.
bool all_finite(const MapPlane& plane, std::size_t texels);

}  // namespace petrichor::texproc::detail

#endif
