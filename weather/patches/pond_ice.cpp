#include "weather/patches/pond_ice.h"

#include <algorithm>

#include "weather/physics/constants.h"

namespace petrichor::weather {
namespace {

constexpr double kIceConductivity_w_m_k = 2.2;
constexpr double kPiece_s = 600.0;  // a step is cut into such pieces

double melted(double heat_j_m2, double water_kg_m2, const PondAir& air, double dt_s)
{
    // The water's own temperature at the end decides: stable for puddles too.
    const double per_kelvin = water_kg_m2 * kWaterHeatCapacity;
    const double gained = heat_j_m2 + air.gain_w_m2 * dt_s;
    return gained > 0.0 ? gained / (1.0 + air.loss_w_m2_k * dt_s / per_kelvin) : gained;
}

double frozen(double heat_j_m2, const PondAir& air, double dt_s)
{
    if (air.ice_gain_w_m2 >= 0.0) return heat_j_m2 + air.ice_gain_w_m2 * dt_s;
    const double ice_m = -heat_j_m2 / (kLatentFusion * kIceDensity);
    const double resistance = ice_m / kIceConductivity_w_m_k + air.cover_m2_k_w;
    return heat_j_m2 + air.ice_gain_w_m2 / (1.0 + air.ice_loss_w_m2_k * resistance) * dt_s;
}

}  // namespace

double step_pond_heat(double heat_j_kg, double water_kg_m2, const PondAir& air, double dt_s)
{
    double heat = heat_j_kg * water_kg_m2;
    for (double left = dt_s; left > 0.0; left -= kPiece_s) {
        const double piece = std::min(left, kPiece_s);
        // What is left over where one becomes the other goes on as the other, a piece later.
        heat = heat >= 0.0 && (heat > 0.0 || air.gain_w_m2 >= 0.0)
                   ? melted(heat, water_kg_m2, air, piece)
                   : frozen(heat, air, piece);
        heat = std::max(heat, -kLatentFusion * water_kg_m2);
    }
    return heat / water_kg_m2;
}

double pond_ice_share(double heat_j_kg)
{
    return std::clamp(-heat_j_kg / kLatentFusion, 0.0, 1.0);
}

double pond_water_c(double heat_j_kg)
{
    return std::max(heat_j_kg, 0.0) / kWaterHeatCapacity;
}

}  // namespace petrichor::weather
