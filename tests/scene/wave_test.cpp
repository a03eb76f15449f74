#include "scene/animation/wave.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace petrichor::scene {
namespace {

// A blade of 1 m, in ten steps.
Primitive blade(const glm::vec3& root)
{
    Primitive p;
    for (int i = 0; i <= 10; ++i) {
        const float v = static_cast<float>(i) / 10.0f;
        p.positions.push_back(root + glm::vec3(0, v, 0));
        p.normals.emplace_back(0, 0, 1);
        p.tangents.emplace_back(1, 0, 0, 1);
        p.uv0.emplace_back(0.5f, 1.0f - v);
        p.weather.emplace_back(1, 1, 1, v);
    }
    return p;
}

Bounds box_of(const Primitive& p)
{
    Bounds box{p.positions[0], p.positions[0]};
    for (const glm::vec3& v : p.positions) {
        box.low = glm::min(box.low, v);
        box.high = glm::max(box.high, v);
    }
    return box;
}

WindLook bending(float bend = 0.8f)
{
    WindLook look;
    look.bend = bend;
    return look;
}

Shape blown(const Primitive& p, const WindLook& look, const Wind& wind,
            const glm::mat4& to_world = glm::mat4(1.0f))
{
    return waved(p, box_of(p), to_world, look, wind);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Wave, CalmAirLeavesEveryBit)
{
    const Primitive p = blade({3.1f, 0.2f, -7.7f});
    WindLook look = bending();
    look.flutter_m = 0.1f;
    const Shape shape = blown(p, look, {{0, 0}, {12.5, 3.0}, 4.2});
    EXPECT_TRUE(same_bits(shape.positions, p.positions));
    EXPECT_TRUE(same_bits(shape.normals, p.normals));
    EXPECT_TRUE(same_bits(shape.tangents, p.tangents));
}

TEST(Wave, RootsStayAndBladesKeepTheirLength)
{
    for (const float x : {0.0f, 5.0f, 11.0f}) {
        const glm::vec3 root(x, 0.3f, 2.0f);
        const Primitive p = blade(root);
        const Shape shape = blown(p, bending(), {{8, 3}, {40.0, 2.0}, 1.3});
        EXPECT_EQ(shape.positions[0], p.positions[0]);
        for (std::size_t i = 1; i < p.positions.size(); ++i) {
            EXPECT_NEAR(glm::length(shape.positions[i] - root), static_cast<float>(i) / 10.0f, 1e-5f);
            EXPECT_NEAR(glm::length(shape.normals[i]), 1.0f, 1e-5f);
            EXPECT_NEAR(glm::dot(shape.normals[i], glm::vec3(shape.tangents[i])), 0.0f, 1e-5f);
        }
        EXPECT_LE(glm::length(shape.positions[10] - p.positions[10]),
                  wave_reach_m(box_of(p), glm::mat4(1.0f), bending()));
    }
}

// Over many places and moments: with the wind, and the more the faster it is.
TEST(Wave, LeansWithTheWindAndMoreInAGale)
{
    const auto mean = [](const glm::vec2& velocity) {
        glm::vec3 sum(0.0f);
        for (int i = 0; i < 200; ++i) {
            const Primitive p = blade({static_cast<float>(i % 20) * 7.0f, 0, static_cast<float>(i / 20) * 9.0f});
            const Shape shape = blown(p, bending(0.6f), {velocity, {3.0 * i, 0.0}, 0.37 * i});
            sum += (shape.positions[10] - p.positions[10]) / 200.0f;
        }
        return sum;
    };
    const glm::vec3 breeze = mean({2, 0});
    const glm::vec3 gale = mean({20, 0});
    const glm::vec3 north = mean({0, -8});
    EXPECT_GT(breeze.x, 0.05f);
    EXPECT_GT(gale.x, 2.0f * breeze.x);
    EXPECT_LT(gale.y, breeze.y);
    EXPECT_NEAR(breeze.z, 0.0f, 1e-4f);
    EXPECT_LT(north.z, -0.15f);
    EXPECT_NEAR(north.x, 0.0f, 1e-4f);
}

// Half a wave of gust later another blade is bent: the pattern travels with the air.
TEST(Wave, GustsTravelWithTheAir)
{
    WindLook look = bending();
    look.sway_hz = 0.0f;
    const auto tip = [&](float x, double air_m) {
        const Primitive p = blade({x, 0, 0});
        return blown(p, look, {{6, 0}, {air_m, 0.0}, 0.0}).positions[10].x - x;
    };
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < 40; ++i) {
        const float x = 1.7f * static_cast<float>(i);
        least = std::min(least, tip(x, 0.0));
        most = std::max(most, tip(x, 0.0));
    }
    EXPECT_GT(most, 1.3f * least);
    // Swaying stands still here but for its place: compare where it is the same.
    WindLook still = look;
    still.bend = 0.8f;
    const Primitive p = blade({4.0f, 0, 0});
    const float now = blown(p, still, {{6, 0}, {0.0, 0.0}, 0.0}).positions[10].x;
    const float later = blown(p, still, {{6, 0}, {7.0, 0.0}, 0.0}).positions[10].x;
    EXPECT_NE(now, later);
}

// A seam between two meshes, or between two instances, does not open.
TEST(Wave, NeighboursInTheWorldMoveAlike)
{
    WindLook look = bending();
    look.weight = WindWeight::Uv;
    look.height_m = 1.0f;
    look.flutter_m = 0.05f;
    const Wind wind{{7, 4}, {100.0, -30.0}, 5.5};
    const Primitive there = blade({6, 1, -2});
    const Primitive here = blade({0, 0, 0});
    glm::mat4 to_there(1.0f);
    to_there[3] = glm::vec4(6, 1, -2, 1);
    const Shape a = blown(there, look, wind);
    const Shape b = blown(here, look, wind, to_there);
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        EXPECT_LT(glm::length(a.positions[i] - b.positions[i] - glm::vec3(6, 1, -2)), 1e-5f);
    // Close together, close together still.
    const Shape c = blown(blade({6.001f, 1, -2}), look, wind);
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        EXPECT_LT(glm::length(a.positions[i] - c.positions[i]), 0.004f);
}

TEST(Wave, WeightsComeFromHeightTexturesOrAMask)
{
    const Wind wind{{9, 0}, {0, 0}, 0.4};
    Primitive p = blade({0, 0, 0});
    WindLook look = bending();
    look.height_m = 1.0f;
    const Shape height = blown(p, look, wind);
    look.weight = WindWeight::Uv;
    const Shape uv = blown(p, look, wind);
    look.weight = WindWeight::Mask;
    const Shape mask = blown(p, look, wind);
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        EXPECT_LT(glm::length(height.positions[i] - uv.positions[i]), 1e-5f);
        EXPECT_LT(glm::length(height.positions[i] - mask.positions[i]), 1e-5f);
    }
    p.weather.assign(p.positions.size(), glm::vec4(1, 1, 1, 0));
    EXPECT_TRUE(same_bits(blown(p, look, wind).positions, p.positions));
}

TEST(Wave, IsAFunctionOfItsArguments)
{
    const Primitive p = blade({2, 0, 5});
    const Wind wind{{5, 5}, {1e7, -1e7}, 1e6};
    const Shape first = blown(p, bending(), wind);
    blown(p, bending(), {{50, 0}, {0, 0}, 0.0});
    EXPECT_TRUE(same_bits(first.positions, blown(p, bending(), wind).positions));
    for (const glm::vec3& v : first.positions) EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
    // A mesh squeezed flat has no shape to bend back.
    const Shape flat = blown(p, bending(), wind, glm::mat4(0.0f));
    EXPECT_TRUE(same_bits(flat.positions, p.positions));
}

}  // namespace
}  // namespace petrichor::scene
