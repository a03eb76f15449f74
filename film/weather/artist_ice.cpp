#include "film/weather/artist_ice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "weather/models/physical/mapping.h"
#include "weather/physics/constants.h"

namespace petrichor::film {
namespace {

constexpr double kStep_s = 1.0 / 16.0;
constexpr double kSteps = 2000.0;
constexpr double kThickestFilm = 0.98;  // a millimetre

// Ice in a kind of hollow, and what has melted of it since.
struct Store {
    double ice = 0.0, melted = 0.0;

    double all() const { return ice + melted; }
};

struct Walk {
    Store cracks, puddles;
    double not_snow = 0.0;
    double film = 0.0;
};

// What the model takes of a store in the cold stays as ice.
void freeze(Store& store, double before, double after, double frozen)
{
    store.ice += std::max(before - after, 0.0);
    const double again = std::min(store.melted, frozen);
    store.melted -= again;
    store.ice += again;
}

void thaw(Store& store, double share, double dried)
{
    const double melt = store.ice * share;
    store.ice -= melt;
    store.melted = std::max(store.melted + melt - dried, 0.0);
}

}  // namespace

shared::WeatherMoment with_ice(shared::WeatherMoment moment, const ArtistIce& ice)
{
    const auto narrow = [](double value) { return static_cast<float>(value); };
    moment.flood_cracks = std::min(moment.flood_cracks + narrow(ice.cracks), 1.0f);
    moment.flood_puddles = std::min(moment.flood_puddles + narrow(ice.puddles), 1.0f);
    moment.snow_amount =
        std::max(moment.snow_amount - narrow(ice.not_snow) * moment.water_to_snow, 0.0f);
    // As a film of water shows. Where patches are they say where it lies.
    const weather::ArtistOutputs glazed = weather::outputs({.water_to_snow = 0.0, .wetness = ice.film}, {}, 0.0, 0.0);
    moment.film_albedo = std::max(moment.film_albedo, narrow(glazed.film_albedo));
    moment.film_smoothness = std::max(moment.film_smoothness, narrow(glazed.film_smoothness));
    return moment;
}

ArtistIceTimeline::ArtistIceTimeline(const weather::ArtistTimeline& weather)
    : start_s_(weather::to_seconds(weather.start()))
{
    // Beyond the last key all ends within the minute that water takes to freeze or dry.
    const double end_s = weather::to_seconds(weather.end()) + 60.0;
    step_s_ = std::max(kStep_s, (end_s - start_s_) / kSteps);
    const auto count = static_cast<std::size_t>(std::ceil((end_s - start_s_) / step_s_));
    steps_.reserve(count + 1);
    Walk walk;
    steps_.push_back({});
    weather::ArtistState before = weather.state_at(weather.start());
    for (std::size_t i = 1; i <= count; ++i) {
        const double time_s = start_s_ + step_s_ * static_cast<double>(i);
        const weather::TimeUs time = weather::to_time_us(time_s);
        const weather::ArtistState after = weather.state_at(time);
        const weather::ArtistParams p = weather.params_at(time);
        const double celsius = weather.temperature_c_at(time);
        const double h = step_s_ * p.time_scale;
        const double slow = h * p.water_to_snow_time_scale;
        const double drive = std::min(std::abs(celsius) / 40.0, 1.0);
        const double frozen = 0.5 * (before.water_to_snow + after.water_to_snow);
        if (!p.script_controlled) {
        } else if (celsius <= 0.0) {
            freeze(walk.cracks, before.cracks, after.cracks, frozen * slow);
            freeze(walk.puddles, before.puddles, after.puddles, frozen * slow);
            walk.film += std::max(before.wetness - after.wetness, 0.0) + before.rain * p.accumulation_rate_wetness * h;
            walk.film = std::min(walk.film, kThickestFilm);
            const double fallen =
                0.5 * (before.snowfall + after.snowfall) * p.accumulation_rate_snow * h;
            walk.not_snow += std::max(after.snow - before.snow - fallen, 0.0);
        } else {
            const double share = 1.0 - std::exp(-4.0 * (1.0 - frozen) * slow);
            const bool dry = weather.rainfall_at(time) == 0.0;
            thaw(walk.cracks, share, dry ? p.evaporation_rate_cracks * drive * h : 0.0);
            thaw(walk.puddles, share, dry ? p.evaporation_rate_puddles * drive * h : 0.0);
            walk.film *= 1.0 - share;
            if (before.snow > 0.0) walk.not_snow *= std::min(after.snow / before.snow, 1.0);
        }
        walk.not_snow = std::min(walk.not_snow, after.snow);
        steps_.push_back({walk.cracks.all(), walk.puddles.all(), walk.not_snow, walk.film});
        before = after;
    }
}

ArtistIce ArtistIceTimeline::at(double time_s) const
{
    const double last = static_cast<double>(steps_.size() - 1);
    const double at = std::clamp((time_s - start_s_) / step_s_, 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(at, std::max(last - 1.0, 0.0)));
    if (steps_.size() < 2) return steps_.front();
    const double u = at - static_cast<double>(i);
    const auto between = [u](double a, double b) { return a + (b - a) * u; };
    const ArtistIce& a = steps_[i];
    const ArtistIce& b = steps_[i + 1];
    return {between(a.cracks, b.cracks), between(a.puddles, b.puddles),
            between(a.not_snow, b.not_snow), between(a.film, b.film)};
}

double ArtistIceTimeline::glaze_mm(double time_s) const
{
    return weather::film_of_wetness_kg_m2({}, at(time_s).film) * (1000.0 / weather::kIceDensity);
}

}  // namespace petrichor::film
