// Planes in depth maps: what a map would hold of them, by the matrices that maps are drawn with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formulas/light/shadow_plane.h"

namespace petrichor::shared {
namespace {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

struct Numbers {
    std::mt19937 random{11};
    float operator()() { return static_cast<float>(random() >> 8) / 8388608.0f - 1.0f; }
    vec3 unit()
    {
        for (;;) {
            const vec3 d((*this)(), (*this)(), (*this)());
            if (const float size = glm::length(d); size > 0.1f && size < 1.0f) return d / size;
        }
    }
};

TEST(ShadowPlane, IsTheDepthThatAParallelMapHoldsOfIt)
{
    Numbers number;
    for (int k = 0; k < 300; ++k) {
        const vec3 to_light = number.unit();
        const vec3 right = glm::normalize(glm::cross(to_light, number.unit()));
        const vec3 up = glm::cross(to_light, right);
        // Rows of a map: 0..1 over 8 m and over 5 m, depth over 90 m.
        const vec3 u = right / 8.0f, v = -up / 5.0f, depth = to_light / 90.0f;
        const vec3 n = number.unit();
        const float facing = std::abs(glm::dot(n, to_light));
        if (facing < 0.2f) continue;
        const vec2 slope = shadow_plane_slope(n, u, v, depth);
        // A step within the plane.
        const vec3 step = glm::cross(n, number.unit());
        EXPECT_NEAR(glm::dot(step, depth), slope.x * glm::dot(step, u) + slope.y * glm::dot(step, v), 2e-6f);
    }
}

TEST(ShadowPlane, IsTheDepthThatALampsMapHoldsOfIt)
{
    Numbers number;
    for (int k = 0; k < 300; ++k) {
        const vec3 n = number.unit();
        const vec3 d(number() * 0.9f, number() * 0.9f, 1.0f);  // on the face along z, which is 1 / along
        const float off = glm::dot(n, d);
        if (std::abs(off) < 0.3f * glm::length(d)) continue;
        const vec2 slope = lamp_plane_slope(n, d, vec2(n.x, n.y));
        // Where another way on the face meets the plane.
        const vec3 way = d + 0.1f * vec3(number(), number(), 0.0f);
        const float along = off / glm::dot(n, way);
        EXPECT_NEAR(1.0f / along, 1.0f + glm::dot(slope, vec2(way - d)), 1e-5f);
    }
}

TEST(ShadowPlane, IsBoundedWhereTheLightGrazes)
{
    const vec3 u(0.1f, 0, 0), v(0, 0, 0.1f), depth(0, 0.01f, 0);
    for (const float lean : {0.0f, 1e-8f, 1e-3f, -1e-3f}) {
        const vec2 slope = shadow_plane_slope(glm::normalize(vec3(1.0f, lean, 0.5f)), u, v, depth);
        EXPECT_LE(glm::length(slope), kShadowPlaneTangent * 0.1f * 1.0001f);
        const vec2 lamp = lamp_plane_slope(vec3(1, 0, 0), vec3(lean, 0, 2.0f), vec2(1, 0));
        EXPECT_LE(glm::length(lamp), 0.5f * 12.1f);
    }
    EXPECT_EQ(shadow_plane_slope(vec3(0, 1, 0), u, v, depth), vec2(0.0f)) << "seen from straight above";
}

TEST(ShadowPlane, LiftsGrowTowardsGrazingLightAndEnd)
{
    constexpr float kRadius = 2.5f, kLeast = 1.15f;
    float last = kLeast;
    for (float facing = 1.0f; facing > 1.0e-4f; facing *= 0.93f) {
        const float lift = shadow_lift_texels(facing, kLeast, kRadius);
        EXPECT_GE(lift, last);
        EXPECT_EQ(lift, shadow_lift_texels(-facing, kLeast, kRadius));
        // What the plane that is followed leaves of its slope over the filter, down to half a degree.
        const float tangent = std::sqrt(1.0f - facing * facing) / facing;
        if (tangent < 113.0f) {
            EXPECT_NEAR(lift, kLeast + kRadius * std::max(tangent - kShadowPlaneTangent, 0.0f), 1e-3f * lift);
        }
        last = lift;
    }
    EXPECT_EQ(shadow_lift_texels(0.0f, kLeast, kRadius), kLeast + kRadius * (kShadowMostTangent - kShadowPlaneTangent));
}

TEST(ShadowPlane, WeightsAreThoseOfABilinearFilter)
{
    for (const vec2 part : {vec2(0.0f), vec2(0.25f, 0.75f), vec2(1.0f)}) {
        const vec4 w = four_texel_weights(part);
        EXPECT_FLOAT_EQ(w.x + w.y + w.z + w.w, 1.0f);
        EXPECT_FLOAT_EQ(w.y + w.w, part.x);
        EXPECT_FLOAT_EQ(w.z + w.w, part.y);
        EXPECT_FLOAT_EQ(four_texels_lit(vec4(0.5f), vec4(0.5f, 0.4f, 0.6f, 0.4f), w), w.x + w.z);
    }
}

}  // namespace
}  // namespace petrichor::shared
