#ifndef PETRICHOR_GPU_PASSES_SKY_SCATTERED_AGAIN_H
#define PETRICHOR_GPU_PASSES_SKY_SCATTERED_AGAIN_H

#include <array>
#include <memory>

#include "formulas/light/atmosphere.h"

namespace petrichor::gpu {

/// Light that air and ground have scattered more than once, by height and sun, for clear air.
///
///   source   Hillaire 2020, section 5.5: what is scattered twice, and a series for the rest. Here along 64
///            directions, denser near the horizon, where all light of a dusk is
class ScatteredAgain {
public:
    static constexpr std::size_t kEntries = static_cast<std::size_t>(shared::kAgainHeights) * shared::kAgainSuns;
    using Table = std::array<glm::vec4, kEntries>;

    /// Haze as Sky::turbidity; the same bits on every machine.
    explicit ScatteredAgain(float turbidity);

    float turbidity() const { return turbidity_; }

    /// As formulas/light/air_radiance.inc reads it, over land of this albedo, 0..1.
    Table table(float ground_albedo) const;

private:
    float turbidity_;
    Table by_air_, by_ground_;  // radiance; of the second for an albedo of 1
};

/// A table and the shared text that reads it.
class ClearAir {
public:
    explicit ClearAir(const ScatteredAgain::Table& table) : table_(table) {}

    /// Radiance, as in air_radiance.inc.
    glm::vec3 radiance(float up, float sun_up, float sun_angle, const glm::vec3& sun_illuminance,
                       float turbidity) const;

    /// What the whole sky sends onto level ground, for a sun of illuminance 1 above the air.
    glm::vec3 on_level_ground(float sun_up, float turbidity) const;

private:
    const ScatteredAgain::Table& table_;
};

}  // namespace petrichor::gpu

#endif
