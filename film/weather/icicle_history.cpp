#include "film/weather/icicle_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "base/portable_math.h"
#include "weather/physics/humidity.h"

namespace petrichor::film {
namespace {

constexpr double kFreezing_k = 273.15;
constexpr double kFusion_j_kg = 3.34e5;
constexpr double kEvaporation_j_kg = 2.5e6;
constexpr double kAirHeat_j_kg_k = 1005.0;
constexpr double kAirConducts_w_m_k = 0.024;
constexpr double kAirViscosity_m2_s = 1.35e-5;
constexpr double kCalm_m_s = 0.2;      // air is never quite still beside ice
constexpr double kWindThere = 0.23;    // of the wind at 10 m: as of drops off edges
constexpr double kLongWave_w_m2_k = 4.6;
constexpr double kHumidity = 0.85;     // where the weather has none
constexpr double kPressure_pa = 101325.0;
constexpr double kSnowHolds_s = 5400.0;   // water on its way through a roof's snow (ours)
constexpr double kFilmHolds_s = 300.0;
constexpr double kMostOutflow_kg_m2_s = 10.0 / 3600.0;
constexpr double kSomeSnow_kg_m2 = 1.0;
constexpr double kPlate_m = 0.1;
constexpr double kFilmStays_mm = 0.4;  // weather/physics/surfaces.h
constexpr double kStep_s = 600.0;      // of the weather; longer where a film has more than kMostSteps
constexpr double kMostSteps = 4096.0;
constexpr double kSubSteps = 4.0;

double wind_there_m_s(const shared::WeatherMoment& w)
{
    return std::max(kWindThere * static_cast<double>(glm::length(w.wind_m_s)), kCalm_m_s);
}

bool cold(const shared::WeatherMoment& w)
{
    return static_cast<double>(w.air_temperature_k) < kFreezing_k;
}

// Of rain: in the cold what does not freeze where it falls, on a plate that loses heat as something two hands wide does.
double rain_kg_m2_s(const shared::WeatherMoment& w)
{
    const double freezes = cold(w) ? std::max(icicle_cooling_w_m2(w, kPlate_m), 0.0) / kFusion_j_kg : 0.0;
    return std::max(static_cast<double>(w.rain_kg_m2_s) - freezes, 0.0);
}

// What comes to edges between two moments, kg/m2.
double comes_kg_m2(const shared::WeatherMoment& a, const shared::WeatherMoment& b, double dt_s)
{
    const bool wet = a.snow_liquid_fraction > 0.0f || b.snow_liquid_fraction > 0.0f || a.melt > 0.0f || b.melt > 0.0f;
    if (!wet || static_cast<double>(a.swe_kg_m2) < kSomeSnow_kg_m2) {
        // A film sheds what is more than a surface holds, and has no more of it than it loses.
        const double film_mm = static_cast<double>(a.film_mm);
        const double sheds = std::min(std::max(film_mm - static_cast<double>(b.film_mm), 0.0), std::max(film_mm - kFilmStays_mm, 0.0));
        return 0.5 * (rain_kg_m2_s(a) + rain_kg_m2_s(b)) * dt_s + sheds;
    }
    // A wet pack lets go what it has not kept of what fell; what it loses to the air is small beside that.
    const double fell = 0.5 * dt_s *
                        static_cast<double>(a.rain_kg_m2_s + b.rain_kg_m2_s + a.snowfall_kg_m2_s + b.snowfall_kg_m2_s);
    const double left = static_cast<double>(a.swe_kg_m2) + fell - static_cast<double>(b.swe_kg_m2);
    return std::clamp(left, 0.0, kMostOutflow_kg_m2_s * dt_s);
}

shared::WeatherMoment between(const shared::WeatherMoment& a, const shared::WeatherMoment& b)
{
    shared::WeatherMoment m = a;
    m.air_temperature_k = 0.5f * (a.air_temperature_k + b.air_temperature_k);
    m.wind_m_s = 0.5f * (a.wind_m_s + b.wind_m_s);
    return m;
}

}  // namespace

double icicle_cooling_w_m2(const shared::WeatherMoment& w, double radius_m)
{
    const double diameter_m = 2.0 * std::max(radius_m, 1e-3);
    const double reynolds = wind_there_m_s(w) * diameter_m / kAirViscosity_m2_s;
    const double nusselt = 0.3 + 0.615 * portable_exp(0.466 * portable_log(std::max(reynolds, 1.0)));
    const double convects = nusselt * kAirConducts_w_m_k / diameter_m;
    const auto air_k = static_cast<double>(w.air_temperature_k);
    const double humidity = w.relative_humidity >= 0.0f ? static_cast<double>(w.relative_humidity) : kHumidity;
    const double pressure_pa = w.pressure_pa > 0.0f ? static_cast<double>(w.pressure_pa) : kPressure_pa;
    const double vapour_pa = weather::saturation_pressure_water_pa(kFreezing_k) - humidity * weather::saturation_pressure_water_pa(air_k);
    const double by_vapour = 0.622 * kEvaporation_j_kg / (kAirHeat_j_kg_k * pressure_pa) * vapour_pa;
    return (convects + kLongWave_w_m2_k) * (kFreezing_k - air_k) + convects * by_vapour;
}

double icicle_after(double ice_kg, double water_kg, const shared::WeatherMoment& w, double dt_s)
{
    const double length_m = scene::icicle_length_m(ice_kg / scene::kIcicleDensity_kg_m3);
    // Heat goes by the width that half of its side has.
    const double radius_m = static_cast<double>(scene::icicle_radius_m(static_cast<float>(0.6 * length_m)));
    const double cools = icicle_cooling_w_m2(w, radius_m) * scene::icicle_area_m2(length_m) / kFusion_j_kg * dt_s;
    if (!cold(w)) return std::max(ice_kg + std::min(cools, 0.0), 0.0);
    return ice_kg + std::clamp(cools, 0.0, water_kg);
}

struct IcicleHistory::Grid {
    std::function<shared::WeatherMoment(double)> weather;
    Clock clock;
    double step_s = 1.0;
    std::once_flag made;
    std::vector<scene::IcicleLengths> lengths;

    void make()
    {
        const double whole_s = std::max(clock.end_s - clock.begin_s, 0.0);
        const double steps = std::clamp(std::ceil(whole_s * clock.weather_s_per_s / kStep_s), 1.0, kMostSteps);
        step_s = whole_s / steps;
        const auto longest_kg = scene::kIcicleDensity_kg_m3 * scene::icicle_volume_m3(static_cast<double>(scene::kLongestIcicle_m));
        std::array<double, scene::kIcicleClasses> ice_kg{};
        double held_kg_m2 = 0.0;
        shared::WeatherMoment before = weather(clock.begin_s);
        lengths.push_back({});
        for (int i = 1; i <= static_cast<int>(steps); ++i) {
            const shared::WeatherMoment after = weather(clock.begin_s + step_s * i);
            const double dt_s = step_s * clock.weather_s_per_s;
            held_kg_m2 += comes_kg_m2(before, after, dt_s);
            const bool snow = static_cast<double>(after.swe_kg_m2) >= kSomeSnow_kg_m2;
            const double goes = held_kg_m2 * (1.0 - portable_exp(-dt_s / (snow ? kSnowHolds_s : kFilmHolds_s)));
            held_kg_m2 -= goes;
            step(ice_kg, goes, between(before, after), dt_s, longest_kg);
            lengths.push_back(lengths_of(ice_kg));
            before = after;
        }
    }

    static void step(std::array<double, scene::kIcicleClasses>& ice_kg, double goes_kg_m2, const shared::WeatherMoment& w, double dt_s,
                     double longest_kg)
    {
        const bool freezes = cold(w);
        for (std::size_t c = 0; c < ice_kg.size(); ++c) {
            const double water_kg = goes_kg_m2 * scene::icicle_class_m2(c);
            if (freezes ? water_kg <= 0.0 : ice_kg[c] <= 0.0) continue;
            for (int k = 0; k < static_cast<int>(kSubSteps); ++k)
                ice_kg[c] = std::min(icicle_after(ice_kg[c], water_kg / kSubSteps, w, dt_s / kSubSteps), longest_kg);
        }
    }

    static scene::IcicleLengths lengths_of(const std::array<double, scene::kIcicleClasses>& ice_kg)
    {
        scene::IcicleLengths lengths;
        for (std::size_t c = 0; c < ice_kg.size(); ++c) {
            if (ice_kg[c] > 0.0) lengths.length_m[c] = static_cast<float>(scene::icicle_length_m(ice_kg[c] / scene::kIcicleDensity_kg_m3));
        }
        return lengths;
    }

    // Number of the point before a time, and how far that lies behind it.
    std::pair<std::size_t, double> place(double clock_s) const
    {
        const double last = static_cast<double>(lengths.size() - 1);
        const double at = step_s > 0.0 ? std::clamp((clock_s - clock.begin_s) / step_s, 0.0, last) : 0.0;
        const auto i = static_cast<std::size_t>(std::min(at, last - 1.0));
        return {i, at - static_cast<double>(i)};
    }
};

bool carries_icicles(float height_m)
{
    return height_m >= 1.5f;
}

IcicleHistory::IcicleHistory(std::function<shared::WeatherMoment(double clock_s)> weather, const Clock& clock)
    : grid_(std::make_shared<Grid>())
{
    grid_->weather = std::move(weather);
    grid_->clock = clock;
}

scene::IcicleLengths IcicleHistory::at(double clock_s) const
{
    if (!grid_) return {};
    Grid& g = *grid_;
    std::call_once(g.made, [&g] { g.make(); });
    const auto [i, u] = g.place(clock_s);
    const scene::IcicleLengths& a = g.lengths[i];
    const scene::IcicleLengths& b = g.lengths[i + 1];
    scene::IcicleLengths between;
    for (std::size_t c = 0; c < scene::kIcicleClasses; ++c)
        between.length_m[c] = a.length_m[c] + (b.length_m[c] - a.length_m[c]) * static_cast<float>(u);
    return between;
}

bool IcicleHistory::any(double from_s, double to_s) const
{
    if (!grid_) return false;
    at(from_s);
    const Grid& g = *grid_;
    const std::size_t first = g.place(from_s).first, last = g.place(to_s).first + 1;
    return std::any_of(g.lengths.begin() + static_cast<std::ptrdiff_t>(first), g.lengths.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                       [](const scene::IcicleLengths& lengths) { return lengths.any(); });
}

}  // namespace petrichor::film
