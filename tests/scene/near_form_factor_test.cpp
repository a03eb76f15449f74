// The share of what a point sees that a polygon close by fills: closed forms, rays, four points at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "formulas/light/near_light.h"
#include "scene/patches/detail/near_four.h"
#include "scene/patches/detail/near_sources.h"
#include "scene/patches/detail/sampling.h"

namespace petrichor::scene {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// A corner of a square of 2b x 2b at distance 1 over the foot of its middle: four times a quarter's.
float square_over_point(float b)
{
    const float r = std::sqrt(1.0f + b * b);
    return 4.0f / (2.0f * kPi) * 2.0f * (b / r) * std::atan(b / r);
}

TEST(NearFormFactor, OfASquareAboveIsTheClosedForm)
{
    for (const float b : {0.05f, 0.5f, 2.0f, 40.0f}) {
        // Seen from below: it faces down.
        const float found = shared::near_form_factor({-b, 1, -b}, {b, 1, -b}, {b, 1, b}, {-b, 1, b},
                                                     {0, 1, 0});
        EXPECT_NEAR(found, square_over_point(b), 3e-4f) << b;
        EXPECT_EQ(shared::near_form_factor({-b, 1, b}, {b, 1, b}, {b, 1, -b}, {-b, 1, -b}, {0, 1, 0}),
                  0.0f)
            << "from behind";
    }
    // Of a wall that stands on the point's own plane, c away, a high and 2 b wide.
    const float a = 1.0f, b = 0.5f;
    for (const float c : {0.005f, 0.02f, 0.3f}) {
        const float r = std::sqrt(a * a + c * c);
        const float right = (std::atan(b / c) - c / r * std::atan(b / r)) / kPi;
        EXPECT_NEAR(
            shared::near_form_factor({c, 0, -b}, {c, 0, b}, {c, a, b}, {c, a, -b}, {0, 1, 0}),
            right, 5e-4f)
            << c;
    }
    // A corner at the point itself is a number.
    EXPECT_TRUE(std::isfinite(
        shared::near_form_factor({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 0, 1})));
}

// The other side of a leaf looks at every point of the leaf from no distance at all: half of the points of a leaf anywhere lie
// in front of it by rounding, and were as dark as it.
TEST(NearFormFactor, OfTheBackOfItsOwnSheetAPointSeesNothing)
{
    int before_by_rounding = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, 50 + k)); };
        const glm::vec3 n = cosine_direction({0, 1, 0}, number(0), number(1));
        const Tangents frame = tangents_of(n);
        const glm::vec3 at(20.0f * number(2) - 10.0f, 3.0f * number(3), 20.0f * number(4) - 10.0f);
        const glm::vec3 u = frame.t * (0.02f + 0.2f * number(5)), v = frame.b * (0.02f + 0.2f * number(6));
        // In turn as seen from below.
        const std::array<glm::vec3, 4> corners{at, at + v, at + v + u, at + u};
        const glm::vec3 x = at + u * number(7) + v * number(8);
        std::array<glm::vec3, 4> c;
        for (std::size_t k = 0; k < 4; ++k) c[k] = corners[k] - x;
        EXPECT_EQ(shared::near_form_factor(c[0], c[1], c[2], c[3], n), 0.0f) << i;
        before_by_rounding += glm::dot(glm::cross(c[2] - c[0], c[3] - c[1]), c[0]) < 0.0f ? 1 : 0;
        // Another leaf over it, at a fiftieth of its size, fills nearly all that its middle sees, and from its other side nothing.
        const float high = 0.02f * std::sqrt(glm::dot(u + v, u + v));
        for (std::size_t k = 0; k < 4; ++k) c[k] = corners[k] - (at + 0.5f * (u + v)) + n * high;
        EXPECT_GT(shared::near_form_factor(c[0], c[1], c[2], c[3], n), 0.7f) << i;
        EXPECT_EQ(shared::near_form_factor(c[3], c[2], c[1], c[0], n), 0.0f) << i;
    }
    EXPECT_GT(before_by_rounding, 100);
}

// What a point of this normal sees of a convex polygon's front, by rays over its hemisphere.
double seen_by_rays(const std::array<glm::vec3, 4>& c, glm::vec3 n, int rays)
{
    const auto part = [](glm::vec3 a, glm::vec3 b, glm::vec3 d, glm::vec3 way) {
        // Within all three planes through the point and an edge; the front is where they turn right.
        return glm::dot(glm::cross(b, a), way) >= 0.0f && glm::dot(glm::cross(d, b), way) >= 0.0f &&
               glm::dot(glm::cross(a, d), way) >= 0.0f;
    };
    int met = 0;
    for (int r = 0; r < rays; ++r) {
        const glm::vec3 way = row_direction(n, r, rays, 11);
        met += part(c[0], c[1], c[2], way) || part(c[0], c[2], c[3], way) ? 1 : 0;
    }
    return static_cast<double>(met) / static_cast<double>(rays);
}

// Anywhere: over the horizon, across it, below, from the front and from behind.
TEST(NearFormFactor, IsWhatRaysSeeWhereverThePolygonStands)
{
    int across = 0, behind = 0, below = 0, large = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, k)); };
        const glm::vec3 n = cosine_direction({0, 1, 0}, number(0), number(1));
        const glm::vec3 u = cosine_direction({1, 0, 0}, number(2), number(3)) * (0.1f + 3.0f * number(4));
        const glm::vec3 v = cosine_direction({0, 0, 1}, number(5), number(6)) * (0.1f + 3.0f * number(7));
        const glm::vec3 corner = glm::vec3(number(8), number(9), number(10)) - 0.5f;
        std::array<glm::vec3, 4> c{corner, corner + u, corner + u + v, corner + v};
        if (i % 2 == 0) std::swap(c[1], c[3]);
        if (i % 5 == 0) c[3] = c[2];  // a triangle
        int up = 0;
        for (const glm::vec3& x : c) up += glm::dot(x, n) > 0.0f ? 1 : 0;
        const bool front = glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), c[0]) < 0.0f;
        const float found = shared::near_form_factor(c[0], c[1], c[2], c[3], n);
        if (!front || up == 0) {
            EXPECT_EQ(found, 0.0f) << i;
        } else {
            EXPECT_NEAR(static_cast<double>(found), seen_by_rays(c, n, 8192), 4e-3) << i << ", corners up: " << up;
        }
        across += front && up > 0 && up < 4 ? 1 : 0;
        behind += front ? 0 : 1;
        below += front && up == 0 ? 1 : 0;
        large += found > 0.3f ? 1 : 0;
    }
    EXPECT_GT(across, 40);
    EXPECT_GT(behind, 50);
    EXPECT_GT(below, 10);
    EXPECT_GT(large, 10);
}

// A wall that goes on below a point's plane is the wall above it.
TEST(NearFormFactor, OfAWallCutByTheHorizonIsThatOfTheUpperPart)
{
    const float a = 1.0f, b = 0.5f;
    for (const float c : {1e-4f, 0.001f, 0.02f, 0.3f}) {
        const float r = std::sqrt(a * a + c * c);
        const float right = (std::atan(b / c) - c / r * std::atan(b / r)) / kPi;
        for (const float deep : {0.0f, 0.01f, 1.0f, 30.0f}) {
            EXPECT_NEAR(shared::near_form_factor({c, -deep, -b}, {c, -deep, b}, {c, a, b}, {c, a, -b}, {0, 1, 0}),
                        right, 5e-4f)
                << c << " " << deep;
        }
        EXPECT_EQ(shared::near_form_factor({c, -1.0f, -b}, {c, -1.0f, b}, {c, 0, b}, {c, 0, -b}, {0, 1, 0}),
                  0.0f)
            << "below";
    }
    // A strip of 1 cm along the foot of a pane, a tenth of a millimetre to 1 cm from the point: half of 1 - h / sqrt(h^2 + w^2).
    const float w = 0.01f;
    for (const float h : {1e-4f, 1e-3f, 5e-3f, 0.01f}) {
        EXPECT_NEAR(shared::near_form_factor({h, 0, -9}, {h, 0, 9}, {h, w, 9}, {h, w, -9}, {0, 1, 0}),
                    0.5f * (1.0f - h / std::sqrt(h * h + w * w)), 1e-3f)
            << h;
    }
}

// In one number: a line from the polygon's plane to a reach before it, no more than all and no less than nothing.
TEST(NearFormFactor, WhatIsSeenIsALineOverTheHeight)
{
    for (const float at_plane : {-1.0f, -0.3f, 0.0f, 0.5f, 1.0f, 1.6f, 2.0f}) {
        for (const float at_reach : {-2.0f, -0.7f, 0.0f, 0.4f, 1.0f, 2.9f}) {
            const float packed = shared::near_seen_packed(at_plane, at_reach);
            for (const float height : {0.0f, 0.1f, 0.5f, 0.9f, 1.0f})
                EXPECT_NEAR(shared::near_seen(packed, height), std::clamp(at_plane + (at_reach - at_plane) * height, 0.0f, 1.0f), 2.5e-3f);
            EXPECT_EQ(shared::near_seen(packed, -0.5f), shared::near_seen(packed, 0.0f));
            EXPECT_EQ(shared::near_seen(packed, 7.0f), shared::near_seen(packed, 1.0f));
        }
    }
    EXPECT_GT(shared::near_seen(shared::near_seen_packed(9.0f, 9.0f), 1.0f), 0.99f) << "held to what fits";
    // What faces up a metre below the point, two the other way round.
    EXPECT_NEAR(shared::near_height({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}), 1.0f, 1e-6f);
    EXPECT_NEAR(shared::near_height({-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}), -1.0f, 1e-6f);
}

// Four at a time get the bits of one at a time, above the horizon, across it, below, beside an edge and behind.
TEST(NearFormFactor, FourPointsGetWhatEachOfThemGets)
{
    int across = 0, seen = 0, beside = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const auto number = [&](std::uint64_t k) { return unit_float(mixed(i, 90 + k)); };
        const glm::vec3 u = cosine_direction({1, 0, 0}, number(0), number(1)) * (0.01f + 3.0f * number(2));
        const glm::vec3 v = cosine_direction({0, 0, 1}, number(3), number(4)) * (0.01f + 3.0f * number(5));
        const glm::vec3 at(4.0f * number(6) - 2.0f, 4.0f * number(7) - 2.0f, 4.0f * number(8) - 2.0f);
        const std::array<glm::vec3, 4> corners{at, at + u, i % 3 == 0 ? at + v : at + u + v, at + v};
        const NearPolygon polygon = polygon_of(corners);
        const glm::vec3 front = front_of(corners);
        std::vector<SamplePoint> points;
        for (std::uint64_t k = 0; k < 7; ++k) {
            const float far = k == 0 ? 0.0f : 3.0f * number(10 + 5 * k);
            points.push_back({at + u * number(11 + 5 * k) + (front - v) * far,
                              cosine_direction({0, 1, 0}, number(12 + 5 * k), number(13 + 5 * k))});
        }
        const FourPoints four(points);
        ASSERT_EQ(four.position_m.size(), 2u);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const SamplePoint& p = points[k];
            const auto lane = static_cast<int>(k % 4);
            std::array<glm::vec3, 4> c;
            int up = 0;
            for (std::size_t j = 0; j < 4; ++j) {
                c[j] = corners[j] - p.position_m;
                up += glm::dot(c[j], p.normal) >= 0.0f ? 1 : 0;
            }
            const float one = shared::near_form_factor(c[0], c[1], c[2], c[3], p.normal);
            EXPECT_EQ(near_form_factors(corners, four.position_m[k / 4], four.normal[k / 4])[lane], one) << i << " " << k;
            const glm::vec3 nearest = nearest_in(polygon, front, p.position_m);
            const Four3 found = nearest_in(polygon, front, four.position_m[k / 4]);
            EXPECT_EQ(glm::vec3(found.x[lane], found.y[lane], found.z[lane]), nearest) << i << " " << k;
            across += one > 0.0f && up > 0 && up < 4 ? 1 : 0;
            seen += one > 0.0f && up == 4 ? 1 : 0;
            beside += std::abs(glm::dot(nearest - p.position_m, front)) < distance_m(polygon, front, p.position_m) ? 1 : 0;
        }
    }
    EXPECT_GT(across, 200);
    EXPECT_GT(seen, 100);
    EXPECT_GT(beside, 200);
}

}  // namespace
}  // namespace petrichor::scene
