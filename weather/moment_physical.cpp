// The physical model as moments: a state of the cell and the file's values around it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "weather/models/artist/model.h"
#include "weather/moment.h"
#include "weather/physics/air.h"
#include "weather/physics/constants.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHoarWindow_us = 12LL * 3600 * 1000000;
constexpr double kHoarScale_kg_m2 = 0.03;  // scene-weather 7: cover 1 - exp(-m / 0.03)
constexpr double kWindFrom_deg = 240.0;    // where nobody says: the usual west-south-west

float narrow(double value)
{
    return static_cast<float>(value);
}

// A mean from its row to the next: the row in force.
double rate_at(const ForcingTable& table, Field field, std::int64_t us)
{
    const auto& t = table.time_us;
    const auto upper = std::upper_bound(t.begin(), t.end(), us);
    const auto row = upper == t.begin() ? 0 : static_cast<std::size_t>(upper - t.begin()) - 1;
    return table[field][row];
}

}  // namespace

double wind_from_deg_at(const ForcingTable& table, std::int64_t us)
{
    const auto& t = table.time_us;
    const auto& v = table[Field::WindFrom];
    const auto upper = std::upper_bound(t.begin(), t.end(), us);
    if (upper == t.begin()) return v.front();
    if (upper == t.end()) return v.back();
    const auto i = static_cast<std::size_t>(upper - t.begin());
    const double turn = std::remainder(v[i] - v[i - 1], 360.0);
    return v[i - 1] +
           turn * static_cast<double>(us - t[i - 1]) / static_cast<double>(t[i] - t[i - 1]);
}

struct PhysicalMoments::Impl {
    std::shared_ptr<const ForcingTable> table;
    PhysicalParams params;
    MappingParams mapping;
    PhysicalTimeline timeline;
    std::vector<std::string> guesses;
    bool wind_from = false, visibility = false;

    Impl(ForcingTable source, const PhysicalParams& wanted, const MappingParams& map)
        : table(std::make_shared<const ForcingTable>(std::move(source))),
          params(wanted),
          mapping(map),
          timeline(table, params),
          wind_from(has_every_row(*table, Field::WindFrom)),
          visibility(has_every_row(*table, Field::Visibility))
    {
        if (!wind_from)
            guesses.emplace_back("no wind direction in every row: taken as from 240 degrees");
        if (!visibility) guesses.emplace_back("no visibility in every row: taken from what falls");
        if (!has_every_row(*table, Field::Direct) || !has_every_row(*table, Field::Diffuse))
            guesses.emplace_back("no direct and diffuse sunlight in every row: split by Erbs 1982");
    }

    double at(Field field, std::int64_t us) const { return value_at(*table, field, us); }

    void set_falling(shared::WeatherMoment& m, std::int64_t us) const
    {
        double rate = rate_at(*table, Field::Precip, us) * params.precip_factor;
        double share = 0.0;
        if (has_every_row(*table, Field::Rain) && has_every_row(*table, Field::Snow)) {
            const double rain = rate_at(*table, Field::Rain, us);
            const double snow = rate_at(*table, Field::Snow, us);
            rate = (rain + snow) * params.precip_factor;
            share = rain + snow > 0.0 ? snow / (rain + snow) : 0.0;
        } else {
            share = snow_fraction(params.phase, at(Field::AirTemp, us), at(Field::RelHumidity, us),
                                  at(Field::Pressure, us));
        }
        rate = std::max(rate, 0.0);
        const double fall = rainfall_of_rate(mapping, rate * 3600.0);
        m.snow_fraction = narrow(rate > 0.0 ? share : 0.0);
        m.rain_kg_m2_s = narrow(rate * (1.0 - share));
        m.snowfall_kg_m2_s = narrow(rate * share);
        m.rain = narrow(fall * (1.0 - share));
        m.snowfall = narrow(fall * share);
    }

    void set_air(shared::WeatherMoment& m, std::int64_t us) const
    {
        m.air_temperature_k = narrow(at(Field::AirTemp, us));
        m.cloud_fraction = narrow(std::clamp(at(Field::Cloud, us), 0.0, 1.0));
        const double from_deg = wind_from ? wind_from_deg_at(*table, us) : kWindFrom_deg;
        m.wind_m_s = wind_vector_m_s(at(Field::Wind, us), from_deg);
        // Stations state the meteorological optical range; the renderer takes Koschmieder's.
        m.visibility_m = narrow(
            visibility
                ? weather::visibility_m(extinction_1_m(std::max(at(Field::Visibility, us), 1.0),
                                                       VisibilityKind::Optical5Percent),
                                        VisibilityKind::Contrast2Percent)
                : visibility_in_m(static_cast<double>(m.rain), static_cast<double>(m.snowfall)));
    }

    void set_ground(shared::WeatherMoment& m, std::int64_t us) const
    {
        const CellState c = timeline.state_at(us);
        const CellDiagnostics d = diagnostics(c);
        const WeatherMasks masks = weather_masks(mapping, params.surface, c, params.step_s);
        ArtistState state;
        state.water_to_snow = masks.water_to_snow;
        state.wetness = masks.wetness;
        state.cracks = masks.cracks;
        state.puddles = masks.puddles;
        state.snow = masks.snow;
        const ArtistOutputs published = outputs(state, {}, 0.0, 0.0);
        m.flood_cracks = narrow(published.flood_cracks);
        m.flood_puddles = narrow(published.flood_puddles);
        m.film_albedo = narrow(published.film_albedo);
        m.film_smoothness = narrow(published.film_smoothness);
        m.freeze_exp = narrow(published.freeze_exp);
        m.melt = narrow(published.melt);
        m.melt_exp = narrow(published.melt_exp);
        m.water_to_snow = narrow(masks.water_to_snow);
        m.snow_amount = narrow(masks.snow);

        m.surface_temperature_k = narrow(c.surface_temp_c + kZeroCelsiusK);
        m.film_mm = narrow(c.film);
        m.crack_water_depth_m =
            narrow(water_level_mm(params.surface.cracks, c.crack + c.crack_ice) * 1e-3);
        m.puddle_depth_m =
            narrow(water_level_mm(params.surface.puddles, c.puddle + c.puddle_ice) * 1e-3);
        m.ice_kg_m2 = narrow(d.surface_ice_kg_m2);
        m.snow_depth_m = narrow(d.snow_depth_m);
        m.swe_kg_m2 = narrow(d.swe_kg_m2);
        if (d.swe_kg_m2 > 0.0) {
            m.snow_liquid_fraction = narrow(d.snow_liquid_kg_m2 / d.swe_kg_m2);
            m.snow_temperature_k = narrow(d.snow_temp_k);
            m.snow_albedo = narrow(c.snow_albedo);
        }
        // Frost counts as negative sublimation; what rain froze to the ground is no hoar.
        const CellState before = timeline.state_at(us - kHoarWindow_us);
        const double hoar =
            std::clamp(before.total_sublimation - c.total_sublimation, 0.0, c.film_ice);
        m.frost = narrow(1.0 - std::exp(-hoar / kHoarScale_kg_m2));
        // The rest of it is glaze: clear ice that shows as a film of water does.
        const double glaze_mm = (c.film_ice - hoar) * (1000.0 / kIceDensity);
        const ArtistOutputs glazed = outputs({.water_to_snow = 0.0, .wetness = wetness_of_film(mapping, glaze_mm)}, {}, 0.0, 0.0);
        m.film_albedo = std::max(m.film_albedo, narrow(glazed.film_albedo));
        m.film_smoothness = std::max(m.film_smoothness, narrow(glazed.film_smoothness));
    }
};

PhysicalMoments::PhysicalMoments(ForcingTable table, const PhysicalParams& params,
                                 const MappingParams& mapping)
    : impl_(std::make_shared<const Impl>(std::move(table), params, mapping))
{
}

Moment PhysicalMoments::at(std::int64_t utc_us) const
{
    Moment moment;
    shared::WeatherMoment& m = moment.values;
    impl_->set_falling(m, utc_us);
    impl_->set_air(m, utc_us);
    set_measured(m, *impl_->table, utc_us);
    impl_->set_ground(m, utc_us);
    set_clock(moment, utc_us, impl_->table->site);
    return moment;
}

std::int64_t PhysicalMoments::begin_us() const
{
    return impl_->timeline.begin_us();
}

std::int64_t PhysicalMoments::end_us() const
{
    return impl_->timeline.end_us();
}

const std::vector<std::string>& PhysicalMoments::guesses() const
{
    return impl_->guesses;
}

}  // namespace petrichor::weather
