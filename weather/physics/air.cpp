#include "weather/physics/air.h"

#include "formulas/weather/visibility.h"
#include "weather/physics/detail/formulas.h"

namespace petrichor::weather {

namespace {

double optical_depth(VisibilityKind kind)
{
    return kind == VisibilityKind::Contrast2Percent ? KOSCHMIEDER_2_PERCENT : KOSCHMIEDER_5_PERCENT;
}

}  // namespace

double extinction_1_m(double visibility_m, VisibilityKind kind)
{
    return optical_depth(kind) / visibility_m;
}

double visibility_m(double extinction_1_m, VisibilityKind kind)
{
    return optical_depth(kind) / extinction_1_m;
}

RainDrops rain_drops(double rate_mm_h)
{
    RainDrops drops;
    drops.slope_1_mm = 4.1 * detail::power(rate_mm_h, -0.21);
    drops.per_m3 = 8000.0 / drops.slope_1_mm;
    drops.mean_diameter_mm = 1.0 / drops.slope_1_mm;
    return drops;
}

double drop_fall_speed_m_s(double diameter_mm)
{
    return detail::larger(9.65 - 10.3 * detail::exponential(-0.6 * diameter_mm), 0.0);
}

}  // namespace petrichor::weather
