#ifndef PETRICHOR_CLI_TEXTURE_MAPS_FILES_H
#define PETRICHOR_CLI_TEXTURE_MAPS_FILES_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "texproc/codecs/files/io.h"

namespace petrichor::cli {

/// "wall.png" or "wall.png:g": a file and, after the last colon, one channel (r g b a or 0..9).
struct MapFile {
    std::filesystem::path path;
    int channel = -1;  ///< -1: not chosen
};
MapFile parse_map_file(const std::string& text);

/// Reads a map in its own numbers; a chosen channel comes alone.
texproc::RawImage read_map(const std::string& text, const texproc::ReadOptions& options);

/// Reads several maps, two at a time: a reading process costs a fifth of a second to start, so more
/// of them would cost more than they bring. `threads` 1: one after the other.
std::vector<texproc::RawImage> read_maps(const std::vector<std::string>& texts,
                                         const texproc::ReadOptions& options, int threads = 0);

/// "out_%d.png" with the number of a level in the place of %d (%03d pads with zeros). Throws Error
/// when the pattern holds no %d or something else after a %.
std::string level_name(const std::string& pattern, int level);

}  // namespace petrichor::cli

#endif
