#ifndef PETRICHOR_WEATHER_PHYSICS_EXCHANGE_H
#define PETRICHOR_WEATHER_PHYSICS_EXCHANGE_H

namespace petrichor::weather {

/// How stable air damps the exchange of heat and vapour.
enum class Stability {
    Louis,        ///< Louis 1979 without a floor: exchange nearly stops over cold snow in calm air
    LouisCapped,  ///< the same with the Richardson number held below `max_richardson`
    Neutral,      ///< no correction
};

struct ExchangeParams {
    Stability stability = Stability::LouisCapped;
    double max_richardson = 0.1;  ///< cap in stable air, >= 0
    double min_wind_m_s = 0.1;    ///< wind is raised to this; > 0
    double max_unstable = 50.0;   ///< most that unstable air adds to the exchange, as a factor >= 1
    double rain_heat = 1.0;       ///< share of the heat that rain brings, 0..1; METRo knows none
};

/// Exchange coefficient of heat in neutral air: k^2 / (ln(zU/z0) ln(zT/z0h)), z0h = z0/10.
double neutral_exchange(double wind_height_m, double temp_height_m, double roughness_m);

/// Bulk Richardson number; positive in stable air.
double bulk_richardson(double wind_height_m, double air_temp_k, double surface_temp_k,
                       double wind_m_s);

/// Louis 1979 factor on the neutral coefficient: 1 at Ri = 0, below 1 in stable air, continuous.
double stability_factor(double richardson, double neutral, double wind_height_m,
                        double roughness_m);

/// C of the unstable branch 1 + 15 |Ri| / (1 + C sqrt|Ri|) that the model uses, Mascart, Noilhan &
/// Giordani 1995: as Louis' 75 CHn sqrt(zU/z0), and right too where heat has a roughness of its
/// own. In calm air the exchange becomes that of free convection.
double convection_coefficient(double wind_height_m, double roughness_m, double heat_roughness_m);

/// Free convection along a wall, of both signs: 1.31 |dT|^(1/3) W m-2 K-1, for what wind brings to
/// be added to (Walton 1983, TARP; ASHRAE). What stands upright is not damped by stable air:
/// gravity across it is none.
inline constexpr double kWallConvection_w_m2 = 1.31;
double wall_convection_w_m2_k(double difference_k);

/// Of leaves and blades: a plate across the wind gives heat and vapour to the air on both sides, kg m-2 s-1 (times the heat
/// capacity of air: W m-2 K-1). 0 without a width.
///   width_m   along the wind
///   wind_m_s  measured in the open: a third of it blows between leaves
///   source  Campbell & Norman 1998, 7.30 (forced convection, laminar, 1.4 for the gusts outdoors); the third is a
///           round number between crowns (0.3 to 0.5) and meadows (0.1 to 0.3)
double leaf_exchange(double width_m, double wind_m_s);

}  // namespace petrichor::weather

#endif
