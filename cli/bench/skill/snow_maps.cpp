#include "cli/bench/skill/snow_maps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/input_file.h"
#include "cli/simulate/grid.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 64u << 20;
constexpr std::size_t kMostSide = 256;
constexpr double kSnow_m = 0.02;
constexpr double kOverpass_h = 10.5;  // by the sun

std::string text_of(const fs::path& file)
{
    return read_file(file, "bench:", kMostBytes);
}

bool is_map(const fs::path& file)
{
    return file.extension() == ".asc" && file.stem().string().rfind("snow_", 0) == 0;
}

// Midnight of the day in the name of a map.
std::int64_t day_of(const fs::path& file)
{
    std::string stem = file.stem().string();
    std::erase(stem, '-');
    const std::string_view day = std::string_view(stem).substr(5);
    std::optional<std::int64_t> us;
    if (day.size() == 8)
        us = weather::us_from_iso(std::string(day.substr(0, 4)) + "-" +
                                  std::string(day.substr(4, 2)) + "-" + std::string(day.substr(6)) +
                                  "T00:00Z");
    if (us) return *us;
    throw Error("bench: " + file.string() + ": its name has no day",
                "Name maps of snow as snow_2018-04-21.asc.");
}

SnowSeen seen_of(double code, bool known, const fs::path& file)
{
    if (!known || code == 205.0 || code == 254.0 || code == 255.0) return SnowSeen::Unknown;
    if (code == 0.0) return SnowSeen::Bare;
    if (code == 1.0 || code == 100.0) return SnowSeen::Snow;
    throw Error("bench: " + file.string() + ": a map of snow has no code " + std::to_string(code),
                "Use 0 for bare ground, 100 for snow, 205 for cloud, 255 for unknown.");
}

// The only file of a folder whose name begins with weather.
fs::path weather_of(const fs::path& folder)
{
    fs::path found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().stem() != "weather") continue;
        if (!found.empty())
            throw Error("bench: " + folder.string() + " has two files weather.*", "Leave one.");
        found = entry.path();
    }
    if (found.empty())
        throw Error("bench: " + folder.string() + " has maps of snow and no file weather.*",
                    "Put the weather of a station into it.");
    return found;
}

// Cells that agree and that do not.
struct Table {
    double both = 0.0, ours = 0.0, seen = 0.0, neither = 0.0, count = 0.0;

    void add(bool model, bool map)
    {
        count += 1.0;
        ours += model;
        seen += map;
        both += model && map;
        neither += !model && !map;
    }
    // Cohen 1960; all of one kind and agreed is 1.
    double kappa() const
    {
        const double agreed = (both + neither) / count;
        const double chance = (ours * seen + (count - ours) * (count - seen)) / (count * count);
        return chance < 1.0 ? (agreed - chance) / (1.0 - chance) : agreed;
    }
};

}  // namespace

bool is_snow_map_set(const fs::path& folder)
{
    if (!fs::exists(folder / "dem.asc")) return false;
    return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                       [](const auto& entry) { return is_map(entry.path()); });
}

SnowMapSet read_snow_map_set(const fs::path& folder, const weather::Site& site)
{
    SnowMapSet set;
    set.name = folder.filename().string();
    const fs::path dem = folder / "dem.asc";
    const Terrain asked = parse_ascii_grid(text_of(dem), dem.string());
    if (std::max(asked.width, asked.height) > kMostSide)
        throw Error("bench: " + dem.string() + " has more than 256 cells a side",
                    "Give a coarser terrain and coarser maps.");
    TerrainOptions options;
    options.file = dem.string();
    options.longest_side = static_cast<int>(kMostSide);
    set.terrain = read_terrain(options, "grass");
    weather::ReadOptions read;
    read.site = site;
    read.heights_given = true;
    set.weather = weather::read_weather(text_of(weather_of(folder)), read);
    const auto& times = set.weather.table.time_us;
    const double east_deg = set.weather.table.site.longitude_deg;
    const double utc_h = kOverpass_h - (std::isnan(east_deg) ? 0.0 : east_deg / 15.0);
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!is_map(entry.path())) continue;
        const std::int64_t day_us = day_of(entry.path());
        const Terrain codes = parse_ascii_grid(text_of(entry.path()), entry.path().string());
        SnowMapSet::Map map;
        map.time_us = day_us + static_cast<std::int64_t>(std::llround(utc_h * 3600e6));
        if (codes.width != set.terrain.width || codes.height != set.terrain.height)
            throw Error("bench: " + entry.path().string() + " has other cells than dem.asc",
                        "Give maps of the terrain's own cells.");
        if (map.time_us < times.front() || map.time_us > times.back())
            throw Error("bench: " + entry.path().string() + " is outside the weather",
                        "Give maps of days that the weather has.");
        for (std::size_t i = 0; i < codes.cells(); ++i)
            map.cells.push_back(seen_of(static_cast<double>(codes.heights_m[i]),
                                        codes.inside[i] && set.terrain.inside[i], entry.path()));
        set.maps.push_back(std::move(map));
    }
    std::sort(set.maps.begin(), set.maps.end(),
              [](const auto& a, const auto& b) { return a.time_us < b.time_us; });
    return set;
}

std::vector<SkillRow> snow_map_rows(const SnowMapSet& set, const std::vector<std::string>& settings)
{
    const Terrain& terrain = set.terrain;
    GridRun run;
    run.model.site.surface = "grass";
    run.model.every_s = 86400.0;
    run.model.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    for (const std::string& setting : settings)
        if (setting.rfind("road.", 0) != 0) run.model.settings.push_back(setting);
    for (const SnowMapSet::Map& map : set.maps) run.map_times_us.push_back(map.time_us);
    Table table;
    ErrorSum line;
    std::size_t next = 0;
    run.on_map = [&](const GridMap& modelled) {
        const std::vector<SnowSeen>& seen = set.maps[next++].cells;
        std::vector<double> heights_m, model_m, map_m;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i] == SnowSeen::Unknown) continue;
            const double depth_m = weather::diagnostics(modelled.states[i]).snow_depth_m;
            table.add(depth_m >= kSnow_m, seen[i] == SnowSeen::Snow);
            heights_m.push_back(static_cast<double>(terrain.heights_m[i]));
            model_m.push_back(depth_m);
            map_m.push_back(seen[i] == SnowSeen::Snow ? 1.0 : 0.0);
        }
        const auto white = std::count(map_m.begin(), map_m.end(), 1.0);
        if (white > 0 && static_cast<std::size_t>(white) < map_m.size())
            line.add(snow_line_m(heights_m, model_m, kSnow_m) - snow_line_m(heights_m, map_m, 0.5));
    };
    run_grid(set.weather, set.name, terrain, run);
    std::vector<SkillRow> rows;
    if (table.count > 0.0)
        rows.push_back({set.name, "snow maps", "", static_cast<std::size_t>(table.count),
                        1.0 - table.kappa(), (table.ours - table.seen) / table.count, "1 - kappa"});
    if (line.count() > 0)
        rows.push_back(
            {set.name, "snow line of maps", "m", line.count(), line.rmse(), line.bias(), "RMSE"});
    return rows;
}

}  // namespace petrichor::cli
