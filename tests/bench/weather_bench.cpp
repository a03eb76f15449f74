// Speed of the physical half of the weather room. Prints one CSV row a case: CPU seconds (minimum and median of the
// repeats), and the number per item that the design asks for. Cases with real files need PETRICHOR_ASSETS.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/weather/winters.h"
#include "weather/mapping.h"
#include "weather/physical_grid.h"
#include "weather/physics/snow_simple.h"

namespace {

using namespace petrichor::weather;
using namespace petrichor::weather::testing_winters;

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Times {
    double least_cpu = 0, median_cpu = 0, least_wall = 0;
};
Times measure(int repeats, const std::function<void()>& run)
{
    std::vector<double> cpu, wall;
    for (int i = 0; i < repeats; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        const double begin_cpu = cpu_seconds();
        run();
        cpu.push_back(cpu_seconds() - begin_cpu);
        wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(cpu.begin(), cpu.end());
    return {cpu.front(), cpu[cpu.size() / 2], *std::min_element(wall.begin(), wall.end())};
}
void row(const char* name, const Times& t, double per, const char* unit)
{
    std::printf("%s,%.6f,%.6f,%.6f,%.4f,%s\n", name, t.least_cpu, t.median_cpu, t.least_wall, per, unit);
    std::fflush(stdout);
}

// The plain model for comparison: degree days, one number of snow.
double degree_day_year(const ForcingTable& table)
{
    double swe = 0, total = 0;
    const auto& t = table[Field::AirTemp];
    const auto& p = table[Field::Precip];
    for (std::size_t i = 0; i + 1 < table.rows(); ++i) {
        const double dt = static_cast<double>(table.time_us[i + 1] - table.time_us[i]) * 1e-6;
        swe += p[i] * dt * std::clamp((275.15 - t[i]) / 2.0, 0.0, 1.0);
        swe -= std::min(swe, degree_day_melt_kg_m2(t[i], t[i + 1], dt, 3.0));
        total += swe;
    }
    return total;
}

std::string metar_year()
{
    std::string text;
    for (int day = 0; day < 365; ++day) {
        static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
        int month = 0, of_month = day;
        while (of_month >= kDays[month]) of_month -= kDays[month++];
        for (int hour = 0; hour < 24; ++hour) {
            char line[160];
            std::snprintf(line, sizeof line, "METAR EDDF %02d%02d50Z 240%02dKT 9999 %s BKN0%02d %02d/%02d Q1013 NOSIG=\n", of_month + 1, hour,
                          5 + hour % 20, hour % 5 == 0 ? "-RA" : "", 10 + hour, 10 + hour % 10, 5 + hour % 5);
            text += line;
        }
    }
    return text;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::size_t cells_wanted = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 1000;
    std::printf("case,cpu_min_s,cpu_median_s,wall_min_s,value,unit\n");
    const std::string epw = asset("USA_CO_Denver.Intl.AP.725650_TMY3.epw");
    if (epw.empty()) {
        std::fprintf(stderr, "PETRICHOR_ASSETS does not name a folder with weather/\n");
        return 2;
    }
    Times t = measure(9, [&] { read_weather(epw); });
    row("read_epw", t, t.least_cpu * 1e3, "ms");
    const std::string metar = metar_year();
    t = measure(5, [&] { read_weather(metar); });
    row("read_metar_year", t, t.least_cpu * 1e3, "ms");

    const ForcingTable table = read_weather(epw).table;
    volatile double sink = 0;
    t = measure(9, [&] { sink = degree_day_year(table); });
    row("degree_day_cell_year", t, t.least_cpu * 1e3, "ms");
    const PhysicalParams params = meadow();
    t = measure(9, [&] { PhysicalTimeline run(table, params); });
    row("cell_year_denver", t, t.least_cpu * 1e3, "ms");
    const ForcingTable snowy = winter_2005().table;
    t = measure(9, [&] { PhysicalTimeline run(snowy, params); });
    row("cell_winter_col_de_porte", t, t.least_cpu * 1e3 * 8760.0 / static_cast<double>(snowy.rows()), "ms a year");
    const PhysicalTimeline run(table, params);
    int k = 0;
    t = measure(9, [&] {
        for (int i = 0; i < 100; ++i) sink = run.state_at(run.begin_us() + (k++ * 7919LL % 8759) * 3600000000LL + 1).film;
    });
    row("seek", t, t.least_cpu * 1e4, "us");

    std::vector<GridCell> cells(cells_wanted);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].elevation_m = 1325 + static_cast<double>(i % 997);
        cells[i].slope_rad = 0.01 * static_cast<double>(i % 37);
        cells[i].aspect_rad = 0.1 * static_cast<double>(i % 63);
        cells[i].surface = static_cast<std::uint32_t>(i % 5 == 0);
    }
    for (const ForcingTable* weather : {&table, &snowy}) {
        GridParams grid;
        grid.surfaces = {surface_preset("grass"), surface_preset("asphalt")};
        const double years = static_cast<double>(weather->rows()) / 8760.0;
        const double scale = 10000.0 / static_cast<double>(cells.size()) / years;
        std::size_t bytes = 0;
        for (const int threads : {1, 2}) {
            grid.threads = threads;
            t = measure(2, [&] {
                PhysicalGrid many(*weather, grid, cells);
                many.advance(many.steps());
                bytes = many.bytes();
            });
            const std::string name = std::string(weather == &table ? "grid_denver_" : "grid_col_de_porte_") + std::to_string(threads) + "_threads";
            row(name.c_str(), t, (threads == 1 ? t.least_cpu : t.least_wall) * scale, threads == 1 ? "cpu s for 10000 cells x 1 year" : "wall s for 10000 cells x 1 year");
        }
        row("grid_memory", {}, static_cast<double>(bytes) / 1048576.0, "MiB");
    }
    return 0;
}
