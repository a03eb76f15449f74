#ifndef PETRICHOR_FILM_TILES_TILED_PICTURE_H
#define PETRICHOR_FILM_TILES_TILED_PICTURE_H

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/interrupted.h"
#include "film/color/display_transform.h"
#include "film/tiles/tile_plan.h"
#include "gpu/renderer.h"

namespace petrichor::film {

/// Where the files of a picture in tiles are made.
struct TiledFiles {
    std::filesystem::path folder;
    std::string exr, png;  ///< names; "": not asked for
    std::vector<std::pair<std::string, std::string>> metadata;
};

/// What is known of a picture in tiles once its files are there.
struct TiledPicture {
    std::string beauty_hash;  ///< as of a picture in one piece
    float exposure = 1.0f;
    gpu::FallingFacts falling;
    gpu::LightFacts light;
};

struct TiledOptions {
    const DisplayTransform* transform = nullptr;  ///< in place of the tone curves of our own
    int threads = 0;
    StopRequest stop = {};                        ///< asked between tiles; Interrupted is thrown then
    std::function<void(int tile)> tile_done = {};
};

/// Renders a frame in tiles, a row of them at a time in memory, and writes its files whole or not at all. The frame's exposure
/// is that of the whole picture.
TiledPicture render_tiled(gpu::Renderer& renderer, const gpu::Frame& frame, const TilePlan& plan, const TiledFiles& files,
                          const TiledOptions& options);

}  // namespace petrichor::film

#endif
