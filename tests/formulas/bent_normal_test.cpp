// Bent normals and what a mirror has left, beside sums over all directions: in a corner, under an awning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "formulas/light/bent_normal.h"
#include "formulas/light/brdf.h"

namespace petrichor::shared {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kTurn = 6.2831853f;
using Open = std::function<bool(const vec3&)>;

const vec3 kUp(0, 1, 0);

// A wall of that height, a unit away along x.
Open beside_wall(float height)
{
    return [height](const vec3& d) { return !(d.x > 0.0f && d.y / std::max(d.x, 1e-6f) < height); };
}

// A slab overhead: ahead of its edge is open sky, and what is level looks out below it.
Open under_awning(float edge)
{
    return [edge](const vec3& d) { return d.y <= 0.0f || d.x / d.y > edge; };
}

struct Left {
    float share = 0.0f;
    vec3 bent = vec3(0.0f);
};

Left summed(const Open& open)
{
    const int rows = 400, columns = 800;
    Left left;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = std::sqrt((static_cast<float>(i) + 0.5f) / rows), turn = kTurn * (static_cast<float>(j) + 0.5f) / columns;
            const float level = std::sqrt(1.0f - up * up);
            const vec3 d(level * std::cos(turn), up, level * std::sin(turn));
            if (!open(d)) continue;
            left.share += 1.0f / (rows * columns);
            left.bent += d;
        }
    }
    left.bent = glm::normalize(left.bent);
    return left;
}

// As the pass does it, over many turns of its two slices: the horizon of a side is the lowest direction from which on all
// towards the eye are open.
vec3 by_slices(const Open& open, const vec3& eye)
{
    const vec3 right = glm::normalize(glm::cross(std::abs(eye.y) > 0.95f ? vec3(1, 0, 0) : kUp, eye)), down = glm::cross(eye, right);
    const int turns = 400;
    vec3 missing(0.0f);
    for (int k = 0; k < turns; ++k) {
        const float turn = 0.5f * kTurn * (static_cast<float>(k) + 0.5f) / turns;
        const vec3 along = right * std::cos(turn) + down * std::sin(turn);
        const vec3 axis = glm::normalize(glm::cross(along, eye));
        const vec3 flat = kUp - axis * glm::dot(kUp, axis);
        const float size = glm::length(flat);
        const float lean = std::atan2(glm::dot(flat, along), glm::dot(flat, eye));
        for (const float side : {1.0f, -1.0f}) {
            const float leans = side * lean, lowest = leans + 0.25f * kTurn;
            float angle = 0.0f;
            while (angle < lowest && open(eye * std::cos(angle) + along * (side * std::sin(angle)))) angle += 0.002f;
            angle = std::min(angle, lowest);
            const vec2 sum = bent_side(std::cos(angle), std::cos(leans), std::sin(leans)) - bent_side(-std::sin(leans), std::cos(leans), std::sin(leans));
            missing += size * (along * (side * sum.x) + eye * sum.y);
        }
    }
    return bent_normal(kUp, missing * (2.0f / turns), 1.0f);
}

TEST(BentNormal, OfASideIsItsSum)
{
    for (const float lean : {-0.8f, 0.0f, 0.6f, 1.2f}) {
        for (const float horizon : {0.2f, 0.9f, 1.5f, 2.2f}) {
            vec2 sum(0.0f);
            const int steps = 4000;
            for (int i = 0; i < steps; ++i) {
                const float a = horizon * (static_cast<float>(i) + 0.5f) / steps;
                sum += vec2(std::sin(a), std::cos(a)) * (std::cos(a - lean) * std::sin(a) * horizon / steps);
            }
            const vec2 side = bent_side(std::cos(horizon), std::cos(lean), std::sin(lean));
            EXPECT_NEAR(side.x, sum.x, 1e-4f) << lean << " " << horizon;
            EXPECT_NEAR(side.y, sum.y, 1e-4f) << lean << " " << horizon;
        }
    }
}

TEST(BentNormal, InACornerAndUnderAnAwningItIsTheMeanOfWhatIsOpen)
{
    // Where nothing is near it is the normal, however the eye looks.
    EXPECT_GT(by_slices([](const vec3&) { return true; }, glm::normalize(vec3(0.5f, 0.4f, 0.2f))).y, 0.99999f);
    for (const vec3& eye : {vec3(-0.6f, 0.7f, 0.3f), vec3(-0.2f, 0.9f, 0.0f)}) {
        for (const float height : {0.5f, 1.5f, 20.0f}) {
            const Open open = beside_wall(height);
            EXPECT_GT(glm::dot(by_slices(open, glm::normalize(eye)), summed(open).bent), std::cos(0.02f)) << height;
            EXPECT_LT(summed(open).bent.x, -0.05f) << "and it leans off the wall";
        }
    }
    for (const float edge : {-0.5f, 0.0f, 1.0f}) {
        const Open open = under_awning(edge);
        EXPECT_GT(glm::dot(by_slices(open, glm::normalize(vec3(0.9f, 0.4f, 0.1f))), summed(open).bent), std::cos(0.02f)) << edge;
    }
}

TEST(BentNormal, ItsCodeIsGoodToADegree)
{
    std::mt19937 numbers{3};
    const auto unit = [&] { return static_cast<float>(numbers() >> 8) / 16777216.0f; };
    for (int i = 0; i < 10000; ++i) {
        const float y = 2.0f * unit() - 1.0f, turn = kTurn * unit(), level = std::sqrt(1.0f - y * y);
        const vec3 d(level * std::cos(turn), y, level * std::sin(turn));
        ASSERT_GT(glm::dot(d, bent_of_code(bent_code(d))), std::cos(0.0175f));
    }
    EXPECT_EQ(bent_of_code(bent_code(kUp)), kUp);
}

// Share of GGX's lobe over the surface that is open.
float mirrored_left(const Open& open, const vec3& v, float roughness)
{
    const float alpha = roughness * roughness;
    const int rows = 160, columns = 160;
    double whole = 0.0, left = 0.0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            // Facets by their distribution.
            const float u = (static_cast<float>(i) + 0.5f) / rows, turn = kTurn * (static_cast<float>(j) + 0.5f) / columns;
            const float up = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u)), level = std::sqrt(std::max(1.0f - up * up, 0.0f));
            const vec3 h(level * std::cos(turn), up, level * std::sin(turn));
            const float vh = glm::dot(v, h);
            const vec3 l = 2.0f * vh * h - v;
            if (l.y <= 0.0f || vh <= 0.0f) continue;
            const double weight = static_cast<double>(ggx_visibility(l.y, v.y, alpha) * 4.0f * l.y * vh / up);
            whole += weight;
            if (open(l)) left += weight;
        }
    }
    return static_cast<float>(left / whole);
}

TEST(BentNormal, AMirrorHasWhatItsLobeSees)
{
    double cones = 0.0, by_angle = 0.0, worst = 0.0;
    int count = 0;
    for (const Open& open : {beside_wall(0.5f), beside_wall(1.5f), beside_wall(20.0f), under_awning(-0.5f), under_awning(0.5f)}) {
        const Left left = summed(open);
        for (const float roughness : {0.25f, 0.4f, 0.6f, 0.8f}) {
            for (const float turn : {0.0f, 0.25f, 0.5f}) {
                for (const float up : {0.3f, 0.6f, 0.9f}) {
                    const float level = std::sqrt(1.0f - up * up);
                    const vec3 v(level * std::cos(kTurn * turn), up, level * std::sin(kTurn * turn));
                    const float truth = mirrored_left(open, v, roughness);
                    const vec3 ray(-v.x, v.y, -v.z);
                    const float found = mirror_left(left.share, kUp, left.bent, ray, roughness);
                    // What knows no direction: Lagarde and de Rousiers 2014.
                    const float lagarde = std::clamp(std::pow(up + left.share, std::exp2(-16.0f * roughness - 1.0f)) - 1.0f + left.share, 0.0f, 1.0f);
                    cones += static_cast<double>(std::abs(found - truth));
                    by_angle += static_cast<double>(std::abs(lagarde - truth));
                    worst = std::max(worst, static_cast<double>(std::abs(found - truth)));
                    ++count;
                }
            }
        }
    }
    RecordProperty("cones", std::to_string(cones / count));
    RecordProperty("by_angle", std::to_string(by_angle / count));
    EXPECT_LT(cones / count, 0.13) << "at worst " << worst;
    EXPECT_LT(cones, 0.67 * by_angle);
    // Where all is open nothing is taken away.
    EXPECT_NEAR(mirror_left(1.0f, kUp, kUp, glm::normalize(vec3(0.9f, 0.2f, 0.0f)), 0.5f), 1.0f, 1e-5f);
}

}  // namespace
}  // namespace petrichor::shared
