#ifndef PETRICHOR_SCENE_ANIMATION_DEFORM_H
#define PETRICHOR_SCENE_ANIMATION_DEFORM_H

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Vertices of a primitive in another shape, as many as it has.
struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< unit
    std::vector<glm::vec4> tangents;  ///< unit xyz, w as it was
};

/// Morph targets first, then joints.
///
///   weights  of the targets; those that are missing are 0
///   joints   from the mesh to the world, every influence below their number; empty: not skinned
///   normals  go by the cofactors of the blended joints, so they stay right under any scale; those
///            of a flat primitive are the triangles' own. One that collapses stays as it was.
///   source   glTF 2.0 specification, 3.7.2.2 (morph targets) and 3.7.3.3 (skinned mesh attributes)
Shape deformed(const Primitive& primitive, std::span<const float> weights,
               std::span<const glm::mat4> joints);

/// A box that holds the primitive in any shape that these weights and joints give it.
Bounds deformed_bounds(const Primitive& primitive, std::span<const float> weights,
                       std::span<const glm::mat4> joints);

}  // namespace petrichor::scene

#endif
