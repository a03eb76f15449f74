// Meshes are cut without cracks, whatever their seams.
#include "scene/subdivide/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace petrichor::scene {
namespace {

using glm::vec2;
using glm::vec3;
using Place = std::array<float, 3>;

Place place(const vec3& p)
{
    return {p.x, p.y, p.z};
}

// A box whose faces have normals and texture coordinates of their own: every edge is a seam.
Primitive box(const vec3& half)
{
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1.0f;
            const auto first = static_cast<std::uint32_t>(p.positions.size());
            for (const vec2 at : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
                p.positions.push_back(half * (n + u * at.x + v * at.y));
                p.normals.push_back(n);
                p.tangents.emplace_back(u, 1.0f);
                p.uv0.push_back(at * (static_cast<float>(axis) + 1.0f) + side);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
        }
    }
    return p;
}

SubdivideOptions longer_than(float length)
{
    SubdivideOptions options;
    options.too_long = [length](const vec3& a, const vec3& b) { return glm::distance(a, b) > length; };
    return options;
}

// Edges, by their places, that do not have as many triangles one way as the other.
std::size_t open_edges(const std::vector<Primitive>& primitives)
{
    std::map<std::pair<Place, Place>, int> ways;
    for (const Primitive& p : primitives) {
        for (std::size_t k = 0; k < p.indices.size(); ++k) {
            const Place a = place(p.positions[p.indices[k]]);
            const Place b = place(p.positions[p.indices[k % 3 == 2 ? k - 2 : k + 1]]);
            ways[a < b ? std::pair(a, b) : std::pair(b, a)] += a < b ? 1 : -1;
        }
    }
    return static_cast<std::size_t>(
        std::count_if(ways.begin(), ways.end(), [](const auto& one) { return one.second != 0; }));
}

float area_of(const std::vector<Primitive>& primitives)
{
    double area = 0.0;
    for (const Primitive& p : primitives) {
        for (std::size_t k = 0; k + 2 < p.indices.size(); k += 3) {
            const vec3 a = p.positions[p.indices[k]];
            area += 0.5 * static_cast<double>(glm::length(glm::cross(
                              p.positions[p.indices[k + 1]] - a, p.positions[p.indices[k + 2]] - a)));
        }
    }
    return static_cast<float>(area);
}

TEST(Subdivide, NoEdgeIsLongerThanAsked)
{
    const CutMesh cut = subdivide({box({1.0f, 0.3f, 2.0f})}, longer_than(0.21f));
    EXPECT_FALSE(cut.limited);
    const Primitive& p = cut.primitives[0];
    float longest = 0.0f;
    for (std::size_t k = 0; k < p.indices.size(); ++k) {
        longest = std::max(longest, glm::distance(p.positions[p.indices[k]],
                                                  p.positions[p.indices[k % 3 == 2 ? k - 2 : k + 1]]));
    }
    EXPECT_LE(longest, 0.21f);
    EXPECT_GT(longest, 0.1f);
    EXPECT_NEAR(area_of(cut.primitives), 2.0f * (2 * 0.6f + 4 * 2.0f + 4 * 0.6f), 1e-4f);
    for (std::size_t v = 0; v < p.positions.size(); ++v)
        ASSERT_NEAR(glm::length(p.normals[v]), 1.0f, 1e-5f);
}

// The finer half of the box meets the coarser one: where they meet, both have the same edges.
TEST(Subdivide, LeavesNoCracksWhereFinenessChanges)
{
    SubdivideOptions options;
    options.too_long = [](const vec3& a, const vec3& b) {
        const vec3 middle = 0.5f * (a + b);
        return glm::distance(a, b) > (middle.x > 0.1f ? 0.05f : 0.4f) + 0.2f * std::abs(middle.z);
    };
    ASSERT_EQ(open_edges({box({1.0f, 0.3f, 2.0f})}), 0u);
    const CutMesh cut = subdivide({box({1.0f, 0.3f, 2.0f})}, options);
    EXPECT_GT(cut.primitives[0].indices.size(), 3000u);
    EXPECT_EQ(open_edges(cut.primitives), 0u);
}

TEST(Subdivide, VerticesOfAPointStayTogetherWhenTheyMove)
{
    CutMesh cut = subdivide({box({1.0f, 0.5f, 1.0f})}, longer_than(0.3f));
    Primitive& p = cut.primitives[0];
    std::set<std::uint32_t> points(cut.points[0].begin(), cut.points[0].end());
    EXPECT_EQ(points.size(), cut.normals.size());
    EXPECT_LT(points.size(), p.positions.size());
    for (std::size_t v = 0; v < p.positions.size(); ++v)
        p.positions[v] += cut.normals[cut.points[0][v]] * 0.1f * std::sin(9.0f * p.positions[v].x);
    EXPECT_EQ(open_edges(cut.primitives), 0u);
}

TEST(Subdivide, WhatIsNotCutIsCutOnlyAtTheSeamAndPinned)
{
    Primitive near, far;
    near.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}};
    far.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    for (Primitive* p : {&near, &far}) {
        p->normals.assign(3, vec3(0, 1, 0));
        p->indices = {0, 1, 2};
    }
    SubdivideOptions options = longer_than(0.3f);
    options.cut = {true, false};
    const CutMesh cut = subdivide({near, far}, options);
    const auto count = [&](std::size_t i) { return cut.primitives[i].indices.size() / 3; };
    EXPECT_EQ(count(0), 32u);
    EXPECT_LT(count(1), 16u);
    const CutMesh both = subdivide({near, far}, longer_than(0.3f));
    // Along z = 0 both sides have the same places, and they are pinned.
    std::array<std::set<Place>, 2> along;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t v = 0; v < cut.primitives[i].positions.size(); ++v) {
            const vec3& p = cut.primitives[i].positions[v];
            if (p.z != 0.0f) continue;
            along[i].insert(place(p));
            EXPECT_TRUE(cut.pinned[cut.points[i][v]]);
        }
    }
    EXPECT_EQ(along[0], along[1]);
    EXPECT_EQ(along[0].size(), 5u);
    EXPECT_EQ(std::count(both.pinned.begin(), both.pinned.end(), true), 0);
    EXPECT_GT(std::count(cut.pinned.begin(), cut.pinned.end(), false), 0);
}

TEST(Subdivide, StopsAtItsLimits)
{
    SubdivideOptions options = longer_than(0.001f);
    options.most_levels = 2;
    const CutMesh levels = subdivide({box(vec3(1.0f))}, options);
    EXPECT_FALSE(levels.limited);
    EXPECT_EQ(levels.primitives[0].indices.size() / 3, 12u * 16u);
    options.most_levels = 20;
    options.most_triangles = 1000;
    const CutMesh most = subdivide({box(vec3(1.0f))}, options);
    EXPECT_TRUE(most.limited);
    EXPECT_LE(most.primitives[0].indices.size() / 3, 1000u);
    EXPECT_EQ(open_edges(most.primitives), 0u);
}

// An octahedron with the normals of a sphere becomes rounder, and its corners stay.
TEST(Subdivide, PhongSmoothingBulgesTowardsTheTangentPlanes)
{
    Primitive p;
    p.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    p.normals = p.positions;
    for (const std::uint32_t x : {0u, 1u}) {
        for (const std::uint32_t y : {2u, 3u}) {
            for (const std::uint32_t z : {4u, 5u}) {
                const bool turned = (x + y + z) % 2 != 0;
                p.indices.insert(p.indices.end(), {x, turned ? z : y, turned ? y : z});
            }
        }
    }
    const auto middle_of = [&](float phong) {
        SubdivideOptions options = longer_than(1.0f);
        options.phong = phong;
        const CutMesh cut = subdivide({p}, options);
        EXPECT_EQ(open_edges(cut.primitives), 0u);
        EXPECT_EQ(cut.primitives[0].positions[0], vec3(1, 0, 0));
        float least = 9.0f;
        for (const vec3& q : cut.primitives[0].positions) {
            if (q.x * q.y != 0.0f) least = std::min(least, glm::length(q));
        }
        return least;
    };
    const float flat = middle_of(0.0f);
    EXPECT_NEAR(flat, std::sqrt(0.5f), 1e-6f);
    // On an edge the projections are (1, 1/2, 0) and (1/2, 1, 0): their mean is 3/4 (1, 1, 0).
    EXPECT_NEAR(middle_of(1.0f), 0.75f * std::sqrt(2.0f), 1e-6f);
}

TEST(Subdivide, JointsOfAMiddleAreThoseOfItsEnds)
{
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.normals.assign(3, vec3(0, 0, 1));
    p.indices = {0, 1, 2};
    p.influences = {{0, 1.0f}, {0, 0.0f}, {1, 1.0f}, {0, 0.0f}, {2, 1.0f}, {0, 0.0f}};
    p.targets.push_back({{{0, 0, 0}, {0, 0, 2}, {0, 0, 0}}, {}, {}});
    const CutMesh cut = subdivide({p}, longer_than(0.9f));
    const Primitive& q = cut.primitives[0];
    ASSERT_EQ(q.influences.size(), 2 * q.positions.size());
    ASSERT_EQ(q.targets[0].positions.size(), q.positions.size());
    bool seen = false;
    for (std::size_t v = 0; v < q.positions.size(); ++v) {
        EXPECT_NEAR(q.influences[2 * v].weight + q.influences[2 * v + 1].weight, 1.0f, 1e-6f);
        if (q.positions[v] != vec3(0.5f, 0, 0)) continue;
        seen = true;
        EXPECT_EQ(q.influences[2 * v].joint, 0u);
        EXPECT_EQ(q.influences[2 * v + 1].joint, 1u);
        EXPECT_NEAR(q.influences[2 * v].weight, 0.5f, 1e-6f);
        EXPECT_EQ(q.targets[0].positions[v], vec3(0, 0, 1));
    }
    EXPECT_TRUE(seen);
}

TEST(Subdivide, TrianglesWithoutAreaAndPlacesThatAreNoNumbersDoNoHarm)
{
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {NAN, 0, 0}, {INFINITY, 0, 0}};
    p.normals.assign(5, vec3(0, 1, 0));
    p.indices = {0, 1, 2, 0, 0, 0, 0, 1, 3, 1, 2, 4};
    SubdivideOptions options = longer_than(0.3f);
    options.most_triangles = 10000;
    const CutMesh cut = subdivide({p}, options);
    EXPECT_FALSE(cut.primitives[0].indices.empty());
    EXPECT_EQ(point_normals(cut).size(), cut.normals.size());
}

}  // namespace
}  // namespace petrichor::scene
