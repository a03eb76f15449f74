#include "cli/bench/skill/find_sets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/input_file.h"
#include "cli/simulate/physical_table.h"
#include "film/weather/weather_input.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using weather::Field;

constexpr std::size_t kMostFiles = 20000;
constexpr std::uintmax_t kMostBytes = 64u << 20;

std::string text_of(const fs::path& file)
{
    return read_file(file, "bench:", kMostBytes);
}

weather::Site site_of(const fs::path& file)
{
    weather::Site site;
    const std::string name = weather::lower(file.string());
    if (name.find("col_de_porte") != std::string::npos || name.find("cdp_") != std::string::npos) {
        site.latitude_deg = 45.30;
        site.longitude_deg = 5.77;
        site.elevation_m = 1325.0;
        site.temp_height_m = 1.5;
    }
    const fs::path toml = file.parent_path() / "site.toml";
    if (fs::exists(toml)) {
        const film::SiteOptions given = film::with_site_table({}, text_of(toml));
        site.latitude_deg = given.latitude_deg.value_or(site.latitude_deg);
        site.longitude_deg = given.longitude_deg.value_or(site.longitude_deg);
        site.elevation_m = given.elevation_m.value_or(site.elevation_m);
        site.temp_height_m = given.temp_height_m.value_or(site.temp_height_m);
        site.wind_height_m = given.wind_height_m.value_or(site.wind_height_m);
    }
    return site;
}

struct Pair {
    std::string name;
    fs::path met, obs;
};
// The observations that belong to a file of weather, by their names.
std::vector<Pair> pairs_of(const fs::path& met)
{
    const std::string file = met.filename().string(), stem = met.stem().string();
    std::vector<Pair> out;
    const auto add = [&](const std::string& name, const std::string& obs) {
        for (const char* end : {".csv", ".txt"}) {
            const fs::path path = met.parent_path() / (obs + end);
            if (out.empty() && fs::exists(path)) out.push_back({name, met, path});
        }
    };
    if (stem.rfind("met_", 0) == 0) add(stem.substr(4), "obs_" + stem.substr(4));
    const std::string tail = "_met_hourly";
    if (stem.size() > tail.size() && stem.ends_with(tail)) {
        const std::string name = stem.substr(0, stem.size() - tail.size());
        add(name, name + "_obs_daily");
    }
    return out;
}

// A file of GHCN-daily holds its own snow depths. Years with none tell nothing.
void add_daily(const fs::path& file, SkillSets& sets)
{
    const std::string text = text_of(file);
    if (std::string(weather::recognise_weather(text).name).rfind("GHCN-daily", 0) != 0) return;
    weather::ReadOptions options;
    options.fill = false;
    auto read = weather::read_weather(text, options);
    WinterSet set;
    set.raw = read.table;
    set.winter.observed = observations_of(read.table);
    const bool seen =
        std::any_of(set.winter.observed.columns.begin(), set.winter.observed.columns.end(),
                    [](const ObservedColumn& c) { return c.column == "snow_depth_m"; });
    if (!seen) {
        sets.notes.push_back(file.string() + ": no snow depth in it");
        return;
    }
    set.winter.observed.daily = true;
    constexpr std::int64_t kDay_us = 86400LL * weather::kMicrosPerSecond;
    for (ObservedColumn& column : set.winter.observed.columns)
        for (std::int64_t& us : column.time_us) us -= (us % kDay_us + kDay_us) % kDay_us;
    weather::fill_forcing(read.table, read.report);
    set.winter.name = file.stem().string();
    set.winter.table = std::move(read.table);
    set.weather_file = set.observed_file = file.string();
    sets.winters.push_back(std::move(set));
}

WinterSet winter_of(const Pair& pair)
{
    weather::ReadOptions options;
    options.site = site_of(pair.met);
    options.heights_given = true;
    options.fill = false;
    auto read = weather::read_weather(text_of(pair.met), options);
    WinterSet set;
    set.raw = read.table;
    weather::fill_forcing(read.table, read.report);
    set.winter.name = pair.name;
    set.winter.table = std::move(read.table);
    auto columns = physical_columns();
    columns.emplace_back("swe_pit_kg_m2");
    set.winter.observed =
        read_observations(text_of(pair.obs), pair.obs.filename().string(), columns);
    set.weather_file = pair.met.string();
    set.observed_file = pair.obs.string();
    return set;
}

// `notes` hears when its forecast cannot be used.
RoadCase road_of(const fs::path& folder, std::vector<std::string>& notes)
{
    RoadCase road;
    road.name = folder.filename().string();
    road.station = weather::read_metro_station(text_of(folder / "station.xml"));
    road.observed = weather::read_metro_observation(text_of(folder / "observation.xml"));
    road.roadcast = weather::read_metro_roadcast(text_of(folder / "roadcast_reference.xml"));
    const fs::path forecast = folder / "forecast.xml";
    try {
        road.forecast = weather::read_metro_forecast(text_of(forecast));
    } catch (const Error& e) {
        notes.push_back(forecast.string() + ": " + e.what() +
                        "; the measured road has half a cover of cloud instead");
    }
    return road;
}

// Bondville near Champaign, a row of 33 numbers every half hour, local standard time at its end. Rows are
// put in the middle of what they are means of, and what falls between two middles is half of either.
LongwaveStation champaign(const std::string& text, const std::string& name)
{
    LongwaveStation station{name, {}, {}, {}};
    weather::ForcingTable& t = station.raw;
    t.site = {.latitude_deg = 40.01,
              .longitude_deg = -88.29,
              .elevation_m = 213.0,
              .temp_height_m = 3.0,
              .wind_height_m = 6.0};
    weather::Lines lines(text);
    while (const auto line = lines.next()) {
        const auto f = weather::words(*line, 40);
        if (f.size() != 33) continue;
        const auto value = [&](std::size_t i) {
            const double v = weather::to_number(f[i]).value_or(weather::kMissing);
            return v <= -6999.0 ? weather::kMissing : v;
        };
        const auto hhmm = static_cast<std::int64_t>(value(1));
        const std::int64_t us = weather::days_from_civil(1998, 1, 1) * 86400000000LL +
                                ((static_cast<std::int64_t>(value(0)) - 1) * 1440 +
                                 hhmm / 100 * 60 + hhmm % 100 - 15 + 6 * 60) *
                                    60000000LL;
        if (!t.time_us.empty() && us <= t.time_us.back()) continue;
        t.time_us.push_back(us);
        t[Field::Wind].push_back(value(2));
        t[Field::AirTemp].push_back(value(4) + weather::kZeroCelsiusK);
        t[Field::RelHumidity].push_back(std::min(value(5), 100.0));
        t[Field::Pressure].push_back(value(6) * 100.0);
        t[Field::Shortwave].push_back(std::max(value(7), 0.0));
        t[Field::Precip].push_back(std::max(value(12), 0.0) * 25.4 / 1800.0);
        t[Field::Longwave].push_back(value(29));
        station.wetness_v.push_back(value(13));
        station.skin_c.push_back(value(14) < -172.0 ? weather::kMissing : value(14));
    }
    auto& rain = t[Field::Precip];
    for (std::size_t i = 0; i + 1 < rain.size(); ++i) rain[i] = 0.5 * (rain[i] + rain[i + 1]);
    return station;
}

void add_station(const fs::path& file, SkillSets& sets)
{
    const std::string name = file.stem().string();
    const std::string text = text_of(file);
    if (name.rfind("champaign", 0) == 0) {
        sets.stations.push_back(champaign(text, name));
        return;
    }
    if (weather::lower(weather::recognise_weather(text).name).find("surfrad") == std::string::npos)
        return;
    weather::ReadOptions options;
    options.fill = false;
    sets.stations.push_back({name, weather::read_weather(text, options).table, {}, {}});
}

}  // namespace

SkillSets find_skill_sets(const std::string& folder)
{
    if (!fs::is_directory(folder))
        throw Error("bench: '" + folder + "' is not a folder",
                    "Give the folder that holds the data sets with --data.");
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
        if (files.size() >= kMostFiles)
            throw Error("bench: more than 20000 files below '" + folder + "'",
                        "Give the folder of the weather data alone.");
        if (entry.is_regular_file() && entry.file_size() <= kMostBytes)
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    SkillSets sets;
    for (const fs::path& file : files) {
        try {
            for (const Pair& pair : pairs_of(file)) sets.winters.push_back(winter_of(pair));
            if (file.filename() == "roadcast_reference.xml" &&
                fs::exists(file.parent_path() / "station.xml") &&
                fs::exists(file.parent_path() / "observation.xml"))
                sets.roads.push_back(road_of(file.parent_path(), sets.notes));
            if (file.filename().string().rfind("DSM_", 0) == 0 && is_urban_site(file.parent_path()))
                sets.towns.push_back(read_urban_site(file.parent_path()));
            if (file.filename() == "dem.asc" && is_snow_map_set(file.parent_path()))
                sets.landscapes.push_back(read_snow_map_set(file.parent_path(), site_of(file)));
            if (file.extension() == ".dat") add_station(file, sets);
            if (file.extension() == ".dly" || file.filename().string().rfind("ghcn", 0) == 0)
                add_daily(file, sets);
        } catch (const Error& e) {
            sets.notes.push_back(file.string() + ": " + e.what());
        }
    }
    if (sets.winters.empty() && sets.roads.empty() && sets.stations.empty() && sets.towns.empty() &&
        sets.landscapes.empty()) {
        throw Error("bench: there is no data set below '" + folder + "'" +
                        (sets.notes.empty() ? "" : "; " + sets.notes.front()),
                    "Put met_X.txt beside obs_X.csv, or the files of a METRo case, or dem.asc, "
                    "weather.* and snow_YYYY-MM-DD.asc, into it.");
    }
    return sets;
}

}  // namespace petrichor::cli
