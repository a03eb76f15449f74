// Coarser triangles that throw the shadows of snow: fewer, where it lies, and without cracks.
#include "scene/snow/coarser_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scene/snow/snow_caps_file.h"
#include "tests/scene/patch_scenes.h"

namespace petrichor::scene {
namespace {

using namespace patch_scenes;
using glm::vec3;

// A post, a slab and a kerb on open ground.
Scene yard()
{
    Scene scene = empty_scene();
    add_face(scene, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
    add_box(scene, {-0.2f, 0, -0.2f}, {0.2f, 1, 0.2f}, false);
    add_box(scene, {1, 0.8f, -1}, {2.6f, 0.9f, 1}, false);
    add_box(scene, {-3, 0, 1.5f}, {-1, 0.12f, 3}, false);
    return scene;
}

SnowCaps caps_of(const Scene& scene)
{
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    SnowCaps caps = build_snow_caps(tracer, {});
    add_casters(caps, {});
    return caps;
}

std::size_t casters_of(const SnowCaps& caps)
{
    std::size_t all = 0;
    for (const SnowCaps::Part& part : caps.parts) all += part.casters.size() / 3;
    return all;
}

// Ericson 2005, Real-Time Collision Detection, 5.1.5.
float away_m(const vec3& p, const vec3& a, const vec3& b, const vec3& c)
{
    const auto to_line = [&](const vec3& s, const vec3& t) {
        const vec3 along = t - s;
        const float share = glm::dot(along, along) > 0.0f ? std::clamp(glm::dot(p - s, along) / glm::dot(along, along), 0.0f, 1.0f) : 0.0f;
        return glm::distance(p, s + share * along);
    };
    const float edges = std::min({to_line(a, b), to_line(b, c), to_line(c, a)});
    const vec3 n = glm::cross(b - a, c - a);
    const float length = glm::length(n);
    if (!(length > 0.0f)) return edges;
    for (const auto& [s, t] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
        if (glm::dot(glm::cross(t - s, p - s), n) < 0.0f) return edges;
    return std::abs(glm::dot(p - a, n)) / length;
}

TEST(SnowCasters, AreFewAndLieWhereTheSnowDoes)
{
    const SnowCaps caps = caps_of(yard());
    EXPECT_LT(3 * casters_of(caps), caps.indices.size() / 3);
    EXPECT_GT(casters_of(caps), 100u);
    const float off_m = 4.0f * casters_over_m(0.0f);
    for (const float depth : {0.04f, 0.1f, 0.15f, 0.25f}) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        std::vector<std::uint32_t> used;
        for (const std::uint32_t corner : caps.indices) used.push_back(caps.corner_points[corner]);
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        float farthest = 0.0f;
        for (std::size_t i = 0; i < used.size(); i += 3) {
            const vec3& p = shape.positions[used[i]];
            float nearest = 1.0e9f;
            for (const SnowCaps::Part& part : caps.parts)
                for (std::size_t k = 0; k < part.casters.size(); k += 3)
                    nearest = std::min(nearest, away_m(p, shape.positions[part.casters[k]], shape.positions[part.casters[k + 1]],
                                                       shape.positions[part.casters[k + 2]]));
            farthest = std::max(farthest, nearest);
        }
        // Between the depths that were looked at a little more.
        EXPECT_LT(farthest, 1.5f * off_m) << depth;
    }
}

// An edge of one triangle alone lies on the border of the caps themselves.
TEST(SnowCasters, HaveNoCracks)
{
    const SnowCaps caps = caps_of(yard());
    using Ways = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;
    const auto add = [](Ways& ways, std::uint32_t a, std::uint32_t b) { ways[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1; };
    Ways fine, coarse;
    for (std::size_t k = 0; k < caps.indices.size(); ++k)
        add(fine, caps.corner_points[caps.indices[k]], caps.corner_points[caps.indices[k % 3 == 2 ? k - 2 : k + 1]]);
    for (const SnowCaps::Part& part : caps.parts)
        for (std::size_t k = 0; k < part.casters.size(); ++k) add(coarse, part.casters[k], part.casters[k % 3 == 2 ? k - 2 : k + 1]);
    std::vector<bool> border(caps.points.size(), false);
    for (const auto& [edge, way] : fine)
        if (way != 0) border[edge.first] = border[edge.second] = true;
    int borders = 0;
    for (const auto& [edge, way] : coarse) {
        EXPECT_LE(std::abs(way), 1);
        if (way == 0) continue;
        ++borders;
        EXPECT_TRUE(border[edge.first] && border[edge.second]);
    }
    EXPECT_GT(borders, 20);
}

TEST(SnowCasters, AreReadBackBitForBit)
{
    const Scene scene = yard();
    const SnowCaps caps = caps_of(scene);
    const auto bytes = snow_caps_to_bytes(caps);
    const auto back = snow_caps_from_bytes(bytes, scene);
    ASSERT_TRUE(back.has_value());
    for (std::size_t i = 0; i < caps.parts.size(); ++i) EXPECT_EQ(back->parts[i].casters, caps.parts[i].casters);
    SnowCaps broken = caps;
    broken.parts[0].casters[1] = static_cast<std::uint32_t>(caps.points.size());
    EXPECT_FALSE(snow_caps_from_bytes(snow_caps_to_bytes(broken), scene)) << "a point that is not there";
    EXPECT_EQ(snow_caps_to_bytes(caps_of(scene)), bytes) << "made again";
    SnowCaps none;
    add_casters(none, {});
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace petrichor::scene
