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

/// Whether the first three channels differ, by a look at some thousand texels: more than JPEG makes them.
bool is_colored(const texproc::RawImage& image);
/// Says on stderr that red is taken for `role` where a coloured image was named without a channel.
void tell_red_taken(const std::string& text, const texproc::RawImage& image, const std::string& role);

/// Says on stderr where a quarter of the normals (0.5 + 0.5 n) or more point into the surface.
void tell_if_no_normals(const std::string& text, const texproc::RawImage& image);

/// Says on stderr how many numbers integers cut: those beyond 0..1, and those that are none.
void tell_cut_numbers(const Image& values);

/// "out_%d.png" with the number of a level in the place of %d (%03d pads with zeros). Throws Error
/// when the pattern holds no %d or something else after a %.
std::string level_name(const std::string& pattern, int level);

}  // namespace petrichor::cli

#endif
