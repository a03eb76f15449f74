// Small scenes for tests of patches: faces that are made corner by corner.
#ifndef PETRICHOR_TESTS_SCENE_PATCH_SCENES_H
#define PETRICHOR_TESTS_SCENE_PATCH_SCENES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace petrichor::scene::patch_scenes {

inline Scene empty_scene()
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    scene.meshes[0].primitives.resize(1);
    scene.instances.resize(1);
    return scene;
}

/// A parallelogram: corner, corner + u, corner + u + v, corner + v; seen from where that turns left.
inline void add_face(Scene& scene, glm::vec3 corner, glm::vec3 u, glm::vec3 v,
                     std::size_t primitive = 0)
{
    Primitive& p = scene.meshes[0].primitives[primitive];
    const auto first = static_cast<std::uint32_t>(p.positions.size());
    const glm::vec3 n = glm::normalize(glm::cross(u, v));
    for (const glm::vec3& x : {corner, corner + u, corner + u + v, corner + v}) {
        p.positions.push_back(x);
        p.normals.push_back(n);
        p.uv0.push_back({0.0f, 0.0f});
    }
    p.uv0[first + 1] = {1.0f, 0.0f};
    p.uv0[first + 2] = {1.0f, 1.0f};
    p.uv0[first + 3] = {0.0f, 1.0f};
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
}

/// The six faces of a box, seen from within or from outside.
inline void add_box(Scene& scene, glm::vec3 low, glm::vec3 high, bool from_within,
                    std::size_t primitive = 0)
{
    const glm::vec3 d = high - low;
    const glm::vec3 x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
    const std::array<std::array<glm::vec3, 3>, 6> faces{{
        {low, z, x},        // floor, normal up
        {low + y, x, z},    // ceiling, down
        {low, y, z},        // x low, towards +x
        {low + x, z, y},    // x high, towards -x
        {low, x, y},        // z low, towards +z
        {low + z, y, x},    // z high, towards -z
    }};
    for (const auto& face : faces) {
        if (from_within)
            add_face(scene, face[0], face[1], face[2], primitive);
        else
            add_face(scene, face[0], face[2], face[1], primitive);
    }
}

/// A room of 4 m, seen from within.
inline Scene room()
{
    Scene scene = empty_scene();
    add_box(scene, glm::vec3(0.0f), glm::vec3(4.0f), true);
    return scene;
}

/// A second primitive with a material of its own; returns its number.
inline std::size_t add_material(Scene& scene, const Material& material)
{
    scene.materials.push_back(material);
    scene.meshes[0].primitives.emplace_back();
    scene.meshes[0].primitives.back().material =
        static_cast<std::uint32_t>(scene.materials.size() - 1);
    return scene.meshes[0].primitives.size() - 1;
}

/// Second coordinates: every face (four corners) gets a square of its own, an eighth of its
/// cell away from the next.
inline void unwrap(Scene& scene)
{
    std::size_t faces = 0;
    for (const Primitive& p : scene.meshes[0].primitives) faces += p.positions.size() / 4;
    const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(faces))));
    const float cell = 1.0f / static_cast<float>(across);
    std::size_t face = 0;
    for (Primitive& p : scene.meshes[0].primitives) {
        for (std::size_t i = 0; i < p.positions.size(); i += 4, ++face) {
            const glm::vec2 low{static_cast<float>(face % across) + 0.125f,
                                static_cast<float>(face / across) + 0.125f};
            for (std::size_t k = 0; k < 4; ++k) p.uv1.push_back((low + 0.75f * p.uv0[i + k]) * cell);
        }
    }
}

}  // namespace petrichor::scene::patch_scenes

#endif
