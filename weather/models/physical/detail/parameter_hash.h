// One hash over everything that parameters hold.
//
// The structured bindings name every field of a struct: one that gets another field does not
// compile until it is added here, and a field left out is an unused name.
#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_PARAMETER_HASH_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_PARAMETER_HASH_H

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/models/physical/physical_grid.h"

namespace petrichor::weather::detail {

// FNV-1a over numbers of 64 bits; -0 and 0 differ, as their bits do.
class ParameterHash {
public:
    std::uint64_t value() const { return value_; }

    template <class... Fields>
    void add(const Fields&... fields)
    {
        (put(fields), ...);
    }

    // Laws and steps: what a model holds besides its surface.
    void add_model(const PhysicalParams& params)
    {
        const auto& [surface, snow, exchange, phase, step_s, substep_s, deep_temp_k, sky_view,
                     precip_factor, canopy_vai, horizon, events] = params;
        static_cast<void>(surface);
        add(snow, exchange, phase, step_s, substep_s, deep_temp_k, sky_view, precip_factor,
            canopy_vai, horizon);
        add(std::uint64_t{events.size()});
        for (const auto& [time_us, kind, amount] : events) add(time_us, kind, amount);
    }

private:
    void put_bits(std::uint64_t bits)
    {
        for (int i = 0; i < 8; ++i) {
            value_ ^= (bits >> (8 * i)) & 0xffu;
            value_ *= 1099511628211u;
        }
    }
    void put(double number) { put_bits(std::bit_cast<std::uint64_t>(number)); }
    template <class Whole>
    requires std::integral<Whole> || std::is_enum_v<Whole>
    void put(Whole number) { put_bits(static_cast<std::uint64_t>(number)); }
    template <class Number>
    void put(const std::vector<Number>& numbers)
    {
        put(std::uint64_t{numbers.size()});
        for (const Number number : numbers) put(number);
    }

    void put(const Hypsometry& relief)
    {
        const auto& [depth_mm, area_fraction, volume_mm] = relief;
        add(depth_mm, area_fraction, volume_mm);
    }
    void put(const HortonParams& horton)
    {
        const auto& [first_mm_h, last_mm_h, decay_1_h, recovery_1_h] = horton;
        add(first_mm_h, last_mm_h, decay_1_h, recovery_1_h);
    }
    void put(const Surface& surface)
    {
        // A name changes nothing.
        const auto& [name, albedo_dry, albedo_wet, emissivity, roughness_m, heat_roughness_share,
                     film_capacity_kg_m2, film_rate_1_s, film_full_kg_m2, slush_rate_1_s,
                     cracks, puddles, infiltration, layers, open_below, conductivity_w_m_k, heat_capacity_j_m3_k,
                     traffic_loss_1_h, traffic_wind_m_s, snow_clearing_1_h, traffic_heat_w_m2,
                     salt_loss_1_h, leaf_width_m] = surface;
        static_cast<void>(name);
        add(albedo_dry, albedo_wet, emissivity, roughness_m, heat_roughness_share, salt_loss_1_h,
            film_capacity_kg_m2, film_rate_1_s, film_full_kg_m2, slush_rate_1_s, cracks, puddles, infiltration,
            open_below, conductivity_w_m_k, heat_capacity_j_m3_k, traffic_loss_1_h,
            traffic_wind_m_s, snow_clearing_1_h, traffic_heat_w_m2, leaf_width_m);
        add(std::uint64_t{layers.size()});
        for (const auto& [thickness_m, layer_w_m_k, layer_j_m3_k] : layers)
            add(thickness_m, layer_w_m_k, layer_j_m3_k);
    }
    void put(const SnowParams& snow)
    {
        const auto& [max_layers, new_density, constant_density_kg_m3, new_density_factor, settling,
                     viscosity_pa_s, viscosity_density_m3_kg, viscosity_wetness, albedo_max,
                     albedo_min, albedo_cold_h, albedo_melting_h, albedo_refresh_kg_m2,
                     irreducible_water, cover_depth_m, roughness_m, emissivity] = snow;
        add(max_layers, new_density, constant_density_kg_m3, new_density_factor, settling,
            viscosity_pa_s, viscosity_density_m3_kg, viscosity_wetness, albedo_max, albedo_min,
            albedo_cold_h, albedo_melting_h, albedo_refresh_kg_m2, irreducible_water, cover_depth_m,
            roughness_m, emissivity);
    }
    void put(const ExchangeParams& exchange)
    {
        const auto& [stability, max_richardson, min_wind_m_s, max_unstable, rain_heat] = exchange;
        add(stability, max_richardson, min_wind_m_s, max_unstable, rain_heat);
    }
    void put(const PhaseParams& phase)
    {
        const auto& [law, all_snow_k, all_rain_k, threshold_k] = phase;
        add(law, all_snow_k, all_rain_k, threshold_k);
    }
    void put(const GridCell& cell)
    {
        const auto& [elevation_m, slope_rad, aspect_rad, sky_view, precip_factor, surface,
                     air_offset_k, wind_factor, shortwave_factor, longwave_offset_w_m2] = cell;
        add(elevation_m, slope_rad, aspect_rad, sky_view, precip_factor, surface, air_offset_k,
            wind_factor, shortwave_factor, longwave_offset_w_m2);
    }
    void put(const Site& site)
    {
        const auto& [latitude_deg, longitude_deg, elevation_m, temp_height_m, wind_height_m,
                     utc_offset_h, name] = site;
        static_cast<void>(utc_offset_h);  // only how times are shown
        static_cast<void>(name);
        add(latitude_deg, longitude_deg, elevation_m, temp_height_m, wind_height_m);
    }
    void put(const ForcingTable& table)
    {
        const auto& [site, time_us, columns] = table;
        add(site, time_us);
        for (const auto& column : columns) put(column);
    }

    std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace petrichor::weather::detail

#endif
