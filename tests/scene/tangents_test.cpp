#include "scene/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <numeric>

#include "tests/scene/gltf_helpers.h"

namespace petrichor::scene {
namespace {

using scene_files::Random;

struct Surface {
    glm::vec3 position, normal;
    glm::vec2 uv;
};

// A grid of (columns x rows) cells over 0..1 x 0..1; v of the parameter grows upwards.
Primitive grid(int columns, int rows, const std::function<Surface(float, float)>& at)
{
    Primitive out;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            const Surface s = at(static_cast<float>(x) / static_cast<float>(columns),
                                 static_cast<float>(y) / static_cast<float>(rows));
            out.positions.push_back(s.position);
            out.normals.push_back(s.normal);
            out.uv0.push_back(s.uv);
        }
    }
    const auto vertex = [columns](int x, int y) {
        return static_cast<std::uint32_t>(y * (columns + 1) + x);
    };
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const auto a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
                       d = vertex(x, y + 1);
            out.indices.insert(out.indices.end(), {a, b, c, a, c, d});
        }
    }
    return out;
}

Surface flat_xy(float s, float t)  // faces +z; uv as in an image: v downwards
{
    return {{s, t, 0.0f}, {0.0f, 0.0f, 1.0f}, {s, 1.0f - t}};
}

Surface on_sphere(float s, float t)
{
    const float longitude = 6.2831853f * s;
    const float latitude = 1.2f * (2.0f * t - 1.0f);
    const glm::vec3 n(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                      std::cos(latitude) * std::cos(longitude));
    return {2.0f * n, n, {3.0f * s, 1.0f - t}};
}

std::vector<glm::vec4> by_corner(const Primitive& primitive)
{
    std::vector<glm::vec4> out;
    for (const std::uint32_t index : primitive.indices) out.push_back(primitive.tangents[index]);
    return out;
}

void expect_orthonormal(const Primitive& primitive)
{
    ASSERT_EQ(primitive.tangents.size(), primitive.positions.size());
    for (std::size_t v = 0; v < primitive.tangents.size(); ++v) {
        const glm::vec3 tangent(primitive.tangents[v]);
        EXPECT_NEAR(glm::length(tangent), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(tangent, primitive.normals[v]), 0.0f, 1e-5f);
        EXPECT_EQ(std::abs(primitive.tangents[v].w), 1.0f);
    }
}

TEST(Tangents, OfAPlaneFollowU)
{
    Primitive plane = grid(3, 2, flat_xy);
    generate_tangents(plane);
    EXPECT_EQ(plane.positions.size(), 12u) << "nothing to split";
    // u grows along +x; cross(n, t) = +y is up in the image, so w = 1.
    for (const glm::vec4& t : plane.tangents) EXPECT_EQ(t, glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
}

TEST(Tangents, OfARotatedAndShearedMappingFollowU)
{
    // u = (x + y) / 2: it grows along (1, 1), whatever v does.
    Primitive plane = grid(4, 4, [](float s, float t) {
        Surface out = flat_xy(s, t);
        out.uv = {0.5f * (s + t), 0.25f * s - 2.0f * t};
        return out;
    });
    generate_tangents(plane);
    // Along u at constant v: ds = 8 dt, so the direction is (8, 1) / sqrt(65).
    for (const glm::vec4& t : plane.tangents) {
        EXPECT_NEAR(t.x, 8.0f / std::sqrt(65.0f), 1e-5f);
        EXPECT_NEAR(t.y, 1.0f / std::sqrt(65.0f), 1e-5f);
        EXPECT_EQ(t.w, 1.0f);
    }
}

TEST(Tangents, OfASphereAreTheParallels)
{
    Primitive sphere = grid(48, 24, on_sphere);
    const std::size_t vertices = sphere.positions.size();
    generate_tangents(sphere);
    EXPECT_EQ(sphere.positions.size(), vertices) << "one chart, one handedness: nothing to split";
    expect_orthonormal(sphere);
    for (std::size_t v = 0; v < vertices; ++v) {
        const glm::vec3 n = sphere.normals[v];
        const glm::vec3 east = glm::normalize(glm::vec3(n.z, 0.0f, -n.x));
        // The border of the chart has triangles on one side only: one step of the grid is 7.5
        // degrees.
        EXPECT_GT(glm::dot(glm::vec3(sphere.tangents[v]), east), 0.99f) << "vertex " << v;
        EXPECT_EQ(sphere.tangents[v].w, 1.0f);
    }
}

// Left half mirrored: u grows away from the seam on both sides, as in symmetric models.
Primitive mirrored_plane()
{
    return grid(4, 2, [](float s, float t) {
        Surface out = flat_xy(s, t);
        out.uv.x = std::abs(s - 0.5f);
        return out;
    });
}

TEST(Tangents, DoNotMixAcrossAMirroredSeam)
{
    Primitive plane = mirrored_plane();
    const std::size_t vertices = plane.positions.size();
    generate_tangents(plane);
    EXPECT_EQ(plane.positions.size(), vertices + 3) << "the three vertices of the seam are doubled";
    expect_orthonormal(plane);
    for (std::size_t i = 0; i < plane.indices.size(); i += 3) {
        float middle = 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            middle += plane.positions[plane.indices[i + c]].x / 3.0f;
        const float side = middle < 0.5f ? -1.0f : 1.0f;
        for (std::size_t c = 0; c < 3; ++c) {
            // +u points away from the seam; up in the image stays up, so the sign flips with it.
            EXPECT_EQ(plane.tangents[plane.indices[i + c]], glm::vec4(side, 0.0f, 0.0f, side));
        }
    }
    // The copies carry everything else unchanged.
    ASSERT_EQ(plane.uv0.size(), plane.positions.size());
    for (std::size_t v = vertices; v < plane.positions.size(); ++v) {
        EXPECT_EQ(plane.positions[v].x, 0.5f);
        EXPECT_EQ(plane.uv0[v].x, 0.0f);
    }
}

TEST(Tangents, AreWeightedByTheAngle)
{
    // Two triangles share the edge 0-1. At vertex 0 the first has an angle of 90 degrees, the
    // second one of 45; their uv are bent so that their directions of u differ.
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.indices = {0, 1, 2, 0, 3, 1};
    p.uv0 = {{0, 0}, {1, 1}, {0, 2}, {2, 1}};
    // By hand, from the edges and uv differences of each: e1 dv2 - e2 dv1, by the sign of the area.
    //   first:  e1 = (1, 0), e2 = (0, 1), dv1 = 1, dv2 = 2, area = 1 * 2 - 1 * 0 = 2: (2, -1)
    //   second: e1 = (1, -1), e2 = (1, 0), dv1 = 1, dv2 = 1, area = 2 * 1 - 1 * 1 = 1: (0, -1)
    const glm::vec2 first = glm::vec2(2, -1) / std::sqrt(5.0f), second(0, -1);
    const glm::vec2 expected = glm::normalize(2.0f * first + 1.0f * second);
    generate_tangents(p);
    EXPECT_NEAR(p.tangents[0].x, expected.x, 1e-6f);
    EXPECT_NEAR(p.tangents[0].y, expected.y, 1e-6f);
    EXPECT_EQ(p.tangents[0].w, -1.0f);
}

TEST(Tangents, WeldCornersThatOnlyTheIndexSeparates)
{
    // The same grid as a soup of triangles: every corner its own vertex.
    Primitive welded = grid(12, 6, on_sphere);
    Primitive soup;
    for (const std::uint32_t index : welded.indices) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(welded.positions[index]);
        soup.normals.push_back(welded.normals[index]);
        soup.uv0.push_back(welded.uv0[index]);
    }
    generate_tangents(welded);
    generate_tangents(soup);
    EXPECT_EQ(by_corner(welded), by_corner(soup));
}

TEST(Tangents, DoNotDependOnTheOrderOfTriangles)
{
    Primitive forward = grid(10, 8, [](float s, float t) {
        Surface out = on_sphere(s, t);
        out.uv.x = std::abs(out.uv.x - 1.3f) + 0.1f * std::sin(9.0f * t);  // with a mirrored seam
        return out;
    });
    Primitive shuffled = forward;
    const std::size_t triangles = forward.indices.size() / 3;
    std::vector<std::size_t> order(triangles);
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random random{7};
    for (std::size_t i = triangles; i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::size_t turn = random.next() % 3;  // also start each triangle at another corner
        for (std::size_t c = 0; c < 3; ++c) {
            shuffled.indices[3 * i + c] = forward.indices[3 * order[i] + (c + turn) % 3];
        }
    }
    generate_tangents(forward);
    generate_tangents(shuffled);
    for (std::size_t i = 0; i < triangles; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            bool found = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = shuffled.indices[3 * i + c], b = forward.indices[3 * order[i] + k];
                if (shuffled.positions[a] != forward.positions[b]) continue;
                found = true;
                EXPECT_LT(glm::distance(shuffled.tangents[a], forward.tangents[b]), 1e-5f);
            }
            EXPECT_TRUE(found);
        }
    }
}

TEST(Tangents, SurviveTrianglesWithoutArea)
{
    Primitive plane = grid(2, 2, flat_xy);
    const auto copy_of = [&plane](std::uint32_t v) {
        plane.positions.push_back(plane.positions[v]);
        plane.normals.push_back(plane.normals[v]);
        plane.uv0.push_back(plane.uv0[v]);
        return static_cast<std::uint32_t>(plane.positions.size() - 1);
    };
    const std::uint32_t twin = copy_of(4);
    plane.indices.insert(plane.indices.end(), {4, twin, 5});  // no area, at decided points
    const std::uint32_t lone = copy_of(0);
    plane.positions[lone] = {7.0f, 7.0f, 7.0f};
    const std::uint32_t lone2 = copy_of(lone), lone3 = copy_of(lone);
    plane.indices.insert(plane.indices.end(), {lone, lone2, lone3});  // no area, alone
    generate_tangents(plane);
    expect_orthonormal(plane);
    for (std::size_t corner = 24; corner < 27; ++corner) {
        EXPECT_EQ(plane.tangents[plane.indices[corner]], glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    }
}

TEST(Tangents, FollowNeighborsWhereTheUvHasNoArea)
{
    // The right column of cells is collapsed to one line of uv.
    Primitive plane = grid(3, 1, [](float s, float t) {
        Surface out = flat_xy(s, t);
        out.uv.x = std::min(s, 2.0f / 3.0f);
        return out;
    });
    generate_tangents(plane);
    expect_orthonormal(plane);
    for (std::size_t v = 0; v < plane.positions.size(); ++v) {
        if (plane.positions[v].x < 0.7f) {
            EXPECT_EQ(plane.tangents[v], glm::vec4(1.0f, 0.0f, 0.0f, 1.0f)) << "vertex " << v;
        }
    }
}

TEST(Tangents, WithoutTextureCoordinatesAreAnyUnitVectors)
{
    Primitive sphere = grid(8, 8, on_sphere);
    sphere.uv0.assign(sphere.positions.size(), glm::vec2(0.0f));
    generate_tangents(sphere);
    expect_orthonormal(sphere);
    sphere.uv0.clear();
    generate_tangents(sphere);
    expect_orthonormal(sphere);
}

TEST(Tangents, UseTheAskedTextureCoordinates)
{
    Primitive plane = grid(2, 2, flat_xy);
    plane.uv1 = plane.uv0;
    for (glm::vec2& uv : plane.uv1) uv = {-uv.y, uv.x};  // u grows along +y
    generate_tangents(plane, 1);
    for (const glm::vec4& t : plane.tangents) EXPECT_EQ(t, glm::vec4(0.0f, 1.0f, 0.0f, 1.0f));
}

TEST(Tangents, SurviveNumbersThatOverflow)
{
    Primitive plane = grid(2, 2, flat_xy);
    for (glm::vec3& position : plane.positions) position *= 3e38f;
    for (glm::vec2& uv : plane.uv0) uv *= 1e30f;
    generate_tangents(plane);
    expect_orthonormal(plane);
    plane = grid(2, 2, flat_xy);
    for (glm::vec3& position : plane.positions) position *= 1e-30f;
    for (glm::vec2& uv : plane.uv0) uv *= 1e-30f;
    generate_tangents(plane);
    expect_orthonormal(plane);
}

TEST(Tangents, SurviveAFanOfStrangers)
{
    // Many triangles meet in one vertex and share no edge: each its own group, quickly.
    Primitive fan;
    const std::uint32_t triangles = 60000;
    Random random{3};
    fan.positions.push_back(glm::vec3(0.0f));
    fan.uv0.push_back(glm::vec2(0.0f));
    for (std::uint32_t t = 0; t < triangles; ++t) {
        for (int c = 0; c < 2; ++c) {
            fan.positions.push_back({random.unit(), random.unit(), 0.0f});
            fan.uv0.push_back({random.unit(), random.unit()});
        }
        fan.indices.insert(fan.indices.end(), {0, 2 * t + 1, 2 * t + 2});
    }
    fan.normals.assign(fan.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    generate_tangents(fan);
    EXPECT_EQ(fan.tangents.size(), fan.positions.size());
    EXPECT_GT(fan.positions.size(), 2u * triangles + triangles / 2);
}

TEST(FlatNormals, AreThoseOfTheTriangles)
{
    // A roof: two slopes, four vertices each, sharing the ridge.
    Primitive roof;
    roof.positions = {{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, -1}, {0, 1, -1}, {1, 0, -1}};
    roof.uv0.assign(6, glm::vec2(0.5f));
    roof.colors.assign(6, glm::vec4(0.25f));
    roof.tangents.assign(6, glm::vec4(1.0f));
    roof.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    const auto before = roof.positions;
    const auto old_indices = roof.indices;
    generate_flat_normals(roof);
    EXPECT_EQ(roof.positions.size(), 8u) << "only the two vertices of the ridge are doubled";
    EXPECT_EQ(roof.normals.size(), 8u);
    EXPECT_EQ(roof.uv0.size(), 8u);
    EXPECT_EQ(roof.colors.size(), 8u);
    EXPECT_TRUE(roof.tangents.empty());
    const float h = std::sqrt(0.5f);
    for (std::size_t i = 0; i < roof.indices.size(); ++i) {
        EXPECT_EQ(roof.positions[roof.indices[i]], before[old_indices[i]]);
        const glm::vec3 expected(i < 6 ? -h : h, h, 0.0f);
        EXPECT_LT(glm::distance(roof.normals[roof.indices[i]], expected), 1e-6f);
    }
}

TEST(FlatNormals, OfATriangleWithoutAreaPointUp)
{
    Primitive line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.indices = {0, 1, 2};
    generate_flat_normals(line);
    for (const glm::vec3& n : line.normals) EXPECT_EQ(n, glm::vec3(0.0f, 1.0f, 0.0f));
}

struct Agreement {
    double within_5_degrees = 0.0, same_sign = 0.0;  // shares of the corners
    std::size_t corners = 0;
};

Agreement compare_with_shipped(const Scene& scene)
{
    Agreement out;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& shipped : mesh.primitives) {
            Primitive ours = shipped;
            generate_tangents(ours);
            for (std::size_t i = 0; i < shipped.indices.size(); ++i) {
                const glm::vec4 a = shipped.tangents[shipped.indices[i]];
                const glm::vec4 b = ours.tangents[ours.indices[i]];
                ++out.corners;
                if (glm::dot(glm::vec3(a), glm::vec3(b)) > std::cos(0.0872665f)) {
                    out.within_5_degrees += 1.0;
                }
                if (a.w == b.w) out.same_sign += 1.0;
            }
        }
    }
    out.within_5_degrees /= static_cast<double>(out.corners);
    out.same_sign /= static_cast<double>(out.corners);
    return out;
}

TEST(Tangents, AgreeWithThoseThatModelsShip)
{
    NEED_ASSETS(assets);
    // FlightHelmet's come from a modelling tool with rules of its own. In the town a sixth of the
    // corners have no texture coordinates that would say anything.
    struct Case {
        const char* file;
        double within_5_degrees, same_sign;
    };
    for (const Case& c : {Case{"FlightHelmet/FlightHelmet.gltf", 0.96, 0.9999},
                          Case{"truck_town/town_model.gltf", 0.83, 0.995}}) {
        const auto agreement =
            compare_with_shipped(scene_files::load_file(assets / "models" / c.file));
        std::cout << c.file << ": " << agreement.corners << " corners, "
                  << 100.0 * agreement.within_5_degrees << " % within 5 degrees, "
                  << 100.0 * agreement.same_sign << " % of the same sign\n";
        EXPECT_GE(agreement.within_5_degrees, c.within_5_degrees);
        EXPECT_GE(agreement.same_sign, c.same_sign);
    }
}

}  // namespace
}  // namespace petrichor::scene
