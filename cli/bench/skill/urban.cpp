#include "cli/bench/skill/urban.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "film/weather/patch_weather.h"
#include "scene/patches/patches.h"
#include "scene/patches/surfaces.h"
#include "weather/patches/patch_weather.h"
#include "weather/patches/sky_light.h"
#include "weather/patches/visibility.h"
#include "weather/physics/constants.h"
#include "weather/physics/solar.h"

namespace petrichor::cli {
namespace {

using weather::Field;

constexpr std::int64_t kHour_us = 3600LL * weather::kMicrosPerSecond;
constexpr float kReach_m = 80.0f;
constexpr float kCell_m = 0.75f;
constexpr std::uint32_t kMostPatches = 16000;
constexpr int kRays = 1024;
// Of them those within 75 degrees of where a sensor looks: the flat window of its pyrgeometer
// (CNR1: CG3) sees a cone of 150 degrees. They come first, in the order of the sine's square.
constexpr int kHeatRays = 955;
constexpr int kSuns = 12;  // of an hour
constexpr double kMostBeamRatio = 10.0;
constexpr double kClear = 0.1;  // of cloud
constexpr double kCos85 = 0.08715574274765817;

// Where a sensor looks, by UrbanFace.
constexpr std::array<glm::vec3, kUrbanFaces> kLooks{glm::vec3{0, 1, 0}, {0, -1, 0}, {0, 0, -1},
                                                    {1, 0, 0},          {0, 0, 1},  {-1, 0, 0}};

constexpr std::uint32_t kSky = 0xffffffffu, kOutside = 0xfffffffeu, kDark = 0xfffffffdu;

// parametersforsolweig_*.json of the data, as the albedos are (urban_scene).
constexpr std::pair<std::string_view, double> kEmissivity[] = {
    {"asphalt", 0.95}, {"roof_tile", 0.95}, {"brick", 0.90}, {"lawn", 0.94}, {"soil", 0.94}};

// Of the walls of houses, which rasters show without windows: what the town models of WRF take
// (PWIN, Salamanca et al. 2010).
constexpr double kGlassShare = 0.2;
// Of two clear panes; from the outer one to the room.
constexpr double kGlassEmissivity = 0.84, kGlassTakes = 0.15, kGlassRoom_w_m2_k = 3.2;

// What a sensor sees: cosine-weighted rays of equal weight, and the sky by the bits of a patch.
struct Sensor {
    weather::Direction look;
    std::vector<std::uint32_t> seen;
    weather::SkyShares sky;
    double sky_share = 0.0, outside_share = 0.0;
    // Of what the pyrgeometer sees; the sky's mean of ln sec z.
    double heat_sky = 0.0, heat_outside = 0.0, log_secant = 0.0, ground_share = 0.0;
    std::array<double, kUrbanFaces> wall_share{};  // by the side that they stand on
    double walls() const
    {
        return wall_share[kFaceNorth] + wall_share[kFaceEast] + wall_share[kFaceSouth] +
               wall_share[kFaceWest];
    }
};

std::size_t side_of(const glm::vec3& way)
{
    if (std::abs(way.x) > std::abs(way.z)) return way.x > 0.0f ? kFaceEast : kFaceWest;
    return way.z > 0.0f ? kFaceSouth : kFaceNorth;
}

glm::vec3 ray_of(const glm::vec3& n, int r)
{
    const float u = (static_cast<float>(r) + 0.5f) / static_cast<float>(kRays);
    const float turn = 2.0f * std::numbers::pi_v<float> * 0.61803399f * static_cast<float>(r);
    const glm::vec3 t = std::abs(n.y) > 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 b = glm::cross(n, t);
    return std::sqrt(u) * (std::cos(turn) * t + std::sin(turn) * b) + std::sqrt(1.0f - u) * n;
}

Sensor sensor_of(const scene::Patches& patches, const scene::Tracer& tracer, const glm::vec3& from,
                 const glm::vec3& look)
{
    Sensor s;
    s.look = {static_cast<double>(look.x), static_cast<double>(look.y),
              static_cast<double>(look.z)};
    double sky = 0.0, outside = 0.0;
    for (int r = 0; r < kRays; ++r) {
        const glm::vec3 d = ray_of(look, r);
        const scene::RayHit hit = tracer.nearest({from, d});
        const double heat = r < kHeatRays ? 1.0 / kHeatRays : 0.0;
        if (!hit.hit()) {
            s.seen.push_back(d.y > 0.0f ? kSky : kOutside);
            (d.y > 0.0f ? sky : outside) += 1.0 / kRays;
            (d.y > 0.0f ? s.heat_sky : s.heat_outside) += heat;
            if (d.y > 0.0f) s.log_secant -= heat * std::log(static_cast<double>(d.y));
            continue;
        }
        const glm::vec3 n = tracer.triangles().normal(hit.triangle);
        const auto patch = scene::patch_at(patches, tracer.triangles().point(hit.triangle, hit.at),
                                           hit.back ? -n : n);
        s.seen.push_back(patch.value_or(kDark));
        (std::abs(n.y) > 0.5f ? s.ground_share : s.wall_share[side_of(d)]) += heat;
    }
    weather::VisibleBits bits{};
    for (int k = 0; k < weather::kVisibleBits; ++k) {
        const weather::Direction d = weather::visible_direction(k);
        if (weather::dot(d, s.look) <= 0.0) continue;
        const glm::vec3 way(d.x, d.y, d.z);
        if (!tracer.blocked({from, way}))
            bits[static_cast<std::size_t>(k >> 5)] |= std::uint32_t{1} << (k & 31);
    }
    s.sky = weather::sky_shares(bits, s.look);
    s.sky_share = sky;
    s.outside_share = outside;
    s.log_secant = s.heat_sky > 0.0 ? s.log_secant / s.heat_sky : 0.5;
    return s;
}

struct Town {
    explicit Town(const UrbanSite& site)
        : scene(urban_scene(site, kReach_m)), triangles(scene, {}), tracer(triangles)
    {
        scene::PatchOptions options;
        options.cell_m = kCell_m;
        options.max_patches = kMostPatches;
        patches = scene::build_patches(tracer, options);
        const auto surfaces = scene::patch_surfaces(patches, triangles, {});
        sites = film::scene_sites(scene, patches, tracer, surfaces, {},
                                  weather::surface_preset("asphalt"));
        for (weather::PatchKind& kind : sites.set.kinds) {
            for (const auto& [name, emissivity] : kEmissivity)
                if (kind.surface.name == name) kind.surface.emissivity = emissivity;
        }
        for (std::size_t f = 0; f < kUrbanFaces; ++f)
            sensors[f] = sensor_of(patches, tracer, site.station_m, kLooks[f]);
    }
    scene::Scene scene;
    scene::Triangles triangles;
    scene::Tracer tracer;
    scene::Patches patches;
    film::SceneSites sites;
    std::array<Sensor, kUrbanFaces> sensors;
};

// The sun over an hour at the station.
struct HourSun {
    std::array<double, kUrbanFaces> beam{}, around{};  // sum of V (n.s)+, over that of up
    double up = 0.0, outside_w_m2 = 1361.0;            // mean of the sun above the horizon
};
HourSun sun_over(const Town& town, const UrbanSite& site, const UrbanDay& day,
                 std::int64_t begin_us)
{
    HourSun sun;
    double sum_up = 0.0, sum_85 = 0.0;
    int above = 0;
    for (int k = 0; k < kSuns; ++k) {
        const auto s =
            weather::sun_direction(begin_us + (2 * k + 1) * kHour_us / (2 * kSuns),
                                   day.table.site.latitude_deg, day.table.site.longitude_deg);
        sun.outside_w_m2 = s.extraterrestrial_w_m2;
        if (!(s.up > 0.0)) continue;
        ++above;
        sum_up += s.up;
        sum_85 += std::max(s.up, kCos85);
        const weather::Direction d{s.east, s.up, -s.north};
        if (town.tracer.blocked({site.station_m, glm::vec3(d.x, d.y, d.z)})) continue;
        for (std::size_t f = 0; f < kUrbanFaces; ++f)
            sun.beam[f] += std::max(0.0, weather::dot(town.sensors[f].look, d));
    }
    if (above == 0) return sun;
    for (std::size_t f = 0; f < kUrbanFaces; ++f) {
        sun.around[f] = sun.beam[f] / sum_85;
        sun.beam[f] = std::min(sun.beam[f] / sum_up, kMostBeamRatio);
    }
    sun.up = sum_up / above;
    return sun;
}

// The sky that the sensor which looks up measures, less what the walls send it. Each side's walls
// send what its sensor has beside that same sky and the ground: linear in the sky.
double measured_sky_w_m2(const Town& town, const UrbanHour& measured, double cloud, double air_k)
{
    const auto& got = measured.longwave;
    const double air_w_m2 = weather::kStefanBoltzmann * std::pow(air_k, 4.0);
    const auto known = [&](const Sensor& s) {
        return s.heat_sky * weather::warm_horizon_w_m2(s.log_secant, cloud, air_k) +
               s.heat_outside * air_w_m2 + s.ground_share * got[kFaceUp];
    };
    const Sensor& up = town.sensors[kFaceDown];
    double left_w_m2 = got[kFaceDown] - known(up), share = up.heat_sky;
    for (const std::size_t side : {kFaceNorth, kFaceEast, kFaceSouth, kFaceWest}) {
        const Sensor& s = town.sensors[side];
        if (!(up.wall_share[side] > 0.0) || !(s.walls() > 0.0)) continue;
        const double weight = up.wall_share[side] / s.walls();
        left_w_m2 -= weight * (got[side] - known(s));
        share -= weight * s.heat_sky;
    }
    return left_w_m2 / share;
}

double sent_w_m2(double temp_k, double emissivity, double arrives_w_m2)
{
    return emissivity * weather::kStefanBoltzmann * std::pow(temp_k, 4.0) +
           (1.0 - emissivity) * arrives_w_m2;
}

std::vector<UrbanRadiation> radiation(const Town& town, const UrbanSite& site, const UrbanDay& day)
{
    const weather::PatchParams params;
    const weather::PatchSet& set = town.sites.set;
    weather::PatchWeather run(day.table, set, params, day.begin_us,
                              film::ponds_of(town.sites.ground));
    std::vector<UrbanRadiation> out;
    for (const UrbanHour& measured : day.measured) {
        // The last second of the hour: what the moment then says is the mean since the hour began.
        run.go_to(measured.begin_us + kHour_us - weather::kMicrosPerSecond);
        std::vector<double> sent(set.patches.size()), heat(set.patches.size());
        const std::int64_t middle = measured.begin_us + kHour_us / 2;
        const auto now = [&](Field f) { return weather::value_at(day.table, f, middle); };
        const double air_k = now(Field::AirTemp);
        const double air_w_m2 = weather::kStefanBoltzmann * std::pow(air_k, 4.0);
        for (std::size_t i = 0; i < sent.size(); ++i) {
            const weather::PatchState s = run.state(i);
            const weather::PatchKind& kind = set.kinds[set.patches[i].kind];
            const weather::Surface& surface = kind.surface;
            const double wet = std::min(s.cell.film / surface.film_capacity_kg_m2, 1.0);
            sent[i] = s.shortwave_w_m2 *
                      (surface.albedo_dry + wet * (surface.albedo_wet - surface.albedo_dry));
            const double own_k = s.cell.surface_temp_c + weather::kZeroCelsiusK;
            heat[i] =
                kind.like_air ? air_w_m2 : sent_w_m2(own_k, surface.emissivity, s.longwave_w_m2);
            if (kind.room_behind)
                heat[i] += kGlassShare * (window_w_m2({.sun_w_m2 = s.shortwave_w_m2,
                                                       .heat_w_m2 = s.longwave_w_m2,
                                                       .wind_m_s = now(Field::Wind) * s.wind_factor,
                                                       .air_k = air_k,
                                                       .room_k = params.room_temp_k}) -
                                          heat[i]);
        }
        const HourSun sun = sun_over(town, site, day, measured.begin_us);
        const double global = std::max(0.0, now(Field::Shortwave));
        const double zenith_rad = std::acos(std::clamp(sun.up, 0.0, 1.0));
        const double clear =
            weather::clear_beam_w_m2(sun.outside_w_m2, zenith_rad, day.table.site.elevation_m);
        const double glowing = std::clamp(now(Field::Diffuse), 0.0, global);
        const double diffuse = std::max(glowing, global - clear * sun.up);
        weather::SkyGlow glow;
        if (sun.up > 0.0 && glowing > 1e-3) {
            const double direct = (global - diffuse) / sun.up;
            glow = weather::glow_below(
                weather::perez_glow(glowing, direct, sun.outside_w_m2, zenith_rad), glowing,
                diffuse, (clear - direct) * std::max(sun.up, kCos85));
        }
        UrbanRadiation r;
        r.begin_us = measured.begin_us;
        for (std::size_t f = 0; f < kUrbanFaces; ++f) {
            const Sensor& s = town.sensors[f];
            weather::SkySeen seen{s.sky_share, s.sky.horizon, sun.around[f],
                                  std::abs(s.look.y) > 0.5 ? 0.0 : 1.0};
            if (s.look.y < -0.5) seen = {0.0, 0.0, 0.0, 0.0};
            r.shortwave[f] = sun.beam[f] * (global - diffuse) +
                             weather::sky_light_w_m2(diffuse, glow, seen) +
                             s.outside_share * params.outside_albedo * global;
            r.longwave[f] =
                s.heat_sky * (now(Field::Longwave) +
                              weather::warm_horizon_w_m2(s.log_secant, now(Field::Cloud), air_k)) +
                s.heat_outside * air_w_m2;
            for (std::size_t ray = 0; ray < s.seen.size(); ++ray) {
                const std::uint32_t patch = s.seen[ray];
                if (patch >= sent.size()) continue;
                r.shortwave[f] += sent[patch] / kRays;
                if (ray < kHeatRays) r.longwave[f] += heat[patch] / kHeatRays;
            }
        }
        const Sensor& up = town.sensors[kFaceDown];
        if (now(Field::Cloud) < kClear) {
            r.clear_sky_w_m2 =
                up.heat_sky * (now(Field::Longwave) +
                               weather::warm_horizon_w_m2(up.log_secant, now(Field::Cloud), air_k));
            r.black_sky_w_m2 = up.heat_sky * air_w_m2;
            r.measured_sky_w_m2 = measured_sky_w_m2(town, measured, now(Field::Cloud), air_k);
            r.black_w_m2 = air_w_m2;
            r.ours_sky_w_m2 = now(Field::Longwave);
        }
        out.push_back(r);
    }
    return out;
}

}  // namespace

double window_k(const WindowAir& w)
{
    const double cube = w.air_k * w.air_k * w.air_k;
    const double radiates_w_m2_k = 4.0 * kGlassEmissivity * weather::kStefanBoltzmann * cube;
    const double exchange_w_m2_k = 4.0 + 4.0 * w.wind_m_s;
    return w.air_k +
           (kGlassTakes * w.sun_w_m2 +
            kGlassEmissivity * (w.heat_w_m2 - weather::kStefanBoltzmann * cube * w.air_k) +
            kGlassRoom_w_m2_k * (w.room_k - w.air_k)) /
               (radiates_w_m2_k + exchange_w_m2_k + kGlassRoom_w_m2_k);
}

double window_w_m2(const WindowAir& w)
{
    return sent_w_m2(window_k(w), kGlassEmissivity, w.heat_w_m2);
}

std::vector<UrbanRadiation> urban_radiation(const UrbanSite& site, const UrbanDay& day)
{
    return radiation(Town(site), site, day);
}

std::vector<SkillRow> urban_rows(const UrbanSite& site)
{
    struct Kind {
        const char* name;
        std::array<double, kUrbanFaces> UrbanHour::*values;
        std::size_t first, last;
        ErrorSum sum;
    };
    std::vector<Kind> kinds{{"K down", &UrbanHour::shortwave, kFaceDown, kFaceDown, {}},
                            {"K up", &UrbanHour::shortwave, kFaceUp, kFaceUp, {}},
                            {"K of the sides", &UrbanHour::shortwave, kFaceNorth, kFaceWest, {}},
                            {"L down", &UrbanHour::longwave, kFaceDown, kFaceDown, {}},
                            {"L up", &UrbanHour::longwave, kFaceUp, kFaceUp, {}},
                            {"L of the sides", &UrbanHour::longwave, kFaceNorth, kFaceWest, {}}};
    const Town town(site);
    ErrorSum left, ours_more;            // of a black sky
    ErrorSum by_walls, ours_over_walls;  // likewise
    for (const UrbanDay& day : site.days) {
        const std::vector<UrbanRadiation> ours = radiation(town, site, day);
        for (std::size_t i = 0; i < ours.size(); ++i) {
            const double more = ours[i].longwave[kFaceDown] - day.measured[i].longwave[kFaceDown];
            left.add((ours[i].clear_sky_w_m2 - more) / ours[i].black_sky_w_m2);
            ours_more.add(more / ours[i].black_sky_w_m2);
            by_walls.add(ours[i].measured_sky_w_m2 / ours[i].black_w_m2);
            ours_over_walls.add((ours[i].ours_sky_w_m2 - ours[i].measured_sky_w_m2) /
                                ours[i].black_w_m2);
            for (Kind& kind : kinds) {
                for (std::size_t f = kind.first; f <= kind.last; ++f)
                    kind.sum.add((ours[i].*kind.values)[f] - (day.measured[i].*kind.values)[f]);
            }
        }
    }
    std::vector<SkillRow> rows;
    for (const Kind& kind : kinds)
        rows.push_back({site.name, kind.name, "W/m2", kind.sum.count(), kind.sum.rmse(),
                        kind.sum.bias(), "RMSE"});
    if (left.count() > 0)
        rows.push_back({site.name, "clear sky over black", "", left.count(), left.bias(),
                        ours_more.bias(), "mean measured"});
    if (by_walls.count() > 0)
        rows.push_back({site.name, "the same by its own walls", "", by_walls.count(),
                        by_walls.bias(), ours_over_walls.bias(), "mean measured"});
    return rows;
}

}  // namespace petrichor::cli
