// One step of all patches.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_STEPS_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_STEPS_H

#include <cstdint>
#include <vector>

#include "weather/patches/detail/patch_tables.h"
#include "weather/patches/driving_rain.h"
#include "weather/patches/sky_light.h"

namespace petrichor::weather::detail {

// All that changes. Rows by slot, spare lanes included.
struct PatchLive {
    std::vector<CellBlock> blocks;
    std::vector<double> radiosity;  // J, longwave that leaves, W/m2
    std::vector<double> hoar;       // kg/m2
    std::vector<double> slid_hours;  // of the patience of a wet pack, see slide_snow
    std::vector<double> pond_m3;
    std::vector<double> pond_heat_j_kg;  // by pond
    double out_kg = 0.0, pond_lost_kg = 0.0, let_in_kg = 0.0;
    TapHeat tap_heat;
    // Of the last step, for whoever asks: recomputed by the next.
    std::vector<float> run_on_kg_m2_s, rain_share, wind_factor, shortwave_w_m2, longwave_w_m2;
};

// The weather of a step, the same for all patches.
struct SkyStep {
    StepForcing forcing;
    std::int64_t begin_us = 0, end_us = 0;
    double global = 0.0, diffuse = 0.0;  // W/m2 on flat ground, mean of the step
    double longwave = 0.0, air_k = 273.15, cloud = 0.0;
    // Directions of the sun within the step: four, above the horizon or not.
    static constexpr std::size_t kSuns = 4;
    std::array<Direction, kSuns> sun;
    std::array<VisibleLookup, kSuns> sun_at;
    double sum_up = 0.0, sum_up_85 = 0.0;  // of those above; the second with each at least cos 85
    SkyGlow glow;
    double wind_x = 0.0, wind_z = 0.0, wind_from_rad = 0.0;  // in the scene's axes
    double rate_mm_h = 0.0;  // of all that falls; 1 where nothing does and shares are asked for
    // Where rain and snow come from: bits and their weights, which add up to 1.
    struct Bit {
        std::int16_t texel;
        float weight;
    };
    std::vector<Bit> rain_from;
    VisibleLookup snow_from;
    double open_water_kg_m2_s = 0.0;  // that evaporates from ponds, >= 0
    // Of the air over ponds: what it holds, kg/kg, and what a metre a second of wind carries, kg/m3.
    double air_humidity = 0.0, pond_exchange_kg_m3 = 0.0, wind_m_s = 0.0;
    double wind_10m_m_s = 0.0, air_density_kg_m3 = 1.25;
};
SkyStep make_sky_step(const ForcingTable& table, const PatchParams& params, std::int64_t begin_us,
                      std::int64_t length_us, bool shares_asked);

// Constants of a step's length, by group.
using GroupSteps = std::vector<StepConstants>;
GroupSteps make_group_steps(const PatchTables& tables, double dt_s, double substep_s);

// Room for the numbers of a step, so that steps allocate nothing.
struct PatchScratch {
    std::vector<double> light, sent, first_light, longwave, albedo;
    std::vector<double> rain, snow, wind;       // factors
    std::vector<double> drained;                // kg/m2 in the step
    std::vector<double> arriving, splash_left;  // by patch
    std::vector<double> drifts_kg;              // by patch: taken below 0, room for it above
    std::vector<double> pond_in_m3, pond_loss_m;
    std::vector<double> pond_let_in_m3, pond_let_in_j;  // of it by taps, and the heat of that
    // Of the patches that drain to a pond: their area, and means over it.
    struct PondView {
        double area_m2 = 0.0, light_w_m2 = 0.0, longwave_w_m2 = 0.0, wind = 0.0, snow_m = 0.0;
    };
    std::vector<PondView> pond_view;
    explicit PatchScratch(const PatchTables& tables);
};

void advance_patches(PatchLive& live, const PatchTables& tables, const SkyStep& sky,
                     const GroupSteps& constants, const PatchParams& params, const Ponds& ponds,
                     PatchScratch& scratch);

}  // namespace petrichor::weather::detail

#endif
