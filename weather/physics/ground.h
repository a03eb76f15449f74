#ifndef PETRICHOR_WEATHER_PHYSICS_GROUND_H
#define PETRICHOR_WEATHER_PHYSICS_GROUND_H

#include <array>
#include <cstddef>
#include <span>

namespace petrichor::weather {

/// Layers of the ground, from the surface down. The first six are those of road models; three more
/// carry the yearly wave, so that a fixed temperature below does not feed the snow with heat.
inline constexpr std::size_t kGroundLayers = 9;
inline constexpr std::array<double, kGroundLayers> kGroundThickness_m{0.01, 0.02, 0.04, 0.08, 0.16,
                                                                      0.32, 0.64, 1.28, 2.56};

/// Heat conduction in the ground over one fixed step, factored once (backward Euler,
/// unconditionally stable; Crank-Nicolson would ring). Bottom: a fixed temperature.
///
/// Seen from its surface the column is a conductance towards an equivalent temperature:
///   flux_down = conductance (surface - equivalent),
/// which couples it implicitly to whatever lies on top.
struct GroundStack {
    double conductance_w_m2_k = 0.0;   ///< of the whole column at its surface
    double half_resistance_top = 0.0;  ///< m2 K / W, from the surface to the first node
    std::array<double, kGroundLayers> weight_below{};  ///< of the equivalent temperature from below
    std::array<double, kGroundLayers> weight_own{};    ///< of the layer's own old temperature
    /// A node's new temperature is a mean of the one above it (the surface, for the first) and its
    /// own equivalent temperature.
    std::array<double, kGroundLayers> weight_above{}, weight_equivalent{};
};

/// Factors for a step of dt seconds; conductivity W m-1 K-1, capacity J m-3 K-1, all > 0.
GroundStack make_ground_stack(double conductivity, double heat_capacity, double dt_s);

/// A layer of a road or a roof.
struct GroundLayer {
    double thickness_m = 0.1;             ///< > 0
    double conductivity_w_m_k = 0.8;      ///< > 0
    double heat_capacity_j_m3_k = 2.1e6;  ///< > 0
};
/// Conductivity and heat capacity of every node: resistances of the layers within it add, and so do
/// their capacities.
struct GroundProfile {
    std::array<double, kGroundLayers> conductivity{}, heat_capacity{};
    double bottom_resistance = 0.0;  ///< m2 K / W, from the last node on to the fixed temperature
};
/// Layers from the top, over ground of the last two values.
///   back_resistance  m2 K / W; above 0 there is no ground below the layers but air behind this
GroundProfile make_ground_profile(std::span<const GroundLayer> layers, double conductivity,
                                  double heat_capacity, double back_resistance);
inline constexpr double kUnderBridge_m2_k_w = 0.1;  ///< 10 W m-2 K-1
GroundStack make_ground_stack(const GroundProfile& profile, double dt_s);

/// Temperatures after one step with the surface held at `surface_temp_k`.
struct GroundStep {
    std::array<double, kGroundLayers> temp_k{};
    double flux_w_m2 = 0.0;  ///< into the ground, mean of the step
};
GroundStep step_ground(const GroundStack& stack, const std::array<double, kGroundLayers>& temp_k,
                       double surface_temp_k, double deep_temp_k);

/// Warming at a depth of a half-space whose surface is raised by `step_k` at time 0 (Carslaw &
/// Jaeger).
double half_space_warming_k(double step_k, double depth_m, double diffusivity_m2_s, double time_s);
/// Flux into that half-space at the surface.
double half_space_flux_w_m2(double step_k, double conductivity, double diffusivity_m2_s,
                            double time_s);
/// Depth at which a wave of a period has fallen to 1/e.
double damping_depth_m(double diffusivity_m2_s, double period_s);

}  // namespace petrichor::weather

#endif
