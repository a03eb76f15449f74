#include "texproc/prefilter/rules.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace petrichor::texproc {
namespace {

// The worked example of the reference: alpha 0.04 (p 0.2), slopes of sigma 0.1, kappa 100.
struct Example {
    const char* rule;
    float alpha;
};
void PrintTo(const Example& e, std::ostream* out)
{
    *out << e.rule;
}

class WorkedExample : public testing::TestWithParam<Example> {};
TEST_P(WorkedExample, ComesOut)
{
    // The length whose 1 / kappa is 0.01, by bisection.
    float low = 0.9f, high = 1.0f;
    for (int i = 0; i < 40; ++i) {
        const float mid = 0.5f * (low + high);
        (inverse_kappa(mid) > 0.01f ? low : high) = mid;
    }
    const float p = rule_roughness(GetParam().rule, 0.2f, 0.0016f, low, low);
    EXPECT_NEAR(p * p, GetParam().alpha, 0.0012f);
}
INSTANTIATE_TEST_SUITE_P(Table, WorkedExample,
                         testing::Values(Example{"moments", 0.147f}, Example{"lux-formula", 0.050f},
                                         Example{"filament", 0.060f}, Example{"godot", 0.0475f},
                                         Example{"filament-1.9", 0.045f}, Example{"none", 0.04f},
                                         Example{"toksvig", 0.147f}, Example{"unreal", 0.147f}),
                         [](const auto& test) {
                             std::string name = test.param.rule;
                             for (char& c : name) {
                                 if (c == '-' || c == '.') c = '_';
                             }
                             return name;
                         });

// Laws that hold for every rule of moments: a flat footprint changes nothing (within the 4e-5 of
// Unreal), more spread is never smoother, the result can be stored.
TEST(Rules, FlatStaysRoughGrows)
{
    for (const Rule& rule : rules()) {
        if (rule.kind != RuleKind::Moments || rule.name == "vmf") continue;
        for (const float p : {0.1f, 0.4f, 0.9f}) {
            const float a2 = p * p * p * p;
            EXPECT_NEAR(rule_roughness(rule.name, p, a2, 1.0f, 1.0f), p, 2e-4f) << rule.name;
            float before = 0.0f;
            for (float length = 1.0f; length > 0.0f; length -= 0.05f) {
                const float now = rule_roughness(rule.name, p, a2, length, length);
                EXPECT_GE(now, before - 1e-5f) << rule.name << " at " << length;
                EXPECT_GE(now, 0.0f);
                EXPECT_LE(now, 1.0f);
                before = now;
            }
        }
    }
}

TEST(Rules, UnknownNamesAreListed)
{
    EXPECT_THROW(rule_named("best"), Error);
}

}  // namespace
}  // namespace petrichor::texproc
