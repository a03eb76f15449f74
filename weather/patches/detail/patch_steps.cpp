#include "weather/patches/detail/patch_steps.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "weather/moment.h"
#include "weather/patches/detail/patch_snow.h"
#include "weather/patches/detail/patch_water.h"
#include "weather/physics/evaporation.h"
#include "weather/physics/exchange.h"
#include "weather/physics/humidity.h"
#include "weather/physics/solar.h"

namespace petrichor::weather::detail {

namespace {

constexpr double kMostBeamRatio = 10.0;
constexpr double kCos85 = 0.08715574274765817;
constexpr double kWaterAlbedo = 0.08, kWaterRoughness_m = 0.001, kSnowRoughness_m = 0.001;
constexpr int kSweepsDry = 2, kSweepsSnow = 6;
constexpr double kLeastLight_w_m2 = 1e-3;  // below it is night
constexpr std::size_t kChunkBlocks = 32;   // that a thread takes at a time

double direction_at_rad(const ForcingTable& table, std::int64_t us, double otherwise_deg)
{
    const double deg =
        has_every_row(table, Field::WindFrom) ? wind_from_deg_at(table, us) : otherwise_deg;
    return deg * (kPi / 180.0);
}

void set_sun(SkyStep& sky, const ForcingTable& table, const PatchParams& params, std::int64_t begin,
             std::int64_t length)
{
    sky.global = std::max(0.0, sky.forcing.shortwave.at(0.5));
    sky.diffuse = sky.global;
    const Site& site = table.site;
    if (!(sky.global > kLeastLight_w_m2) || !std::isfinite(site.latitude_deg) ||
        !std::isfinite(site.longitude_deg))
        return;
    double outside = 1361.0;
    std::size_t above = 0;
    const double north = params.north_deg * (kPi / 180.0);
    const auto turn = sine_cosine(north);
    for (std::size_t k = 0; k < SkyStep::kSuns; ++k) {
        const auto at =
            begin + static_cast<std::int64_t>((static_cast<double>(k) + 0.5) / SkyStep::kSuns *
                                              static_cast<double>(length));
        const SunDirection sun = sun_direction(at, site.latitude_deg, site.longitude_deg);
        outside = sun.extraterrestrial_w_m2;
        // North is -z turned clockwise.
        sky.sun[k] = {sun.east * turn.cos + sun.north * turn.sin, sun.up,
                      sun.east * turn.sin - sun.north * turn.cos};
        sky.sun_at[k] = visible_lookup(sky.sun[k]);
        if (!(sun.up > 0.0)) continue;
        ++above;
        sky.sum_up += sun.up;
        sky.sum_up_85 += std::max(sun.up, kCos85);
    }
    if (above == 0) return;
    const double up = sky.sum_up / static_cast<double>(above);
    const std::int64_t middle = begin + length / 2;
    if (has_every_row(table, Field::Diffuse))
        sky.diffuse = std::clamp(value_at(table, Field::Diffuse, middle), 0.0, sky.global);
    else
        sky.diffuse = sky.global * diffuse_fraction(sky.global, up, outside);
    // Between two rows about sunrise the file's line runs above what a sun so low can send: a wall
    // that faces it would get ten times of that. What the beam cannot bring is of all of the sky.
    const double zenith_rad = arc_cosine(std::min(up, 1.0));
    const double clear = clear_beam_w_m2(outside, zenith_rad, site.elevation_m);
    double most = clear;
    if (has_every_row(table, Field::Direct))
        most = std::min(most, std::max(0.0, value_at(table, Field::Direct, middle)));
    const double glowing = sky.diffuse;
    sky.diffuse = std::max(sky.diffuse, sky.global - most * up);
    if (!(glowing > kLeastLight_w_m2)) return;
    const double direct = (sky.global - sky.diffuse) / up;
    sky.glow = glow_below(perez_glow(glowing, direct, outside, zenith_rad), glowing, sky.diffuse,
                          (clear - direct) * std::max(up, kCos85));
}

void set_wind(SkyStep& sky, const ForcingTable& table, const PatchParams& params,
              std::int64_t middle, bool shares_asked)
{
    const double speed = std::max(0.0, sky.forcing.wind.at(0.5));
    sky.wind_from_rad =
        direction_at_rad(table, middle, params.wind_from_deg) + params.north_deg * (kPi / 180.0);
    const auto from = sine_cosine(sky.wind_from_rad);
    sky.wind_x = -speed * from.sin;
    sky.wind_z = speed * from.cos;
    sky.rate_mm_h = sky.forcing.precip * params.model.precip_factor * 3600.0;
    if (!(sky.rate_mm_h > 0.0)) {
        if (!shares_asked) return;
        sky.rate_mm_h = 1.0;
    }
    const RainFan fan = rain_fan(sky.wind_x, sky.wind_z, sky.rate_mm_h);
    std::array<float, kVisibleBits> weight{};
    for (std::size_t i = 0; i < fan.from.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k)
            weight[static_cast<std::size_t>(fan.from[i].texel[k])] +=
                static_cast<float>(fan.weight[i]) * fan.from[i].weight[k];
    for (std::size_t i = 0; i < weight.size(); ++i)
        if (weight[i] > 0.0f) sky.rain_from.push_back({static_cast<std::int16_t>(i), weight[i]});
    sky.snow_from = visible_lookup(snow_direction(sky.wind_x, sky.wind_z));
}

void set_open_water(SkyStep& sky, const ForcingTable& table)
{
    PenmanForcing p;
    p.air_temp_k = sky.air_k;
    p.rel_humidity_pct = sky.forcing.rh_pct.at(0.5);
    p.pressure_pa = sky.forcing.pressure.at(0.5);
    p.wind_m_s = std::max(sky.forcing.wind.at(0.5), 0.1);
    const double squared = sky.air_k * sky.air_k;
    p.net_radiation_w_m2 =
        (1.0 - kWaterAlbedo) * sky.global + sky.longwave - kStefanBoltzmann * squared * squared;
    p.exchange_coefficient =
        neutral_exchange(table.site.wind_height_m, table.site.temp_height_m, kWaterRoughness_m);
    sky.open_water_kg_m2_s = std::max(0.0, penman_monteith(p).rate_kg_m2_s);
    sky.air_humidity =
        specific_humidity(vapour_pressure_pa(sky.air_k, p.rel_humidity_pct), p.pressure_pa);
    sky.air_density_kg_m3 = air_density_kg_m3(sky.air_k, sky.air_humidity, p.pressure_pa);
    sky.pond_exchange_kg_m3 = sky.air_density_kg_m3 * p.exchange_coefficient;
    sky.wind_m_s = sky.forcing.wind.at(0.5);
    sky.wind_10m_m_s = sky.wind_m_s * logarithm(10.0 / kSnowRoughness_m) /
                       logarithm(std::max(table.site.wind_height_m, 0.1) / kSnowRoughness_m);
}

// Sun and sky on a slot, W/m2.
double first_light(const PatchSlot& s, const SkyStep& sky)
{
    double beam = 0.0;
    for (std::size_t k = 0; k < SkyStep::kSuns; ++k) {
        const double facing = dot(s.normal, sky.sun[k]);
        if (facing > 0.0 && sky.sun[k].y > 0.0)
            beam += facing * visible_share(s.visible, sky.sun_at[k]);
    }
    SkySeen seen{s.sky_share, s.horizon, 0.0, s.sine_tilt};
    double direct = 0.0;
    if (sky.sum_up > 0.0) {
        direct = (sky.global - sky.diffuse) * std::min(beam / sky.sum_up, kMostBeamRatio);
        seen.sun = beam / sky.sum_up_85;
    }
    return direct + sky_light_w_m2(sky.diffuse, sky.glow, seen);
}

double mean_over_links(const PatchTables& t, const std::vector<double>& values, std::size_t slot)
{
    const std::uint32_t from = t.link_begin[slot], to = t.link_begin[slot + 1];
    if (from == to) return 0.0;
    double sum = 0.0;
    for (std::uint32_t k = from; k < to; ++k) sum += values[t.links[k]];
    return sum / static_cast<double>(to - from);
}

struct Covered {
    double snow;  // share
    double depth_m;
};
Covered snow_over(const CellBlock& block, std::size_t lane, const CellConstants& k)
{
    double depth = 0.0;
    for (std::size_t i = 0; i < kSnowLayers; ++i)
        depth += number(block, PETRICHOR_CELL_NUMBER(snow_thickness) + i, lane);
    if (!(depth > 0.0)) return {0.0, 0.0};
    return {hyperbolic_tangent_positive(depth * k.inverse_cover_depth), depth};
}

double albedo_of(const CellBlock& block, std::size_t lane, const CellConstants& k)
{
    const double film = number(block, PETRICHOR_CELL_NUMBER(film), lane);
    const double wet = std::min(film * k.inverse_film_capacity, 1.0);
    const double bare = k.albedo_dry + wet * (k.albedo_wet - k.albedo_dry);
    const double cover = snow_over(block, lane, k).snow;
    const double snow = number(block, PETRICHOR_CELL_NUMBER(snow_albedo), lane);
    return std::min(bare + cover * (snow - bare), 0.98);
}

double fourth(double kelvin)
{
    return kelvin * kelvin * kelvin * kelvin;
}

// What reaches a slot before patches have sent light to each other, and the shares of rain, snow
// and wind.
void receive(std::size_t slot, const PatchLive& live, const PatchTables& t, const SkyStep& sky,
             double twin_k, double outside_albedo, PatchScratch& w)
{
    const PatchSlot& s = t.slot[slot];
    const std::size_t b = slot / kPatchLanes, lane = slot % kPatchLanes;
    w.longwave[slot] =
        s.sky_share * (sky.longwave + warm_horizon_w_m2(s.log_secant, sky.cloud, sky.air_k)) +
        s.patch_share * mean_over_links(t, live.radiosity, slot) +
        s.out_share * kStefanBoltzmann * fourth(twin_k);
    if (sky.global > kLeastLight_w_m2) {
        w.first_light[slot] = first_light(s, sky) + s.out_share * outside_albedo * sky.global;
        w.albedo[slot] = albedo_of(live.blocks[b], lane, t.groups[t.group_of_block[b]].constants);
        w.light[slot] = w.first_light[slot];
        w.sent[slot] = w.albedo[slot] * w.light[slot];
    } else {
        w.light[slot] = 0.0;
    }
    w.wind[slot] = 1.0 - 0.75 * blocking_from(s.blocked, sky.wind_from_rad);
    if (sky.rain_from.empty()) {
        w.rain[slot] = w.snow[slot] = 1.0;
        return;
    }
    float hidden = 0.0f;  // so that open sky is exactly 1
    for (const SkyStep::Bit& bit : sky.rain_from)
        if (!sees(s.visible, bit.texel)) hidden += bit.weight;
    const double open = std::max(0.0, 1.0 - static_cast<double>(hidden));
    w.rain[slot] =
        rain_on_plane(s.normal, sky.wind_x, sky.wind_z, sky.rate_mm_h) * open * s.wall_factor;
    w.snow[slot] = std::max(0.0, s.normal.y) *
                   (0.5 * visible_share(s.visible, sky.snow_from) + 0.5 * s.zenith);
}

// A block of eight through the step.
void run_block(std::size_t b, PatchLive& live, const PatchTables& t, const SkyStep& sky,
               const GroupSteps& constants, const PatchParams& params, PatchScratch& w)
{
    static const AdvanceBlock advance = fastest_advance_block();
    const std::uint32_t g = t.group_of_block[b];
    const PatchGroup& group = t.groups[g];
    const PatchKind& kind = t.set.kinds[group.kind];
    PlaceBlock place_block;
    CellBlock& block = live.blocks[b];
    double drained_before[kPatchLanes], frost_before[kPatchLanes];
    for (std::size_t lane = 0; lane < kPatchLanes; ++lane) {
        const std::size_t slot = b * kPatchLanes + lane;
        CellPlace<double> place = station_place(1.0, params.model.precip_factor);
        place.shortwave_factor = w.light[slot] > 0.0 ? w.light[slot] / sky.global : 0.0;
        place.longwave_offset = w.longwave[slot] - sky.longwave;
        place.wind_factor = w.wind[slot];
        place.rain_factor = w.rain[slot];
        place.snow_factor = w.snow[slot];
        place.gravity_across = std::clamp(t.slot[slot].normal.y, -1.0, 1.0);
        double numbers[kPlaceNumbers];
        std::memcpy(numbers, &place, sizeof place);
        for (std::size_t i = 0; i < kPlaceNumbers; ++i) place_block.numbers[i][lane] = numbers[i];
        drained_before[lane] = number(block, PETRICHOR_CELL_NUMBER(total_drainage), lane);
        frost_before[lane] = number(block, PETRICHOR_CELL_NUMBER(total_sublimation), lane);
    }
    advance(block, place_block, &sky.forcing, 1, group.constants, constants[g]);
    for (std::size_t lane = 0; lane < kPatchLanes; ++lane) {
        const std::size_t slot = b * kPatchLanes + lane;
        w.drained[slot] =
            number(block, PETRICHOR_CELL_NUMBER(total_drainage), lane) - drained_before[lane];
        const double grown =
            frost_before[lane] - number(block, PETRICHOR_CELL_NUMBER(total_sublimation), lane);
        const double ice = number(block, PETRICHOR_CELL_NUMBER(film_ice), lane);
        live.hoar[slot] = std::clamp(live.hoar[slot] + grown, 0.0, ice);
        const Covered cover = snow_over(block, lane, group.constants);
        const double e =
            group.constants.emissivity +
            cover.snow * (group.constants.snow_emissivity - group.constants.emissivity);
        const double surface_k =
            number(block, PETRICHOR_CELL_NUMBER(surface_temp_c), lane) + kZeroCelsiusK;
        live.radiosity[slot] =
            kind.like_air ? kStefanBoltzmann * fourth(sky.air_k)
                          : e * kStefanBoltzmann * fourth(surface_k) + (1.0 - e) * w.longwave[slot];
        live.rain_share[slot] = static_cast<float>(w.rain[slot]);
        live.wind_factor[slot] = static_cast<float>(w.wind[slot]);
        live.shortwave_w_m2[slot] = static_cast<float>(w.light[slot]);
        live.longwave_w_m2[slot] = static_cast<float>(w.longwave[slot]);
        live.run_on_kg_m2_s[slot] = 0.0f;
    }
}

}  // namespace

SkyStep make_sky_step(const ForcingTable& table, const PatchParams& params, std::int64_t begin,
                      std::int64_t length, bool shares_asked)
{
    SkyStep sky;
    sky.begin_us = begin;
    sky.end_us = begin + length;
    sky.forcing = make_step_forcing(table, begin, length, SunUse::FlatOpenGround);
    sky.longwave = sky.forcing.longwave.at(0.5);
    sky.air_k = sky.forcing.air_c.at(0.5) + kZeroCelsiusK;
    sky.cloud = std::clamp(value_at(table, Field::Cloud, begin + length / 2), 0.0, 1.0);
    set_sun(sky, table, params, begin, length);
    set_wind(sky, table, params, begin + length / 2, shares_asked);
    set_open_water(sky, table);
    return sky;
}

GroupSteps make_group_steps(const PatchTables& tables, double dt_s, double substep_s)
{
    GroupSteps steps;
    for (const PatchGroup& group : tables.groups)
        steps.push_back(make_step_constants(group.constants, dt_s, substep_s));
    return steps;
}

PatchScratch::PatchScratch(const PatchTables& t)
{
    for (auto* row :
         {&light, &sent, &first_light, &longwave, &albedo, &rain, &snow, &wind, &drained})
        row->assign(t.slots(), 0.0);
    arriving.assign(t.set.patches.size(), 0.0);
    splash_left.assign(t.set.patches.size(), 0.0);
    drifts_kg.assign(t.set.patches.size(), 0.0);
    pond_in_m3.assign(t.set.ponds, 0.0);
    pond_loss_m.assign(t.set.ponds, 0.0);
    pond_let_in_m3.assign(t.set.ponds, 0.0);
    pond_let_in_j.assign(t.set.ponds, 0.0);
    pond_view.assign(t.set.ponds, {});
}

void advance_patches(PatchLive& live, const PatchTables& t, const SkyStep& sky,
                     const GroupSteps& constants, const PatchParams& params, const Ponds& ponds,
                     PatchScratch& w)
{
    const std::size_t chunk_slots = kChunkBlocks * kPatchLanes;
    const auto over_slots = [&](const auto& body) {
        parallel_for((t.slots() + chunk_slots - 1) / chunk_slots, params.threads,
                     [&](std::size_t c) {
                         const std::size_t to = std::min(t.slots(), (c + 1) * chunk_slots);
                         for (std::size_t i = c * chunk_slots; i < to; ++i) body(i);
                     });
    };
    const std::size_t twin = t.slot_of_patch[t.twin];
    const CellState open = cell_in(live.blocks[twin / kPatchLanes], twin % kPatchLanes);
    const bool snowy = open.snow_ice[0] > 0.0;
    const double outside = snowy ? params.outside_snow_albedo : params.outside_albedo;
    over_slots([&](std::size_t i) {
        receive(i, live, t, sky, open.surface_temp_c + kZeroCelsiusK, outside, w);
    });
    if (sky.global > kLeastLight_w_m2) {
        const int sweeps = snowy ? kSweepsSnow : kSweepsDry;
        for (int k = 0; k < sweeps; ++k) {
            over_slots([&](std::size_t i) {
                w.light[i] =
                    w.first_light[i] + t.slot[i].patch_share * mean_over_links(t, w.sent, i);
            });
            if (k + 1 < sweeps)
                over_slots([&](std::size_t i) { w.sent[i] = w.albedo[i] * w.light[i]; });
        }
    }
    if (!sky.rain_from.empty()) share_what_falls(live, t, w);
    parallel_for((t.blocks() + kChunkBlocks - 1) / kChunkBlocks, params.threads,
                 [&](std::size_t c) {
                     const std::size_t to = std::min(t.blocks(), (c + 1) * kChunkBlocks);
                     for (std::size_t b = c * kChunkBlocks; b < to; ++b)
                         run_block(b, live, t, sky, constants, params, w);
                 });
    drift_snow(live, t, sky, w);
    slide_snow(live, t, sky.forcing.dt_s, w);
    let_water_in(live, t, sky, params.taps, ponds, w);
    run_off(live, t, sky.forcing.dt_s, w);
    step_ponds(live, t, sky, ponds, w);
}

}  // namespace petrichor::weather::detail
