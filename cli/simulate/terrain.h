#ifndef PETRICHOR_CLI_SIMULATE_TERRAIN_H
#define PETRICHOR_CLI_SIMULATE_TERRAIN_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace petrichor::cli {

struct TerrainOptions {
    std::string file;  ///< ESRI ASCII grid, or an image of heights; row 0 is the north
    std::optional<double>
        cell_size_m;             ///< of a texel; needed for images, replaces that of an ASCII grid
    std::string height_range_m;  ///< "800:2400": heights of black and white; needed for 8- and
                                 ///< 16-bit images
    std::string mask;  ///< optional image, same extent: black is the first surface, white the last
    std::string surfaces;    ///< "grass,rock": what the grey levels of the mask mean, evenly spread
    int longest_side = 128;  ///< larger terrains are averaged down to this many cells
};

/// Heights and surfaces of a landscape, row by row from the north, west to east.
struct Terrain {
    std::size_t width = 0, height = 0;
    double spacing_m = 0.0;
    std::vector<float> heights_m;  ///< finite everywhere; outside() cells hold the lowest height
    std::vector<bool> inside;      ///< false where the file has no height
    std::vector<std::uint32_t> surface;  ///< index into `surfaces`
    std::vector<std::string> surfaces;   ///< names of presets
    std::string note;                    ///< size, spacing and heights, for people

    std::size_t cells() const { return width * height; }
};

/// Reads a terrain and averages it down to the size asked for.
///   throws  Error for files that cannot be read, holes everywhere, sizes beyond 16384 or that do
///   not fit, degrees
///           instead of metres, and options that are missing
Terrain read_terrain(const TerrainOptions& options, const std::string& default_surface);

/// An ESRI ASCII grid: ncols, nrows, xllcorner/xllcenter, yllcorner/yllcenter, cellsize,
/// NODATA_value, then rows.
///   throws  Error with the line and what was expected
Terrain parse_ascii_grid(std::string_view text, const std::string& file);

}  // namespace petrichor::cli

#endif
