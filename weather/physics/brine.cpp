#include "weather/physics/brine.h"

#include "weather/physics/detail/brine_kernel.h"

namespace petrichor::weather {

double brine_strength(double temp_c)
{
    return detail::brine_share_of(-temp_c);
}

double freezing_point_c(double salt_share)
{
    // The share grows with the depression all the way.
    double low = 0.0, high = kEutecticDepression_k;
    if (!(salt_share > 0.0)) return 0.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (detail::brine_share_of(middle) < salt_share ? low : high) = middle;
    }
    return -high;
}

double freezing_point_c(double salt_kg_m2, double water_kg_m2)
{
    return salt_kg_m2 > 0.0 ? freezing_point_c(salt_kg_m2 / (salt_kg_m2 + water_kg_m2)) : 0.0;
}

double brine_water_kg_m2(double salt_kg_m2, double water_kg_m2, double temp_c)
{
    return detail::brine_water_of(salt_kg_m2, water_kg_m2, temp_c);
}

}  // namespace petrichor::weather
