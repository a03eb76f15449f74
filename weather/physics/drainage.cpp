#include "weather/physics/drainage.h"

#include <cmath>

#include "weather/physics/detail/horton.h"
#include "weather/physics/detail/reservoir.h"

namespace petrichor::weather {

FilmStep drain_film(double water, double net, double rate, double threshold, double dt)
{
    const auto constants = detail::reservoir_constants(rate, threshold, dt);
    const auto step =
        detail::drain_reservoir(water, net, threshold, detail::drain_of<double>(constants));
    return {step.water, step.drained, step.shortfall};
}

double rrl_film_mm(double length_m, double rate_mm_h, double slope_n)
{
    return 0.046 * std::sqrt(length_m * rate_mm_h) * detail::power(slope_n, 0.2);
}

double manning_film_mm(double length_m, double rate_mm_h, double manning_n, double slope)
{
    const double flow_m2_s = rate_mm_h / 3.6e6 * length_m;
    if (!(flow_m2_s > 0.0)) return 0.0;
    return 1000.0 * detail::power(manning_n * flow_m2_s / std::sqrt(slope), 0.6);
}

double horton_depth_mm(const HortonParams& p, double hours)
{
    return detail::infiltration_depth(p.first_mm_h, detail::make_horton_step(p, hours), p);
}

}  // namespace petrichor::weather
