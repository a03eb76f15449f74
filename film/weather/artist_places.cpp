#include "film/weather/artist_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "film/weather/artist_ice.h"
#include "formulas/weather/falls_here.h"
#include "scene/basins/water.h"
#include "weather/moment.h"

namespace petrichor::film {
namespace {

constexpr double kPuddleRain_m = 0.020;  // that full puddles stand for
// Factors in steps; rain on a windward wall passes 1. Those of rain are even in its root: a tenth of
// the rain leaves most of its film.
constexpr double kSteps = 8.0, kRainSteps = 12.0, kMostRain = 2.0;

using Class = std::array<int, 4>;

int step_of(double factor)
{
    return static_cast<int>(std::lround(std::clamp(factor, 0.0, 1.0) * kSteps));
}
Class class_of(const weather::PlaceFactors& f)
{
    // Rain and snow make pictures; drying and freezing may be coarser.
    return {static_cast<int>(
                std::lround(std::sqrt(std::clamp(f.rain, 0.0, kMostRain)) * kRainSteps)),
            2 * ((step_of(f.drying) + 1) / 2), 2 * ((step_of(f.freezing) + 1) / 2), step_of(f.snow)};
}
weather::PlaceFactors factors_of(const Class& c)
{
    const double root = c[0] / kRainSteps;
    return {root * root, c[1] / kSteps, c[2] / kSteps, c[3] / kSteps};
}

constexpr int kTimes = 8;               // of a script, at which its wind is asked
constexpr double kDryWeight = 1e-3;     // of a time at which nothing falls: counts where all are dry

// The winds of a script, those in which most falls first in weight.
std::vector<weather::WeightedClimate> climates_of(const WeatherScript& script, double latitude_deg, double north_deg)
{
    std::vector<weather::WeightedClimate> all;
    double sum = 0.0;
    for (int i = 0; i < kTimes; ++i) {
        const double us = 1e6 * script.duration_s * (i + 0.5) / kTimes;
        const double weight = std::max(weather::value_at(script.timeline.rainfall, us), kDryWeight);
        weather::PlaceClimate c;
        c.latitude_deg = latitude_deg;
        c.north_deg = north_deg;
        c.wind_m_s = weather::value_at(script.sky.wind_m_s, us);
        c.wind_from_deg = weather::value_at(script.sky.wind_from_deg, us);
        sum += weight;
        const auto same = std::find_if(all.begin(), all.end(), [&](const weather::WeightedClimate& one) {
            return one.climate.wind_m_s == c.wind_m_s && one.climate.wind_from_deg == c.wind_from_deg;
        });
        if (same == all.end()) {
            all.push_back({c, weight});
        } else {
            same->weight += weight;
        }
    }
    for (weather::WeightedClimate& one : all) one.weight /= sum;
    return all;
}

// Hoar is of the air: it grows where heat is lost to the sky overhead, as at pixels without patches.
double hoar_share(const weather::WeatherPatch& patch)
{
    const double up = std::clamp(patch.normal.y, 0.0, 1.0);
    const double facing = std::clamp(0.5 + 0.6 * patch.normal.y, 0.0, 1.0);
    return weather::sky_shares(patch.visible, patch.normal).zenith * up * facing;
}

struct Scaling {
    const char* name;
    double weather::PlaceFactors::*factor;
};
// What of a script a factor scales, by the names of ArtistParams.
constexpr Scaling kScalings[] = {
    {"accumulation_rate_wetness", &weather::PlaceFactors::rain},
    {"accumulation_rate_cracks", &weather::PlaceFactors::rain},
    {"accumulation_rate_puddles", &weather::PlaceFactors::rain},
    {"accumulation_rate_snow", &weather::PlaceFactors::snow},
    {"evaporation_rate_wetness", &weather::PlaceFactors::drying},
    {"evaporation_rate_cracks", &weather::PlaceFactors::drying},
    {"evaporation_rate_puddles", &weather::PlaceFactors::drying},
    {"water_to_snow_time_scale", &weather::PlaceFactors::freezing},
};

// States set by hand are what has fallen in the open: of a place, by the laws of its pixels without
// patches.
double film_here(double open, double share)
{
    return open * static_cast<double>(shared::film_share(static_cast<float>(share)));
}
double flood_here(double open, double share)
{
    return open * static_cast<double>(shared::flood_share(static_cast<float>(share)));
}
double snow_here(double open, double share)
{
    return static_cast<double>(
        shared::cover_of_share(static_cast<float>(open), static_cast<float>(share)));
}
struct HandSet {
    const char* name;
    double weather::PlaceFactors::*factor;
    double (*here)(double open, double share);
};
constexpr HandSet kHandSets[] = {
    {"wetness", &weather::PlaceFactors::rain, film_here},
    {"cracks", &weather::PlaceFactors::rain, flood_here},
    {"puddles", &weather::PlaceFactors::rain, flood_here},
    {"snow", &weather::PlaceFactors::snow, snow_here},
};

}  // namespace

WeatherScript script_at_place(const WeatherScript& script, const weather::PlaceFactors& factors)
{
    WeatherScript out = script;
    for (const Scaling& s : kScalings) {
        const double factor = factors.*s.factor;
        for (const weather::ArtistParameter& p : weather::artist_parameters())
            if (p.name == s.name) out.params.*p.member *= factor;
        if (const auto keyed = out.timeline.parameters.find(s.name);
            keyed != out.timeline.parameters.end()) {
            for (double& value : keyed->second.values) value = std::min(value * factor, 1e9);
        }
    }
    for (const HandSet& set : kHandSets) {
        const double share = factors.*set.factor;
        if (share >= 1.0) continue;  // all that the open has
        for (const weather::HandSetState& state : weather::hand_set_states())
            if (state.name == set.name)
                out.initial.*state.member = set.here(out.initial.*state.member, share);
        if (const auto keyed = out.timeline.states.find(set.name);
            keyed != out.timeline.states.end()) {
            for (double& value : keyed->second.values) value = set.here(value, share);
        }
    }
    return out;
}

constexpr std::uint32_t kNoMaterial = 0xffffffu;

struct ArtistPlaces::Impl {
    struct Solved {
        WeatherScript script;
        weather::ArtistTimeline weather;
        std::optional<ArtistIceTimeline> ice;  // where it freezes
    };
    std::shared_ptr<const gpu::PlaceShape> shape;
    scene::Basins basins;
    std::vector<Solved> solved;
    std::vector<std::uint32_t> solved_of;  // of a patch
    std::vector<float> rain, hoar;         // of a patch: shares of what the open has
    std::vector<std::uint32_t> material;   // of a patch
    std::vector<double> area_m2;           // of a patch
    ShelterParts shelter;
    Solved open;
    ArtistTaps taps;
};

ArtistPlaces::ArtistPlaces(const SceneSites& sites, const WeatherScript& script,
                           double latitude_deg, double north_deg, const KeyedTaps& clock)
{
    const std::vector<weather::WeightedClimate> climates = climates_of(script, latitude_deg, north_deg);
    const weather::SunPath path = weather::sun_path(climates.front().climate);
    const bool freezes = weather::range_of(script.timeline.temperature_c).low <= 0.0;
    const auto solved = [freezes](WeatherScript here) {
        weather::ArtistTimeline weather = here.solve();
        std::optional<ArtistIceTimeline> ice;
        if (freezes) ice.emplace(weather);
        return Impl::Solved{std::move(here), std::move(weather), std::move(ice)};
    };
    auto impl = std::make_shared<Impl>(Impl{
        sites.shape, sites.ground.basins, {}, {}, {}, {}, sites.material, {}, sites.shelter, solved(script),
        ArtistTaps(sites.taps, sites.ground.basins, script, clock)});
    const auto& wetted = impl->taps.wetted();
    std::vector<std::vector<TapSpan>> runs{{}};  // of water over a place: none, then each that there is
    std::map<std::pair<Class, std::size_t>, std::uint32_t> known;
    for (std::uint32_t i = 0; i < sites.set.patches.size(); ++i) {
        const weather::WeatherPatch& patch = sites.set.patches[i];
        const auto below = wetted.find(i);
        const auto run = std::find(runs.begin(), runs.end(),
                                   below == wetted.end() ? std::vector<TapSpan>{} : below->second);
        const auto which = static_cast<std::size_t>(run - runs.begin());
        if (run == runs.end()) runs.push_back(below->second);
        const auto factors = weather::place_factors(patch, sites.set.kinds[patch.kind], climates, path);
        const Class c = class_of(factors);
        const auto [place, is_new] =
            known.try_emplace({c, which}, static_cast<std::uint32_t>(impl->solved.size()));
        if (is_new) {
            WeatherScript here = script_at_place(script, factors_of(c));
            if (which > 0) here = script_below_taps(script, std::move(here), runs[which]);
            impl->solved.push_back(solved(std::move(here)));
        }
        impl->solved_of.push_back(place->second);
        impl->area_m2.push_back(patch.area_m2);
        impl->rain.push_back(static_cast<float>(factors.rain));
        impl->hoar.push_back(static_cast<float>(hoar_share(patch)));
    }
    impl_ = std::move(impl);
}

std::size_t ArtistPlaces::scripts() const
{
    return impl_->solved.size();
}

std::shared_ptr<const gpu::PlaceWeather> ArtistPlaces::at(double time_s) const
{
    const Impl& m = *impl_;
    std::vector<shared::WeatherMoment> moments;
    const auto moment_of = [&](const Impl::Solved& s) {
        const auto moment =
            weather::artist_moment(s.weather, s.script.timeline, s.script.sky, time_s).values;
        return s.ice ? with_ice(moment, s.ice->at(time_s)) : moment;
    };
    for (const Impl::Solved& s : m.solved) moments.push_back(moment_of(s));
    const auto place = std::make_shared<gpu::PlaceWeather>();
    place->shape = m.shape;
    const auto put = [](std::vector<glm::vec4>& states, const Impl::Solved& solved, const shared::WeatherMoment& here, double glaze_mm,
                        float hoar, float rain, std::uint32_t material) {
        const double frozen = static_cast<double>(here.water_to_snow);
        // Lux's film_albedo is wetness x 0.85 x what is not frozen; the pixel has the 0.85.
        const auto influence = static_cast<float>(solved.script.params.wetness_influence_on_albedo);
        const float film = influence > 0.0f ? std::min(1.0f, here.film_albedo / influence) : 0.0f;
        states.emplace_back(film, here.flood_cracks, here.flood_puddles, here.snow_amount);
        states.emplace_back(here.frost * hoar, static_cast<float>(frozen), rain, 0.0f);
        states.emplace_back(here.film_mm, here.puddle_depth_m, here.snow_depth_m, here.ice_kg_m2);
        states.emplace_back(static_cast<float>(1.0 - frozen), here.air_temperature_k, static_cast<float>(glaze_mm),
                            static_cast<float>(material));
    };
    const auto glaze_mm = [&](const Impl::Solved& s) { return s.ice ? s.ice->glaze_mm(time_s) : 0.0; };
    std::vector<double> glazes_mm;
    for (const Impl::Solved& s : m.solved) glazes_mm.push_back(glaze_mm(s));
    for (std::size_t i = 0; i < m.solved_of.size(); ++i) {
        const std::uint32_t of = m.solved_of[i];
        put(place->states, m.solved[of], moments[of], glazes_mm[of], m.hoar[i], m.rain[i], m.material[i]);
    }
    place->states = states_with_parts(std::move(place->states), PLACE_STATE_TEXELS, m.shelter, m.area_m2);
    // What no patch lies on, as leaves, finds its glaze there; ground of no material goes on as that.
    if (const double open_mm = glaze_mm(m.open); open_mm > 0.0) put(place->open, m.open, moment_of(m.open), open_mm, 1.0f, 1.0f, kNoMaterial);
    // Everywhere the same film has run into the hollows.
    scene::BasinWater water(m.basins);
    const double depth_m = kPuddleRain_m * static_cast<double>(moment_of(m.open).flood_puddles);
    std::vector<double> into;
    for (const double cells : m.basins.pit_cells)
        into.push_back(depth_m * cells * m.basins.cell_area_m2);
    const std::vector<double> let_in_m3 = m.taps.in_pits_m3(time_s);
    for (std::size_t pit = 1; pit < let_in_m3.size(); ++pit) into[pit] += let_in_m3[pit];
    scene::pour(m.basins, water, into);
    place->levels_m = scene::drawn_levels_m(m.basins, water);
    return place;
}

}  // namespace petrichor::film
