#ifndef PETRICHOR_FILM_WEATHER_INPUTS_H
#define PETRICHOR_FILM_WEATHER_INPUTS_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "film/weather/packed.h"

namespace petrichor::film {

enum class InputKind {
    Keys,     ///< CSV with time_s, temperature_c, rainfall
    Script,   ///< TOML with [weather]
    Weather,  ///< any weather file
};

/// One INPUT of `petrichor simulate`, in memory.
struct Input {
    std::string name;  ///< for titles: the file without folder and extension, the preset, "keys"
    std::string file;  ///< for messages
    InputKind kind = InputKind::Keys;
    std::string text;
};

/// Reads the inputs named on the command line: files, names of presets, - for standard input.
/// Packed files (gzip, zip, NetCDF, GRIB) are opened, an archive may hold several. The
/// kind is recognised from the content.
///   throws  Error for a missing or huge file, a name that is no preset (with the nearest), and for
///   kinds that do not
///           go together: several inputs must all be weather files
///   place    where to read a grid
///   notes    gets what was left out of archives; may be null
std::vector<Input> read_inputs(const std::vector<std::string>& words, const GridPlace& place = {},
                               std::vector<std::string>* notes = nullptr);

/// The kind of a text that is no TOML: keys name time_s and an input of the artist model in their
/// first line.
InputKind kind_of_text(std::string_view text);

/// The whole file, or of a binary one only the head, so that its reader refuses it without delay.
///   throws  Error when it cannot be read or has more than 256 MiB
std::string read_input_file(const std::filesystem::path& path);

/// The whole of a file that --checkpoint wrote, whatever its size.
///   throws  Error when it cannot be read
std::string read_checkpoint_file(const std::filesystem::path& path);

}  // namespace petrichor::film

#endif
