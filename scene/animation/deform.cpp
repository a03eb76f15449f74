#include "scene/animation/deform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace petrichor::scene {
namespace {

template <int N>
void add_targets(std::vector<glm::vec<N, float>>& values, const Primitive& primitive,
                 std::span<const float> weights, std::vector<glm::vec3> MorphTarget::*part)
{
    const std::size_t count = std::min(weights.size(), primitive.targets.size());
    for (std::size_t t = 0; t < count; ++t) {
        const auto& deltas = primitive.targets[t].*part;
        if (deltas.empty() || weights[t] == 0.0f) continue;
        for (std::size_t v = 0; v < values.size(); ++v) {
            for (int c = 0; c < 3; ++c) values[v][c] += weights[t] * deltas[v][c];
        }
    }
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise)
{
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : otherwise;
}

glm::mat4 blended(const Primitive& primitive, std::size_t vertex, std::size_t each,
                  std::span<const glm::mat4> joints)
{
    glm::mat4 m(0.0f);
    for (std::size_t i = vertex * each; i < (vertex + 1) * each; ++i) {
        const Influence& influence = primitive.influences[i];
        if (influence.weight != 0.0f) m += influence.weight * joints[influence.joint];
    }
    return m;
}

void skin(Shape& shape, const Primitive& primitive, std::span<const glm::mat4> joints)
{
    const std::size_t each = primitive.influences.size() / shape.positions.size();
    for (std::size_t v = 0; v < shape.positions.size(); ++v) {
        const glm::mat4 m = blended(primitive, v, each, joints);
        const glm::mat3 linear(m);
        glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
        if (glm::determinant(linear) < 0.0f) cofactors = -cofactors;
        shape.positions[v] = glm::vec3(m * glm::vec4(shape.positions[v], 1.0f));
        shape.normals[v] = unit_or(cofactors * shape.normals[v], shape.normals[v]);
        if (!shape.tangents.empty()) {
            const glm::vec3 was(shape.tangents[v]);
            shape.tangents[v] = glm::vec4(unit_or(linear * was, was), shape.tangents[v].w);
        }
    }
}

// Every triangle of a flat primitive has its own vertices, or shares them with triangles in its plane.
void flatten(Shape& shape, const Primitive& primitive, bool mirrored)
{
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* index = &primitive.indices[i];
        const glm::dvec3 a(shape.positions[index[0]]);
        glm::dvec3 across = glm::cross(glm::dvec3(shape.positions[index[1]]) - a,
                                       glm::dvec3(shape.positions[index[2]]) - a);
        if (mirrored) across = -across;
        const double length = glm::length(across);
        if (!(length > 0.0) || !std::isfinite(length)) continue;
        for (int c = 0; c < 3; ++c) shape.normals[index[c]] = glm::vec3(across / length);
    }
}

}  // namespace

Shape deformed(const Primitive& primitive, std::span<const float> weights,
               std::span<const glm::mat4> joints)
{
    Shape shape{primitive.positions, primitive.normals, primitive.tangents};
    if (shape.positions.empty()) return shape;
    add_targets<3>(shape.positions, primitive, weights, &MorphTarget::positions);
    add_targets<3>(shape.normals, primitive, weights, &MorphTarget::normals);
    add_targets<4>(shape.tangents, primitive, weights, &MorphTarget::tangents);
    for (std::size_t v = 0; v < shape.normals.size(); ++v)
        shape.normals[v] = unit_or(shape.normals[v], primitive.normals[v]);
    for (std::size_t v = 0; v < shape.tangents.size(); ++v) {
        const glm::vec4& was = primitive.tangents[v];
        shape.tangents[v] =
            glm::vec4(unit_or(glm::vec3(shape.tangents[v]), glm::vec3(was)), was.w);
    }
    const bool skinned = !primitive.influences.empty() && !joints.empty();
    if (skinned) skin(shape, primitive, joints);
    if (primitive.flat) {
        const bool mirrored =
            skinned &&
            glm::determinant(glm::mat3(joints[primitive.influences.front().joint])) < 0.0f;
        flatten(shape, primitive, mirrored);
    }
    return shape;
}

Bounds deformed_bounds(const Primitive& primitive, std::span<const float> weights,
                       std::span<const glm::mat4> joints)
{
    const Shape shape = deformed(primitive, weights, joints);
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
    for (const glm::vec3& position : shape.positions) {
        bounds.low = glm::min(bounds.low, position);
        bounds.high = glm::max(bounds.high, position);
    }
    return bounds;
}

}  // namespace petrichor::scene
