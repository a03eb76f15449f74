// The form that a body of snow takes.
#include "scene/snow/snow_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/scene/snow_scenes.h"

namespace petrichor::scene {
namespace {

using namespace snow_scenes;
using glm::vec2;
using glm::vec3;

TEST(SnowShape, APostRisesByTheDepthAndItsShouldersAreRound)
{
    const SnowCaps caps = caps_of(yard());
    for (const float depth : {0.05f, 0.1f, 0.15f}) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        float top = 0.0f, shoulder = 0.0f, rim = -1.0f;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const auto& p = caps.points[i];
            if (std::max(std::abs(p.base_m.x), std::abs(p.base_m.z)) > 0.21f || p.base_m.y < 0.9f) continue;
            const float up = shape.positions[i].y - 1.0f;
            top = std::max(top, up);
            if (p.edge_m < 0.45f * depth && p.edge_m > 0.2f * depth) shoulder = std::max(shoulder, up);
            if (p.edge_m < 1e-3f) rim = std::max(rim, up);
        }
        EXPECT_NEAR(top, depth, 0.25f * depth);
        EXPECT_LT(shoulder, 0.95f * top);
        EXPECT_LT(rim, 0.0f);
    }
    // What stands up too far falls off a post.
    const SnowShape deep = snow_shape(caps, std::vector<float>(caps.points.size(), 5.0f));
    EXPECT_LT(deep.thickest_m, 1.3f * kDeepestSnow_m);
}

// A slope holds a part of what falls on it. Where the depth is already that of such a slope it lies as deep there, and not the part of a
// part; on what is steeper than its place there is less, on what is flatter no more.
TEST(SnowShape, SteepnessCountsOnce)
{
    constexpr float kTilt = 40.0f, kHolds = 2.0f / 3.0f;
    const float tilt = glm::radians(kTilt);
    Scene scene = empty_scene();
    add_face(scene, {-5, 3, 5}, {10, 0, 0}, {0, 10 * std::sin(tilt), -10 * std::cos(tilt)});
    const SnowCaps caps = caps_of(scene);
    const DrawnSnow all = all_drawn(caps);
    // Far up the slope: there repose takes little.
    for (const float depth : {0.02f, 0.08f, 0.1f}) {
        const std::vector<float> depths(caps.points.size(), depth);
        const auto of = [&](float held) { return snow_shape(caps, depths, all, std::vector<float>(caps.points.size(), held)); };
        const SnowShape open = snow_shape(caps, depths), same = of(1.0f), slope = of(kHolds), flatter = of(0.5f), steeper = of(0.8f);
        EXPECT_EQ(open.positions, same.positions);
        int inner = 0;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const auto& p = caps.points[i];
            if (std::abs(p.base_m.x) > 2.0f || p.base_m.z > 0.0f || p.base_m.z < -1.5f) continue;
            ++inner;
            ASSERT_NEAR(flatter.thickness_m[i], slope.thickness_m[i], 1.0e-5f) << "flatter than its place";
            if (depth < 0.03f) {
                ASSERT_NEAR(slope.thickness_m[i], open.thickness_m[i], 1.0e-5f) << "in the relief of the slope";
                continue;
            }
            ASSERT_NEAR(slope.thickness_m[i], depth * p.uneven, 0.04f * depth);
            ASSERT_LT(open.thickness_m[i], 0.85f * slope.thickness_m[i]);
            ASSERT_LT(steeper.thickness_m[i], 0.95f * slope.thickness_m[i]) << "steeper than its place";
            ASSERT_GT(steeper.thickness_m[i], open.thickness_m[i]);
        }
        EXPECT_GT(inner, 20);
    }
}

// Snow slides off a kerb towards the road; the bed behind it, which shares no vertex with it, has no more there.
TEST(SnowShape, IsOneSheetOverAKerbAndWhatLiesBehindIt)
{
    Scene scene = empty_scene();
    add_face(scene, {-3, -0.15f, -2}, {0, 0, 4}, {3, 0, 0});    // road
    add_face(scene, {0, -0.15f, -2}, {0, 0, 4}, {0, 0.15f, 0});  // face of the kerb
    add_face(scene, {0, 0, -2}, {0, 0, 4}, {0.14f, 0, 0});       // its top
    add_face(scene, {0.14f, -0.02f, -2}, {0, 0, 4}, {2, 0, 0});  // bed
    add_face(scene, {0.14f, -0.02f, -2}, {0, 0.02f, 0}, {0, 0, 4});
    const SnowCaps caps = caps_of(scene);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.14f));
    std::map<float, float> kerb, bed;  // along the joint
    float deep = 0.0f;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        if (std::abs(p.base_m.z) > 1.0f) continue;
        const float top = shape.positions[i].y;
        if (std::abs(p.base_m.x - 0.14f) < 1e-3f) (p.base_m.y > -0.01f ? kerb : bed)[p.base_m.z] = top;
        if (p.base_m.x > 1.0f) deep = std::max(deep, top);
    }
    ASSERT_GT(kerb.size(), 3u);
    int beside = 0;
    for (const auto& [z, top] : kerb) {
        EXPECT_GT(top, 0.03f);
        const auto after = bed.lower_bound(z);
        if (after == bed.begin() || after == bed.end()) continue;
        const auto before = std::prev(after);
        const float there = before->second + (after->second - before->second) * (z - before->first) / (after->first - before->first);
        EXPECT_NEAR(top, there, 0.01f) << "no step to look under, at " << z;
        ++beside;
    }
    EXPECT_GT(beside, 2);
    EXPECT_GT(deep, 0.1f) << "and all of it farther in";
}

// Far from an eye triangles are long: the swells that they cannot carry are left out, or a low sun would show them.
TEST(SnowShape, LongTrianglesHaveNoCreases)
{
    Scene scene = empty_scene();
    add_face(scene, {-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
    const Triangles triangles(scene, {});
    const Tracer tracer(triangles);
    const auto bend_of = [&](float edge_m) {
        SnowCapOptions options;
        options.eyes_m = {{0, 1.7f, 0}};
        options.coarsest_m = edge_m;
        options.most_triangles = 400'000;
        const SnowCaps caps = build_snow_caps(tracer, options);
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.2f));
        double sum = 0.0;
        int count = 0;
        for (std::size_t k = 0; k < caps.indices.size(); ++k) {
            const std::uint32_t a = caps.corner_points[caps.indices[k]];
            const std::uint32_t b = caps.corner_points[caps.indices[k % 3 == 2 ? k - 2 : k + 1]];
            if (glm::length(caps.points[a].base_m) > 8.0f || caps.points[a].edge_m < 1.0f) continue;
            const float apart = glm::distance(shape.positions[a], shape.positions[b]);
            sum += static_cast<double>(glm::distance(shape.normals[a], shape.normals[b]) / std::max(apart, 1e-4f));
            ++count;
        }
        EXPECT_GT(count, 100);
        return sum / std::max(count, 1);
    };
    const double fine = bend_of(0.1f), coarse = bend_of(0.6f);
    RecordProperty("fine", std::to_string(fine));
    RecordProperty("coarse", std::to_string(coarse));
    EXPECT_LT(coarse, 0.4 * fine) << "edges of triangles do not stand in for what lies between them";
}

// Setts of 15 cm, 1.5 cm high at their crowns: a hand of snow lies even over them, a finger shows them.
TEST(SnowShape, DeepSnowHidesTheStonesBelow)
{
    const SnowCaps caps = caps_of(cobbles(3, 60, 0.0075f));
    const auto unevenness = [&](float depth) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        double rough = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const vec3& base = caps.points[i].base_m;
            if (std::abs(base.x - 1.5f) > 0.8f || std::abs(base.z - 1.5f) > 0.8f) continue;
            const double over = static_cast<double>(shape.positions[i].y - shape.thickness_m[i]);
            rough += over * over;
            ++count;
        }
        return std::sqrt(rough / std::max(count, 1));
    };
    EXPECT_GT(unevenness(0.015f), 0.006) << "thin snow follows them";
    EXPECT_LT(unevenness(0.1f), 0.003);
    EXPECT_GT(unevenness(0.1f), 0.0);
}

// A lid that lies on ground which goes on below it, a finger higher: under deep snow its rim is under the snow of the
// ground, which it does not disturb; its middle is level with it.
TEST(SnowShape, OverALidOnTheGroundThereIsOneSheet)
{
    Scene scene = empty_scene();
    add_ground(scene);
    add_box(scene, {-0.3f, -0.03f, -0.3f}, {0.3f, 0.008f, 0.3f}, false);
    const SnowCaps caps = caps_of(scene);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.14f));
    int rim = 0, middle = 0, ground = 0;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        const float out = std::max(std::abs(p.base_m.x), std::abs(p.base_m.z));
        const float over = shape.positions[i].y - shape.thickness_m[i];  // of the ground's own height
        if (p.base_m.y < 0.004f) {
            if (out > 0.8f) continue;
            EXPECT_NEAR(over, 0.0f, 0.003f) << p.base_m.x << " " << p.base_m.z;
            ++ground;
        } else if (out > 0.299f) {
            EXPECT_LT(over, -0.015f);
            ++rim;
        } else if (out < 0.1f) {
            EXPECT_NEAR(over, 0.0f, 0.01f);
            ++middle;
        }
    }
    EXPECT_GT(rim, 3);
    EXPECT_GT(ground, 3);
    EXPECT_GT(middle, 0);
}

// A ball of 20 cm under half a metre of snow: it carries what lies at repose on its crown, little at its
// sides, and nowhere is the snow steeper than it holds by itself.
TEST(SnowShape, RoundThingsCarryAllOfItOnTheirCrown)
{
    Scene scene = empty_scene();
    add_ground(scene);
    constexpr int kAround = 48, kUp = 14;
    constexpr float kRadius = 0.1f;
    const auto on_ball = [](int ring, int turn) {
        const float up = 1.45f * static_cast<float>(ring) / kUp;  // from the crown down
        const float way = 6.2831853f * static_cast<float>(turn) / kAround;
        return kRadius * vec3(std::sin(up) * std::cos(way), std::cos(up), std::sin(up) * std::sin(way)) +
               vec3(0.0f, 1.0f, 0.0f);
    };
    for (int ring = 0; ring < kUp; ++ring) {
        for (int turn = 0; turn < kAround; ++turn) {
            const vec3 a = on_ball(ring, turn), b = on_ball(ring, turn + 1), c = on_ball(ring + 1, turn);
            const vec3 d = on_ball(ring + 1, turn + 1);
            Primitive& p = scene.meshes[0].primitives[0];
            const auto first = static_cast<std::uint32_t>(p.positions.size());
            for (const vec3& v : {a, b, c, d}) {
                p.positions.push_back(v);
                p.normals.push_back(glm::normalize(v - vec3(0.0f, 1.0f, 0.0f)));
                if (!p.uv0.empty()) p.uv0.emplace_back(0.0f);
                if (!p.tangents.empty()) p.tangents.emplace_back(1, 0, 0, 1);
            }
            for (const std::uint32_t v : {0u, 1u, 2u, 1u, 3u, 2u}) p.indices.push_back(first + v);
        }
    }
    SnowCapOptions options;
    options.eyes_m = {{0.0f, 1.4f, 1.0f}};
    const SnowCaps caps = caps_of(scene, options);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.5f));
    float crown = 0.0f, side = 0.0f, ground = 0.0f;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const vec3& base = caps.points[i].base_m;
        const float out = glm::length(vec2(base.x, base.z));
        if (base.y < 0.5f) ground = std::max(ground, shape.thickness_m[i]);
        else if (out < 0.03f) crown = std::max(crown, shape.thickness_m[i]);
        else if (out > 0.075f) side = std::max(side, shape.thickness_m[i]);
    }
    EXPECT_GT(ground, 0.25f);
    EXPECT_GT(crown, 0.012f);
    EXPECT_LT(crown, 0.7f * kRadius) << "no hat";
    EXPECT_LT(side, 0.5f * crown + 0.012f);
}

// A gable of steps, steeper than snow lies at repose: deep snow closes each of them, and all of them carry no more than the eaves hold.
TEST(SnowShape, AStairSteeperThanReposeCarriesNoWall)
{
    Scene scene = empty_scene();
    add_ground(scene);
    constexpr int kSteps = 5;
    constexpr float kRise = 0.1f, kTread = 0.07f, kEaves = 1.2f;
    for (int k = 0; k < kSteps; ++k) {
        const float half = kTread * static_cast<float>(kSteps - k), up = kEaves + kRise * static_cast<float>(k);
        const float in = k + 1 < kSteps ? kTread : half;
        for (int piece = 0; piece < 20; ++piece) {
            for (const float side : {-1.0f, 1.0f}) {
                const vec3 along(0, 0, -0.06f * side);
                const float z = side * (0.6f - 0.06f * static_cast<float>(piece));
                add_face(scene, {side * half, up, z}, along, {-side * in, 0, 0});
                add_face(scene, {side * half, up - kRise, z}, along, {0, kRise, 0});
            }
        }
    }
    SnowCapOptions options;
    options.eyes_m = {{1.5f, 2.2f, 1.5f}};
    const SnowCaps caps = caps_of(scene, options);
    for (const float depth : {0.07f, 0.14f, 0.35f}) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        float ground = 0.0f, stair = 0.0f, highest = 0.0f;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            float& most = caps.points[i].base_m.y < 0.5f ? ground : stair;
            most = std::max(most, shape.thickness_m[i]);
            if (caps.points[i].base_m.y > 0.5f) highest = std::max(highest, shape.positions[i].y);
        }
        EXPECT_GT(ground, 0.6f * depth);
        EXPECT_GT(stair, 0.012f) << "it is not bare";
        EXPECT_LT(stair, 0.06f) << depth;
        EXPECT_LT(highest, kEaves + kRise * (kSteps - 1) + 0.06f) << depth;
    }
}

// The rim of a cap is within what it lies on: along its faces it would be drawn by halves.
TEST(SnowShape, ARimEndsWithinTheStone)
{
    const SnowCaps caps = caps_of(yard());
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.1f));
    int rims = 0;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        if (std::abs(p.base_m.y - 1.0f) > 1e-4f || p.edge_m > 1e-4f) continue;
        ++rims;
        const vec3 at = shape.positions[i];
        EXPECT_LT(at.y, 0.995f);
        EXPECT_LT(std::min(std::abs(at.x), std::abs(at.z)), 0.2f);
        EXPECT_LT(std::max(std::abs(at.x), std::abs(at.z)), 0.2001f) << at.x << " " << at.z;
        const bool corner = std::min(std::abs(p.base_m.x), std::abs(p.base_m.z)) > 0.199f;
        if (!corner) {
            EXPECT_LT(std::max(std::abs(at.x), std::abs(at.z)), 0.195f) << at.x << " " << at.z;
        }
    }
    EXPECT_GE(rims, 8);
}

// A kerb of 12 cm under 14 cm of snow: what its edge sheds reaches down into the snow of the road. Under 3 cm its face is bare.
TEST(SnowShape, DeepSnowClosesAStep)
{
    const SnowCaps caps = caps_of(yard());
    const auto rim_over_road = [&](float depth) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        float highest = -1.0f;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const auto& p = caps.points[i];
            if (std::abs(p.base_m.y - 0.12f) > 1e-4f || std::abs(p.base_m.x + 1.0f) > 1e-4f || std::abs(p.base_m.z - 2.2f) > 0.5f) continue;
            highest = std::max(highest, shape.positions[i].y - 0.75f * depth);
        }
        return highest;
    };
    EXPECT_LT(rim_over_road(0.14f), 0.0f);
    EXPECT_GT(rim_over_road(0.14f), -0.06f);
    EXPECT_GT(rim_over_road(0.03f), 0.08f);
}

// A post on one wide triangle: its foot stands in the snow, which has no fold around it. It may have two sides, and rest on its
// own underside.
TEST(SnowShape, GoesOnIntoWhatStandsInIt)
{
    for (const bool two_sided : {false, true}) {
        for (const float lift : {0.0f, 0.005f}) {
            Scene scene = empty_scene();
            add_ground(scene, 20.0f);
            scene.materials[0].double_sided = two_sided;
            add_box(scene, {0.1f, lift, 0.1f}, {0.35f, 0.6f, 0.35f}, false);
            SnowCapOptions options;
            options.eyes_m = {{0.0f, 1.6f, 4.0f}};
            const SnowCaps caps = caps_of(scene, options);
            const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.14f));
            int near = 0;
            for (std::size_t i = 0; i < caps.points.size(); ++i) {
                const auto& p = caps.points[i];
                if (p.base_m.y > 0.01f) continue;
                const vec3 off = glm::max(glm::abs(p.base_m - vec3(0.225f, 0.0f, 0.225f)) - 0.125f, vec3(0.0f));
                const vec3 in = glm::abs(p.base_m - vec3(0.225f, 0.0f, 0.225f));
                const bool underside = std::abs(in.x - 0.125f) < 1e-4f && std::abs(in.z - 0.125f) < 1e-4f;
                if (std::hypot(off.x, off.z) > 0.1f || underside) continue;
                ++near;
                EXPECT_GT(shape.thickness_m[i], 0.06f) << p.base_m.x << " " << p.base_m.z;
            }
            EXPECT_GT(near, 2);
        }
    }
}

// A tube on a table is no step of it: in snow as deep as the tube is high it has a cap of its own, no slab with faces.
TEST(SnowShape, AThinThingKeepsItsOwnCap)
{
    Scene scene = empty_scene();
    add_ground(scene);
    add_box(scene, {-0.15f, 0, -0.15f}, {0.15f, 0.08f, 0.15f}, false);
    add_box(scene, {-0.12f, 0.08f, -0.024f}, {0.12f, 0.14f, 0.024f}, false);
    SnowCapOptions options;
    options.eyes_m = {{0, 0.6f, 1.0f}};
    const SnowCaps caps = caps_of(scene, options);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.06f));
    float highest = 0.0f, on_table = 0.0f, shoulder = 0.0f;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const vec3& base = caps.points[i].base_m;
        if (std::abs(base.y - 0.14f) < 1e-4f) {
            highest = std::max(highest, shape.positions[i].y - base.y);
            if (caps.points[i].edge_m > 0.004f && caps.points[i].edge_m < 0.01f) shoulder = std::max(shoulder, shape.thickness_m[i]);
        }
        if (std::abs(base.y - 0.08f) < 1e-4f) on_table = std::max(on_table, shape.positions[i].y - base.y);
    }
    EXPECT_GT(shoulder, 0.004f);
    EXPECT_LT(shoulder, 0.024f) << "no slab";
    EXPECT_GT(highest, 0.004f);
    EXPECT_GT(on_table, 0.05f) << "the table, which is wide, has all of it";
    EXPECT_LT(highest, on_table - 0.06f + 0.024f) << "over the snow around it a heap as high as its half width at most";
}

// Around a box of a hand's width the snow of the ground ends in no teeth: its height goes on evenly along the foot. The ground
// is left out below it, as that of models is, in cells that know nothing of its sides.
TEST(SnowShape, EndsEvenlyAtTheFootOfASmallThing)
{
    Scene scene = empty_scene();
    constexpr float kCell = 0.04f;
    for (int z = -20; z < 20; ++z) {
        for (int x = -20; x < 20; ++x) {
            const vec2 middle = kCell * (vec2(static_cast<float>(x), static_cast<float>(z)) + 0.5f);
            if (glm::length(middle) > 0.06f)
                add_face(scene, {middle.x - 0.5f * kCell, 0, middle.y + 0.5f * kCell}, {kCell, 0, 0}, {0, 0, -kCell});
        }
    }
    // Turned against the triangles of the ground.
    const float c = 0.12f * std::cos(0.5f), s = 0.12f * std::sin(0.5f);
    const std::vector<vec3> corners{{c, 0, s}, {-s, 0, c}, {-c, 0, -s}, {s, 0, -c}};
    for (std::size_t k = 0; k < 4; ++k)
        add_face(scene, corners[(k + 1) % 4], corners[k] - corners[(k + 1) % 4], {0, 0.1f, 0});
    add_face(scene, corners[0] + vec3(0, 0.1f, 0), corners[3] - corners[0], corners[1] - corners[0]);
    SnowCapOptions options;
    options.eyes_m = {{-0.6f, 0.5f, 1.0f}};
    const SnowCaps caps = caps_of(scene, options);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.06f));
    // Of the ground within 1 cm of a side and off its corners, by where along it.
    float steepest = 0.0f;
    int pairs = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const vec3 from = corners[k], along = glm::normalize(corners[(k + 1) % 4] - corners[k]);
        const vec3 out = glm::normalize(0.5f * (corners[k] + corners[(k + 1) % 4]));
        std::vector<std::pair<float, float>> foot;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const vec3& base = caps.points[i].base_m;
            const float off = glm::dot(base - from, out), at = glm::dot(base - from, along);
            if (std::abs(base.y) < 1e-4f && off > 0.0f && off < 0.01f && at > 0.03f && at < 0.14f) foot.emplace_back(at, shape.positions[i].y);
        }
        std::sort(foot.begin(), foot.end());
        for (std::size_t i = 1; i < foot.size(); ++i) {
            steepest = std::max(steepest, std::abs(foot[i].second - foot[i - 1].second));
            ++pairs;
        }
    }
    RecordProperty("pairs", pairs);
    RecordProperty("steepest_m", std::to_string(steepest));
    EXPECT_GT(pairs, 12);
    EXPECT_LT(steepest, 0.012f);
}

// A board that lies over a wall, 6 cm from its face: snow is round at its end, no slab stands up there. On wide ground the
// snow beside the same board buries its edge.
TEST(SnowShape, ABoardIsRoundWhereNoSnowReachesUpToIt)
{
    const auto end_of_board = [](float wall) {
        Scene scene = empty_scene();
        add_box(scene, {-wall, -1.0f, -wall}, {0.0f, 0.0f, wall}, false);
        add_box(scene, {-0.9f, 0.0f, -0.1f}, {-0.06f, 0.04f, 0.1f}, false);
        if (wall > 1.0f) add_box(scene, {0.0f, -1.0f, -wall}, {wall, 0.0f, wall}, false);
        const SnowCaps caps = caps_of(scene);
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.14f));
        float thickest = -1.0f;
        for (std::size_t i = 0; i < caps.points.size(); ++i) {
            const auto& p = caps.points[i];
            if (std::abs(p.base_m.y - 0.04f) < 1e-4f && std::abs(p.base_m.x + 0.06f) < 1e-4f) thickest = std::max(thickest, shape.thickness_m[i]);
        }
        EXPECT_GE(thickest, 0.0f) << "none is there";
        return thickest;
    };
    EXPECT_LT(end_of_board(0.2f), 0.05f);
    EXPECT_GT(end_of_board(2.0f), 0.08f);
}

// Two stones of a kerb with a slot between them: at the corner snow is round as along the edge.
TEST(SnowShape, IsRoundAtTheCornersOfASlot)
{
    Scene scene = empty_scene();
    add_box(scene, {-1.0f, 0.0f, -0.5f}, {-0.04f, 1.0f, 0.5f}, false);
    add_box(scene, {0.04f, 0.0f, -0.5f}, {1.0f, 1.0f, 0.5f}, false);
    const SnowCaps caps = caps_of(scene);
    const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), 0.2f));
    int corners = 0, beside = 0;
    for (std::size_t i = 0; i < caps.points.size(); ++i) {
        const auto& p = caps.points[i];
        if (p.base_m.y != 1.0f || std::abs(p.base_m.x) > 0.08f) continue;
        if (p.edge_m < 0.005f) {
            EXPECT_LT(shape.thickness_m[i], 0.08f) << p.base_m.x << " " << p.base_m.z;
            ++corners;
        } else if (p.edge_m > 0.3f) {
            EXPECT_GT(shape.thickness_m[i], 0.14f) << "the slot is closed";
            ++beside;
        }
    }
    EXPECT_GT(corners, 3);
    EXPECT_GT(beside, 3);
}

TEST(SnowShape, WithoutSnowCapsAreBelowTheGround)
{
    const SnowCaps caps = caps_of(yard());
    const SnowShape none = snow_shape(caps, std::vector<float>(caps.points.size(), 0.0f));
    EXPECT_EQ(none.thickest_m, 0.0f);
    for (std::size_t i = 0; i < caps.points.size(); ++i)
        ASSERT_LT(none.positions[i].y, caps.points[i].base_m.y);
    // And they rise without a jump.
    float before = -0.02f;
    for (float depth = 0.0f; depth < 0.1f; depth += 0.002f) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        const float up = shape.positions[0].y - caps.points[0].base_m.y;
        EXPECT_GE(up, before - 1e-6f);
        EXPECT_LT(up - before, 0.012f);
        before = up;
    }
}

}  // namespace
}  // namespace petrichor::scene
