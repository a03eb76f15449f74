#ifndef PETRICHOR_SCENE_ANIMATION_WAVE_H
#define PETRICHOR_SCENE_ANIMATION_WAVE_H

#include "scene/animation/deform.h"

namespace petrichor::scene {

/// The wind of a moment.
struct Wind {
    glm::vec2 velocity_m_s{0.0f};  ///< world x and z
    glm::dvec2 air_m{0.0};         ///< how far the air has gone, world x and z: gusts go with it
    double time_s = 0.0;           ///< drives the swaying

    bool operator==(const Wind&) const = default;
};

/// What stands in the wind bends with it, sways and flutters: plants, flags, hair of grass. A function of
/// the arguments alone; neighbours in the world move alike, whatever mesh they are of. Without wind the
/// shape is that of the primitive, to the bit.
///
///   box      of the primitive, in its own space
///   source   the lean saturates with the speed, as plants that fold do (Vogel 1984); gusts are noise
///            that the air carries (Taylor 1938, frozen turbulence); blades keep their length
Shape waved(const Primitive& primitive, const Bounds& box, const glm::mat4& to_world,
            const WindLook& look, const Wind& wind);

/// No vertex goes farther than this, metres in the world.
float wave_reach_m(const Bounds& box, const glm::mat4& to_world, const WindLook& look);

}  // namespace petrichor::scene

#endif
