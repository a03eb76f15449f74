#include "weather/models/physical/observed_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/solar.h"

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

constexpr double kDay_s = 86400.0, kTurn_1_s = 2.0 * kPi / kDay_s;

// What is known of a profile at its first measurement, above the sub-surface thermometer.
class Profile {
public:
    Profile(double surface_c, double below_c, double sensor_m)
        : below_c_(below_c), left_k_(surface_c - below_c), sensor_m_(sensor_m)
    {
    }
    void add_wave(const DayWave& wave, double second_of_sun)
    {
        wave_ = wave;
        second_ = second_of_sun;
        below_c_ -= wave.at(sensor_m_, second_of_sun);
        left_k_ += wave.at(sensor_m_, second_of_sun) - wave.at(0.0, second_of_sun);
    }
    double at(double depth_m) const
    {
        return below_c_ + wave_.at(depth_m, second_) +
               left_k_ * (1.0 - std::min(depth_m / sensor_m_, 1.0));
    }

private:
    double below_c_, left_k_, sensor_m_, second_ = 0.0;
    DayWave wave_;
};

// Heat that brings the model to the thermometer in the ground, between the two layers about it, the
// nearer the more.
class Thermometer {
public:
    explicit Thermometer(double depth_m)
    {
        double top_m = 0.0, above_m = 0.0;
        for (std::size_t i = 0; i < kGroundLayers; ++i) {
            const double middle_m = top_m + 0.5 * kGroundThickness_m[i];
            if (middle_m >= depth_m || i + 1 == kGroundLayers) {
                below_ = i;
                share_below_ = i == 0 ? 1.0
                                      : std::clamp((depth_m - above_m) / (middle_m - above_m), 0.0,
                                                   1.0);
                break;
            }
            top_m += kGroundThickness_m[i];
            above_m = middle_m;
        }
    }
    void bring(std::array<double, kGroundLayers>& temps_c, double measured_c) const
    {
        const std::size_t above = below_ == 0 ? 0 : below_ - 1;
        const double up = 1.0 - share_below_, down = share_below_;
        const double missed_k = measured_c - (up * temps_c[above] + down * temps_c[below_]);
        const double squares = up * up + down * down;
        temps_c[above] += missed_k * up / squares;
        temps_c[below_] += missed_k * down / squares;
    }

private:
    std::size_t below_ = 0;
    double share_below_ = 1.0;
};

// METRo's first profile (its subroutine MAKITP).
DayWave metro_wave(const Surface& surface, double sensor_m)
{
    double diffusivity = 0.0, top_m = 0.0;
    for (const GroundLayer& layer : surface.layers) {
        const double part_m = std::min(layer.thickness_m, sensor_m - top_m);
        diffusivity += part_m / sensor_m * layer.conductivity_w_m_k / layer.heat_capacity_j_m3_k;
        top_m += part_m;
        if (top_m >= sensor_m) break;
    }
    diffusivity += (sensor_m - top_m) / sensor_m * surface.conductivity_w_m_k /
                   surface.heat_capacity_j_m3_k;
    return {7.5, std::sqrt(diffusivity / kTurn_1_s), 0.25 * kDay_s};
}

}  // namespace

double DayWave::at(double depth_m, double second_of_sun) const
{
    const double x = depth_m / damping_m;
    return amplitude_k * detail::exponential(-x) *
           detail::sine_cosine(kTurn_1_s * (second_of_sun - warmest_s) - x).cos;
}

DayWave day_wave(const Surface& surface, double latitude_deg, std::int64_t time_us, double cloud)
{
    constexpr double kBack_w_m2_k = 20.0;
    constexpr std::int64_t kHour_us = 3600LL * kMicrosPerSecond;
    const bool layered = !surface.layers.empty();
    const double conductivity = layered ? surface.layers.front().conductivity_w_m_k
                                        : surface.conductivity_w_m_k,
                 capacity = layered ? surface.layers.front().heat_capacity_j_m3_k
                                    : surface.heat_capacity_j_m3_k;
    // Light of the hours around noon at longitude 0, where the clock is the mean sun's.
    const std::int64_t noon_us = time_us / (24 * kHour_us) * 24 * kHour_us + 12 * kHour_us;
    double light_w_m2 = 0.0;
    for (int h = -12; h < 12; ++h) {
        const double sine = sun_direction(noon_us + h * kHour_us, latitude_deg, 0.0).up;
        light_w_m2 +=
            cloudy_sky_w_m2(sine, cloud) * detail::sine_cosine(2.0 * kPi * h / 24.0).cos / 12.0;
    }
    // Half of a half-space's admittance is in phase with the surface, half an eighth of a day
    // before it.
    const double half = std::sqrt(0.5 * kTurn_1_s * conductivity * capacity);
    const double in_phase = kBack_w_m2_k + half;
    const double admittance = std::sqrt(in_phase * in_phase + half * half);
    DayWave wave;
    wave.amplitude_k = (1.0 - surface.albedo_dry) * std::max(light_w_m2, 0.0) / admittance;
    wave.damping_m = std::sqrt(2.0 * conductivity / (capacity * kTurn_1_s));
    wave.warmest_s = 0.5 * kDay_s + detail::arc_cosine(in_phase / admittance) / kTurn_1_s;
    return wave;
}

CellState observed_start(const ForcingTable& table, const PhysicalParams& params,
                         const RoadTemperatures& measured, FirstProfile first)
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
    Profile profile(*surface, below_c, measured.subsurface_depth_m);
    const Site& site = table.site;
    if (first != FirstProfile::Line && !std::isnan(site.longitude_deg) &&
        !std::isnan(site.latitude_deg)) {
        const auto at = std::find_if(measured.surface_c.begin(), measured.surface_c.end(), usable) -
                        measured.surface_c.begin();
        const std::int64_t us = measured.time_us[static_cast<std::size_t>(at)];
        const auto by_sun_us =
            us + static_cast<std::int64_t>(site.longitude_deg / 360.0 * kDay_s * 1e6);
        const double cloud =
            table.has(Field::Cloud) && table.rows() > 0 ? value_at(table, Field::Cloud, us) : 0.5;
        profile.add_wave(first == FirstProfile::Metro
                             ? metro_wave(params.surface, measured.subsurface_depth_m)
                             : day_wave(params.surface, site.latitude_deg, by_sun_us, cloud),
                         static_cast<double>(by_sun_us % 86400000000LL) * 1e-6);
    }
    double depth_m = 0.0;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        temps_c[i] = profile.at(depth_m + 0.5 * kGroundThickness_m[i]);
        depth_m += kGroundThickness_m[i];
    }
    const Thermometer thermometer(measured.subsurface_depth_m);
    const auto below_at = [&](std::size_t i) {
        return i < measured.subsurface_c.size() ? measured.subsurface_c[i] : kMissing;
    };
    double last_c = *surface, last_below_c = kMissing;
    std::optional<std::int64_t> before_us;
    for (std::size_t i = 0; i < measured.time_us.size(); ++i) {
        if (!usable(measured.surface_c[i])) continue;
        const double now_c = measured.surface_c[i], now_below_c = below_at(i);
        const bool below_known =
            first == FirstProfile::Metro && usable(now_below_c) && usable(last_below_c);
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
                if (below_known)
                    thermometer.bring(temps_c, last_below_c + (now_below_c - last_below_c) *
                                                                  (part + 1) / parts);
            }
        }
        before_us = measured.time_us[i];
        last_c = now_c;
        last_below_c = now_below_c;
    }
    cell.surface_temp_c = last_c;
    std::copy(temps_c.begin(), temps_c.end(), std::begin(cell.ground_temp_c));
    return cell;
}

}  // namespace petrichor::weather
