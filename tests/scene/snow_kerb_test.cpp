// Deep snow on the kerbs of the demo: one sheet, seen from where people stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "demo/street.h"
#include "scene/patches/tracer.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::scene {
namespace {

using glm::vec3;

// A street under snow: its own triangles, and those of the caps as they lie.
class Snowed {
public:
    Snowed(const Scene& street, const SnowCaps& caps, float depth_m)
        : caps_(&caps), shape_(snow_shape(caps, std::vector<float>(caps.points.size(), depth_m))), scene_(street)
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
        vec3 at{0.0f};
        vec3 normal{0.0f};
    };
    // What an eye sees along a ray. The last of a rim is drawn as snow where it is a centimetre deep.
    Seen look(const vec3& eye, const vec3& target) const
    {
        const vec3 way = glm::normalize(target - eye);
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

SnowCaps caps_seen_from(const Scene& scene, const vec3& eye)
{
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    SnowCapOptions options;
    options.eyes_m = {eye};
    return build_snow_caps(tracer, options);
}

struct Street {
    Scene scene = demo::make_demo_street({.texture_size = 16});
    SnowCaps caps = caps_seen_from(scene, {0.0f, 1.6f, 7.0f});
};
const Street& street()
{
    static const Street made;
    return made;
}

// Kerbs of 11 cm, their blocks tilted and bevelled, with joints between; a gutter of blocks before them, paving or a verge
// behind. Along what lies in the open.
struct Kerb {
    const char* name;
    float side, from_z, to_z;
};
constexpr Kerb kKerbs[] = {{"left", -1.0f, 4.6f, 6.5f}, {"right", 1.0f, 2.9f, 6.5f}};

// Snow lies where it fell: nowhere is it higher above its ground than it is deep and than a step that a bank covers.
TEST(SnowOnKerbs, StandsNowhereUp)
{
    for (const float depth : {0.05f, 0.12f, 0.2f, 0.3f}) {
        const SnowShape shape = snow_shape(street().caps, std::vector<float>(street().caps.points.size(), depth));
        float highest = 0.0f;
        for (std::size_t i = 0; i < shape.positions.size(); ++i)
            highest = std::max(highest, shape.positions[i].y - street().caps.points[i].base_m.y);
        EXPECT_LT(highest, 1.5f * depth + 0.3f) << "at " << depth;
        EXPECT_GT(highest, depth) << "at " << depth;
    }
}

// No stone is seen between the snow on a kerb and that beside it, by someone who stands in the street.
TEST(SnowOnKerbs, LeavesNoStoneBetween)
{
    for (const float depth : {0.12f, 0.15f, 0.2f, 0.3f}) {
        const Snowed snowed(street().scene, street().caps, depth);
        for (const Kerb& kerb : kKerbs) {
            int all = 0, stone = 0;
            for (float z = kerb.from_z; z < kerb.to_z; z += 0.011f) {
                for (float x = 2.2f; x < 2.9f; x += 0.013f) {
                    ++all;
                    stone += snowed.look({0.0f, 1.6f, 8.5f}, {kerb.side * x, 0.1f, z}).snow ? 0 : 1;
                }
            }
            const double share = static_cast<double>(stone) / all;
            RecordProperty(std::string(kerb.name) + std::to_string(depth), std::to_string(share));
            EXPECT_LT(share, 0.0005) << kerb.name << " " << depth;
        }
    }
}

// Nor farther from the eye, at joints of both the kerb and its gutter, under snow that is hardly as deep as the kerb is high.
TEST(SnowOnKerbs, LeavesNoStoneAtJointsAndFarAway)
{
    const vec3 eye(0.9f, 1.5f, 6.0f);
    const SnowCaps caps = caps_seen_from(street().scene, eye);
    struct Look {
        const char* name;
        float depth, side, from_z, to_z, most;
    };
    for (const Look& part : {Look{"left", 0.087f, -1.0f, 1.0f, 5.0f, 0.001f}, Look{"right", 0.087f, 1.0f, -3.9f, 5.0f, 0.001f},
                             Look{"far", 0.16f, 1.0f, -6.9f, -5.0f, 0.001f}}) {
        const Snowed snowed(street().scene, caps, part.depth);
        int all = 0, stone = 0;
        for (float z = part.from_z; z < part.to_z; z += 0.017f) {
            for (float x = 2.4f; x < 2.6f; x += 0.013f) {
                ++all;
                stone += snowed.look(eye, {part.side * x, 0.1f, z}).snow ? 0 : 1;
            }
        }
        const float share = static_cast<float>(stone) / static_cast<float>(all);
        RecordProperty(part.name, std::to_string(share));
        EXPECT_LE(share, part.most) << part.name;
    }
}

// One sheet: seen from above it has no steps, and hardly a crease.
TEST(SnowOnKerbs, IsOneSheet)
{
    for (const float depth : {0.12f, 0.2f, 0.3f}) {
        const Snowed snowed(street().scene, street().caps, depth);
        for (const Kerb& kerb : kKerbs) {
            int all = 0, steps = 0, creases = 0;
            for (float z = kerb.from_z; z < kerb.to_z; z += 0.037f) {
                Snowed::Seen before;
                for (float x = 2.1f; x < 2.78f; x += 0.01f) {
                    const auto seen = snowed.look({kerb.side * x, 3.0f, z}, {kerb.side * x, 0.0f, z});
                    if (seen.snow && before.snow) {
                        ++all;
                        steps += std::abs(seen.at.y - before.at.y) > 0.02f ? 1 : 0;
                        creases += glm::dot(seen.normal, before.normal) < 0.9f ? 1 : 0;
                    }
                    before = seen;
                }
            }
            EXPECT_GT(all, 1000);
            RecordProperty(std::string("steps_") + kerb.name + std::to_string(depth), steps);
            RecordProperty(std::string("creases_") + kerb.name + std::to_string(depth), creases);
            EXPECT_LT(steps, all / 500) << kerb.name << " " << depth;
            EXPECT_LT(creases, all / 100) << kerb.name << " " << depth;
        }
    }
}

}  // namespace
}  // namespace petrichor::scene
