// Where snow has a body.
#include "scene/snow/snow_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/snow/snow_caps_file.h"
#include "tests/scene/snow_scenes.h"

namespace petrichor::scene {
namespace {

using namespace snow_scenes;
using glm::vec3;

TEST(SnowCaps, LieOnWhatFacesUpAndSeesTheSky)
{
    const SnowCaps caps = caps_of(yard());
    ASSERT_FALSE(caps.empty());
    EXPECT_GT(point_at(caps, {0, 0, 2}).share, 0.95f) << "in the open";
    EXPECT_LT(point_at(caps, {1.8f, 0, 0}).share, 0.05f) << "under the table";
    EXPECT_GT(point_at(caps, {1.8f, 0.9f, 0}).share, 0.95f) << "on the table";
    for (const auto& p : caps.points) {
        EXPECT_FALSE(std::abs(p.base_m.y - 0.8f) < 1e-4f) << "what faces down";
        ASSERT_GE(p.share, 0.0f);
        ASSERT_LE(p.share, 1.0f);
    }
    Scene sheltered = yard();
    sheltered.materials[0].weather.sheltered = true;
    EXPECT_TRUE(caps_of(sheltered).empty());
}

TEST(SnowCaps, AreGivenUpAtEveryAsking)
{
    const Scene scene = yard();
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    int asked = 0;
    SnowCapOptions options;
    options.stop = [&] { return ++asked < 0; };
    const SnowCaps whole = build_snow_caps(tracer, options);
    ASSERT_GE(asked, 8);
    EXPECT_FALSE(whole.empty());
    const int all = asked;
    for (int at = 1; at <= all; ++at) {
        asked = 0;
        options.stop = [&] { return ++asked == at; };
        EXPECT_THROW(build_snow_caps(tracer, options), Interrupted) << at;
    }
}

TEST(SnowCaps, SteepGroundHoldsLess)
{
    const auto share_on = [](float degrees) {
        Scene scene = empty_scene();
        const float a = degrees * 0.01745329f;
        add_face(scene, {-2, 0, 2}, {4, 0, 0}, {0, 4 * std::sin(a), -4 * std::cos(a)});
        float most = 0.0f;
        for (const auto& p : caps_of(scene).points) most = std::max(most, p.share);
        return most;
    };
    EXPECT_NEAR(share_on(20), 1.0f, 0.02f);
    EXPECT_NEAR(share_on(45), 0.5f, 0.02f);
    EXPECT_NEAR(share_on(62), 0.0f, 0.02f);
}

TEST(SnowCaps, EdgesAreOpenWhereTheGroundFallsAway)
{
    const SnowCaps caps = caps_of(yard());
    EXPECT_LT(point_at(caps, {0.2f, 1, 0}).edge_m, 0.01f) << "of the post";
    EXPECT_NEAR(point_at(caps, {0, 1, 0}).edge_m, 0.2f, 0.03f) << "its middle";
    EXPECT_NEAR(point_at(caps, {0.1f, 1, 0.1f}).support_m, 0.2f, 0.03f);
    EXPECT_GT(point_at(caps, {0.5f, 0, -2.0f}).edge_m, 1.0f) << "at the foot of the wall";
    const auto& kerb = point_at(caps, {-1.0f, 0.12f, 2});
    EXPECT_NEAR(kerb.edge_m, std::abs(kerb.base_m.x + 1.0f), 1e-3f) << "of the kerb";
    EXPECT_LT(kerb.edge_m, 0.1f);
    EXPECT_GT(point_at(caps, {-0.97f, 0, 2.2f}).edge_m, 1.0f) << "below the kerb";
    EXPECT_GT(point_at(caps, {1.8f, 0.9f, 0}).edge_m, 0.5f) << "the middle of the table";
}

// All triangles meet edge to edge; where they end, there is a wall, or the cap has sunk below its ground. A bank ends below
// the snow of the caps.
TEST(SnowCaps, HaveNoCracks)
{
    const SnowCaps caps = caps_of(yard());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
    for (std::size_t k = 0; k < caps.indices.size(); ++k) {
        const std::uint32_t a = caps.corner_points[caps.indices[k]];
        const std::uint32_t b = caps.corner_points[caps.indices[k % 3 == 2 ? k - 2 : k + 1]];
        ways[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.15f));
    int borders = 0;
    for (const auto& [edge, way] : ways) {
        if (way == 0) continue;
        ++borders;
        for (const std::uint32_t i : {edge.first, edge.second}) {
            const auto& p = caps.points[i];
            const bool sunk = shape.positions[i].y < p.base_m.y;
            const bool at_wall = std::abs(p.base_m.z + 2.0f) < 1e-3f && p.edge_m > 0.1f;
            const bool rim = p.edge_m < 1e-3f;
            const bool hidden = p.share <= 0.02f;
            const float sheet_m = std::max(p.fill_m[2], p.fill_m[3]) + 0.15f * p.uneven * p.broad;
            if (p.bank > 0.0f) {
                EXPECT_TRUE(shape.positions[i].y < p.base_m.y + sheet_m - 0.01f || std::abs(p.base_m.z + 2.0f) < 0.06f) << p.base_m.x << " " << p.base_m.y << " " << p.base_m.z;
                continue;
            }
            EXPECT_TRUE(sunk || at_wall || rim || hidden || p.base_m.y == 0.0f)
                << p.base_m.x << " " << p.base_m.y << " " << p.base_m.z;
        }
    }
    EXPECT_GT(borders, 20);
}

// A plinth of 6 cm that stands on the ground is a thing: its snow is its own, and no bank buries it. A pavement as high is ground.
TEST(SnowCaps, BanksLieOnGroundAndNotOnThings)
{
    const auto banked = [](const vec3& high) {
        Scene scene = empty_scene();
        add_face(scene, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
        add_box(scene, {-0.15f, 0, -0.15f}, high, false);
        SnowCapOptions options;
        options.eyes_m = {{0, 1.6f, 2.5f}};
        const SnowCaps caps = caps_of(scene, options);
        int points = 0;
        for (const auto& p : caps.points) points += p.bank > 0.0f ? 1 : 0;
        return points;
    };
    EXPECT_EQ(banked({0.15f, 0.06f, 0.15f}), 0);
    EXPECT_GT(banked({0.85f, 0.06f, 0.85f}), 100);
}

// What roofs a pavement over is no ground of the kerb at its rim.
TEST(SnowCaps, BanksLieAtTheFootOfAnAwningToo)
{
    Scene scene = empty_scene();
    add_ground(scene, 4.0f);
    add_box(scene, {0, 0, -4}, {4, 0.12f, 4}, false);
    add_face(scene, {-0.1f, 2.4f, 1}, {2.1f, 0, 0}, {0, 0, -2});
    const SnowCaps caps = caps_of(scene, {.eyes_m = {{-2, 1.6f, 0}}});
    const auto banks = [&](float from_z, float to_z) {
        return std::count_if(caps.points.begin(), caps.points.end(), [&](const SnowCaps::Point& p) {
            return p.bank > 0.0f && p.fade < 0.5f && p.base_m.y < 0.3f && p.base_m.z > from_z && p.base_m.z < to_z;
        });
    };
    EXPECT_GT(banks(1.5f, 2.5f), 100);
    EXPECT_GT(banks(-0.5f, 0.5f), banks(1.5f, 2.5f) / 2);
}

// Two slabs 2 cm apart: their borders are closed, and under snow they reach over the joint.
TEST(SnowCaps, ReachOverJoints)
{
    Scene scene = empty_scene();
    add_box(scene, {-1.01f, -0.5f, -1}, {-0.01f, 0, 1}, false);
    add_box(scene, {0.01f, -0.5f, -1}, {1.01f, 0, 1}, false);
    const SnowCaps caps = caps_of(scene);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.1f));
    float left = -1.0f, right = 1.0f;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        if (std::abs(p.base_m.y) > 1e-4f || std::abs(p.base_m.z) > 0.5f) continue;
        (p.base_m.x < 0.0f ? left : right) =
            p.base_m.x < 0.0f ? std::max(left, shape.positions[i].x)
                              : std::min(right, shape.positions[i].x);
        if (std::abs(p.base_m.x) < 0.011f) {
            EXPECT_GT(shape.thickness_m[i], 0.05f) << "no notch at the joint";
        }
    }
    EXPECT_GE(left, right);
    EXPECT_LT(point_at(caps, {1.01f, 0, 0}).edge_m, 0.01f) << "the far side is open";
}

// Bars of 2 cm, 5 cm apart over a pit, in a level ground: thin snow leaves the slots open, deep snow closes them.
TEST(SnowCaps, CloseOverAGrating)
{
    Scene scene = empty_scene();
    add_box(scene, {-2, -0.5f, -2}, {-0.2f, 0, 2}, false);
    add_box(scene, {0.2f, -0.5f, -2}, {2, 0, 2}, false);
    for (int i = -2; i <= 2; ++i) {
        const float x = 0.07f * static_cast<float>(i);
        add_box(scene, {x - 0.01f, -0.03f, -2}, {x + 0.01f, 0, 2}, false);
    }
    const SnowCaps caps = caps_of(scene);
    // Of the pixels across the grating, the share that lies under snow near its full height.
    const auto closed = [&](float depth) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        std::vector<bool> under(400, false);
        for (std::size_t k = 0; k + 2 < caps.indices.size(); k += 3) {
            float low = 1e9f, left = 1e9f, right = -1e9f;
            bool here = true;
            for (std::size_t c = 0; c < 3; ++c) {
                const vec3& at = shape.positions[caps.corner_points[caps.indices[k + c]]];
                low = std::min(low, at.y);
                left = std::min(left, at.x);
                right = std::max(right, at.x);
                here = here && std::abs(at.z) < 1.0f;
            }
            if (!here || low < 0.6f * depth) continue;
            for (int i = 0; i < 400; ++i) {
                const float x = -0.2f + 0.001f * static_cast<float>(i);
                if (x >= left && x <= right) under[static_cast<std::size_t>(i)] = true;
            }
        }
        return static_cast<double>(std::count(under.begin(), under.end(), true)) / 400.0;
    };
    EXPECT_LT(closed(0.02f), 0.35);
    EXPECT_GT(closed(0.15f), 0.98);
}

// A ledge of 3 cm at a wall has a cover alone: no collar of a body.
TEST(SnowCaps, NarrowLedgesHaveNone)
{
    const auto body_on_a_ledge = [](float width) {
        Scene scene = yard();
        add_box(scene, {-0.2f - width, 0.4f, -0.2f}, {-0.2f, 0.45f, 0.2f}, false);
        const SnowCaps caps = caps_of(scene);
        return std::any_of(caps.indices.begin(), caps.indices.end(), [&](std::uint32_t i) {
            return caps.points[caps.corner_points[i]].base_m.y == 0.45f;
        });
    };
    EXPECT_FALSE(body_on_a_ledge(0.03f));
    EXPECT_TRUE(body_on_a_ledge(0.12f));
}

// Each triangle of a cap knows what it lies on; what parts of have no cap is not told.
TEST(SnowCaps, KnowWhatLiesBelowThem)
{
    const Scene scene = yard();
    const SnowCaps caps = caps_of(scene);
    for (const SnowCaps::Part& part : caps.parts) {
        const Instance& instance = scene.instances[part.instance];
        const Primitive& p = scene.meshes[instance.mesh].primitives[part.primitive];
        ASSERT_EQ(part.below.size(), part.index_count / 3);
        std::map<std::uint32_t, double> area_m2;
        for (std::size_t t = 0; t < part.below.size(); ++t) {
            const std::uint32_t below = part.below[t];
            if (below == SnowCaps::kUncovered) continue;
            const auto base = [&](std::size_t c) {
                return caps.points[caps.corner_points[caps.indices[part.first_index + 3 * t + c]]].base_m;
            };
            const auto own = [&](std::size_t c) {
                return vec3(instance.to_world * glm::vec4(p.positions[p.indices[3 * below + c]], 1.0f));
            };
            const vec3 middle = (base(0) + base(1) + base(2)) / 3.0f;
            const vec3 face = glm::cross(own(1) - own(0), own(2) - own(0));
            for (std::size_t c = 0; c < 3; ++c) {  // within it
                const vec3 side = glm::cross(own((c + 1) % 3) - own(c), middle - own(c));
                EXPECT_GE(glm::dot(side, face), -1e-4f);
            }
            EXPECT_NEAR(glm::dot(middle - own(0), glm::normalize(face)), 0.0f, 1e-4f);
            area_m2[below] += 0.5 * static_cast<double>(glm::length(glm::cross(base(1) - base(0), base(2) - base(0))));
        }
        for (const auto& [below, covered] : area_m2) {
            const auto own = [&](std::size_t c) {
                return vec3(instance.to_world * glm::vec4(p.positions[p.indices[3 * below + c]], 1.0f));
            };
            EXPECT_NEAR(covered, 0.5 * static_cast<double>(glm::length(glm::cross(own(1) - own(0), own(2) - own(0)))), 1e-3)
                << "all of it";
        }
    }
    const auto told = [](const SnowCaps::Part& part) {
        return std::any_of(part.below.begin(), part.below.end(),
                           [](std::uint32_t below) { return below != SnowCaps::kUncovered; });
    };
    EXPECT_TRUE(std::any_of(caps.parts.begin(), caps.parts.end(), told));
}

TEST(SnowCaps, AreReadBackBitForBit)
{
    const Scene scene = yard();
    const SnowCaps caps = caps_of(scene);
    const auto bytes = snow_caps_to_bytes(caps);
    const auto back = snow_caps_from_bytes(bytes, scene);
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(snow_caps_to_bytes(*back), bytes);
    const std::vector<float> depth(caps.points.size(), 0.1f);
    EXPECT_EQ(snow_shape(*back, depth).positions, snow_shape(caps, depth).positions);
    for (std::size_t cut = 0; cut < bytes.size(); cut += bytes.size() / 37)
        EXPECT_FALSE(snow_caps_from_bytes(std::span(bytes).first(cut), scene)) << cut;
    auto spoiled = bytes;
    spoiled[0] = std::byte{1};
    EXPECT_FALSE(snow_caps_from_bytes(spoiled, scene));
    // Another scene, another eye: another key.
    const std::string key = snow_caps_fingerprint("rays", scene, {});
    EXPECT_EQ(snow_caps_fingerprint("rays", yard(), {}), key);
    EXPECT_NE(snow_caps_fingerprint("other rays", scene, {}), key);
    SnowCapOptions eyes;
    eyes.eyes_m = {{0, 1, 0}};
    EXPECT_NE(snow_caps_fingerprint("rays", scene, eyes), key);
    Scene wet = yard();
    wet.materials[0].weather.sheltered = true;
    EXPECT_NE(snow_caps_fingerprint("rays", wet, {}), key);
}

TEST(SnowCaps, TracksPressThemDown)
{
    Scene scene = empty_scene();
    add_ground(scene);
    SnowCapOptions options;
    options.pressed = [](const vec3& at) { return std::abs(at.x) < 0.1f ? 0.7f : 0.0f; };
    const SnowCaps caps = caps_of(scene, options);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.15f));
    float in = 0.0f, beside = 1.0f;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        if (std::abs(p.base_m.z) > 1.0f) continue;
        if (std::abs(p.base_m.x) < 0.09f) in = std::max(in, shape.thickness_m[i]);
        if (std::abs(p.base_m.x) > 0.11f && std::abs(p.base_m.x) < 0.6f)
            beside = std::min(beside, shape.thickness_m[i]);
    }
    EXPECT_GT(in, 0.02f);
    EXPECT_LT(in, 0.4f * 0.15f);
    EXPECT_GT(beside, 0.75f * 0.15f);
    EXPECT_LT(std::abs(point_at(caps, {0, 0, 0}).base_m.x), 0.06f) << "finer there";
}

// A channel with sides of 25 degrees below a grating that is level with its rims: what is so low hides it from no snow.
TEST(SnowCaps, LieInAGutterBelowItsGrating)
{
    Scene scene = empty_scene();
    add_face(scene, {-2, 0, 2}, {1.85f, 0, 0}, {0, 0, -4});
    add_face(scene, {-0.15f, 0, 2}, {0.15f, -0.06f, 0}, {0, 0, -4});
    add_face(scene, {0, -0.06f, 2}, {0.15f, 0.06f, 0}, {0, 0, -4});
    add_face(scene, {0.15f, 0, 2}, {1.85f, 0, 0}, {0, 0, -4});
    for (int i = -4; i <= 4; ++i) {
        const float z = 0.05f * static_cast<float>(i);
        add_box(scene, {-0.15f, -0.024f, z - 0.02f}, {0.15f, -0.002f, z + 0.02f}, false);
    }
    EXPECT_GT(point_at(caps_of(scene), {0.0f, -0.06f, 0.0f}).share, 0.6f);
}

TEST(SnowCaps, AreFinerWhereAnEyeIsNearAndEndAtTheirReach)
{
    Scene scene = empty_scene();
    add_ground(scene, 200.0f);
    SnowCapOptions options;
    options.eyes_m = {{0, 1.6f, 0}};
    const SnowCaps caps = caps_of(scene, options);
    ASSERT_FALSE(caps.empty());
    EXPECT_LE(caps.indices.size() / 3, options.most_triangles + 2);
    std::vector<bool> used(caps.points.size(), false);
    for (const std::uint32_t i : caps.indices) used[caps.corner_points[i]] = true;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const bool far = glm::length(caps.points[i].base_m) > options.reach_m;
        ASSERT_TRUE(!far || caps.points[i].share < 0.02f) << "it tapers off";
    }
    const auto again = caps_of(scene, options);
    EXPECT_EQ(again.indices, caps.indices);
}

TEST(DrawnSnow, GrowsAndHasALimit)
{
    float before = -1.0f;
    for (const float depth : {0.0f, 0.02f, 0.1f, 0.2f, 0.21f, 0.5f, 2.0f, 100.0f}) {
        EXPECT_GE(drawn_snow_m(depth), before);
        EXPECT_LE(drawn_snow_m(depth), std::min(depth, kDeepestSnow_m) + 1e-6f);
        before = drawn_snow_m(depth);
    }
    EXPECT_EQ(drawn_snow_m(0.15f), 0.15f);
    EXPECT_EQ(drawn_snow_m(NAN), 0.0f);
}

}  // namespace
}  // namespace petrichor::scene
