#ifndef PETRICHOR_CLI_TEXTURE_FILES_H
#define PETRICHOR_CLI_TEXTURE_FILES_H

#include <cstdint>
#include <filesystem>
#include <string>

#include "texproc/files/io.h"

namespace petrichor::cli {

/// "wall.png" or "wall.png:g": a file and, after the last colon, one channel (r g b a or 0..9).
struct MapFile {
    std::filesystem::path path;
    int channel = -1;  ///< -1: not chosen
};
MapFile parse_map_file(const std::string& text);

/// Reads a map in its own numbers; a chosen channel comes alone.
texproc::RawImage read_map(const std::string& text, const texproc::ReadOptions& options);

/// "out_%d.png" with the number of a level in the place of %d (%03d pads with zeros). Throws Error
/// when the pattern holds no %d or something else after a %.
std::string level_name(const std::string& pattern, int level);

}  // namespace petrichor::cli

#endif
