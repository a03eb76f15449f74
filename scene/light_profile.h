#ifndef PETRICHOR_SCENE_LIGHT_PROFILE_H
#define PETRICHOR_SCENE_LIGHT_PROFILE_H

#include <glm/glm.hpp>
#include <span>

#include "scene/scene.h"

namespace petrichor::scene {

/// How a lamp shines that way, by channel, as the lighting pass reads it (formulas/light/light_profile.h):
/// 1 without a profile, and for one that `profiles` does not hold.
///
///   profiles  Scene::light_profiles
///   away      unit, from the lamp
///   far_m     from the lamp; tells what is within a lantern
glm::vec3 profile_towards(const Light& light, std::span<const LightProfile> profiles, glm::vec3 away, float far_m);

}  // namespace petrichor::scene

#endif
