#include "cli/bench/weather_bench.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/input_file.h"
#include "cli/bench/sample_weather.h"
#include "weather/models/artist/exact.h"
#include "weather/models/physical/physical.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/physics/snow_simple.h"
#include "weather/readers/read_weather.h"

namespace petrichor::cli {
namespace {

using weather::Field;
using weather::ForcingTable;

constexpr int kSeeks = 100;  // in one timing of a seek
constexpr int kArtistSeeks = 10000;
constexpr int kSegments = 1000;
constexpr std::uint64_t kMostBytes = 256u << 20;  // of a weather file
constexpr int kSteps = 60 * 60;                   // a minute at 60 Hz

// Results go here, so that no work is left out.
volatile double sink = 0.0;

// The plain model: snow by temperature, melt by degree days, one number of snow.
double degree_day_run(const ForcingTable& table)
{
    const auto& temp_k = table[Field::AirTemp];
    const auto& precip = table[Field::Precip];
    const weather::DegreeDayParams params;
    double swe_kg_m2 = 0.0, sum = 0.0;
    for (std::size_t i = 0; i + 1 < table.rows(); ++i) {
        const double dt_s = static_cast<double>(table.time_us[i + 1] - table.time_us[i]) * 1e-6;
        const double snow_share = std::clamp(
            (params.all_rain_k - temp_k[i]) / (params.all_rain_k - params.all_snow_k), 0.0, 1.0);
        swe_kg_m2 += precip[i] * dt_s * snow_share;
        swe_kg_m2 -=
            std::min(swe_kg_m2, weather::degree_day_melt_kg_m2(temp_k[i], temp_k[i + 1], dt_s,
                                                               params.melt_kg_m2_k_day));
        sum += swe_kg_m2;
    }
    return sum;
}

struct WeatherCase {
    std::string name;
    ForcingTable table;
};
std::vector<WeatherCase> cases_of(const WeatherBenchOptions& options)
{
    if (!options.file.empty())
        return {
            {"file",
             weather::read_weather(read_file(options.file, "bench: weather", kMostBytes)).table}};
    return {{"bare", sample_year(options.days, false)}, {"snow", sample_year(options.days, true)}};
}

std::string hours_text(const ForcingTable& table)
{
    return std::to_string(table.rows()) + " h";
}

weather::PhysicalParams meadow()
{
    weather::PhysicalParams params;
    params.surface = weather::surface_preset("grass");
    return params;
}

// One piece of many: the cost of each.
Cost shared_out(Cost cost, int pieces)
{
    cost.cpu_ms /= pieces;
    cost.wall_ms /= pieces;
    return cost;
}

void add_cell_rows(const WeatherCase& one, int repeat, std::vector<BenchRow>& rows)
{
    const weather::PhysicalParams params = meadow();
    const auto table = std::make_shared<const ForcingTable>(one.table);
    rows.push_back({"degree_day_" + one.name, "1 cell, " + hours_text(one.table),
                    median_cost(repeat, [&] { sink = degree_day_run(one.table); })});
    rows.push_back({"cell_year_" + one.name, "1 cell, " + hours_text(one.table),
                    median_cost(repeat,
                                [&] {
                                    const weather::PhysicalTimeline run(table, params);
                                    sink = static_cast<double>(run.steps());
                                }),
                    one.name == "bare" ? 3.0 : 4.0});
    // Layers of its own, a horizon, salt every other day.
    weather::PhysicalParams road;
    road.surface = weather::surface_preset("road");
    road.horizon.assign(36, 0.1);
    for (std::int64_t us = table->time_us.front(); us < table->time_us.back();
         us += 2 * 86400LL * 1000000)
        road.events.push_back({us, weather::RoadEvent::Kind::Salt, 10.0});
    const bool placed = std::isfinite(table->site.latitude_deg + table->site.longitude_deg);
    if (!placed) road.horizon.clear();
    rows.push_back({"road_year_" + one.name, "1 cell with layers, horizon, salt",
                    median_cost(repeat,
                                [&] {
                                    const weather::PhysicalTimeline run(table, road);
                                    sink = static_cast<double>(run.steps());
                                }),
                    5.0});
    const weather::PhysicalTimeline run(table, params);
    const std::int64_t length_us = run.end_us() - run.begin_us();
    std::int64_t n = 0;
    const Cost seeks = median_cost(repeat, [&] {
        for (int i = 0; i < kSeeks; ++i)
            sink = run.state_at(run.begin_us() + (++n * 7919000003) % length_us).film;
    });
    rows.push_back({"seek_" + one.name, "1 state at any time", shared_out(seeks, kSeeks), 1.0});
}

void add_grid_rows(const WeatherCase& one, const WeatherBenchOptions& options, int threads,
                   std::vector<BenchRow>& rows)
{
    const double base_m =
        std::isfinite(one.table.site.elevation_m) ? one.table.site.elevation_m : 0.0;
    const auto cells = sample_cells(static_cast<std::size_t>(options.cells), base_m);
    weather::GridParams params;
    params.surfaces = {weather::surface_preset("grass"), weather::surface_preset("asphalt")};
    for (const bool all : {false, true}) {
        params.threads = all ? threads : 1;
        std::size_t bytes = 0;
        const Cost cost = median_cost(options.grid_repeat, [&] {
            weather::PhysicalGrid grid(one.table, params, cells);
            grid.advance(grid.steps());
            bytes = grid.bytes();
        });
        rows.push_back({"grid_" + one.name + (all ? "_all_threads" : "_1_thread"),
                        std::to_string(options.cells) + " cells, " + hours_text(one.table) + ", " +
                            std::to_string(params.threads) +
                            (params.threads == 1 ? " thread" : " threads"),
                        cost, 10000.0, static_cast<double>(bytes) / 1048576.0});
    }
}

std::vector<BenchRow> rival_rows(const WeatherBenchOptions& options)
{
    std::vector<BenchRow> rows;
    for (const Rival& rival : options.rivals) {
        rows.push_back(
            {rival.name, "the whole program: " + rival.command, time_rival(rival, options.repeat)});
    }
    return rows;
}

void add_reader_rows(const WeatherBenchOptions& options, std::vector<BenchRow>& rows)
{
    const ForcingTable table = sample_year(options.days, false);
    weather::ReadOptions reading;  // for reports that say the day only
    reading.year = kSampleYear;
    reading.month = kSampleMonth;
    const auto add = [&](const char* name, const std::string& text, double goal_ms) {
        rows.push_back({name, std::to_string(text.size() / 1024) + " KiB",
                        median_cost(options.repeat,
                                    [&] {
                                        sink = static_cast<double>(
                                            weather::read_weather(text, reading).table.rows());
                                    }),
                        goal_ms});
    };
    add("read_epw", epw_of(table), 15.0);
    add("read_metar_year", metar_of(table), 60.0);
    if (!options.file.empty())
        add("read_file", read_file(options.file, "bench: weather", kMostBytes), 0.0);
}

void add_artist_rows(int repeat, std::vector<BenchRow>& rows)
{
    const weather::ArtistTimeline solved(sample_timeline(kSegments), {}, {});
    std::int64_t n = 0;
    const Cost seeks = median_cost(repeat, [&] {
        for (int i = 0; i < kArtistSeeks; ++i)
            sink = solved.state_at((++n * 7919000003) % solved.end()).snow;
    });
    rows.push_back({"artist_exact", "1 state at any time of 1000 segments",
                    shared_out(seeks, kArtistSeeks), 0.020});
    const weather::ArtistParams params;
    const Cost steps = median_cost(repeat, [&] {
        weather::ArtistState now;
        for (int i = 0; i < kSteps; ++i) now = weather::step(now, params, 5.0, 0.4, 1.0 / 60.0);
        sink = now.wetness;
    });
    rows.push_back({"artist_stepped", "1 step of 1/60 s", shared_out(steps, kSteps)});
}

int thread_count(const WeatherBenchOptions& options)
{
    if (options.threads > 0) return options.threads;
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

std::string source_of(const WeatherBenchOptions& options)
{
    return options.file.empty() ? "made up"
                                : std::filesystem::path(options.file).filename().string();
}

void print_text(const WeatherBenchOptions& options, const std::vector<BenchRow>& rows)
{
    std::printf("weather: %s; medians of %d (grids: %d), CPU time of all threads together\n",
                source_of(options).c_str(), options.repeat, options.grid_repeat);
    std::printf("  %-24s %13s %13s %11s %9s  %s\n", "", "cpu ms", "wall ms", "goal ms", "MiB",
                "for");
    for (const BenchRow& row : rows) {
        std::printf("  %-24s %13.5f %13.5f", row.name.c_str(), row.cost.cpu_ms, row.cost.wall_ms);
        if (row.goal_ms > 0.0)
            std::printf(" %11.2f", row.goal_ms);
        else
            std::printf(" %11s", "");
        if (row.memory_mib > 0.0)
            std::printf(" %9.1f", row.memory_mib);
        else
            std::printf(" %9s", "");
        std::printf("  %s\n", row.what.c_str());
    }
    std::printf("  peak memory of the program: %ld MiB\n", peak_memory_mib());
}

}  // namespace

std::vector<BenchRow> weather_rows(const WeatherBenchOptions& options)
{
    const auto cases = cases_of(options);
    std::vector<BenchRow> rows = rival_rows(options);  // first: they may not even start
    for (const WeatherCase& one : cases) add_cell_rows(one, options.repeat, rows);
    add_reader_rows(options, rows);
    add_artist_rows(options.repeat, rows);
    for (const WeatherCase& one : cases) add_grid_rows(one, options, thread_count(options), rows);
    return rows;
}

std::string json_report(const WeatherBenchOptions& options, const std::vector<BenchRow>& rows)
{
    nlohmann::ordered_json report;
    report["weather"] = source_of(options);
    report["repeat"] = options.repeat;
    report["grid_repeat"] = options.grid_repeat;
    report["threads"] = thread_count(options);
    report["peak_memory_mib"] = peak_memory_mib();
    report["rows"] = nlohmann::ordered_json::array();
    for (const BenchRow& row : rows) {
        nlohmann::ordered_json entry{{"name", row.name},
                                     {"what", row.what},
                                     {"cpu_ms", row.cost.cpu_ms},
                                     {"wall_ms", row.cost.wall_ms}};
        if (row.goal_ms > 0.0) entry["goal_ms"] = row.goal_ms;
        if (row.memory_mib > 0.0) entry["memory_mib"] = row.memory_mib;
        report["rows"].push_back(std::move(entry));
    }
    return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

void run_weather_bench(const WeatherBenchOptions& options)
{
    const auto rows = weather_rows(options);
    if (options.json)
        std::cout << json_report(options, rows) << "\n";
    else
        print_text(options, rows);
}

}  // namespace petrichor::cli
