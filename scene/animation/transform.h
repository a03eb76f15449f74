#ifndef PETRICHOR_SCENE_ANIMATION_TRANSFORM_H
#define PETRICHOR_SCENE_ANIMATION_TRANSFORM_H

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace petrichor::scene {

/// Translation * rotation * scale, as glTF composes a node.
glm::dmat4 compose(const glm::dvec3& translation, const glm::dquat& rotation,
                   const glm::dvec3& scale);

/// A unit quaternion from x, y, z, w as files give them; nothing when they have no direction.
std::optional<glm::dquat> to_rotation(const glm::vec4& xyzw);

/// All its numbers are below 1e18: a place in the world and its square still fit a float.
bool is_usable(const glm::dmat4& m);

/// The rotation and place of a matrix: columns made orthonormal, z first, since a camera or light
/// looks along it. A mirrored or collapsed matrix gives the nearest proper frame.
glm::dmat4 without_scale(const glm::dmat4& m);

}  // namespace petrichor::scene

#endif
