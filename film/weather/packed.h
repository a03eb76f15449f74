#ifndef PETRICHOR_FILM_WEATHER_PACKED_H
#define PETRICHOR_FILM_WEATHER_PACKED_H

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/interrupted.h"

namespace petrichor::film {

/// Where to read a grid of weather, when a file is one.
struct GridPlace {
    std::optional<double> latitude_deg, longitude_deg;
    bool nearest = false;  ///< not between the four points around the place
};

/// A text that was inside a packed file.
struct UnpackedText {
    std::string name;  ///< of the entry; empty when the file holds one thing
    std::string text;
};

/// Whether a file that begins so is one: gzip, zip, NetCDF, GRIB.
bool is_packed_weather(std::string_view head);

/// What packed files can be opened: "gzip, zip, NetCDF, GRIB".
std::string packed_kinds();

/// The texts in a packed weather file, read by the limited program petrichor-weather; a NetCDF or
/// GRIB file becomes plain CSV of one place. Of an archive with several files those that are
/// weather; the others are named in `left_out`.
///   throws  Error for a file that is damaged, too large when unpacked (256 MiB of text), or holds
///           no weather; Interrupted
std::vector<UnpackedText> unpack_weather(const std::filesystem::path& path, const GridPlace& place,
                                         std::vector<std::string>& left_out,
                                         const StopRequest& stop = {});

}  // namespace petrichor::film

#endif
