#include "texproc/study/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "texproc/prefilter/detail/codes.h"
#include "texproc/study/protocol.h"
#include "texproc/study/scored_maps.h"

namespace petrichor::texproc {
namespace {

using namespace detail;

ProtocolOptions small_protocol()
{
    ProtocolOptions o;
    o.seeds = 1;
    o.texels = 8;
    o.points = 256;
    return o;
}

std::vector<Variant> joint_variants()
{
    std::vector<Variant> all;
    for (const bool quick : {false, true}) {
        Variant v;
        v.name = quick ? "quick" : "full";
        v.options.rule = "overlap";
        v.options.quick = quick;
        all.push_back(v);
    }
    return all;
}

// The promise of the default on the maps that were made to break it.
TEST(Protocol, TheDefaultIsNeverWorseThanPlainOnHardMaps)
{
    const auto rows = run_protocol(hard_maps(128), joint_variants(), small_protocol());
    ASSERT_EQ(rows.size(), hard_maps(128).size() * 2 * 2);
    for (const ProtocolRow& row : rows) {
        for (const LevelScore& l : row.score.levels) {
            EXPECT_LE(l.tested, l.plain + 0.005) << row.material << " " << row.variant << " level "
                                                 << l.level << " light " << row.light;
        }
    }
    for (const ProtocolSummary& s : summarize(rows)) {
        if (s.variant != "full") continue;
        EXPECT_GT(s.with_room, 2);
        EXPECT_GE(s.worst_gap, 80.0) << s.worst_material;
        EXPECT_GE(s.mean_gap, 100.0);
        EXPECT_EQ(s.levels_over_plain, 0);
    }
}

// A summary by hand: two materials, one without room.
TEST(Protocol, SummariesFollowTheirDefinitions)
{
    const auto row = [](const char* material, double plain, double best, double tested) {
        ProtocolRow r{material, "rule", 0.0f, {}};
        r.score.levels = {{1, plain, best, tested, 0, 0}, {6, plain, best, plain + 0.01, 0, 0}};
        return r;
    };
    const auto all = summarize(
        {row("a", 0.5, 0.3, 0.35), row("b", 0.4, 0.3, 0.25), row("c", 0.02, 0.01, 0.016)});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].with_room, 2);
    EXPECT_NEAR(all[0].worst_gap, 75.0, 1e-9);
    EXPECT_NEAR(all[0].mean_gap, 112.5, 1e-9);
    EXPECT_NEAR(all[0].pooled_gap, 100.0, 1e-9);
    EXPECT_NEAR(all[0].worst_excess_without_room, 0.006, 1e-9);
    EXPECT_EQ(all[0].worst_material, "a");
    EXPECT_EQ(all[0].levels_over_plain, 0);
    EXPECT_FALSE(all[1].fine);
    EXPECT_EQ(all[1].levels_over_plain, 3);
    EXPECT_NE(to_markdown(all).find("75 / 112 / 100"), std::string::npos) << to_markdown(all);
}

// What is fitted for a score is what a whole chain holds.
TEST(PrefilterSome, GivesTheTexelsOfTheWholeChain)
{
    const ScoredMaps maps = hard_maps(128)[0];
    PrefilterOptions options;
    options.rule = "overlap";
    const Prefiltered whole = prefilter_raw(maps.normal, maps.roughness, options);
    const auto wanted = [](int level, int x, int y) { return (x + 2 * y + level) % 5 == 0; };
    const Prefiltered some = prefilter_some(maps.normal, maps.roughness, {options}, wanted).front();
    int texels = 0;
    for (std::size_t k = 1; k < whole.roughness.size(); ++k) {
        for (int y = 0; y < whole.roughness[k].height; ++y) {
            for (int x = 0; x < whole.roughness[k].width; ++x) {
                if (!wanted(static_cast<int>(k), x, y)) continue;
                ++texels;
                EXPECT_EQ(some.roughness[k].at(x, y, 0), whole.roughness[k].at(x, y, 0));
                EXPECT_EQ(some.normal[k].at(x, y, 1), whole.normal[k].at(x, y, 1));
            }
        }
    }
    EXPECT_GT(texels, 500);
}

TEST(ScoredMaps, RollAndRainKeepWhatTheyShould)
{
    const ScoredMaps dry = hard_maps(64)[3];
    EXPECT_EQ(rolled(rolled(dry.normal, 13, -5), -13, 5).bytes, dry.normal.bytes);
    EXPECT_NE(rolled(dry.normal, 1, 0).bytes, dry.normal.bytes);
    Image height(64, 64, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < height.pixels.size(); ++i) height.pixels[i] = static_cast<float>(i);
    const ScoredMaps wet = with_puddles(dry, height, 0.25f);
    const Image n = to_image(wet.normal, ColorSpace::Data),
                r = to_image(wet.roughness, ColorSpace::Data);
    std::size_t flat = 0;
    for (std::size_t i = 0; i < r.pixels.size(); ++i) {
        EXPECT_LE(r.pixels[i], 0.5f + 1e-4f);
        flat += n.pixels[3 * i + 2] > 0.9999f && r.pixels[i] < 0.081f;
    }
    EXPECT_NEAR(static_cast<double>(flat) / static_cast<double>(r.pixels.size()), 0.25, 0.01);
    EXPECT_THROW(with_puddles(dry, Image(8, 8, 1, ColorSpace::Data)), Error);
}

// Codes mean what the options say, in every layout.
TEST(Codes, ComeBackAsTheLobeTheyStore)
{
    const Direction n = normalized({0.2f, -0.3f, 1.0f});
    for (const bool down : {false, true}) {
        for (const bool smooth : {false, true}) {
            for (const bool alpha : {false, true}) {
                for (const bool rebuilt : {false, true}) {
                    const StoredAs as{16, smooth, alpha, down, rebuilt};
                    const Codes codes = rounded(n, 0.04f, as);
                    EXPECT_GT(dot(read_normal(codes, as), n), 0.999999f);
                    EXPECT_NEAR(read_alpha2(codes, as), 0.04f, 1e-4f);
                    EXPECT_EQ(codes.normal[1] > 0.5f, down);
                }
            }
        }
    }
}

// A glossy lobe whose direction no unit vector of eight bits holds: the choice comes nearer than
// rounding, and is never dearer.
TEST(Codes, ChoiceBeatsRounding)
{
    const StoredAs as{8, false, false, false, false};
    Samples samples;
    double rounding = 0.0, choice = 0.0;
    for (int i = 0; i < 40; ++i) {
        Cells cells;
        const float t = 0.1f + 0.01f * static_cast<float>(i);
        const Direction n = normalized({t, 0.37f * t, 1.0f});
        cells.add(n.x, n.y, n.z, 2e-5f, 1.0f);
        const LobeCost cost(cells.view(), whole_of(cells.view(), {}), 640,
                            static_cast<std::uint32_t>(i), samples);
        const Codes plain = rounded(n, 2e-5f, as);
        const Codes chosen = cheapest_codes(cost, n, 2e-5f, plain, 0.0f, as);
        const float a = cost(read_normal(plain, as), read_alpha2(plain, as));
        const float b = cost(read_normal(chosen, as), read_alpha2(chosen, as));
        EXPECT_LE(b, a);
        rounding += static_cast<double>(a);
        choice += static_cast<double>(b);
    }
    EXPECT_LT(choice, 0.7 * rounding);
}

// Eight bits as shipped: far better than plain mips in the same eight bits.
TEST(Protocol, ChosenCodesSurviveEightBits)
{
    std::vector<Variant> variants = protocol_variants(8);
    std::erase_if(variants, [](const Variant& v) {
        return v.name != "plain as shipped" && v.name != "overlap joint";
    });
    ASSERT_EQ(variants.size(), 2u);
    const auto rows =
        run_protocol({hard_maps(128)[0], hard_maps(128)[5]}, variants, small_protocol());
    for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
        EXPECT_LT(rows[i + 1].score.fine().tested, rows[i].score.fine().tested + 0.005)
            << rows[i].material;
        EXPECT_LT(rows[i + 1].score.coarse().tested, rows[i].score.coarse().tested + 0.005)
            << rows[i].material;
    }
}

}  // namespace
}  // namespace petrichor::texproc
