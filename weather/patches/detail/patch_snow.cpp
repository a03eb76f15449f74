#include "weather/patches/detail/patch_snow.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formulas/noise/noise.h"
#include "weather/patches/detail/patch_spot.h"
#include "weather/patches/detail/patch_water.h"
#include "weather/patches/moving_snow.h"
#include "weather/physics/snow_simple.h"

namespace petrichor::weather::detail {

namespace {

constexpr double kHeapDensity_kg_m3 = 350.0;
constexpr int kReposePasses = 8;
constexpr double kTanDry = 1.0, kTanMoist = 1.4281480067421144;  // of 45 and 55 degrees
constexpr double kLeastUp = 0.5;                                 // a heap lies on what faces up
constexpr double kThrown = 0.7, kThrownOn = 0.3;                 // of a slab, where it lands and where that lands (ours)
constexpr double kThrownUp_m = 0.15;                             // no higher than a kerb
// Of the time that a wet pack holds, times its pull (ours): a metal roof of 30 degrees is bare after
// two hours in the mean.
constexpr double kSlidesPerHour = 2.0;
// Of drifts (ours): wind has its full load after so long a way over loose snow, and drops it over so
// long a way in the lee of what nobody has measured. What is this dense or frozen into a crust stays, and drifts end this
// deep, and no higher than what they lie behind.
constexpr double kLoads_m = 100.0, kDrops_m = 5.0;
constexpr double kLoose_kg_m3 = 300.0, kDriftDensity_kg_m3 = 300.0;
constexpr double kDeepestDrift_m = 1.0;
constexpr double kMostOfALayer = 0.9;  // in a step, so that no pack is without its upper layer

// A piece of a pack, kg and J for a whole patch.
struct Snow {
    double ice_kg = 0.0, liquid_kg = 0.0, heat_j = 0.0, volume_m3 = 0.0;
    double mass_kg() const { return ice_kg + liquid_kg; }
    void add(const Snow& more)
    {
        ice_kg += more.ice_kg;
        liquid_kg += more.liquid_kg;
        heat_j += more.heat_j;
        volume_m3 += more.volume_m3;
    }
    Snow share(double of) const
    {
        return {ice_kg * of, liquid_kg * of, heat_j * of, volume_m3 * of};
    }
};
Snow take_from_layer(const Spot& spot, std::size_t i, double share, double area_m2)
{
    double& ice = spot.at(kIce + i);
    double& liquid = spot.at(kLiquid + i);
    double& thick = spot.at(kThick + i);
    Snow taken;
    taken.ice_kg = ice * share * area_m2;
    taken.liquid_kg = liquid * share * area_m2;
    taken.volume_m3 = thick * share * area_m2;
    taken.heat_j = (ice * kIceHeatCapacity + liquid * kWaterHeatCapacity) * spot.at(kTemp + i) *
                   share * area_m2;
    ice -= ice * share;
    liquid -= liquid * share;
    thick -= thick * share;
    if (share >= 1.0) ice = liquid = thick = spot.at(kTemp + i) = 0.0;
    return taken;
}
// Takes a share of every layer.
Snow take_snow(const Spot& spot, double share, double area_m2)
{
    Snow taken;
    for (std::size_t i = 0; i < kSnowLayers; ++i)
        taken.add(take_from_layer(spot, i, share, area_m2));
    return taken;
}
// Lays it on top; the upper layer takes it all, and is cut into layers by the next step.
void lay_snow(const Spot& spot, const Snow& snow, double volume_m3, double area_m2)
{
    double& ice = spot.at(kIce);
    double& liquid = spot.at(kLiquid);
    double& temp = spot.at(kTemp);
    const double heat =
        (ice * kIceHeatCapacity + liquid * kWaterHeatCapacity) * temp + snow.heat_j / area_m2;
    ice += snow.ice_kg / area_m2;
    liquid += snow.liquid_kg / area_m2;
    spot.at(kThick) += volume_m3 / area_m2;
    const double capacity = ice * kIceHeatCapacity + liquid * kWaterHeatCapacity;
    temp = capacity > 0.0 ? std::min(heat / capacity, 0.0) : 0.0;
}
double depth_of(const Spot& spot)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i) sum += spot.at(kThick + i);
    return sum;
}
bool wet_at_its_base(const Spot& spot)
{
    std::size_t base = kSnowLayers;
    while (base > 0 && !(spot.at(kIce + base - 1) > 0.0)) --base;
    return base > 0 && spot.at(kLiquid + base - 1) > 0.0;
}

// Heaps relax towards the angle at which they rest: half of what is too much goes to the lowest
// neighbour.
void settle_heaps(PatchLive& live, const PatchTables& t)
{
    const PatchSet& set = t.set;
    if (set.beside_begin.empty()) return;
    for (int pass = 0; pass < kReposePasses; ++pass) {
        for (std::uint32_t i = 0; i < t.twin; ++i) {
            const Spot from = spot_of(live, t, i);
            const double depth = depth_of(from);
            if (!(depth > 0.0) || set.patches[i].normal.y < kLeastUp) continue;
            const double height = set.patches[i].height_m + depth;
            double steepest = 0.0;
            std::uint32_t lowest = kNoPatch;
            for (std::uint32_t k = set.beside_begin[i]; k < set.beside_begin[i + 1]; ++k) {
                const std::uint32_t j = set.beside[k];
                if (set.patches[j].normal.y < kLeastUp) continue;
                const double drop =
                    height - set.patches[j].height_m - depth_of(spot_of(live, t, j));
                const double moist = from.at(kLiquid) > 0.0 ? kTanMoist : kTanDry;
                const double excess = drop - moist * static_cast<double>(set.beside_m[k]);
                if (excess > steepest) {
                    steepest = excess;
                    lowest = j;
                }
            }
            if (lowest == kNoPatch) continue;
            const double area = set.patches[i].area_m2, area_to = set.patches[lowest].area_m2;
            // Half of the excess, shared so that the neighbour does not rise above it.
            const double moved = std::min(depth, 0.5 * steepest * area_to / (area + area_to));
            const Snow snow = take_snow(from, moved / depth, area);
            lay_snow(spot_of(live, t, lowest), snow, snow.volume_m3, area_to);
        }
    }
}

// A slab breaks where it lands: most of it is thrown to what lies beside, and some of that on, so that what has come down below a
// strip of a roof is a heap with soft sides and not the square of its patch.
void spread(std::uint32_t at, const Snow& slab, PatchLive& live, const PatchTables& t)
{
    const PatchSet& set = t.set;
    const auto lay = [&](std::uint32_t i, const Snow& snow) {
        lay_snow(spot_of(live, t, i), snow, snow.mass_kg() / kHeapDensity_kg_m3, set.patches[i].area_m2);
    };
    // Not uphill onto what stands there, nor onto a roof that it would slide from again.
    const auto takes = [&](std::uint32_t from, std::uint32_t to) {
        return set.patches[to].normal.y >= kLeastUp && set.patches[to].height_m < set.patches[from].height_m + kThrownUp_m &&
               !(t.slot[t.slot_of_patch[to]].slide_pull > 0.0);
    };
    const auto beside = [&](std::uint32_t i) {
        std::vector<std::uint32_t> all;
        if (i + 1 >= set.beside_begin.size()) return all;
        for (std::uint32_t k = set.beside_begin[i]; k < set.beside_begin[i + 1]; ++k)
            if (takes(i, set.beside[k])) all.push_back(set.beside[k]);
        return all;
    };
    const auto near = beside(at);
    if (near.empty()) return lay(at, slab);
    lay(at, slab.share(1.0 - kThrown));
    const double each = kThrown / static_cast<double>(near.size());
    for (const std::uint32_t i : near) {
        const auto far = beside(i);
        lay(i, slab.share(far.empty() ? each : each * (1.0 - kThrownOn)));
        for (const std::uint32_t j : far) lay(j, slab.share(each * kThrownOn / static_cast<double>(far.size())));
    }
}

// A slab on its way: it takes along what lies on the slope below it, and is a heap where that ends.
// Returns whether it came to lie on a patch.
bool release(std::uint32_t first, PatchLive& live, const PatchTables& t, PatchScratch& w)
{
    Snow slab;
    std::uint32_t at = first;
    while (at < t.set.patches.size() && t.slot[t.slot_of_patch[at]].slide_pull > 0.0) {
        slab.add(take_snow(spot_of(live, t, at), 1.0, t.set.patches[at].area_m2));
        live.slid_hours[t.slot_of_patch[at]] = 0.0;
        at = t.set.patches[at].runs_to;
    }
    if (at >= t.set.patches.size()) {
        pour_on(live, t, at, slab.mass_kg(), w);
        return false;
    }
    spread(at, slab, live, t);
    return true;
}

}  // namespace

std::vector<double> slide_patience(const PatchTables& t, const PatchSet& set)
{
    const std::size_t count = set.patches.size();
    // The patch at the eaves below, by which a strip of the roof is known.
    std::vector<std::uint32_t> end(count, kNoPatch);
    for (auto it = t.downhill.rbegin(); it != t.downhill.rend(); ++it) {
        if (!(t.slot[t.slot_of_patch[*it]].slide_pull > 0.0)) continue;
        const std::uint32_t to = set.patches[*it].runs_to;
        end[*it] = to < count && end[to] != kNoPatch ? end[to] : *it;
    }
    const auto own = [](std::uint32_t strip) {
        const auto u = static_cast<double>(shared::hash_f(strip + 1u));
        return -logarithm(std::clamp(1.0 - u, 1e-3, 1.0));
    };
    std::vector<double> patience(count, 0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (end[i] != i) continue;
        double least = own(i), among = 1.0;
        if (i + 1 < set.beside_begin.size()) {
            for (std::uint32_t k = set.beside_begin[i]; k < set.beside_begin[i + 1]; ++k) {
                const std::uint32_t strip = end[set.beside[k]];
                if (strip == kNoPatch || strip == i) continue;
                least = std::min(least, own(strip));
                among += 1.0;
            }
        }
        patience[i] = least * among;  // the least of n has the n-th part of their mean
    }
    for (std::uint32_t i = 0; i < count; ++i)
        if (end[i] != kNoPatch) patience[i] = patience[end[i]];
    return patience;
}

void slide_snow(PatchLive& live, const PatchTables& t, double dt_s, PatchScratch& w)
{
    bool slid = false;
    for (const std::uint32_t i : t.shedding) {
        const std::size_t slot = t.slot_of_patch[i];
        double& hours = live.slid_hours[slot];
        if (!wet_at_its_base(spot_of(live, t, i))) {
            hours = 0.0;  // bare, or frozen to the roof
            continue;
        }
        hours += kSlidesPerHour * t.slot[slot].slide_pull * dt_s / 3600.0;
        if (hours >= t.slide_patience[i] && release(i, live, t, w)) slid = true;
    }
    if (slid) settle_heaps(live, t);
}

namespace {

// What the wind drops on a patch with snow so deep, kg/m2, of a load of so many kg through each metre
// across it.
double dropped_kg_m2(const PatchTables& t, std::uint32_t patch, double wind_from_rad, double load_kg_m,
                     double depth_m)
{
    const auto behind = [&](double share_1_m, double height_m) {
        const double highest_m = std::min(height_m, kDeepestDrift_m);
        const double room_m = std::max(0.0, highest_m - depth_m);
        if (!(room_m > 0.0)) return 0.0;
        return std::min(load_kg_m * share_1_m * room_m / highest_m, room_m * kDriftDensity_kg_m3);
    };
    if (t.set.upwind.empty()) return behind(1.0 / kDrops_m, kDeepestDrift_m);
    const double turn = wind_from_rad / (2.0 * kPi);
    const double at = (turn - std::floor(turn)) * kWindClasses;
    const auto low = static_cast<std::size_t>(at) % kWindClasses;
    const double part = at - std::floor(at);
    double sum = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
        const Upwind& one = t.set.upwind[patch][(low + k) % kWindClasses];
        const auto height_m = static_cast<double>(one.height_m);
        const double share = lee_share_1_m(static_cast<double>(one.distance_m), height_m);
        sum += (k == 0 ? 1.0 - part : part) * behind(share, height_m);
    }
    return sum;
}

}  // namespace

void drift_snow(PatchLive& live, const PatchTables& t, const SkyStep& sky, PatchScratch& w)
{
    const double dry_m_s = drift_threshold_m_s(sky.air_k, false);
    if (!(sky.wind_10m_m_s > dry_m_s)) return;
    const double open = snow_friction_m_s(sky.wind_10m_m_s);
    const double dt_s = sky.forcing.dt_s;
    // What the wind could take and drop, kg.
    double loose_kg = 0.0, room_kg = 0.0;
    const double full_kg_m_s =
        saltation_kg_m_s(open, snow_friction_m_s(dry_m_s), sky.air_density_kg_m3);
    for (std::uint32_t i = 0; i < t.twin; ++i) {
        w.drifts_kg[i] = 0.0;
        const std::size_t slot = t.slot_of_patch[i];
        const WeatherPatch& patch = t.set.patches[i];
        const PatchSlot& s = t.slot[slot];
        // Not in rooms, not on walls, not among leaves and blades.
        if (patch.normal.y < kLeastUp || !(s.sky_share > 0.0) ||
            !t.set.kinds[patch.kind].holds_by_tilt)
            continue;
        const Spot spot = spot_of(live, t, i);
        const double ice = spot.at(kIce), thick = spot.at(kThick);
        const bool wet = spot.at(kLiquid) > 0.0;
        const double threshold = snow_friction_m_s(
            drift_threshold_m_s(wet ? sky.air_k : kZeroCelsiusK + spot.at(kTemp), wet));
        const double here = open * w.wind[slot];
        if (here > threshold) {
            if (!(ice > 0.0) || ice > kLoose_kg_m3 * thick) continue;
            const double takes = saltation_kg_m_s(here, threshold, sky.air_density_kg_m3) *
                                 dt_s / kLoads_m;
            w.drifts_kg[i] = -std::min(takes, ice + spot.at(kLiquid)) * patch.area_m2;
            loose_kg -= w.drifts_kg[i];
        } else {
            const double slow = 1.0 - here / threshold;
            w.drifts_kg[i] = dropped_kg_m2(t, i, sky.wind_from_rad, full_kg_m_s * dt_s, depth_of(spot)) *
                             slow * s.snow_holds * s.sky_share * patch.area_m2;
            room_kg += w.drifts_kg[i];
        }
    }
    // Over ground without a lee as much comes as goes.
    const double moved_kg = std::min(loose_kg, room_kg);
    if (!(moved_kg > 0.0)) return;
    Snow air;
    for (std::uint32_t i = 0; i < t.twin; ++i) {
        if (!(w.drifts_kg[i] < 0.0)) continue;
        const Spot spot = spot_of(live, t, i);
        const double area = t.set.patches[i].area_m2;
        const double all_kg = (spot.at(kIce) + spot.at(kLiquid)) * area;
        const double share =
            std::min(kMostOfALayer, -w.drifts_kg[i] * (moved_kg / loose_kg) / all_kg);
        air.add(take_from_layer(spot, 0, share, area));
    }
    for (std::uint32_t i = 0; i < t.twin; ++i) {
        if (!(w.drifts_kg[i] > 0.0)) continue;
        const Snow part = air.share(w.drifts_kg[i] / room_kg);
        lay_snow(spot_of(live, t, i), part, part.mass_kg() / kDriftDensity_kg_m3,
                 t.set.patches[i].area_m2);
    }
}

}  // namespace petrichor::weather::detail
