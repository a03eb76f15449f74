#include "weather/models/physical/detail/cell_steps.h"

#include <algorithm>
#include <cmath>

#include "weather/models/physical/detail/block_kernel.h"
#include "weather/models/physical/physical.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/canopy_kernel.h"
#include "weather/physics/detail/snow_laws.h"
#include "weather/physics/exchange.h"

namespace petrichor::weather::detail {

namespace {

// The day's course of sun and air asks for this much, however long a step is.
constexpr double kLongestPart_s = 3600.0;
constexpr std::int64_t kDay_us = 86400 * kMicrosPerSecond;
constexpr double kTrafficByNight = 0.4 / 1.5;  // of its wind by day
constexpr double kPlainDeck_m = 0.3;        // of a bridge or a wall whose layers are not given
constexpr double kOuterWall_m2_k_w = 0.04;  // of a wall in the wind (ISO 6946)
constexpr double kInRoom_m2_k_w = 0.13;     // and in a room
// Old houses of masonry let 1.4 to 2.2 through (TABULA); chosen.
constexpr double kHouseWall_w_m2_k = 1.5;

std::vector<GroundLayer> layers_of(const CellConstants& k)
{
    const Surface& s = k.surface;
    if (!s.layers.empty() || !(k.back_resistance > 0.0)) return s.layers;
    return {{kPlainDeck_m, s.conductivity_w_m_k, s.heat_capacity_j_m3_k}};
}

double year_angle(std::int64_t time_us, bool south)
{
    const double days = static_cast<double>(time_us) / 86400e6;
    return 2.0 * kPi * ((days - (south ? 21.0 : 204.0)) / 365.2425);
}

}  // namespace

void advance_cell_plain(CellState& cell, const CellPlace<double>& place, const StepForcing* steps,
                        std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_steps(cell, steps, count, place, k, s);
}

void advance_block_16(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                      std::size_t count, const CellConstants& k, const StepConstants& s)
{
    advance_block<16>(block, place, steps, count, k, s);
}

bool machine_has_wide_registers()
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return false;
#endif
}

bool machine_has_widest_registers()
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
#else
    return false;
#endif
}

AdvanceCell fastest_advance_cell()
{
    return machine_has_wide_registers() ? advance_cell_wide : advance_cell_plain;
}

AdvanceBlock fastest_advance_block()
{
    if (machine_has_widest_registers()) return advance_block_64;
    return machine_has_wide_registers() ? advance_block_32 : advance_block_16;
}

CellPlace<double> station_place(double sky_view, double precip_factor)
{
    CellPlace<double> place{};
    place.pressure_factor = 1.0;
    place.sky_view = sky_view;
    place.normal_up = 1.0;
    place.precip_factor = precip_factor;
    place.wind_factor = 1.0;
    place.shortwave_factor = 1.0;
    place.rain_factor = 1.0;
    place.snow_factor = 1.0;
    place.gravity_across = 1.0;
    return place;
}

double climate_mean_c(double latitude_deg, double elevation_m)
{
    const double sine = sine_cosine(latitude_deg * (kPi / 180.0)).sin;
    const double height_m = std::isnan(elevation_m) ? 0.0 : elevation_m;
    return 14.9 - 28.0 * (1.5 * sine * sine - 0.5) - kLapseRate_k_m * height_m;
}

double climate_amplitude_k(double latitude_deg)
{
    const double sine = sine_cosine(latitude_deg * (kPi / 180.0)).sin;
    return 16.0 * sine * sine;
}

YearlyWave yearly_wave(const ForcingTable& table)
{
    // Least squares for mean and amplitude of T = mean + amplitude cos(year - phase); the warmest
    // day is 24 July in the north and 22 January in the south.
    const bool south = table.site.latitude_deg < 0.0;
    double n = 0.0, c1 = 0.0, cc = 0.0, t1 = 0.0, tc = 0.0;
    // All rows of a day share its cosine: the season does not move within a day.
    std::int64_t day_end_us = table.time_us[0];
    double c = 0.0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::int64_t now_us = table.time_us[i];
        if (now_us >= day_end_us) {
            const std::int64_t day_begin_us = now_us - ((now_us % kDay_us) + kDay_us) % kDay_us;
            day_end_us = day_begin_us + kDay_us;
            c = sine_cosine(year_angle(day_begin_us + kDay_us / 2, south)).cos;
        }
        const double t = table[Field::AirTemp][i] - kZeroCelsiusK;
        n += 1.0;
        c1 += c;
        cc += c * c;
        t1 += t;
        tc += t * c;
    }
    const double days = static_cast<double>(table.time_us.back() - table.time_us.front()) / 86400e6;
    YearlyWave wave;
    wave.south = south;
    wave.mean_c = t1 / n;
    const double spread = cc / n - (c1 / n) * (c1 / n);
    if (days >= 120.0 && spread > 0.02) {
        wave.amplitude_k = clamped((tc / n - (t1 / n) * (c1 / n)) / spread, 0.0, 30.0);
        wave.mean_c = t1 / n - wave.amplitude_k * c1 / n;
    } else {
        // Days or weeks say little about the year: do not invent permafrost from a cold spell.
        const double file_c = wave.mean_c;
        if (std::isnan(table.site.latitude_deg)) {
            wave.mean_c = std::max(file_c, 2.0);
        } else {
            // Two weak witnesses: the mean of the latitude, and the file less the season of the
            // latitude.
            const double season_k = climate_amplitude_k(table.site.latitude_deg) * c1 / n;
            wave.mean_c = 0.5 * (climate_mean_c(table.site.latitude_deg, table.site.elevation_m) +
                                 (file_c - season_k));
            wave.recent_k = file_c - wave.mean_c;
        }
    }
    return wave;
}

CellState initial_cell(const ForcingTable& table, const CellConstants& k)
{
    return initial_cell(table, k, table.time_us[0]);
}

CellState initial_cell(const ForcingTable& table, const CellConstants& k, std::int64_t at_us)
{
    const YearlyWave wave = yearly_wave(table);
    CellState c{};
    c.snow_albedo = k.snow.albedo_max;
    c.surface_temp_c = value_at(table, Field::AirTemp, at_us) - kZeroCelsiusK;
    // The wave of the year goes down into the ground, fading and late by one radian in `damping`;
    // near the surface the last days of air count.
    const double diffusivity = k.surface.conductivity_w_m_k / k.surface.heat_capacity_j_m3_k;
    const double damping = std::sqrt(diffusivity * 365.2425 * 86400.0 / kPi);
    const double now = year_angle(at_us, wave.south);
    double depth = 0.0;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        const double z = (depth + 0.5 * kGroundThickness_m[i]) / damping;
        c.ground_temp_c[i] =
            k.deep_temp_c +
            exponential(-z) * (wave.amplitude_k * sine_cosine(now - z).cos + wave.recent_k);
        depth += kGroundThickness_m[i];
    }
    c.infiltration_mm_h = k.surface.infiltration.first_mm_h;
    return c;
}

double behind_wall_m2_k_w(const CellConstants& k)
{
    double resistance = kOuterWall_m2_k_w + kInRoom_m2_k_w;
    for (const GroundLayer& layer : layers_of(k))
        resistance += layer.thickness_m / layer.conductivity_w_m_k;
    return kInRoom_m2_k_w + std::max(0.0, 1.0 / kHouseWall_w_m2_k - resistance);
}

CellState initial_wall(const ForcingTable& table, const CellConstants& k, std::int64_t at_us)
{
    CellState c = initial_cell(table, k, at_us);
    const GroundProfile profile =
        make_ground_profile(layers_of(k), k.surface.conductivity_w_m_k,
                            k.surface.heat_capacity_j_m3_k, k.back_resistance);
    // From the air through the wall to the room, as heat flows that has had its time.
    double to_node[kGroundLayers], sum = kOuterWall_m2_k_w;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        const double half = 0.5 * kGroundThickness_m[i] / profile.conductivity[i];
        to_node[i] = sum + half;
        sum += 2.0 * half;
    }
    sum += profile.bottom_resistance;
    const double outside_c = c.surface_temp_c;
    for (std::size_t i = 0; i < kGroundLayers; ++i)
        c.ground_temp_c[i] = outside_c + (k.deep_temp_c - outside_c) * (to_node[i] / sum);
    c.surface_temp_c = outside_c + (k.deep_temp_c - outside_c) * (kOuterWall_m2_k_w / sum);
    return c;
}

CellConstants make_cell_constants(const PhysicalParams& params, const Site& site,
                                  double deep_temp_k)
{
    CellConstants k;
    const Surface& s = params.surface;
    k.surface = s;
    k.snow = params.snow;
    k.exchange = params.exchange;
    k.phase = params.phase;
    k.deep_temp_c = deep_temp_k - kZeroCelsiusK;
    if (s.open_below) k.back_resistance = kUnderBridge_m2_k_w;
    k.wind_height_m = site.wind_height_m;
    k.albedo_dry = s.albedo_dry;
    k.albedo_wet = s.albedo_wet;
    k.emissivity = s.emissivity;
    k.snow_emissivity = params.snow.emissivity;
    k.log_roughness = logarithm(s.roughness_m);
    k.log_snow_roughness = logarithm(params.snow.roughness_m);
    k.log_wind_height = logarithm(site.wind_height_m);
    k.log_temp_height_10 = logarithm(site.temp_height_m * 10.0);  // z0h = z0 / 10
    k.heat_roughness = logarithm(s.heat_roughness_share * 10.0);
    k.neutral_bare =
        neutral_exchange_of(k.log_wind_height - k.log_roughness,
                            k.log_temp_height_10 - (k.log_roughness + k.heat_roughness));
    k.leaf_exchange = leaf_exchange(s.leaf_width_m, 1.0);
    k.convection_bare =
        convection_of(k.log_wind_height - k.log_roughness, -logarithm(s.heat_roughness_share));
    k.convection_snow =
        convection_of(k.log_wind_height - k.log_snow_roughness, logarithm(10.0));  // z0h = z0 / 10
    k.inverse_cover_depth = 1.0 / params.snow.cover_depth_m;
    k.least_wind = std::max(params.exchange.min_wind_m_s, s.traffic_wind_m_s);
    k.least_wind_by_night =
        std::max(params.exchange.min_wind_m_s, kTrafficByNight * s.traffic_wind_m_s);
    k.film_capacity = s.film_capacity_kg_m2;
    k.inverse_film_capacity = 1.0 / s.film_capacity_kg_m2;
    k.film = {s.film_capacity_kg_m2, 1.0 / std::max(s.film_capacity_kg_m2, s.film_full_kg_m2)};
    k.crack_capacity = s.cracks.capacity_kg_m2();
    k.puddle_capacity = s.puddles.capacity_kg_m2();
    k.canopy_capacity = kCanopyHolds_kg_m2 * params.canopy_vai;
    k.permeable = s.infiltration.first_mm_h > 0.0;
    return k;
}

namespace {

PartConstants make_part_constants(const CellConstants& k, double dt_s)
{
    const Surface& surface = k.surface;
    const HortonParams& horton = surface.infiltration;
    const double hours = dt_s / 3600.0;
    PartConstants part;
    part.dt_s = dt_s;
    part.inverse_dt_1_s = 1.0 / dt_s;
    part.ground =
        make_ground_stack(make_ground_profile(layers_of(k), surface.conductivity_w_m_k,
                                              surface.heat_capacity_j_m3_k, k.back_resistance),
                          dt_s);
    part.film = reservoir_constants(surface.film_rate_1_s, k.film_capacity, dt_s);
    part.film_in_snow = reservoir_constants(surface.slush_rate_1_s, k.film_capacity, dt_s);
    part.horton = make_horton_step(horton, hours);
    part.horton_turn = make_horton_step(horton, hours / kFillingTurns);
    part.sprayed = 1.0 - exponential(-surface.traffic_loss_1_h * hours);
    part.salt_kept = exponential(-surface.salt_loss_1_h * hours);
    part.cleared = 1.0 - exponential(-surface.snow_clearing_1_h * hours);
    return part;
}

}  // namespace

StepConstants make_step_constants(const CellConstants& k, double dt_s, double substep_s)
{
    StepConstants s;
    s.dt_s = dt_s;
    const auto parts_of = [&](double longest_s) {
        return std::max(1, static_cast<int>(std::ceil(dt_s / longest_s - 1e-9)));
    };
    s.whole_parts = parts_of(kLongestPart_s);
    s.parts = std::max(s.whole_parts, parts_of(substep_s));
    s.whole = make_part_constants(k, dt_s / s.whole_parts);
    s.part = make_part_constants(k, dt_s / s.parts);
    s.albedo_cold = kept_after(dt_s, k.snow.albedo_cold_h);
    s.albedo_melting = kept_after(dt_s, k.snow.albedo_melting_h);
    s.unloading_cold = unloaded_share(dt_s, kUnloadingCold_s);
    s.unloading_melting = unloaded_share(dt_s, kUnloadingMelting_s);
    s.settling = kept_after(dt_s, kSettling_h);
    return s;
}

}  // namespace petrichor::weather::detail
