#ifndef PETRICHOR_SCENE_PATCHES_LAMPS_H
#define PETRICHOR_SCENE_PATCHES_LAMPS_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/patches.h"
#include "scene/patches/tracer.h"

namespace petrichor::scene {

/// Rays to a lamp end so far before it: lamps sit inside their lanterns.
inline constexpr float kLanternRadius_m = 0.35f;

/// Irradiance that a point light or spot brings to a surface that nothing shades, lux by channel: by its
/// cone and its profile, of those of the scene. Nearer than least_m it does not grow. Directional lights: as
/// far away as they are.
glm::vec3 lamp_irradiance(const Light& light, std::span<const LightProfile> profiles, glm::vec3 position_m,
                          glm::vec3 normal, float least_m = 0.0f);

/// Whether a ray from a point reaches the lamp. It ends kLanternRadius_m before it.
bool lamp_seen(const Tracer& tracer, const Light& light, glm::vec3 from);

/// Positions of the lamps near which cells are smaller; none where there are more than 64: cells would be small everywhere.
std::vector<glm::vec3> lamps_that_cut(const Scene& scene);

/// Light of one lamp on every patch, added to `direct`, one entry a leaf. Directional lights are shaded
/// by the visibility bits, others by reach (trace_lamp; empty: nothing shades them) and by their profile, of
/// `profiles`, those of the scene.
void add_lamp(const Patches& patches, const Light& light, std::span<const LightProfile> profiles,
              std::span<const std::uint8_t> reach, std::vector<glm::vec3>& direct);

}  // namespace petrichor::scene

#endif
