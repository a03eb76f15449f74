// Icicles before anything is drawn: their shape, and the ice that it holds.
#include "scene/icicles/icicles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "formulas/noise/noise.h"

namespace petrichor::scene {
namespace {

using glm::vec3;

std::vector<DripPoint> edge(float height_m = 3.0f, int count = 60)
{
    std::vector<DripPoint> points;
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        points.push_back({{0.04f * static_cast<float>(i), height_m, 0.0f}, 0.0f, 0.02f + 0.2f * shared::hash_f(n), shared::hash_u(n), 0u, {0.0f, 1.0f}});
    }
    return points;
}

IcicleLengths all_of(float length_m)
{
    IcicleLengths lengths;
    lengths.length_m.fill(length_m);
    return lengths;
}

struct Mesh3 {
    std::vector<vec3> positions, normals;
    std::vector<std::uint32_t> indices;
};

Mesh3 mesh_of(const Icicle& one, float length_m)
{
    Mesh3 m;
    m.positions.resize(icicle_vertices(one));
    m.normals.resize(icicle_vertices(one));
    m.indices.resize(std::size_t{3} * icicle_triangles(one));
    shape_icicle(one, length_m, m.positions, m.normals);
    icicle_indices(one, m.indices);
    for (std::uint32_t& i : m.indices) i -= one.first_vertex;
    return m;
}

double volume_m3(const Mesh3& m)
{
    double sum = 0.0;
    const vec3 o = m.positions.front();
    for (std::size_t i = 0; i < m.indices.size(); i += 3) {
        const vec3 a = m.positions[m.indices[i]] - o, b = m.positions[m.indices[i + 1]] - o, c = m.positions[m.indices[i + 2]] - o;
        sum += static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6.0;
    }
    return sum;
}

TEST(Icicle, VolumeAndAreaAreThoseOfItsProfile)
{
    double volume = 0.0, area = 0.0;
    constexpr double kStep = 1e-4;
    const auto tip = static_cast<double>(kIcicleTip_m);
    for (int i = 0; i < 9000; ++i) {
        const double middle = kStep * (i + 0.5), length = kStep * (i + 1);
        const auto r = static_cast<double>(icicle_radius_m(static_cast<float>(middle)));
        volume += 3.14159265 * r * r * kStep;
        area += 2.0 * 3.14159265 * r * kStep;
        if (i % 1000 != 999) continue;
        EXPECT_NEAR(icicle_volume_m3(length), volume, 1e-4 * volume);
        EXPECT_NEAR(icicle_area_m2(length), area + 2.0 * 3.14159265 * tip * tip, 1e-4 * area);
        EXPECT_NEAR(icicle_length_m(icicle_volume_m3(length)), length, 1e-9);
    }
    EXPECT_EQ(icicle_length_m(0.0), 0.0);
    EXPECT_EQ(icicle_length_m(-1.0), 0.0);
    EXPECT_NEAR(icicle_radius_m(0.0f), kIcicleTip_m, 1e-7f);
}

TEST(Icicle, LengthsOfAreasBetweenClassesHoldNoMoreIce)
{
    // As long as their water lets them be: ice in the measure of what is drained.
    IcicleLengths lengths;
    for (std::size_t c = 0; c < kIcicleClasses; ++c) lengths.length_m[c] = static_cast<float>(icicle_length_m(icicle_class_m2(c) * 1e-3));
    float before = 0.0f;
    for (double area = 1e-5; area < 5.0; area *= 1.07) {
        const float length = icicle_length_m(lengths, static_cast<float>(area));
        EXPECT_GE(length, before);
        before = length;
        // The longest that is drawn has 0.92 of it.
        const double held = icicle_volume_m3(0.92 * static_cast<double>(length));
        EXPECT_LE(held, area * 1e-3 * 1.0001) << area;
        if (area < 4.0) {
            EXPECT_NEAR(icicle_volume_m3(static_cast<double>(length)), area * 1e-3, 0.03 * area * 1e-3) << area;
        }
    }
    EXPECT_EQ(icicle_length_m(lengths, 0.0f), 0.0f);
    EXPECT_EQ(icicle_length_m(lengths, std::nanf("")), 0.0f);
}

TEST(Icicles, AreClosedAndHoldTheirIce)
{
    const auto points = edge();
    for (const float far_m : {1.0f, 5.0f, 10.0f, 40.0f}) {
        const std::vector<vec3> eyes{{1.0f, 3.0f, far_m}};
        const Icicles all = hang_icicles(points, eyes);
        ASSERT_EQ(all.icicles.size(), points.size());
        for (const float length_m : {0.02f, 0.1f, 0.4f, 0.9f}) {
            const Mesh3 m = mesh_of(all.icicles[7], length_m);
            const double ice = icicle_volume_m3(static_cast<double>(length_m));
            // Few bands cut a curve short or long; the dome on the edge comes on top.
            EXPECT_NEAR(volume_m3(m), ice, 0.11 * ice) << far_m << " m, " << length_m;
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
            for (std::size_t i = 0; i < m.indices.size(); i += 3) {
                for (std::size_t k = 0; k < 3; ++k) ++sides[{m.indices[i + k], m.indices[i + (k + 1) % 3]}];
                const vec3 a = m.positions[m.indices[i]], b = m.positions[m.indices[i + 1]], c = m.positions[m.indices[i + 2]];
                const vec3 face = glm::cross(b - a, c - a);
                for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(glm::dot(face, m.normals[m.indices[i + k]]), -0.2f * glm::length(face));
            }
            for (const auto& [side, count] : sides) {
                EXPECT_EQ(count, 1);
                EXPECT_EQ(sides.count({side.second, side.first}), 1u) << "a hole";
            }
        }
    }
}

TEST(Icicles, HangDownFromTheEdgeAndTouchNothingBelow)
{
    const auto points = edge(0.5f);
    const Icicles all = hang_icicles(points, {});
    for (const Icicle& one : all.icicles) {
        const float length_m = icicle_length_m(one, all_of(2.6f));
        EXPECT_GT(length_m, 0.2f);
        EXPECT_LE(length_m, 0.41f);
        const Mesh3 m = mesh_of(one, length_m);
        for (const vec3& p : m.positions) {
            EXPECT_GT(p.y, 0.05f);
            EXPECT_LT(p.y, 0.53f);
        }
    }
    for (const Icicles::Part& part : all.parts) {
        for (std::uint32_t i = part.first; i < part.end; ++i) {
            for (const vec3& p : mesh_of(all.icicles[i], icicle_length_m(all.icicles[i], all_of(2.6f))).positions) {
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, part.box.low)) && glm::all(glm::lessThanEqual(p, part.box.high)));
            }
        }
    }
}

TEST(Icicles, DifferInLengthAndAreNoneWithoutIce)
{
    const auto points = edge();
    const Icicles all = hang_icicles(points, {});
    float least = 1.0f, most = 0.0f;
    for (const Icicle& one : all.icicles) {
        EXPECT_EQ(icicle_length_m(one, {}), 0.0f);
        EXPECT_EQ(icicle_length_m(one, all_of(0.004f)), 0.0f) << "glaze";
        const float length_m = icicle_length_m(one, all_of(0.3f));
        least = std::min(least, length_m);
        most = std::max(most, length_m);
    }
    EXPECT_LT(least, 0.15f);
    EXPECT_GT(most, 0.25f);
    EXPECT_LT(most, 0.3f);
}

// No comb: their lengths are spread as widely as those of a drawing of lots, and longer parts of an eave are fed better than others,
// far more than chance would have it.
TEST(Icicles, HangInTuftsAsTheEaveIsFed)
{
    const Icicles all = hang_icicles(edge(3.0f, 2000), {});
    std::vector<const Icicle*> row;
    for (const Icicle& one : all.icicles) row.push_back(&one);
    std::sort(row.begin(), row.end(), [](const Icicle* a, const Icicle* b) { return a->root_m.x < b->root_m.x; });
    ASSERT_EQ(row.size(), 2000u);
    double sum = 0.0, square = 0.0, parts = 0.0;
    constexpr std::size_t kPart = 10;  // 0.4 m
    for (std::size_t i = 0; i < row.size(); i += kPart) {
        double part = 0.0;
        for (std::size_t k = i; k < i + kPart; ++k) {
            const auto share = static_cast<double>(row[k]->share);
            EXPECT_GE(share, 0.0799);
            EXPECT_LE(share, 0.9201);
            part += share / kPart;
            sum += share;
            square += share * share;
        }
        parts += part * part;
    }
    const double n = static_cast<double>(row.size()), mean = sum / n, variance = square / n - mean * mean;
    EXPECT_GT(mean, 0.4);
    EXPECT_LT(mean, 0.6);
    EXPECT_GT(std::sqrt(variance) / mean, 0.5);
    // Of numbers by chance the means of ten have a tenth of the variance.
    EXPECT_GT(parts * kPart / n - mean * mean, 0.2 * variance);
}

TEST(Icicles, AreFewerCornersFarAwayAndNoneBeyondSight)
{
    const auto points = edge();
    const auto triangles = [&](float far_m) {
        const std::vector<vec3> eyes{{1.0f, 3.0f, far_m}};
        return hang_icicles(points, eyes).triangles;
    };
    EXPECT_GT(triangles(1.0f), triangles(6.0f));
    EXPECT_GT(triangles(6.0f), triangles(12.0f));
    EXPECT_GT(triangles(12.0f), triangles(40.0f));
    EXPECT_EQ(triangles(90.0f), 0u);
    // A city's eaves around an eye are cut as if they were farther away.
    const std::vector<vec3> eye{{1.0f, 3.0f, 1.0f}};
    EXPECT_LE(hang_icicles(edge(3.0f, 2000), std::vector<vec3>(1, vec3(40.0f, 3.0f, 0.0f))).triangles, 300'000u);
}

TEST(Icicles, TheirMaterialIsTheLastOfTheScene)
{
    Scene scene;
    scene.materials.resize(2);
    Icicles found;
    EXPECT_FALSE(find_icicle_material(scene, found));
    add_icicle_material(scene);
    ASSERT_TRUE(find_icicle_material(scene, found));
    EXPECT_EQ(found.material, 2u);
    EXPECT_EQ(found.instance, 0u);
    EXPECT_NEAR(scene.materials[2].ior, 1.31f, 1e-6f);
}

}  // namespace
}  // namespace petrichor::scene
