#include "scene/patches/lanterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "formulas/codec/octahedral.h"
#include "scene/patches/tracer.h"

namespace petrichor::scene {
namespace {

constexpr std::size_t kMost = 64;
constexpr float kLeastRadius_m = 0.03f;
constexpr float kMostRadius_m = 0.12f;
constexpr float kOfTheWay = 0.6f;
constexpr float kNothing_m = 1e3f;
constexpr int kSide = kLightProfileSide;
constexpr int kTraced = kSide / 2;  // directions a side; those between are means
constexpr int kPoints = 48;

bool may_have_one(const Light& light)
{
    const bool somewhere = glm::all(glm::lessThan(glm::abs(light.position_m), glm::vec3(1e6f)));  // NaN is nowhere
    return somewhere && light.kind == LightKind::Point && light.profile < 0 && light.node == kNoNode && light.length_m == 0.0f &&
           (light.radius_m == 0.0f || light.radius_m >= kLeastRadius_m);
}

bool hides(const Material& m)
{
    const bool glows = m.emissive * m.emissive_strength != glm::vec3(0.0f);
    return m.casts_shadows && !glows && m.transmission == 0.0f && m.alpha_mode != AlphaMode::Blend;
}

// Corners of triangles, three by three, around each of some lamps.
struct Around {
    std::size_t lamp = 0;
    std::vector<glm::vec3> corners;
    bool moves = false;
};

void gather(const Scene& scene, std::vector<Around>& all)
{
    glm::vec3 low(1e30f), high(-1e30f);
    for (const Around& one : all) {
        low = glm::min(low, scene.lights[one.lamp].position_m);
        high = glm::max(high, scene.lights[one.lamp].position_m);
    }
    for (const Instance& instance : scene.instances) {
        if (instance.backdrop || instance.detail.level != 0) continue;
        for (const Primitive& part : scene.meshes[instance.mesh].primitives) {
            if (!hides(scene.materials[part.material])) continue;
            for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
                std::array<glm::vec3, 3> corner;
                for (std::size_t k = 0; k < 3; ++k)
                    corner[k] = glm::vec3(instance.to_world * glm::vec4(part.positions[part.indices[i + k]], 1.0f));
                const glm::vec3 least = glm::min(glm::min(corner[0], corner[1]), corner[2]) - kLanternHalf_m;
                const glm::vec3 most = glm::max(glm::max(corner[0], corner[1]), corner[2]) + kLanternHalf_m;
                if (glm::any(glm::lessThan(most, low)) || glm::any(glm::greaterThan(least, high))) continue;
                for (Around& one : all) {
                    const glm::vec3 at = scene.lights[one.lamp].position_m;
                    if (glm::any(glm::lessThan(most, at)) || glm::any(glm::greaterThan(least, at))) continue;
                    one.moves = one.moves || instance.moves;
                    one.corners.insert(one.corners.end(), corner.begin(), corner.end());
                }
            }
        }
    }
}

// To the border of the cube.
float way_out_m(const glm::vec3& from, const glm::vec3& away)
{
    float least = 1e30f;
    for (int i = 0; i < 3; ++i) {
        const float side = away[i] > 0.0f ? kLanternHalf_m : -kLanternHalf_m;
        if (std::abs(away[i]) > 1e-6f) least = std::min(least, (side - from[i]) / away[i]);
    }
    return least;
}

class Lantern {
public:
    Lantern(const Light& light, const Around& around)
        : middle_(light.position_m), scene_(scene_of(around)), triangles_(scene_, {}), tracer_(triangles_)
    {
    }

    // x: share of the ball that is seen, y: metres to what is first met from its middle.
    std::optional<LightProfile> profile(float radius_m) const
    {
        std::vector<float> first;
        float nearest = kNothing_m;
        for (int i = 0; i < kTraced * kTraced; ++i) {
            const glm::vec3 away = direction(i);
            const RayHit hit = tracer_.nearest(
                {middle_ + kLampItself_m * away, away, way_out_m(glm::vec3(0.0f), away) - kLampItself_m});
            first.push_back(hit.hit() ? hit.distance_m + kLampItself_m : kNothing_m);
            nearest = std::min(nearest, first.back());
        }
        if (nearest == kNothing_m) return std::nullopt;
        const float radius = radius_m > 0.0f ? std::min(radius_m, 0.9f * nearest)
                                             : std::min(kOfTheWay * nearest, kMostRadius_m);
        std::vector<float> seen;
        for (int i = 0; i < kTraced * kTraced; ++i) seen.push_back(share_seen(direction(i), radius));
        LightProfile made;
        made.lantern = true;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const glm::vec2 at = 0.5f * glm::vec2(x, y) - 0.25f;
                made.texels.emplace_back(between(seen, at), first[texel(glm::ivec2(at + 0.5f))], 0.0f);
            }
        }
        return made;
    }

private:
    static Scene scene_of(const Around& around)
    {
        Scene scene;
        Primitive part;
        part.positions = around.corners;
        for (std::size_t i = 0; i < around.corners.size(); ++i) part.indices.push_back(static_cast<std::uint32_t>(i));
        Material both;
        both.double_sided = true;
        scene.materials.push_back(both);
        scene.meshes.push_back({"lantern", {std::move(part)}});
        scene.instances.emplace_back();
        return scene;
    }
    static glm::vec3 direction(int i)
    {
        const glm::vec2 at = (glm::vec2(i % kTraced, i / kTraced) + 0.5f) / static_cast<float>(kTraced);
        return shared::octahedral_decode(at * 2.0f - 1.0f);
    }
    // Of a disc across the way, its points along a spiral.
    float share_seen(const glm::vec3& away, float radius_m) const
    {
        const glm::vec3 across = glm::normalize(std::abs(away.y) < 0.7f ? glm::vec3(-away.z, 0.0f, away.x)
                                                                       : glm::vec3(0.0f, away.z, -away.y));
        const glm::vec3 other = glm::cross(away, across);
        int seen = 0;
        Tracer::Blocker last;
        for (int k = 0; k < kPoints; ++k) {
            const float r = radius_m * std::sqrt((static_cast<float>(k) + 0.5f) / kPoints);
            const float turn = 2.39996323f * static_cast<float>(k);
            const glm::vec3 aside = r * (std::cos(turn) * across + std::sin(turn) * other);
            const float begin = std::sqrt(std::max(kLampItself_m * kLampItself_m - r * r, 0.0f));
            const glm::vec3 from = aside + begin * away;
            seen += tracer_.blocked({middle_ + from, away, way_out_m(from, away)}, &last) ? 0 : 1;
        }
        return static_cast<float>(seen) / kPoints;
    }
    static std::size_t texel(glm::ivec2 at)
    {
        at = glm::clamp(at, glm::ivec2(0), glm::ivec2(kTraced - 1));
        return static_cast<std::size_t>(at.y * kTraced + at.x);
    }
    static float between(const std::vector<float>& of, glm::vec2 at)
    {
        const glm::ivec2 low(glm::floor(at));
        const glm::vec2 part = at - glm::vec2(low);
        const float above = glm::mix(of[texel(low)], of[texel(low + glm::ivec2(1, 0))], part.x);
        const float below = glm::mix(of[texel(low + glm::ivec2(0, 1))], of[texel(low + 1)], part.x);
        return glm::mix(above, below, part.y);
    }

    glm::vec3 middle_;
    Scene scene_;
    Triangles triangles_;
    Tracer tracer_;
};

}  // namespace

std::vector<std::string> shade_by_lanterns(Scene& scene)
{
    std::vector<Around> all;
    std::size_t not_asked = 0;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (!may_have_one(scene.lights[i])) continue;
        if (all.size() < kMost)
            all.push_back({i, {}, false});
        else
            ++not_asked;
    }
    std::vector<std::string> names;
    if (all.empty()) return names;
    gather(scene, all);
    for (const Around& one : all) {
        if (one.corners.empty() || one.moves) continue;
        Light& light = scene.lights[one.lamp];
        std::optional<LightProfile> profile = Lantern(light, one).profile(light.radius_m);
        if (!profile) continue;
        profile->name = "lantern of " + light.name;
        light.profile = static_cast<std::int32_t>(scene.light_profiles.size());
        light.in_lantern = true;
        scene.light_profiles.push_back(std::move(*profile));
        names.push_back(light.name);
    }
    if (!names.empty() && not_asked > 0)
        scene.warnings.push_back("lanterns: what stands around " + std::to_string(not_asked) + " lamps behind the first " +
                                 std::to_string(kMost) + " shades with hard edges");
    return names;
}

}  // namespace petrichor::scene
