#include "cli/simulate/terrain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.h"
#include "base/image.h"
#include "cli/rooms.h"
#include "film/weather/inputs.h"
#include "texproc/codecs/files/io.h"
#include "weather/forcing/forcing.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

constexpr std::size_t kMostSide = 16384;

// "800:2400", low below high.
std::pair<double, double> range_from(const std::string& text)
{
    const std::size_t colon = text.find(':');
    const auto low = weather::to_number(text.substr(0, colon));
    const auto high =
        colon == text.npos ? std::nullopt : weather::to_number(text.substr(colon + 1));
    if (!low || !high || !(*low < *high) || *low < -500.0 || *high > 9000.0) {
        throw Error("--grid-height-m must be two heights like 800:2400, got \"" + text + "\"",
                    "Give the heights of black and white in metres.");
    }
    return {*low, *high};
}

Terrain terrain_from_image(const TerrainOptions& options)
{
    const texproc::RawImage raw = texproc::read_raw(options.file);
    const bool whole = raw.type == texproc::PixelType::U8 || raw.type == texproc::PixelType::U16;
    if (!options.cell_size_m)
        throw Error("grid: an image does not say how large its texels are", "Give --cell-size-m.");
    if (whole && options.height_range_m.empty()) {
        throw Error("grid: " + options.file + " holds grey levels, not metres",
                    "Give --grid-height-m LOW:HIGH, the heights of black and white.");
    }
    const Image image = texproc::to_image(raw, ColorSpace::Data);
    const auto [low, high] =
        options.height_range_m.empty() ? std::pair{0.0, 1.0} : range_from(options.height_range_m);
    Terrain terrain;
    terrain.width = static_cast<std::size_t>(image.width);
    terrain.height = static_cast<std::size_t>(image.height);
    terrain.spacing_m = *options.cell_size_m;
    terrain.heights_m.resize(terrain.cells());
    terrain.inside.assign(terrain.cells(), true);
    for (std::size_t i = 0; i < terrain.cells(); ++i) {
        const double v =
            static_cast<double>(image.pixels[i * static_cast<std::size_t>(image.channels)]);
        terrain.heights_m[i] = static_cast<float>(low + (high - low) * v);
        // GeoTIFFs mark holes with numbers that no ground has.
        terrain.inside[i] =
            std::isfinite(v) && terrain.heights_m[i] > -1000.0f && terrain.heights_m[i] < 10000.0f;
    }
    return terrain;
}

// Mean of the valid heights in each cell of a coarser grid.
Terrain averaged(const Terrain& fine, std::size_t longest)
{
    const std::size_t side = std::max(fine.width, fine.height);
    if (side <= longest) return fine;
    const double factor = static_cast<double>(side) / static_cast<double>(longest);
    const auto coarse_side = [&](std::size_t n) {
        return std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround(static_cast<double>(n) / factor)));
    };
    Terrain out;
    out.width = coarse_side(fine.width);
    out.height = coarse_side(fine.height);
    out.spacing_m =
        fine.spacing_m * static_cast<double>(fine.width) / static_cast<double>(out.width);
    std::vector<double> sums(out.cells(), 0.0);
    std::vector<std::size_t> counts(out.cells(), 0);
    for (std::size_t y = 0; y < fine.height; ++y) {
        for (std::size_t x = 0; x < fine.width; ++x) {
            if (!fine.inside[y * fine.width + x]) continue;
            const std::size_t to =
                y * out.height / fine.height * out.width + x * out.width / fine.width;
            sums[to] += static_cast<double>(fine.heights_m[y * fine.width + x]);
            ++counts[to];
        }
    }
    for (std::size_t i = 0; i < out.cells(); ++i) {
        out.inside.push_back(counts[i] > 0);
        out.heights_m.push_back(
            counts[i] > 0 ? static_cast<float>(sums[i] / static_cast<double>(counts[i])) : 0.0f);
    }
    return out;
}

// Holes get the lowest height, so that they cast no shadow.
std::pair<float, float> close_holes(Terrain& terrain, const std::string& file)
{
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (std::size_t i = 0; i < terrain.cells(); ++i) {
        if (!terrain.inside[i]) continue;
        low = std::min(low, terrain.heights_m[i]);
        high = std::max(high, terrain.heights_m[i]);
    }
    if (low > high)
        throw Error("grid: " + file + " has no heights, only holes",
                    "Give a terrain with heights.");
    for (std::size_t i = 0; i < terrain.cells(); ++i) {
        if (!terrain.inside[i]) terrain.heights_m[i] = low;
    }
    return {low, high};
}

std::vector<std::string> names_in(const std::string& list)
{
    std::vector<std::string> names;
    for (const auto part : weather::split(list, ',')) {
        const auto name = weather::trimmed(part);
        if (!name.empty()) names.emplace_back(name);
    }
    return names;
}

void add_surfaces(Terrain& terrain, const TerrainOptions& options,
                  const std::string& default_surface)
{
    terrain.surface.assign(terrain.cells(), 0);
    terrain.surfaces = names_in(options.surfaces);
    if (options.mask.empty()) {
        if (terrain.surfaces.size() > 1)
            throw Error("grid: --surfaces names several surfaces, but there is no mask",
                        "Give --surface-mask FILE.");
        if (terrain.surfaces.empty()) terrain.surfaces = {default_surface};
        return;
    }
    if (terrain.surfaces.size() < 2)
        throw Error("grid: --surface-mask needs the names of its surfaces",
                    "Give --surfaces grass,rock: black is the first, white the last.");
    const Image mask = texproc::read_image(options.mask);
    for (std::size_t y = 0; y < terrain.height; ++y) {
        for (std::size_t x = 0; x < terrain.width; ++x) {
            const auto at = [](std::size_t i, std::size_t n, int size) {
                return static_cast<int>((2 * i + 1) * static_cast<std::size_t>(size) / (2 * n));
            };
            const double v = static_cast<double>(
                mask.at(at(x, terrain.width, mask.width), at(y, terrain.height, mask.height), 0));
            const double last = static_cast<double>(terrain.surfaces.size() - 1);
            terrain.surface[y * terrain.width + x] =
                static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * last));
        }
    }
}

}  // namespace

Terrain parse_ascii_grid(std::string_view text, const std::string& file)
{
    Terrain terrain;
    double nodata = -9999.0, columns = 0.0, rows = 0.0;
    weather::Lines lines(text);
    std::size_t cell = 0;
    const auto refuse = [&](const std::string& what) {
        throw Error("grid: " + file + " line " + std::to_string(lines.number()) + ": " + what,
                    "Give an ESRI ASCII grid: ncols, nrows, xllcorner, yllcorner, cellsize, "
                    "NODATA_value, then the rows from the north.");
    };
    while (const auto line = lines.next()) {
        const auto words = weather::words(*line, kMostSide + 1);
        if (words.empty()) continue;
        const auto first = weather::to_number(words[0]);
        if (!first) {
            const double value = words.size() == 2
                                     ? weather::to_number(words[1]).value_or(weather::kMissing)
                                     : weather::kMissing;
            const std::string key = weather::lower(words[0]);
            if (std::isnan(value) || cell > 0)
                refuse("'" + weather::shown(*line) +
                       "' is neither a header line nor a row of heights");
            if (key == "ncols")
                columns = value;
            else if (key == "nrows")
                rows = value;
            else if (key == "cellsize" || key == "dx")
                terrain.spacing_m = value;
            else if (key == "nodata_value")
                nodata = value;
            else if (key != "xllcorner" && key != "yllcorner" && key != "xllcenter" &&
                     key != "yllcenter" && key != "dy")
                refuse("the header has no key '" + weather::shown(words[0]) + "'");
            continue;
        }
        if (terrain.heights_m.empty()) {
            const auto side = [](double n) {
                return n >= 1.0 && n <= static_cast<double>(kMostSide) && n == std::floor(n);
            };
            if (!side(columns) || !side(rows) || !(terrain.spacing_m > 0.0))
                refuse("ncols, nrows (1..16384) and cellsize must come before the heights");
            terrain.width = static_cast<std::size_t>(columns);
            terrain.height = static_cast<std::size_t>(rows);
            // No more memory than the text can fill: two characters a height at least.
            if (terrain.cells() > text.size())
                refuse("the file is too short for " + std::to_string(terrain.width) + " x " +
                       std::to_string(terrain.height) + " heights");
            terrain.heights_m.resize(terrain.cells());
            terrain.inside.resize(terrain.cells());
        }
        for (const auto word : words) {
            const auto value = weather::to_number(word);
            if (!value) refuse("'" + weather::shown(word) + "' is not a height");
            if (cell == terrain.cells()) refuse("there are more heights than ncols x nrows");
            terrain.heights_m[cell] = static_cast<float>(*value);
            terrain.inside[cell++] = *value != nodata && *value > -1000.0 && *value < 10000.0;
        }
    }
    if (cell == 0 || cell != terrain.cells()) {
        refuse("the file ends after " + std::to_string(cell) + " of " +
               std::to_string(terrain.cells()) + " heights");
    }
    return terrain;
}

Terrain read_terrain(const TerrainOptions& options, const std::string& default_surface)
{
    if (options.longest_side < 2 || options.longest_side > 1024) {
        throw Error(
            "grid: --grid-size must be 2..1024 cells, got " + std::to_string(options.longest_side),
            "Give a size in range; 128 is usual.");
    }
    if (options.cell_size_m && !(*options.cell_size_m > 0.0 && *options.cell_size_m <= 1e5)) {
        throw Error("grid: --cell-size-m must be above 0 and at most 100000",
                    "Give the width of a texel in metres.");
    }
    const std::string kind =
        weather::lower(std::filesystem::path(options.file).extension().string());
    Terrain fine = kind == ".asc" || kind == ".txt"
                       ? parse_ascii_grid(read_input_file(options.file), options.file)
                       : terrain_from_image(options);
    if (options.cell_size_m) {
        fine.spacing_m = *options.cell_size_m;
    } else if (fine.spacing_m < 0.05) {
        throw Error("grid: the cells of " + options.file + " are " +
                        std::to_string(fine.spacing_m) + " wide: these are degrees, not metres",
                    "Project the terrain, or give --cell-size-m.");
    }
    Terrain terrain = averaged(fine, static_cast<std::size_t>(options.longest_side));
    const auto [low, high] = close_holes(terrain, options.file);
    add_surfaces(terrain, options, default_surface);
    char note[200];
    std::snprintf(note, sizeof note,
                  "terrain %zu x %zu, averaged to %zu x %zu cells of %.4g m, %.0f to %.0f m high",
                  fine.width, fine.height, terrain.width, terrain.height, terrain.spacing_m,
                  static_cast<double>(low), static_cast<double>(high));
    terrain.note = note;
    return terrain;
}

}  // namespace petrichor::cli
