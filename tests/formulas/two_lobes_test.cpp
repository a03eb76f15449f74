#include "formulas/light/two_lobes.h"

#include <gtest/gtest.h>

namespace petrichor::shared {
namespace {

const vec3 kNormal = normalize(vec3(0.1f, -0.2f, 1.0f)), kOther = normalize(vec3(-0.3f, 0.1f, 1.0f));
const vec3 kEye = normalize(vec3(0.5f, 0.2f, 0.8f)), kLight = normalize(vec3(-0.3f, 0.4f, 0.9f));
const vec3 kDiffuse(0.3f, 0.2f, 0.1f), kF0(0.04f, 0.3f, 0.9f);

void expect_near(const vec3& a, const vec3& b)
{
    EXPECT_LT(length(a - b), 1e-5f * (1.0f + length(b)));
}

TEST(TwoLobes, ThatAreTheSameAreOne)
{
    const Lobe lobe = make_lobe(kNormal, kEye, kDiffuse, kF0, 0.2f);
    for (const float share : {0.0f, 0.3f, 1.0f})
        expect_near(shade_two_lobes(lobe, lobe, share, kNormal, kLight), shade_lobe(lobe, kLight));
}

// What shines is each lobe's by its share; what is diffuse is lit once, by a normal of its own.
TEST(TwoLobes, ShineByTheirShares)
{
    const Lobe first = make_lobe(kNormal, kEye, kDiffuse, kF0, 0.2f), second = make_lobe(kOther, kEye, splat3(0.0f), kF0, 0.5f);
    const vec3 between = normalize(kNormal + kOther);
    const Lobe shine = make_lobe(kNormal, kEye, splat3(0.0f), kF0, 0.2f);
    const vec3 diffuse = kDiffuse * (dot(between, kLight) / kPi);
    for (const float share : {0.0f, 0.25f, 1.0f}) {
        expect_near(shade_two_lobes(first, second, share, between, kLight),
                    diffuse + (1.0f - share) * shade_lobe(shine, kLight) + share * shade_lobe(second, kLight));
    }
}

// A light behind one lobe may stand before the other.
TEST(TwoLobes, AreLitEachFromItsOwnSide)
{
    const vec3 low = normalize(vec3(1.0f, 0.0f, 0.05f));
    const vec3 away = normalize(vec3(-0.2f, 0.0f, 1.0f)), toward = normalize(vec3(0.2f, 0.0f, 1.0f));
    const Lobe first = make_lobe(away, kEye, splat3(0.0f), kF0, 0.4f), second = make_lobe(toward, kEye, splat3(0.0f), kF0, 0.4f);
    EXPECT_EQ(length(shade_lobe(first, low)), 0.0f);
    EXPECT_GT(length(shade_two_lobes(first, second, 0.5f, vec3(0.0f, 0.0f, 1.0f), low)), 0.0f);
}

TEST(TwoLobes, JoinedOnesLieBetween)
{
    EXPECT_NEAR(joined_roughness(0.3f, 0.3f, 0.7f), 0.3f, 1e-6f);
    EXPECT_NEAR(joined_roughness(0.2f, 0.6f, 0.0f), 0.2f, 1e-6f);
    EXPECT_NEAR(joined_roughness(0.2f, 0.6f, 1.0f), 0.6f, 1e-6f);
    EXPECT_GT(joined_roughness(0.2f, 0.6f, 0.5f), 0.2f);
    EXPECT_LT(joined_roughness(0.2f, 0.6f, 0.5f), 0.6f);
}

}  // namespace
}  // namespace petrichor::shared
