#include "weather/physics/friction.h"

#include <algorithm>

#include "weather/physics/brine.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

namespace {

constexpr double kDry = 0.82, kWet = 0.70, kSlush = 0.35, kPacked = 0.25, kIce = 0.20,
                 kWetIce = 0.08;
// e-folding covers, kg/m2.
constexpr double kWaterCover = 0.1, kIceCover = 0.05, kSnowCover = 0.5;
constexpr double kTrace_kg_m2 = 0.01;
constexpr double kFreezes_w_m2 = 0.1;  // a thousandth of a millimetre an hour: less is nothing to see
constexpr double kMetroLayer_kg_m2 = 0.2;
constexpr double kBlackIce_mm = 0.01;

double share(double cover, double scale)
{
    return 1.0 - detail::exponential(-std::max(cover, 0.0) / scale);
}

double snow_of(const CellState& c)
{
    double sum = 0.0;
    for (const double ice : c.snow_ice) sum += ice;
    return sum;
}
double snow_water_of(const CellState& c)
{
    double sum = 0.0;
    for (const double liquid : c.snow_liquid) sum += liquid;
    return sum;
}

}  // namespace

double wheel_friction(const CellState& c)
{
    double friction = kDry + (kWet - kDry) * share(c.film, kWaterCover);
    const double ice = c.film_ice;
    const double icy = kIce + (kWetIce - kIce) * share(c.film, kWaterCover);
    friction += (std::min(icy, friction) - friction) * share(ice, kIceCover);
    const double snow = snow_of(c);
    if (snow > 0.0) {
        // Snow soaks up water until half of it is water.
        const double wet = std::min((snow_water_of(c) + c.film) / (0.5 * snow), 1.0);
        const double snowy = kPacked + (kSlush - kPacked) * wet;
        friction += (std::min(snowy, friction) - friction) * share(snow, kSnowCover);
    }
    return std::clamp(friction, kWetIce, kDry);
}

double glaze_mm(const CellState& c)
{
    return (c.film_ice + c.crack_ice) * (1000.0 / kIceDensity);
}

bool black_ice(const CellState& c)
{
    return glaze_mm(c) >= kBlackIce_mm && !(snow_of(c) > 0.0) && c.surface_temp_c <= 0.0;
}

RoadCondition road_condition(const CellState& c)
{
    const double snow = snow_of(c);
    const double frozen = snow + c.film_ice;
    const double water = c.film + snow_water_of(c);
    const bool rains = c.step_rain > kTrace_kg_m2, snows = c.step_snow > kTrace_kg_m2;
    const bool water_freezes = c.flux_melt < -kFreezes_w_m2;
    if (rains && water_freezes && c.surface_temp_c <= 0.0) return RoadCondition::IcingRain;
    if (snows && (c.surface_temp_c > 0.0 || c.flux_melt > 0.0)) return RoadCondition::MeltingSnow;
    if (frozen >= kMetroLayer_kg_m2 && water >= kMetroLayer_kg_m2)
        return RoadCondition::WaterAndSnow;
    if (water >= kMetroLayer_kg_m2) return RoadCondition::Wet;
    if (frozen >= kMetroLayer_kg_m2) return RoadCondition::IceOrSnow;
    const bool settles = c.flux_latent < 0.0;
    const bool freezes = c.surface_temp_c <= freezing_point_c(c.salt, c.film + c.crack + c.puddle);
    if (settles && !rains && !freezes) return RoadCondition::Dew;
    if ((settles && !snows && freezes) || water_freezes) return RoadCondition::Frost;
    return RoadCondition::Dry;
}

}  // namespace petrichor::weather
