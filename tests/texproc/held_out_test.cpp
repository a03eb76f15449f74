// The promises of the rule "overlap" on materials that it was not chosen on.
#include <gtest/gtest.h>

#include <algorithm>

#include "texproc/study/fresh_maps.h"
#include "texproc/study/protocol.h"
#include "texproc/study/scored_maps.h"

namespace petrichor::texproc {
namespace {

std::vector<Variant> overlap_variants(int bits)
{
    std::vector<Variant> variants = protocol_variants(bits);
    std::erase_if(variants, [](const Variant& v) {
        return v.name != "overlap joint" && v.name != "overlap roughness only" &&
               v.name != "plain as shipped";
    });
    return variants;
}

ProtocolOptions some_texels(std::vector<float> lights)
{
    ProtocolOptions o;
    o.seeds = 1;
    o.texels = 16;
    o.points = 512;
    o.lights = std::move(lights);
    return o;
}

class HeldOut : public testing::TestWithParam<std::uint32_t> {};

TEST_P(HeldOut, ClosesTheRoomAndNeverLosesToPlain)
{
    const auto rows =
        run_protocol(fresh_maps(160, GetParam()), overlap_variants(16), some_texels({0.0f, 0.1f}));
    double gaps = 0.0;
    int count = 0;
    for (const ProtocolRow& row : rows) {
        if (row.variant == "plain as shipped") continue;
        const bool joint = row.variant == "overlap joint";
        const std::string what = row.material + ", " + row.variant + ", light " +
                                 std::to_string(row.light) + "\n" + to_text(row.score);
        for (const LevelScore& l : row.score.levels) {
            EXPECT_LE(l.tested, l.plain + 0.005) << "level " << l.level << " of " << what;
        }
        for (const RangeScore& range : {row.score.fine(), row.score.coarse()}) {
            if (!range.has_room()) {
                EXPECT_LE(range.excess(), 0.005) << what;
                continue;
            }
            EXPECT_GE(range.gap(), joint ? 95.0 : 85.0) << what;
            if (!joint) gaps += range.gap(), ++count;
        }
    }
    EXPECT_GE(gaps, 95.0 * count);
}

TEST_P(HeldOut, EightBitsNeverLoseToPlainMipsOfEightBits)
{
    const auto rows =
        run_protocol(fresh_maps(96, GetParam()), overlap_variants(8), some_texels({0.0f}));
    for (std::size_t i = 0; i + 2 < rows.size(); i += 3) {
        const auto one = [&](const char* name) -> const Score& {
            return std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(i),
                                rows.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                                [&](const ProtocolRow& r) { return r.variant == name; })
                ->score;
        };
        const Score& plain = one("plain as shipped");
        const Score& joint = one("overlap joint");
        for (std::size_t k = 0; k < joint.levels.size(); ++k) {
            EXPECT_LE(joint.levels[k].tested, plain.levels[k].tested + 0.005)
                << rows[i].material << ", level " << joint.levels[k].level;
        }
    }
}

// Against level 0 as the file holds it: what supersampling of that file shows.
TEST_P(HeldOut, EightBitsCloseTheRoomOfWhatShips)
{
    std::vector<ScoredMaps> materials = fresh_maps(96, GetParam());
    const std::vector<ScoredMaps> hard = hard_maps(128);
    materials.push_back(*std::find_if(hard.begin(), hard.end(),
                                      [](const ScoredMaps& m) { return m.name == "scratched mirror"; }));
    ProtocolOptions options = some_texels({0.0f});
    options.bits = 8;
    for (const ProtocolRow& row : run_protocol(materials, overlap_variants(8), options)) {
        if (row.variant != "overlap joint") continue;
        for (const RangeScore& range : {row.score.fine(), row.score.coarse()}) {
            if (range.has_room()) {
                EXPECT_GE(range.gap(), 90.0) << row.material << "\n" << to_text(row.score);
            }
        }
    }
}

// Polished tiles whose texels lean to all sides of straight up, by less than two codes: from level 7 on the mean of
// so many is straight up, and only a level 0 that leans as one has a code there.
TEST(EightBits, HoldTheMeanOfAPolishedTile)
{
    std::vector<ScoredMaps> hard = hard_maps(512);
    std::erase_if(hard, [](const ScoredMaps& m) { return m.name != "two-gloss tile"; });
    ASSERT_EQ(hard.size(), 1u);
    ProtocolOptions options = some_texels({0.0f});
    options.bits = 8;
    for (const ProtocolRow& row : run_protocol(hard, overlap_variants(8), options)) {
        if (row.variant != "overlap joint") continue;
        EXPECT_GE(row.score.fine().gap(), 90.0) << to_text(row.score);
        EXPECT_GE(row.score.coarse().gap(), 95.0) << to_text(row.score);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, HeldOut, testing::Values(101u, 102u));

// Where one lobe is split over a patchwork, each patch keeps its own.
TEST(Patchwork, LaysBothMaterialsInAChecker)
{
    const auto maps = fresh_maps(64, 7);
    const ScoredMaps both = patchwork(maps[0], maps[4], 8);
    ASSERT_EQ(both.normal.bytes.size(), maps[0].normal.bytes.size());
    const std::size_t line = 2 * static_cast<std::size_t>(maps[0].roughness.width);
    for (std::size_t x = 0; x < 64; ++x) {
        const RawImage& from = (x / 8) % 2 ? maps[4].roughness : maps[0].roughness;
        EXPECT_EQ(both.roughness.bytes[line + 2 * x], from.bytes[line + 2 * x]) << x;
    }
}

}  // namespace
}  // namespace petrichor::texproc
