// Which scenes stand on ground of their own, and what is laid below the others.
#include "film/scenes/ground_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "film/jobs/camera.h"

namespace petrichor::film {
namespace {

scene::Primitive box(const glm::vec3& low, const glm::vec3& high)
{
    scene::Primitive p;
    for (int corner = 0; corner < 8; ++corner) {
        p.positions.emplace_back(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                 corner & 4 ? high.z : low.z);
        p.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
    p.indices = {0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2,
                 4, 6, 7, 4, 7, 5, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return p;
}

scene::Scene scene_of(std::vector<scene::Primitive> primitives)
{
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({"mesh", std::move(primitives)});
    scene.instances.push_back({"instance", 0, glm::mat4(1.0f)});
    return scene;
}

TEST(GroundPlane, WideScenesWithAFloorBringTheirOwn)
{
    const auto floor = box({-60, -0.1f, -60}, {60, 0, 60});
    const auto house = box({-1, 0, -1}, {1, 3, 1});
    const scene::Scene town = scene_of({floor, house});
    EXPECT_TRUE(brings_ground(town, content_bounds(town)));
    const scene::Scene alone = scene_of({house});
    EXPECT_FALSE(brings_ground(alone, content_bounds(alone)));
    // Things beside each other with nothing between.
    const scene::Scene apart =
        scene_of({box({-60, 0, -60}, {-30, 20, -30}), box({30, 0, 30}, {60, 20, 60})});
    EXPECT_FALSE(brings_ground(apart, content_bounds(apart)));
}

// Its rim would be an edge over nothing.
TEST(GroundPlane, AYardIsLaidOnGroundAtItsUnderside)
{
    scene::Scene yard = scene_of({box({-5, -0.1f, -5}, {5, 0, 5}), box({-1, 0, -1}, {1, 3, 1})});
    const scene::Bounds content = content_bounds(yard);
    EXPECT_FALSE(brings_ground(yard, content));
    add_ground(yard, content);
    const scene::Primitive& disc = yard.meshes.back().primitives[0];
    // Its underside is what faces up there when winding is not trusted: the ground goes on from below its rim, a few millimetres lower.
    double beside = 0.0;
    for (std::size_t k = 0; k + 2 < disc.indices.size(); k += 3) {
        const glm::vec3 middle = (disc.positions[disc.indices[k]] + disc.positions[disc.indices[k + 1]] + disc.positions[disc.indices[k + 2]]) / 3.0f;
        EXPECT_NEAR(middle.y, -0.1f, 0.01f);
        const float out = std::max(std::abs(middle.x), std::abs(middle.z));
        if (out > 5.2f && out < 20.0f)
            beside += 0.5 * static_cast<double>(glm::length(glm::cross(disc.positions[disc.indices[k + 1]] - disc.positions[disc.indices[k]],
                                                                       disc.positions[disc.indices[k + 2]] - disc.positions[disc.indices[k]])));
    }
    EXPECT_NEAR(beside, 40.0 * 40.0 - 10.4 * 10.4, 160.0) << "all around it";
}

TEST(GroundPlane, LiesBelowTheSceneAndLeavesItsBoundsAlone)
{
    scene::Scene alone = scene_of({box({-1, 2, -1}, {1, 5, 1})});
    const scene::Bounds before = content_bounds(alone);
    add_ground(alone, before);
    const scene::Bounds after = scene::scene_bounds(alone);
    EXPECT_EQ(before.low, after.low);
    EXPECT_EQ(before.high, after.high);
    ASSERT_TRUE(alone.instances.back().backdrop);
    float reach = 0.0f;
    for (const std::size_t mesh : {alone.meshes.size() - 2, alone.meshes.size() - 1}) {
        const scene::Primitive& part = alone.meshes[mesh].primitives[0];
        for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
            const glm::vec3& a = part.positions[part.indices[i]];
            const glm::vec3& b = part.positions[part.indices[i + 1]];
            const glm::vec3& c = part.positions[part.indices[i + 2]];
            EXPECT_GT(glm::cross(b - a, c - a).y, 0.0f) << "faces up";
            EXPECT_LT(a.y, 2.0f);
            EXPECT_GT(a.y, 1.99f) << "and touches what stands on it";
            reach = std::max({reach, glm::length(a), glm::length(b), glm::length(c)});
        }
    }
    EXPECT_GT(reach, 100.0f * glm::length(before.high - before.low));
    EXPECT_EQ(alone.materials.back().name, "default ground");
    EXPECT_EQ(alone.textures.size(), 3u);
}

// The yard ends in grass, and no crack is between them: each side at the rim of the one is a side of the other.
TEST(GroundPlane, IsAYardInAMeadow)
{
    using Side = std::array<float, 4>;
    const auto rim_of = [](const scene::Primitive& part) {
        std::set<Side> open;
        for (std::size_t k = 0; k < part.indices.size(); ++k) {
            const glm::vec3& a = part.positions[part.indices[k]];
            const glm::vec3& b = part.positions[part.indices[k % 3 == 2 ? k - 2 : k + 1]];
            if (open.erase({b.x, b.z, a.x, a.z}) == 0) open.insert({a.x, a.z, b.x, b.z});
        }
        return open;
    };
    scene::Scene alone = scene_of({box({-1, 2, -1}, {1, 5, 1})});
    add_ground(alone, content_bounds(alone));
    const scene::Primitive& land = alone.meshes[alone.meshes.size() - 2].primitives[0];
    const scene::Primitive& yard = alone.meshes.back().primitives[0];
    EXPECT_EQ(alone.materials[land.material].name, "default meadow");
    EXPECT_EQ(alone.materials[yard.material].name, "default ground");
    std::set<Side> around = rim_of(land);
    float nearest = 1.0e9f, farthest = 0.0f;
    for (const Side& side : rim_of(yard)) {
        const float out = std::hypot(side[0], side[1]);
        if (out < 10.0f) continue;  // below the box
        EXPECT_EQ(around.erase({side[2], side[3], side[0], side[1]}), 1u);
        nearest = std::min(nearest, out);
        farthest = std::max(farthest, out);
    }
    EXPECT_GT(nearest, 18.0f);
    EXPECT_LT(farthest, 32.0f);
    EXPECT_GT(farthest / nearest, 1.05f) << "it runs in and out";
    for (const Side& side : around) EXPECT_GT(std::hypot(side[0], side[1]), 500.0f) << "the horizon";
    // What is a finger high stands on asphalt, as far as one sees.
    scene::Scene small = scene_of({box({-0.01f, 0, -0.01f}, {0.01f, 0.02f, 0.01f})});
    add_ground(small, content_bounds(small));
    EXPECT_EQ(small.materials.size(), scene_of({box({-1, 2, -1}, {1, 5, 1})}).materials.size() + 1);
}

// Patches cannot tell two sheets apart that are closer than they are wide: the dark one below a plate would show on it.
TEST(GroundPlane, IsLeftOutWhereAPlateLiesOnIt)
{
    const auto covered_m2 = [](float height) {
        // Half of the rectangle around it, so that it brings no ground.
        scene::Scene plate = scene_of({box({-5, height, -5}, {5, height + 0.05f, 0}), box({-5, 0, 4.9f}, {5, 0.1f, 5})});
        const scene::Bounds content = content_bounds(plate);
        EXPECT_FALSE(brings_ground(plate, content));
        add_ground(plate, content);
        const scene::Primitive& disc = plate.meshes.back().primitives[0];
        double left_out = 0.0;
        for (int z = 0; z < 100; ++z) {
            for (int x = 0; x < 100; ++x) {
                const glm::vec2 at(-5.0f + 0.1f * (static_cast<float>(x) + 0.5f), -5.0f + 0.1f * (static_cast<float>(z) + 0.5f));
                bool there = false;
                for (std::size_t i = 0; i + 2 < disc.indices.size() && !there; i += 3) {
                    const auto side = [&](std::size_t a, std::size_t b) {
                        const glm::vec3 p = disc.positions[disc.indices[i + a]], q = disc.positions[disc.indices[i + b]];
                        return (q.x - p.x) * (at.y - p.z) - (q.z - p.z) * (at.x - p.x) <= 1e-5f;
                    };
                    there = side(0, 1) && side(1, 2) && side(2, 0);
                }
                if (there) continue;
                left_out += 0.01;
                EXPECT_LT(at.y, 0.0f) << "ground beside the plate is whole";
            }
        }
        return left_out;
    };
    EXPECT_GT(covered_m2(0.0f), 40.0) << "of 50";
    EXPECT_EQ(covered_m2(1.0f), 0.0) << "one can look below a table";
}

// Nor does a corner of one of its triangles lie within a side of another: snow would end at both.
TEST(GroundPlane, HasNoCornersWithinSides)
{
    scene::Scene board = scene_of({box({-0.16f, 0, -0.17f}, {0.16f, 0.1f, 0.2f}), box({-0.02f, 0.1f, -0.02f}, {0.02f, 0.7f, 0.02f})});
    add_ground(board, content_bounds(board));
    const scene::Primitive& disc = board.meshes.back().primitives[0];
    std::set<std::pair<float, float>> corners;
    for (const std::uint32_t i : disc.indices) corners.emplace(disc.positions[i].x, disc.positions[i].z);
    int within = 0;
    for (std::size_t k = 0; k < disc.indices.size(); ++k) {
        const glm::vec3 middle = 0.5f * (disc.positions[disc.indices[k]] + disc.positions[disc.indices[k % 3 == 2 ? k - 2 : k + 1]]);
        within += corners.count({middle.x, middle.z}) > 0 ? 1 : 0;
    }
    EXPECT_EQ(within, 0);
    EXPECT_GT(disc.positions.size(), 8000u);
}

}  // namespace
}  // namespace petrichor::film
