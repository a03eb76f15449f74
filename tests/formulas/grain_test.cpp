// What a grained surface mirrors, beside sums over its lobe up to an anisotropy of 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "formulas/light/grain.h"
#include "formulas/light/layers.h"

namespace petrichor::shared {
namespace {

using glm::vec2;
using glm::vec3;

const vec3 kUp(0, 0, 1), kAlong(1, 0, 0);

// The mean direction of what the lobe mirrors, not of one.
vec3 middle(float roughness, float anisotropy, const vec3& v)
{
    vec3 sum(0.0f);
    float total = 0.0f;
    const int rows = 200, columns = 400;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = (static_cast<float>(i) + 0.5f) / rows, turn = 6.2831853f * (static_cast<float>(j) + 0.5f) / columns;
            const float level = std::sqrt(1.0f - up * up);
            const vec3 l(level * std::cos(turn), level * std::sin(turn), up);
            const float light = anisotropic_lobe(kUp, kAlong, v, l, alpha_along(roughness, anisotropy), roughness * roughness) * up;
            sum += l * light;
            total += light;
        }
    }
    return sum / total;
}

vec3 mirrored(const vec3& h, const vec3& v)
{
    return 2.0f * glm::dot(h, v) * h - v;
}

const std::vector<vec3> kEyes = {glm::normalize(vec3(0.3f, 0, 0.95f)), glm::normalize(vec3(0.6f, 0, 0.8f)), glm::normalize(vec3(0.9f, 0, 0.4f)),
                                 glm::normalize(vec3(0.5f, 0.5f, 0.7f)), glm::normalize(vec3(0, 0.7f, 0.7f))};

TEST(Grain, TheMiddleOfTheLobeIsMirrored)
{
    std::vector<float> errors, of_text;
    for (const float roughness : {0.2f, 0.3f, 0.4f, 0.5f}) {
        for (const float anisotropy : {0.5f, 0.7f, 0.85f, 1.0f}) {
            for (const vec3& v : kEyes) {
                const vec3 truth = glm::normalize(middle(roughness, anisotropy, v));
                const auto off = [&](const vec3& h) { return std::acos(std::min(glm::dot(mirrored(h, v), truth), 1.0f)); };
                errors.push_back(off(grain_middle(kUp, kAlong, v, anisotropy)));
                // KHR_materials_anisotropy, what it calls an approximation.
                const vec3 across = glm::cross(kUp, kAlong);
                const float keep = std::pow(1.0f - anisotropy * (1.0f - roughness), 4.0f);
                of_text.push_back(off(glm::normalize(glm::mix(glm::normalize(glm::cross(glm::cross(across, v), across)), kUp, keep))));
                EXPECT_LT(errors.back(), 0.25f) << roughness << " " << anisotropy << " " << v.x << " " << v.z;
            }
        }
    }
    const auto mean = [](const std::vector<float>& all) {
        float sum = 0.0f;
        for (const float e : all) sum += e / static_cast<float>(all.size());
        return sum;
    };
    RecordProperty("mean", std::to_string(mean(errors)));
    RecordProperty("of_text", std::to_string(mean(of_text)));
    EXPECT_LT(mean(errors), 0.12f);
    EXPECT_LT(mean(errors), 0.3f * mean(of_text));
    EXPECT_EQ(grain_middle(kUp, kAlong, kEyes[1], 0.0f), kUp);
}

// Along the grain, in the mean over what is drawn: also where all slopes that there are would have another middle.
TEST(Grain, WhatIsDrawnHasTheMiddleOfTheLobe)
{
    for (const float anisotropy : {0.5f, 0.7f, 0.9f, 1.0f}) {
        for (const vec3& v : {kEyes[0], kEyes[1], kEyes[2]}) {
            const float roughness = 0.3f, wide = grain_alpha(roughness * roughness, anisotropy);
            float sum = 0.0f;
            const int draws = 20000;
            for (int i = 0; i < draws; ++i) {
                const vec2 u((static_cast<float>(i) + 0.5f) / draws, std::fmod(static_cast<float>(i) * 0.61803399f, 1.0f));
                const vec3 h = grain_normal(kUp, kAlong, v, seen_slope(u, wide, vec2(v.x, v.z)));
                sum += mirrored(h, v).x / draws;
            }
            EXPECT_NEAR(sum, middle(roughness, anisotropy, v).x, 0.16f) << anisotropy << " " << v.x;
        }
    }
}

}  // namespace
}  // namespace petrichor::shared
