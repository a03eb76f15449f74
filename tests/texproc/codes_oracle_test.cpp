// What a file of 8 bits can hold at all, and how near the rule comes to it.
#include "texproc/study/detail/codes_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "texproc/study/fresh_maps.h"
#include "texproc/study/protocol.h"

namespace petrichor::texproc {
namespace {

using namespace detail;

constexpr StoredAs kEightBits{.bits = 8};

struct Texel {
    Samples samples;
    std::array<double, kViews> mass{};

    Texel(const Direction& n, float alpha)
    {
        Cells cells;
        cells.add(n.x, n.y, n.z, alpha * alpha, 1.0f);
        Random random{7};
        place_points(cells, n, widths_between(0.25f * alpha * alpha, 16.0f * alpha * alpha), 512,
                     random, samples);
        mass = reference_mass(samples);
    }
    double error(const Codes& c)
    {
        return measure(samples, mass,
                       round_lobe(read_normal(c, kEightBits), read_alpha2(c, kEightBits)))
            .error;
    }
    CodeErrors best(const Direction& n, float alpha)
    {
        return best_codes(samples, mass, {round_lobe(n, alpha * alpha)},
                          static_cast<double>(0.7f * alpha), 0.0f, kEightBits);
    }
};

Direction leaning(float x, float y)
{
    return normalized({x / 255.0f, y / 255.0f, 1.0f});
}

TEST(BestCodes, OfALobeThatCodesAreIsThatLobe)
{
    const Codes there{{132.0f / 255.0f, 125.0f / 255.0f, 1.0f}, 40.0f / 255.0f};
    const Direction n = read_normal(there, kEightBits);
    const float alpha = std::sqrt(read_alpha2(there, kEightBits));
    Texel texel(n, alpha);
    const CodeErrors found = texel.best(n, alpha);
    EXPECT_LT(found.kept, 1e-3);
    EXPECT_LT(found.any, 1e-3);
}

// Of vectors nearly unit, none lies between one and three steps of a half code; half as long ones
// have one at two.
TEST(BestCodes, ShortNormalsReachWhereLongOnesCannot)
{
    const Direction n = leaning(2.0f, 2.0f);
    Texel texel(n, 0.01f);
    const CodeErrors found = texel.best(n, 0.01f);
    EXPECT_LT(found.any, 0.1);
    EXPECT_GT(found.kept, found.any + 0.05);
}

// Every code near by, one by one: none is better.
TEST(BestCodes, NoCodeNearByIsBetter)
{
    const Direction n = leaning(2.3f, 1.2f);
    constexpr float kAlpha = 0.012f;
    Texel texel(n, kAlpha);
    const CodeErrors found = texel.best(n, kAlpha);
    EXPECT_GT(found.any, 0.1);  // x and y go together in short vectors: there is no code here
    double any = 2.0, kept = 2.0;
    for (int z = 128; z <= 255; z += 1) {
        for (int x = 126; x <= 131; ++x) {
            for (int y = 126; y <= 130; ++y) {
                Codes c{{static_cast<float>(x) / 255.0f, static_cast<float>(y) / 255.0f,
                         static_cast<float>(z) / 255.0f},
                        0.0f};
                const float length = 2.0f * c.normal[2] - 1.0f;
                for (int r = 20; r <= 60; r += 2) {
                    c.rough = static_cast<float>(r) / 255.0f;
                    const double e = texel.error(c);
                    any = std::min(any, e);
                    if (length >= kShortestNormal) kept = std::min(kept, e);
                }
            }
        }
    }
    EXPECT_LE(found.any, any + 1e-6);
    EXPECT_LE(found.kept, kept + 1e-6);
    EXPECT_NEAR(found.any, any, 0.02);
    EXPECT_NEAR(found.kept, kept, 0.02);
}

// Lacquer of lobes narrower than a code: 90 % of its room is more than 8 bits hold, in any code;
// the rule takes nearly all that there is.
TEST(BestCodes, LacquerHasLittleMoreThanTheRuleTakes)
{
    std::vector<ScoredMaps> maps = fresh_maps(384, 809);
    std::erase_if(maps, [](const ScoredMaps& m) { return m.name.rfind("lacquer", 0) != 0; });
    ASSERT_EQ(maps.size(), 1u);
    std::vector<Variant> variants = protocol_variants(8);
    std::erase_if(variants, [](const Variant& v) { return v.name != "overlap joint"; });
    ASSERT_EQ(variants.size(), 1u);
    ProtocolOptions o = quick_protocol();
    o.bits = 8;
    o.best_codes = true;
    o.lights = {0.0f};
    const auto rows = run_protocol(maps, variants, o);
    ASSERT_EQ(rows.size(), 3u);
    const RangeScore rule = rows[0].score.fine(), kept = rows[1].score.fine(),
                     any = rows[2].score.fine();
    ASSERT_TRUE(rule.has_room());
    std::printf("rule %.0f %%, best codes %.0f %%, of any length %.0f %%\n", rule.gap(), kept.gap(),
                any.gap());
    EXPECT_LE(any.tested, kept.tested);
    EXPECT_LE(kept.tested, rule.tested);
    EXPECT_LT(any.gap(), 90.0);
    EXPECT_GT(rule.gap(), kept.gap() - 5.0);
}

}  // namespace
}  // namespace petrichor::texproc
