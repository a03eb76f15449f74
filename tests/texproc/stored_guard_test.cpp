// What is stored is never worse than plain mips stored alike.
#include "texproc/prefilter/stored_guard.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/assets.h"
#include "tests/texproc/textures.h"
#include "texproc/gltf/rewrite.h"
#include "texproc/study/fresh_maps.h"

namespace petrichor::texproc {
namespace {

struct Floor {
    ScoredMaps maps;
    PictureBench bench;
    Prefiltered ours;
    std::vector<Image> plain;
};

// Few pixels of a material on which the filter gains much.
Floor floor_of_grains()
{
    std::vector<ScoredMaps> all = fresh_maps(128, 3);
    const auto grains = std::find_if(all.begin(), all.end(),
                                     [](const auto& m) { return m.name.starts_with("mica"); });
    PictureOptions pictures = build_pictures(0);
    pictures.views[0].width = 60;
    pictures.views[0].rows = 40;
    PictureBench bench(grains->normal, grains->roughness, {}, pictures);
    Prefiltered ours =
        prefilter_raw(grains->normal, grains->roughness, {.rule = "picture", .quick = true});
    std::vector<Image> plain = bench.plain_roughness();
    return {std::move(*grains), std::move(bench), std::move(ours), std::move(plain)};
}

void make_glossy(Image& level)
{
    for (float& p : level.pixels) p *= 0.3f;
}

TEST(StoredGuard, AChainThatGainsStaysAsItIs)
{
    const Floor floor = floor_of_grains();
    const StoredGuard guard = guard_stored(floor.bench, floor.ours, floor.plain);
    EXPECT_TRUE(guard.plain.empty());
    EXPECT_TRUE(guard.darken);
    EXPECT_LT(guard.score.rmse, guard.plain_score.rmse);
}

TEST(StoredGuard, OnlyLevelsThatCostBecomePlain)
{
    Floor floor = floor_of_grains();
    for (const std::size_t spoilt : {1u, 2u, 3u}) make_glossy(floor.ours.roughness[spoilt]);
    const StoredGuard guard = guard_stored(floor.bench, floor.ours, floor.plain);
    ASSERT_EQ(guard.plain.size(), floor.plain.size());
    EXPECT_TRUE(guard.plain[1] || guard.plain[2] || guard.plain[3]);
    EXPECT_LT(std::count(guard.plain.begin() + 1, guard.plain.end(), 1),
              static_cast<std::ptrdiff_t>(floor.plain.size()) - 1);
    EXPECT_LE(guard.score.rmse, guard.plain_score.rmse);
    EXPECT_LE(guard.score.flicker, guard.plain_score.flicker);
}

TEST(StoredGuard, NothingIsLeftOfAChainThatOnlyCosts)
{
    Floor floor = floor_of_grains();
    for (Image& level : floor.ours.roughness) make_glossy(level);
    for (Image& level : floor.ours.base_share)
        for (float& share : level.pixels) share = 0.2f;
    const StoredGuard guard = guard_stored(floor.bench, floor.ours, floor.plain);
    EXPECT_FALSE(guard.darken);
    EXPECT_EQ(std::count(guard.plain.begin() + 1, guard.plain.end(), 0), 0);
    EXPECT_EQ(guard.score.rmse, guard.plain_score.rmse);
}

class StoredScene : public TextureFiles {};

// Nearly flat: blocks cost more than the filter gains there.
TEST_F(StoredScene, IsNeverWorseThanPlainMipsInTheSameBlocks)
{
    NEED_ASSETS(assets);
    GltfBuildOptions options;
    options.images.size = 256;
    const GltfBuildReport report =
        build_gltf(assets / "models/NormalTangentTest.glb", folder / "out.glb", options);
    ASSERT_EQ(report.materials.size(), 1u);
    const PictureError& error = report.materials[0].picture;
    EXPECT_LE(error.shipped.rmse, error.plain.rmse);
    EXPECT_LE(error.shipped.flicker, error.plain.flicker);
}

}  // namespace
}  // namespace petrichor::texproc
