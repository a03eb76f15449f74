#include "weather/physics/ground.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/ground_kernel.h"

namespace petrichor::weather {

namespace {

// Nodes behind the last layer: they carry no heat and resist nothing.
constexpr double kNoResistance_w_m_k = 1e6, kNoCapacity_j_m3_k = 1e-3;

}  // namespace

GroundProfile make_ground_profile(std::span<const GroundLayer> layers, double conductivity,
                                  double heat_capacity, double back_resistance)
{
    GroundProfile profile;
    const bool open = back_resistance > 0.0;
    if (layers.empty() && !open) {
        profile.conductivity.fill(conductivity);
        profile.heat_capacity.fill(heat_capacity);
        return profile;
    }
    profile.bottom_resistance = back_resistance;
    const GroundLayer below{1e9, open ? kNoResistance_w_m_k : conductivity,
                            open ? kNoCapacity_j_m3_k : heat_capacity};
    std::size_t at = 0;
    double left_m = layers.empty() ? below.thickness_m : layers[0].thickness_m;
    for (std::size_t i = 0; i < kGroundLayers; ++i) {
        double wanted_m = kGroundThickness_m[i], resistance = 0.0, capacity = 0.0;
        while (wanted_m > 0.0) {
            const GroundLayer& layer = at < layers.size() ? layers[at] : below;
            const double part_m = std::min(wanted_m, left_m);
            resistance += part_m / layer.conductivity_w_m_k;
            capacity += part_m * layer.heat_capacity_j_m3_k;
            wanted_m -= part_m;
            left_m -= part_m;
            if (left_m <= 0.0) {
                ++at;
                left_m = at < layers.size() ? layers[at].thickness_m : below.thickness_m;
            }
        }
        profile.conductivity[i] = kGroundThickness_m[i] / resistance;
        profile.heat_capacity[i] = capacity / kGroundThickness_m[i];
    }
    return profile;
}

GroundStack make_ground_stack(double conductivity, double heat_capacity, double dt_s)
{
    return make_ground_stack(make_ground_profile({}, conductivity, heat_capacity, 0.0), dt_s);
}

GroundStack make_ground_stack(const GroundProfile& profile, double dt_s)
{
    GroundStack stack;
    // From the bottom up. `y`: conductance seen below a point, towards the equivalent temperature
    // there.
    double y = 0.0;
    for (std::size_t i = kGroundLayers; i-- > 0;) {
        const double half = 0.5 * kGroundThickness_m[i] / profile.conductivity[i];
        // How much of the node its lower interface feels, and how much of the upper one the node.
        double share_down = 0.0;
        if (i + 1 == kGroundLayers) {
            y = 1.0 / (half + profile.bottom_resistance);  // straight to the fixed temperature
        } else {
            share_down = 1.0 / (1.0 + y * half);
            y = y * share_down;
            stack.weight_above[i + 1] *= share_down;
        }
        const double storage = profile.heat_capacity[i] * kGroundThickness_m[i] / dt_s;
        const double total = y + storage;
        stack.weight_below[i] = y / total;
        stack.weight_own[i] = storage / total;
        stack.weight_above[i] = 1.0 / (1.0 + total * half);
        y = total * stack.weight_above[i];
        stack.half_resistance_top = half;
    }
    for (std::size_t i = 0; i < kGroundLayers; ++i)
        stack.weight_equivalent[i] = 1.0 - stack.weight_above[i];
    stack.conductance_w_m2_k = y;
    return stack;
}

GroundStep step_ground(const GroundStack& stack, const std::array<double, kGroundLayers>& temp_k,
                       double surface_temp_k, double deep_temp_k)
{
    double equivalent[kGroundLayers];
    const double seen = detail::ground_equivalent(stack, temp_k.data(), deep_temp_k, equivalent);
    GroundStep step;
    step.flux_w_m2 = stack.conductance_w_m2_k * (surface_temp_k - seen);
    step.temp_k = temp_k;
    detail::ground_update(stack, surface_temp_k, equivalent, step.temp_k.data());
    return step;
}

double half_space_warming_k(double step_k, double depth_m, double diffusivity, double time_s)
{
    return step_k * std::erfc(depth_m / (2.0 * std::sqrt(diffusivity * time_s)));
}

double half_space_flux_w_m2(double step_k, double conductivity, double diffusivity, double time_s)
{
    return conductivity * step_k / std::sqrt(kPi * diffusivity * time_s);
}

double damping_depth_m(double diffusivity, double period_s)
{
    return std::sqrt(diffusivity * period_s / kPi);
}

}  // namespace petrichor::weather
