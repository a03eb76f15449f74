// Small scenes for tests of snow, and the caps of them.
#ifndef PETRICHOR_TESTS_SCENE_SNOW_SCENES_H
#define PETRICHOR_TESTS_SCENE_SNOW_SCENES_H

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/snow/snow_caps.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene::snow_scenes {

using namespace patch_scenes;

inline SnowCaps caps_of(const Scene& scene, SnowCapOptions options = {})
{
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    return build_snow_caps(tracer, options);
}

inline void add_ground(Scene& scene, float half = 3.0f)
{
    add_face(scene, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
}

/// A post, a table without legs, a wall and a kerb on open ground.
inline Scene yard()
{
    Scene scene = empty_scene();
    add_ground(scene);
    add_box(scene, {-0.2f, 0, -0.2f}, {0.2f, 1, 0.2f}, false);
    add_box(scene, {1, 0.8f, -1}, {2.6f, 0.9f, 1}, false);
    add_box(scene, {-3, 0, -2.2f}, {3, 2, -2.0f}, false);
    add_box(scene, {-3, 0, 1.5f}, {-1, 0.12f, 3}, false);
    return scene;
}

/// The nearest point at the height of a place.
inline const SnowCaps::Point& point_at(const SnowCaps& caps, const glm::vec3& place)
{
    const SnowCaps::Point* best = &caps.points.front();
    const auto away = [&](const SnowCaps::Point& p) {
        return glm::distance(p.base_m, place) + 100.0f * std::abs(p.base_m.y - place.y);
    };
    for (const auto& p : caps.points) {
        if (away(p) < away(*best)) best = &p;
    }
    return *best;
}

/// Stones of 15 cm, `half_m` above and below the mean, in quads of a whole part of that.
inline Scene cobbles(std::uint32_t quads_a_stone, std::uint32_t side, float half_m)
{
    Scene scene = patch_scenes::empty_scene();
    const float step_m = 0.15f / static_cast<float>(quads_a_stone);
    const float turn = 6.2831853f / static_cast<float>(quads_a_stone);
    Primitive& p = scene.meshes[0].primitives[0];
    for (std::uint32_t z = 0; z <= side; ++z) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            const float up = half_m * (std::sin(turn * static_cast<float>(x)) + std::sin(turn * static_cast<float>(z)));
            p.positions.emplace_back(step_m * static_cast<float>(x), up, step_m * static_cast<float>(z));
            p.normals.emplace_back(0, 1, 0);
            p.uv0.emplace_back(0.0f);
        }
    }
    for (std::uint32_t z = 0; z < side; ++z) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = z * (side + 1) + x, b = a + side + 1;
            for (const std::uint32_t v : {a, b, a + 1, a + 1, b, b + 1}) p.indices.push_back(v);
        }
    }
    return scene;
}

}  // namespace petrichor::scene::snow_scenes

#endif
