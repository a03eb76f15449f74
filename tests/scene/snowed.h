// What an eye sees of a scene under snow.
#ifndef PETRICHOR_TESTS_SCENE_SNOWED_H
#define PETRICHOR_TESTS_SCENE_SNOWED_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "scene/patches/tracer.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::scene::snow_scenes {

// A scene under snow: its own triangles, and those of the caps as they lie.
class Snowed {
public:
    Snowed(const Scene& scene, const SnowCaps& caps, float depth_m)
        : caps_(&caps), shape_(snow_shape(caps, std::vector<float>(caps.points.size(), depth_m))), scene_(scene)
    {
        own_ = Triangles(scene_, {}).size();
        Mesh mesh;
        Primitive p;
        p.material = caps.parts.front().material;
        p.positions = shape_.positions;
        p.normals = shape_.normals;
        for (std::size_t k = 0; k + 2 < caps.indices.size(); k += 3) {
            const std::uint32_t a = caps.corner_points[caps.indices[k]], b = caps.corner_points[caps.indices[k + 1]];
            const std::uint32_t c = caps.corner_points[caps.indices[k + 2]];
            if (!(glm::length(glm::cross(shape_.positions[b] - shape_.positions[a], shape_.positions[c] - shape_.positions[a])) > 0.0f)) continue;
            p.indices.insert(p.indices.end(), {a, b, c});
            corners_.push_back({a, b, c});
        }
        mesh.primitives.push_back(std::move(p));
        scene_.meshes.push_back(std::move(mesh));
        Instance instance;
        instance.mesh = static_cast<std::uint32_t>(scene_.meshes.size() - 1);
        scene_.instances.push_back(instance);
        triangles_.emplace(scene_, std::vector<AlphaImage>{});
        tracer_.emplace(*triangles_);
    }

    struct Seen {
        bool snow = false;
        glm::vec3 at{0.0f};
        glm::vec3 normal{0.0f};
    };
    // What an eye sees along a ray. The last of a rim is drawn as snow where it is a centimetre deep.
    Seen look(const glm::vec3& eye, const glm::vec3& target) const
    {
        const glm::vec3 way = glm::normalize(target - eye);
        float from = 0.0f;
        for (int i = 0; i < 8; ++i) {
            const RayHit hit = tracer_->nearest({eye + way * from, way});
            if (!hit.hit()) break;
            from += hit.distance_m;
            if (hit.triangle < own_) return {false, eye + way * from, {}};
            const auto& t = corners_.at(hit.triangle - own_);
            const float b0 = 1.0f - hit.at.b1 - hit.at.b2;
            const float deep = b0 * shape_.deep_m[t[0]] + hit.at.b1 * shape_.deep_m[t[1]] + hit.at.b2 * shape_.deep_m[t[2]];
            if (deep > 0.01f && !hit.back)
                return {true, eye + way * from, glm::normalize(b0 * shape_.normals[t[0]] + hit.at.b1 * shape_.normals[t[1]] + hit.at.b2 * shape_.normals[t[2]])};
            from += 1.0e-4f;
        }
        return {};
    }
    const SnowShape& shape() const { return shape_; }

private:
    const SnowCaps* caps_;
    SnowShape shape_;
    Scene scene_;
    std::uint32_t own_ = 0;
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::optional<Triangles> triangles_;
    std::optional<Tracer> tracer_;
};

inline SnowCaps caps_seen_from(const Scene& scene, const glm::vec3& eye)
{
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    SnowCapOptions options;
    options.eyes_m = {eye};
    return build_snow_caps(tracer, options);
}

}  // namespace petrichor::scene::snow_scenes

#endif
