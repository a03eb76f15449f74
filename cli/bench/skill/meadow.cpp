#include "cli/bench/skill/meadow.h"

#include <cmath>

#include "weather/physics/constants.h"

namespace petrichor::cli {
namespace {

constexpr double kStep_s = 1800.0;
// Halfway between what the sensor says when it is dry (0.04 V) and wet (0.17 V).
constexpr double kWet_v = 0.105;
// Of liquid water alone: the sensor is a resistance, and ice and dry snow hardly conduct.
constexpr double kWet_kg_m2 = 0.01;

}  // namespace

std::vector<SkillRow> meadow_rows(const LongwaveStation& station,
                                  const weather::PhysicalParams& params)
{
    if (station.wetness_v.empty()) return {};
    weather::ForcingTable table = station.raw;
    weather::ReadReport report;
    weather::fill_forcing(table, report);
    if (table.rows() != station.raw.rows()) return {};  // rows were divided
    weather::PhysicalParams p = params;
    p.step_s = kStep_s;
    const weather::PhysicalTimeline run(table, p);
    ErrorSum skin;
    double both = 0.0, ours = 0.0, seen = 0.0, count = 0.0, neither = 0.0;
    const auto states =
        run.series(run.begin_us(), run.end_us(),
                   static_cast<std::int64_t>(kStep_s) * weather::kMicrosPerSecond);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::int64_t step = (table.time_us[i] - run.begin_us()) /
                                  (static_cast<std::int64_t>(kStep_s) * weather::kMicrosPerSecond);
        if (step < 0 || static_cast<std::size_t>(step) >= states.size()) continue;
        const weather::CellState& cell = states[static_cast<std::size_t>(step)];
        skin.add(cell.surface_temp_c - station.skin_c[i]);
        if (std::isnan(station.wetness_v[i])) continue;
        const bool wet = cell.film >= kWet_kg_m2;
        const bool measured = station.wetness_v[i] > kWet_v;
        count += 1.0;
        ours += wet ? 1.0 : 0.0;
        seen += measured ? 1.0 : 0.0;
        both += wet && measured ? 1.0 : 0.0;
        neither += !wet && !measured ? 1.0 : 0.0;
    }
    std::vector<SkillRow> rows;
    if (skin.count() > 0)
        rows.push_back({station.name, "skin temperature", "K", skin.count(), skin.rmse(), skin.bias(),
                        "RMSE"});
    if (count > 0.0) {
        // Cohen 1960.
        const double agreed = (both + neither) / count;
        const double chance =
            (ours * seen + (count - ours) * (count - seen)) / (count * count);
        rows.push_back({station.name, "wetness, 1 - kappa", "", static_cast<std::size_t>(count),
                        1.0 - (agreed - chance) / (1.0 - chance), (ours - seen) / count,
                        "1 - kappa"});
    }
    return rows;
}

}  // namespace petrichor::cli
