#include "weather/models/physical/observed_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/physics/constants.h"

namespace petrichor::weather {

namespace {

constexpr double kLongest_s = 3600.0;

bool usable(double temp_c)
{
    return temp_c > -90.0 && temp_c < 100.0;  // false for NaN
}

std::optional<double> first_usable(std::span<const double> temps_c)
{
    const auto found = std::find_if(temps_c.begin(), temps_c.end(), usable);
    return found == temps_c.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

CellState observed_start(const ForcingTable& table, const PhysicalParams& params,
                         const RoadTemperatures& measured)
{
    check_params(params);
    const auto surface = first_usable(measured.surface_c);
    if (!surface || measured.time_us.size() != measured.surface_c.size()) {
        throw Error("start: there is no measured surface temperature between -90 and 100 C",
                    "Give at least one, or leave the measured start out.");
    }
    const double below_c = first_usable(measured.subsurface_c).value_or(*surface);
    const double deep_c =
        std::isnan(params.deep_temp_k) ? below_c : params.deep_temp_k - kZeroCelsiusK;
    const auto k = detail::make_cell_constants(params, table.site, deep_c + kZeroCelsiusK);
    CellState cell = detail::initial_cell(table, k);
    std::array<double, kGroundLayers> temps_c{};
    double depth_m = 0.0;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        const double z = (depth_m + 0.5 * kGroundThickness_m[i]) / measured.subsurface_depth_m;
        temps_c[i] = *surface + (below_c - *surface) * std::min(z, 1.0);
        depth_m += kGroundThickness_m[i];
    }
    double last_c = *surface;
    std::optional<std::int64_t> before_us;
    for (std::size_t i = 0; i < measured.time_us.size(); ++i) {
        if (!usable(measured.surface_c[i])) continue;
        const double now_c = measured.surface_c[i];
        if (before_us) {
            const double span_s = static_cast<double>(measured.time_us[i] - *before_us) * 1e-6;
            const int parts = std::max(1, static_cast<int>(std::ceil(span_s / kLongest_s)));
            if (parts > 24 * 366) break;  // a year without a value says nothing any more
            const auto s = detail::make_step_constants(k, span_s / parts, kLongest_s);
            for (int part = 0; part < parts; ++part) {
                const double x = (part + 0.5) / parts;
                temps_c =
                    step_ground(s.whole.ground, temps_c, last_c + (now_c - last_c) * x, deep_c)
                        .temp_k;
            }
        }
        before_us = measured.time_us[i];
        last_c = now_c;
    }
    cell.surface_temp_c = last_c;
    std::copy(temps_c.begin(), temps_c.end(), std::begin(cell.ground_temp_c));
    return cell;
}

}  // namespace petrichor::weather
