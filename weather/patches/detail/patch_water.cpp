#include "weather/patches/detail/patch_water.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weather/patches/detail/patch_spot.h"
#include "weather/patches/pond_ice.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather::detail {

namespace {

constexpr double kMostSplashed = 0.5;  // of the rain on a piece of ground
const CellConstants& constants_of(const PatchTables& t, std::size_t patch)
{
    return t.groups[t.group_of_block[t.slot_of_patch[patch] / kPatchLanes]].constants;
}

}  // namespace

void pour_on(PatchLive& live, const PatchTables& t, std::uint32_t target, double kg,
             PatchScratch& w)
{
    if (target < t.set.patches.size())
        w.arriving[target] += kg;
    else if (target != kRunsOut)
        w.pond_in_m3[target & ~kToPond] += kg * 1e-3;
    else
        live.out_kg += kg;
}

void share_what_falls(const PatchLive& live, const PatchTables& t, PatchScratch& w)
{
    const PatchSet& set = t.set;
    for (const std::uint32_t i : t.splashed) {
        const std::uint32_t foot = set.patches[i].foot;
        const std::size_t slot = t.slot_of_patch[foot];
        w.splash_left[foot] = kMostSplashed * w.rain[slot] * set.patches[foot].area_m2;
    }
    for (const std::uint32_t i : t.splashed) {
        const WeatherPatch& patch = set.patches[i];
        const std::size_t slot = t.slot_of_patch[patch.foot];
        const CellBlock& block = live.blocks[slot / kPatchLanes];
        if (number(block, kIce, slot % kPatchLanes) > 0.0) continue;  // snow takes it
        const WeatherPatch& ground = set.patches[patch.foot];
        const double wanted = splash_share(patch.foot_height_m, set.kinds[ground.kind].splash) *
                              w.rain[slot] * patch.area_m2;
        const double jumps = std::min(wanted, w.splash_left[patch.foot]);
        w.splash_left[patch.foot] -= jumps;
        w.rain[t.slot_of_patch[i]] += jumps / patch.area_m2;
        w.rain[slot] -= jumps / ground.area_m2;
    }
    for (const std::uint32_t i : t.downhill) {
        const std::size_t slot = t.slot_of_patch[i];
        const double spilled = w.snow[slot] * (1.0 - t.slot[slot].snow_holds);
        if (!(spilled > 0.0)) continue;
        w.snow[slot] -= spilled;
        const WeatherPatch& patch = set.patches[i];
        // What falls out of the scene, or into a pond, never was in the books.
        if (patch.runs_to >= set.patches.size()) continue;
        w.snow[t.slot_of_patch[patch.runs_to]] +=
            spilled * patch.area_m2 / set.patches[patch.runs_to].area_m2;
    }
}

namespace {

// Stores of a patch fill with what they lack, ice in them counted; then its ground soaks. Returns
// what is left of the water, kg.
double take_in(PatchLive& live, const PatchTables& t, std::uint32_t patch, double kg, double dt_s)
{
    const Spot spot = spot_of(live, t, patch);
    const CellConstants& k = constants_of(t, patch);
    double left = kg / t.set.patches[patch].area_m2;
    const auto fill = [&](std::size_t water, std::size_t ice, double capacity) {
        const double room = capacity - spot.at(water) - spot.at(ice);
        const double taken = std::clamp(left, 0.0, std::max(room, 0.0));
        spot.at(water) += taken;
        left -= taken;
    };
    fill(PETRICHOR_CELL_NUMBER(film), PETRICHOR_CELL_NUMBER(film_ice), k.film_capacity);
    fill(PETRICHOR_CELL_NUMBER(crack), PETRICHOR_CELL_NUMBER(crack_ice), k.crack_capacity);
    fill(PETRICHOR_CELL_NUMBER(puddle), PETRICHOR_CELL_NUMBER(puddle_ice), k.puddle_capacity);
    if (k.permeable && spot.at(PETRICHOR_CELL_NUMBER(surface_temp_c)) > 0.0) {
        const double soaks = spot.at(PETRICHOR_CELL_NUMBER(infiltration_mm_h)) * dt_s / 3600.0;
        const double taken = std::min(left, std::max(soaks, 0.0));
        spot.at(PETRICHOR_CELL_NUMBER(total_infiltration)) += taken;
        left -= taken;
    }
    return left * t.set.patches[patch].area_m2;
}

void show_run_on(PatchLive& live, const PatchTables& t, std::uint32_t patch, double kg, double dt_s)
{
    live.run_on_kg_m2_s[t.slot_of_patch[patch]] +=
        static_cast<float>(kg / (t.set.patches[patch].area_m2 * dt_s));
}

}  // namespace

namespace {

// A stream over ground: so wide, and so much heat passes (ours: water a few mm deep that tumbles).
constexpr double kStream_m = 0.3, kStream_w_m2_k = 500.0;
constexpr std::size_t kWarmedLayers = 3;  // of the ground, 7 cm: as deep as an hour reaches

double capacity_of_j_k(const PatchTables& t, std::uint32_t patch)
{
    double thick_m = 0.0;
    for (std::size_t k = 0; k < kWarmedLayers; ++k) thick_m += kGroundThickness_m[k];
    return thick_m * t.set.kinds[t.set.patches[patch].kind].surface.heat_capacity_j_m3_k *
           t.set.patches[patch].area_m2;
}
double ground_c(const Spot& spot)
{
    double sum = 0.0, thick_m = 0.0;
    for (std::size_t k = 0; k < kWarmedLayers; ++k) {
        sum += kGroundThickness_m[k] * spot.at(PETRICHOR_CELL_NUMBER(ground_temp_c) + k);
        thick_m += kGroundThickness_m[k];
    }
    return sum / thick_m;
}

// Heat for the ground of a patch: it melts the ice on it first, then warms it. Below snow the surface is
// the snow's.
void warm_ground(PatchLive& live, const PatchTables& t, std::uint32_t patch, double heat_j)
{
    const Spot spot = spot_of(live, t, patch);
    double left = heat_j;
    const auto melt = [&](std::size_t water, std::size_t ice) {
        if (!(left > 0.0)) return;
        const double area = t.set.patches[patch].area_m2;
        const double melted = std::min(spot.at(ice), left / (kLatentFusion * area));
        spot.at(ice) -= melted;
        spot.at(water) += melted;
        left -= melted * kLatentFusion * area;
    };
    melt(PETRICHOR_CELL_NUMBER(film), PETRICHOR_CELL_NUMBER(film_ice));
    melt(PETRICHOR_CELL_NUMBER(crack), PETRICHOR_CELL_NUMBER(crack_ice));
    melt(PETRICHOR_CELL_NUMBER(puddle), PETRICHOR_CELL_NUMBER(puddle_ice));
    const double warmer_k = left / capacity_of_j_k(t, patch);
    for (std::size_t k = 0; k < kWarmedLayers; ++k)
        spot.at(PETRICHOR_CELL_NUMBER(ground_temp_c) + k) += warmer_k;
    if (!(spot.at(kIce) > 0.0)) spot.at(PETRICHOR_CELL_NUMBER(surface_temp_c)) += warmer_k;
}

// Water that runs over a patch and gives it heat by what it touches. Returns its temperature, C.
double cooled_by_ground(PatchLive& live, const PatchTables& t, std::uint32_t patch, double kg,
                        double water_c, double dt_s)
{
    const double area = t.set.patches[patch].area_m2;
    const double touched_m2 = std::min(area, kStream_m * std::sqrt(area));
    const double water_j_k = kg * kWaterHeatCapacity;
    double heat = heat_to_ground_j(water_c, ground_c(spot_of(live, t, patch)), water_j_k,
                                   capacity_of_j_k(t, patch), kStream_w_m2_k * touched_m2 * dt_s);
    // What it loses at 0 C freezes where it comes to lie: by the patch's own weather.
    heat = std::min(heat, water_j_k * water_c);
    live.tap_heat.ground += heat;
    warm_ground(live, t, patch, heat);
    return water_c - heat / water_j_k;
}

}  // namespace

void let_water_in(PatchLive& live, const PatchTables& t, const SkyStep& sky,
                  const std::vector<PatchTap>& taps, const Ponds& ponds, PatchScratch& w)
{
    std::vector<float> level_m;
    if (!taps.empty() && ponds.level_m) level_m = ponds.level_m(live.pond_m3);
    for (const PatchTap& tap : taps) {
        double left = let_in_kg(tap, sky.begin_us, sky.end_us);
        double water_c = tap.temp_k - kZeroCelsiusK;
        live.let_in_kg += left;
        live.tap_heat.let_in += left * kWaterHeatCapacity * water_c;
        std::uint32_t runs_to = kRunsOut;
        for (const TapStretch& stretch : tap.stretches) {
            for (const std::uint32_t patch : stretch.way) {
                if (!(left > 0.0)) break;
                show_run_on(live, t, patch, left, sky.forcing.dt_s);
                water_c = cooled_by_ground(live, t, patch, left, water_c, sky.forcing.dt_s);
                const double before = left;
                left = take_in(live, t, patch, left, sky.forcing.dt_s);
                live.tap_heat.kept += (before - left) * kWaterHeatCapacity * water_c;
            }
            runs_to = stretch.runs_to;
            const std::size_t pond = runs_to & ~kToPond;
            if (runs_to == kRunsOut || pond >= level_m.size() ||
                static_cast<double>(level_m[pond]) < stretch.spill_m)
                break;
        }
        if (!(left > 0.0)) continue;
        const double heat_j = left * kWaterHeatCapacity * water_c;
        if (runs_to == kRunsOut) {
            live.tap_heat.out += heat_j;
        } else {
            live.tap_heat.ponds += heat_j;
            w.pond_let_in_m3[runs_to & ~kToPond] += left * 1e-3;
            w.pond_let_in_j[runs_to & ~kToPond] += heat_j;
        }
        pour_on(live, t, runs_to, left, w);
    }
}

void run_off(PatchLive& live, const PatchTables& t, double dt_s, PatchScratch& w)
{
    const PatchSet& set = t.set;
    for (const std::uint32_t i : t.downhill) {
        const WeatherPatch& patch = set.patches[i];
        const std::size_t slot = t.slot_of_patch[i];
        double passed = w.arriving[i];
        w.arriving[i] = 0.0;
        if (passed > 0.0) {
            show_run_on(live, t, i, passed, dt_s);
            passed = take_in(live, t, i, passed, dt_s);
        }
        const double shed = passed + w.drained[slot] * patch.area_m2;
        if (!(shed > 0.0)) continue;
        const double to_gutter = shed * patch.gutter_share;
        live.out_kg += to_gutter;
        pour_on(live, t, patch.runs_to, shed - to_gutter, w);
    }
}

namespace {

constexpr double kWaterAlbedo = 0.08, kIceAlbedo = 0.3;  // of clear ice on dark ground
constexpr double kWaterEmissivity = 0.97;
constexpr double kSnowConductivity_w_m_k = 0.25;
constexpr double kLeastWind_m_s = 0.1;
constexpr double kSeenIce_kg_m2 = 0.1;  // that shuts water off from the air

// What ponds see of sun, sky and wind: the mean of the ground that drains to them.
void view_from_ponds(const PatchLive& live, const PatchTables& t, PatchScratch& w)
{
    std::fill(w.pond_view.begin(), w.pond_view.end(), PatchScratch::PondView{});
    for (std::uint32_t i = 0; i < t.twin; ++i) {
        const WeatherPatch& patch = t.set.patches[i];
        if (patch.runs_to == kRunsOut || (patch.runs_to & kToPond) == 0) continue;
        PatchScratch::PondView& view = w.pond_view[patch.runs_to & ~kToPond];
        const std::size_t slot = t.slot_of_patch[i], lane = slot % kPatchLanes;
        double snow = 0.0;
        for (std::size_t k = 0; k < kSnowLayers; ++k)
            snow += number(live.blocks[slot / kPatchLanes], kThick + k, lane);
        view.area_m2 += patch.area_m2;
        view.light_w_m2 += patch.area_m2 * w.light[slot];
        view.longwave_w_m2 += patch.area_m2 * w.longwave[slot];
        view.wind += patch.area_m2 * w.wind[slot];
        view.snow_m += patch.area_m2 * snow;
    }
    for (PatchScratch::PondView& view : w.pond_view) {
        if (!(view.area_m2 > 0.0)) continue;
        view.light_w_m2 /= view.area_m2;
        view.longwave_w_m2 /= view.area_m2;
        view.wind /= view.area_m2;
        view.snow_m /= view.area_m2;
    }
}

PondAir air_over(const PatchScratch::PondView& view, const SkyStep& sky)
{
    const double wind = std::max(sky.wind_m_s * view.wind, kLeastWind_m_s);
    const double exchange = sky.pond_exchange_kg_m3 * wind;  // kg m-2 s-1
    constexpr double kZero = kZeroCelsiusK;
    const double cube = kZero * kZero * kZero;
    const auto surface = [&](double albedo, double latent, double full, double slope,
                             double& gain, double& loss) {
        gain = (1.0 - albedo) * view.light_w_m2 +
               kWaterEmissivity * (view.longwave_w_m2 - kStefanBoltzmann * cube * kZero) +
               exchange * (kAirHeatCapacity * (sky.air_k - kZero) +
                           latent * (sky.air_humidity - full));
        loss = 4.0 * kWaterEmissivity * kStefanBoltzmann * cube +
               exchange * (kAirHeatCapacity + latent * slope);
    };
    const double pressure = sky.forcing.pressure.at(0.5);
    const auto held = [&](double vapour_pa) { return specific_humidity(vapour_pa, pressure); };
    const double full = held(saturation_pressure_ice_pa(kZero));
    PondAir air;
    surface(kWaterAlbedo, kLatentVaporisation, full,
            held(saturation_pressure_water_pa(kZero + 1.0)) - full, air.gain_w_m2,
            air.loss_w_m2_k);
    // Snow on the ice is as bright as the snow beside it; what light comes through is little.
    const double albedo = view.snow_m > 0.01 ? 0.8 : kIceAlbedo;
    surface(albedo, kLatentSublimation, full, full - held(saturation_pressure_ice_pa(kZero - 1.0)),
            air.ice_gain_w_m2, air.ice_loss_w_m2_k);
    air.cover_m2_k_w = view.snow_m / kSnowConductivity_w_m_k;
    return air;
}

double of(const std::vector<PondShape>& shape, std::size_t pond)
{
    return pond < shape.size() ? shape[pond].depth_m * kWaterDensity : 0.0;
}

// Water that has run in brings the warmth of the air, that of taps its own; then the surface gains or loses.
void freeze_ponds(PatchLive& live, const PatchTables& t, const SkyStep& sky, const Ponds& ponds,
                  PatchScratch& w)
{
    const std::vector<PondShape> shape = ponds.shape(live.pond_m3);
    view_from_ponds(live, t, w);
    for (std::size_t i = 0; i < t.set.ponds; ++i) {
        const double water_kg_m2 = of(shape, i);
        double& heat = live.pond_heat_j_kg[i];
        if (!(water_kg_m2 > 1e-6)) {
            heat = 0.0;
            continue;
        }
        const double all_kg = water_kg_m2 * shape[i].area_m2;
        const double in_kg = w.pond_in_m3[i] * kWaterDensity;
        const double by_taps_kg = w.pond_let_in_m3[i] * kWaterDensity;
        const double share = std::clamp(in_kg / all_kg, 0.0, 1.0);
        const double of_air = kWaterHeatCapacity * std::max(sky.air_k - kZeroCelsiusK, 0.0);
        const double warm =
            in_kg > 0.0 ? (std::max(in_kg - by_taps_kg, 0.0) * of_air + w.pond_let_in_j[i]) / in_kg : 0.0;
        heat += share * (warm - heat);
        if (w.pond_view[i].area_m2 > 0.0)
            heat = step_pond_heat(heat, water_kg_m2, air_over(w.pond_view[i], sky),
                                  sky.forcing.dt_s);
    }
}

}  // namespace

void step_ponds(PatchLive& live, const PatchTables& t, const SkyStep& sky, const Ponds& ponds,
                PatchScratch& w)
{
    if (t.set.ponds == 0) return;
    const double dt_s = sky.forcing.dt_s;
    const bool thawed = sky.air_k > kZeroCelsiusK;
    std::vector<PondShape> before;
    if (ponds.shape) before = ponds.shape(live.pond_m3);
    for (std::size_t i = 0; i < t.set.ponds; ++i) {
        const double soaks = thawed && i < t.set.pond_soaks_mm_h.size()
                                 ? t.set.pond_soaks_mm_h[i] / 3600.0
                                 : 0.0;  // mm/s, kg m-2 s-1
        // Under ice the air takes no water.
        const bool shut = pond_ice_share(live.pond_heat_j_kg[i]) * of(before, i) > kSeenIce_kg_m2;
        const double rises = shut ? 0.0 : sky.open_water_kg_m2_s;
        w.pond_loss_m[i] = (rises + soaks) * dt_s * 1e-3;
    }
    if (ponds.step) {
        const PondStep done = ponds.step(live.pond_m3, w.pond_in_m3, w.pond_loss_m);
        live.out_kg += done.out_m3 * 1e3;
        live.pond_lost_kg += done.lost_m3 * 1e3;
    } else {
        for (const double in : w.pond_in_m3) live.out_kg += in * 1e3;
    }
    if (ponds.shape) freeze_ponds(live, t, sky, ponds, w);
    for (auto* row : {&w.pond_in_m3, &w.pond_let_in_m3, &w.pond_let_in_j})
        std::fill(row->begin(), row->end(), 0.0);
}

}  // namespace petrichor::weather::detail
