#include "weather/models/physical/mapping.h"

#include <algorithm>

#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr double kFarEnough = 38.0;  // 1 - exp(-38) is 1 in double precision

double unit(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

double rise(double x, double scale)
{
    return x > 0.0 ? unit(1.0 - detail::exponential(-x / scale)) : 0.0;
}

double fall(double y, double scale)
{
    if (!(y > 0.0)) return 0.0;
    if (y >= 1.0) return kFarEnough * scale;
    return std::min(-scale * detail::logarithm(1.0 - y), kFarEnough * scale);
}

}  // namespace

double rainfall_of_rate(const MappingParams& p, double rate_mm_h)
{
    if (!(rate_mm_h > 0.0)) return 0.0;
    return unit(detail::logarithm(1.0 + rate_mm_h / p.rain_low_mm_h) /
                detail::logarithm(1.0 + p.rain_full_mm_h / p.rain_low_mm_h));
}

double rate_of_rainfall_mm_h(const MappingParams& p, double rainfall)
{
    const double span = detail::logarithm(1.0 + p.rain_full_mm_h / p.rain_low_mm_h);
    return p.rain_low_mm_h * (detail::exponential(unit(rainfall) * span) - 1.0);
}

double wetness_of_film(const MappingParams& p, double film)
{
    return rise(film, p.film_scale_kg_m2);
}
double film_of_wetness_kg_m2(const MappingParams& p, double wetness)
{
    return fall(wetness, p.film_scale_kg_m2);
}
double snow_of_depth(const MappingParams& p, double depth_m)
{
    return rise(depth_m, p.snow_scale_m);
}
double depth_of_snow_m(const MappingParams& p, double snow)
{
    return fall(snow, p.snow_scale_m);
}

double level_of_store(const Hypsometry& relief, double stored)
{
    return unit(water_level_mm(relief, stored) / relief.depth_mm);
}

double store_of_level_kg_m2(const Hypsometry& relief, double level)
{
    return stored_kg_m2(relief, unit(level) * relief.depth_mm);
}

WeatherMasks weather_masks(const MappingParams& p, const Surface& surface, const CellState& c,
                           double step_s)
{
    const double per_hour = step_s > 0.0 ? 3600.0 / step_s : 0.0;
    const double fell = c.step_rain + c.step_snow;
    WeatherMasks m;
    m.rainfall = rainfall_of_rate(p, fell * per_hour);
    const double share = fell > 0.0 ? c.step_snow / fell : 0.0;
    m.snowfall = m.rainfall * share;
    m.rain = m.rainfall - m.snowfall;
    m.wetness = wetness_of_film(p, c.film);
    m.cracks = level_of_store(surface.cracks, c.crack + c.crack_ice);
    m.puddles = level_of_store(surface.puddles, c.puddle + c.puddle_ice);
    m.water_to_snow = unit(c.frozen_fraction);
    double depth = 0.0;
    for (const double d : c.snow_thickness) depth += d;
    m.snow = snow_of_depth(p, depth);
    return m;
}

CellState state_of_masks(const MappingParams& p, const Surface& surface, const WeatherMasks& m,
                         const CellState& base)
{
    CellState c = base;
    const double depth = depth_of_snow_m(p, m.snow);
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        c.snow_thickness[i] = i == 0 ? depth : 0.0;
        c.snow_ice[i] = 100.0 * c.snow_thickness[i];
        c.snow_liquid[i] = 0.0;
        c.snow_temp_c[i] = i == 0 && depth > 0.0 ? std::min(base.surface_temp_c, 0.0) : 0.0;
    }
    // The film's mask counts liquid only, so film water stays liquid.
    c.film = film_of_wetness_kg_m2(p, m.wetness);
    c.film_ice = 0.0;
    const bool frozen = m.water_to_snow > 0.5;
    const double crack = store_of_level_kg_m2(surface.cracks, m.cracks);
    const double puddle = store_of_level_kg_m2(surface.puddles, m.puddles);
    c.crack = frozen ? 0.0 : crack;
    c.crack_ice = frozen ? crack : 0.0;
    c.puddle = frozen ? 0.0 : puddle;
    c.puddle_ice = frozen ? puddle : 0.0;
    c.frozen_fraction = unit(m.water_to_snow);
    return c;
}

}  // namespace petrichor::weather
