// Points of occlusion: which pixels take theirs, by planes seen through a pinhole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "formulas/light/occlusion_points.h"

namespace petrichor::shared {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPixel = 0.001f;  // radians
constexpr float kNear_m = 0.1f;

// Depth where the ray through a pixel meets the plane of that normal and place.
float depth_of(vec3 normal, vec3 place, vec2 pixel)
{
    const vec3 ray(pixel * kPixel, 1.0f);
    return kNear_m * glm::dot(normal, ray) / glm::dot(normal, place);
}

struct Sight {
    vec3 normal;
    vec3 place;
    OcclusionPoint point;
};

// Planes at 1 to 50 m, leaning up to 86 degrees off the eye; as their points are read back.
Sight sight(std::mt19937& random)
{
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    Sight s;
    const float lean = 1.5f * number(random);
    const float turn = 3.14159265f * number(random);
    s.normal = vec3(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), -std::cos(lean));
    s.place = vec3(0.0f, 0.0f, std::exp(2.0f + 1.9f * number(random)));
    const float depth = depth_of(s.normal, s.place, vec2(0.0f));
    const vec2 change(depth_of(s.normal, s.place, vec2(1.0f, 0.0f)) - depth,
                      depth_of(s.normal, s.place, vec2(0.0f, 1.0f)) - depth);
    s.point = occlusion_point_of(occlusion_point_code({depth, 0.5f, change / (depth * kPixel), 5u}));
    return s;
}

TEST(OcclusionPoints, PixelsOfAPlaneFitIt)
{
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Sight s = sight(random);
        EXPECT_EQ(s.point.alone, 5u);
        EXPECT_NEAR(s.point.open, 0.5f, 0.51f / 255.0f);
        for (const vec2 across : {vec2(1, 1), vec2(-2, 3), vec2(3, -3)}) {
            const float depth = depth_of(s.normal, s.place, across);
            const float off = occlusion_off_plane(s.point, across, depth, s.point.depth * kPixel);
            // What is left are the bits of depth and slope.
            EXPECT_GT(occlusion_fit(off), 0.95f) << across.x << ' ' << across.y << ' ' << s.normal.z;
        }
    }
}

TEST(OcclusionPoints, TheDistanceOffAPlaneIsThatInSpace)
{
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i) {
        const Sight s = sight(random);
        const float step = s.point.depth * kPixel;
        const float width_m = kNear_m / s.point.depth * kPixel;
        for (const float off : {-8.0f, -2.0f, 0.5f, 3.0f}) {
            // Another plane beside it, that many widths of a pixel away.
            const vec3 beside = s.place + s.normal * (off * width_m);
            const float depth = depth_of(s.normal, beside, vec2(0.0f));
            EXPECT_NEAR(occlusion_off_plane(s.point, vec2(0.0f), depth, step), std::abs(off),
                        0.02f + 0.15f * std::abs(off));
        }
    }
}

TEST(OcclusionPoints, WhatLiesAPixelOffTakesNothing)
{
    EXPECT_EQ(occlusion_fit(1.0f), 0.0f);
    EXPECT_EQ(occlusion_fit(std::numeric_limits<float>::quiet_NaN()), 0.0f);
    EXPECT_EQ(occlusion_fit(0.0f), 1.0f);
    const OcclusionPoint none = occlusion_point_of(uvec2(kNoOcclusionPoint, kNoOcclusionPoint));
    EXPECT_EQ(none.alone, 15u);
    for (const float depth : {1.0e-6f, 0.01f, 1.0f}) {
        EXPECT_EQ(occlusion_fit(occlusion_off_plane(none, vec2(1.0f), depth, depth * kPixel)), 0.0f);
    }
}

TEST(OcclusionPoints, FlatSurfacesHaveNoSlope)
{
    EXPECT_EQ(occlusion_slope_of(occlusion_slope_code(0.0f)), 0.0f);
    for (float slope = -300.0f; slope < 300.0f; slope += 0.37f) {
        const float kept = occlusion_slope_of(occlusion_slope_code(slope));
        // A step of the code is a step across the line of sight, too.
        EXPECT_NEAR(kept, slope, 1.0e-4f * (1.0f + std::abs(slope)) * (1.0f + std::abs(slope)));
    }
}

TEST(OcclusionPoints, ABlockAmongEqualOnesHasTheirs)
{
    const vec2 other(0.25f, 1.0f);
    EXPECT_FLOAT_EQ(occlusion_from(0.25f, other, other, other), 0.25f);
    // Points that do not count change nothing.
    EXPECT_FLOAT_EQ(occlusion_from(0.25f, vec2(1.0f, 0.0f), vec2(0.0f, 0.0f), vec2(1.0f, 0.0f)), 0.25f);
    // A ramp over columns of blocks goes on evenly over pixels: a quarter of the way to the block beside.
    EXPECT_FLOAT_EQ(occlusion_from(0.4f, vec2(0.8f, 1.0f), vec2(0.4f, 1.0f), vec2(0.8f, 1.0f)), 0.5f);
}

TEST(OcclusionPoints, FourPixelsShareAWord)
{
    uint word = 0u;
    for (uint pixel = 0u; pixel < 4u; ++pixel) word |= occlusion_in_word(0.2f * static_cast<float>(pixel), pixel);
    for (uint pixel = 0u; pixel < 4u; ++pixel)
        EXPECT_NEAR(occlusion_of_word(word, pixel), 0.2f * static_cast<float>(pixel), 0.51f / 255.0f);
}

}  // namespace
}  // namespace petrichor::shared
