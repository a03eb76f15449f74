#include "texproc/prefilter/stored.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "texproc/generate/generate.h"
#include "texproc/study/fresh_maps.h"
#include "texproc/study/score.h"

namespace petrichor::texproc {
namespace {

Image ones(int width, int height)
{
    return Image(width, height, 1, ColorSpace::Data, 1.0f);
}

Image exact(const std::vector<std::byte>& bytes, Block block, int width, int height)
{
    return to_image(decode_blocks(bytes, block, width, height, BlockSign::Exact), ColorSpace::Data);
}

// A flat normal lies between two codes: 8-bit values miss it by half of one, blocks need not.
TEST(WeightedBlocks, NumbersBetweenCodesAreReached)
{
    Image smooth(12, 8, 2, ColorSpace::Data);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 12; ++x) {
            smooth.at(x, y, 0) = 0.5f;
            smooth.at(x, y, 1) = 0.5f + 0.0004f * static_cast<float>(x - y);
        }
    }
    const auto bytes = encode_blocks_weighted(smooth, ones(12, 8), Block::Bc5);
    const Image read = exact(bytes, Block::Bc5, 12, 8);
    double off = 0.0;
    for (std::size_t i = 0; i < read.pixels.size(); i += 2) {
        EXPECT_NEAR(255.0f * read.pixels[i], 127.5f, 0.0715f);  // 1/14 of a code
        off += static_cast<double>(std::abs(read.pixels[i + 1] - smooth.pixels[i + 1]));
    }
    EXPECT_LT(255.0 * 2.0 * off / static_cast<double>(read.pixels.size()), 0.1);  // codes: 0.25
}

TEST(WeightedBlocks, ExactValuesRoundToTheCodes)
{
    const MaterialMaps maps = generate_material(MaterialKind::Cobble, 64, 1, 1);
    const auto bytes = encode_blocks(to_raw(maps.roughness, PixelType::U8), Block::Bc4);
    const Image fine = exact(bytes, Block::Bc4, 64, 64);
    const RawImage codes = decode_blocks(bytes, Block::Bc4, 64, 64);
    for (std::size_t i = 0; i < fine.pixels.size(); ++i) {
        EXPECT_LE(std::abs(255.0f * fine.pixels[i] - static_cast<float>(codes.bytes[i])), 0.5001f);
    }
}

TEST(WeightedBlocks, HeavyTexelsComeFirst)
{
    Image values(4, 4, 1, ColorSpace::Data), weights = ones(4, 4);
    for (std::size_t i = 0; i < 16; ++i) {
        values.pixels[i] = static_cast<float>(37 * i % 16) / 15.0f;
    }
    const auto off = [&](std::size_t texel) {
        const Image read =
            exact(encode_blocks_weighted(values, weights, Block::Bc4), Block::Bc4, 4, 4);
        return std::abs(read.pixels[texel] - values.pixels[texel]);
    };
    for (std::size_t texel = 0; texel < 16; ++texel) {
        weights = ones(4, 4);
        const float light = off(texel);
        weights.pixels[texel] = 1000.0f;
        EXPECT_LE(off(texel), light + 1e-6f);
        EXPECT_LT(off(texel), 0.012f);
    }
    EXPECT_THROW(encode_blocks_weighted(values, weights, Block::Bc7), Error);
    EXPECT_THROW(encode_blocks_weighted(values, ones(8, 4), Block::Bc4), Error);
}

// A reader's view of normals in blocks: three channels, z rebuilt where there are only two.
Image read_normals(const Image& level)
{
    Image to(level.width, level.height, 3, ColorSpace::Data);
    for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) {
            const float u = 2.0f * level.at(x, y, 0) - 1.0f, v = 2.0f * level.at(x, y, 1) - 1.0f;
            to.at(x, y, 0) = level.at(x, y, 0);
            to.at(x, y, 1) = level.at(x, y, 1);
            to.at(x, y, 2) = level.channels > 2
                                 ? level.at(x, y, 2)
                                 : 0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - u * u - v * v));
        }
    }
    return to;
}

Image first_channel(const Image& level)
{
    Image to(level.width, level.height, 1, ColorSpace::Data);
    for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) to.at(x, y, 0) = level.at(x, y, 0);
    }
    return to;
}

struct Shipping {
    const char* rule = "overlap";
    bool quick = false;
    bool fitted = true;  // else by squared error of codes
    Block normal = Block::Bc5, roughness = Block::Bc4;
    int threads = 1;
};

struct Shipped {
    Prefiltered chain;
    Score score;
};

// What comes out of a chain in blocks.
Shipped shipped(const RawImage& normal, const RawImage& roughness, const Shipping& as)
{
    const PrefilterOptions options{.rule = as.rule, .threads = as.threads, .quick = as.quick};
    Prefiltered chain = prefilter_raw(normal, roughness, options);
    LobeWeights weights;
    if (as.fitted) weights = lobe_weights(chain, options);
    if (as.normal != Block::Bc5) weights.normal.clear();
    if (as.roughness != Block::Bc4) weights.roughness.clear();
    chain.normal = through_blocks(chain.normal, weights.normal, {.block = as.normal});
    for (std::size_t k = 1; k < chain.normal.size(); ++k) {
        chain.normal[k] = read_normals(chain.normal[k]);
    }
    if (as.fitted) chain.roughness = aim_roughness(normal, roughness, chain, options);
    chain.roughness = through_blocks(chain.roughness, weights.roughness, {.block = as.roughness});
    for (std::size_t k = 1; k < chain.roughness.size(); ++k) {
        chain.roughness[k] = first_channel(chain.roughness[k]);
    }
    const Score score = texproc::score(normal, roughness, chain, options, {.texels = 32});
    return {chain, score};
}

Shipped shipped(const MaterialMaps& maps, const Shipping& as)
{
    return shipped(to_raw(maps.normal, PixelType::U16), to_raw(maps.roughness, PixelType::U16), as);
}

// Polished metal has narrow lobes, which half a code of the normal turns by much of their width.
TEST(StoredChains, FittedBlocksLoseLessLight)
{
    const MaterialMaps maps = generate_material(MaterialKind::MetalPlate, 64, 1, 1);
    EXPECT_LT(shipped(maps, {}).score.fine().tested,
              shipped(maps, {.fitted = false}).score.fine().tested);
}

// Blocks take most from re-aimed normals, which differ more from texel to texel than mean normals
// do. Still no level is worse than the plain mip in the same blocks, on materials that nothing was
// chosen on.
class CompressedChains : public testing::TestWithParam<Block> {};
TEST_P(CompressedChains, NeverLoseToPlainMipsInTheSameBlocks)
{
    const Block normal = GetParam();
    const Block roughness = normal == Block::Bc5 ? Block::Bc4 : Block::Bc7;
    for (const ScoredMaps& maps : fresh_maps(64, 103)) {
        const auto as = [&](const char* rule, bool quick) {
            return shipped(maps.normal, maps.roughness,
                           {.rule = rule,
                            .quick = quick,
                            .fitted = std::string(rule) != "none",
                            .normal = normal,
                            .roughness = roughness,
                            .threads = 0})
                .score;
        };
        const Score plain = as("none", false);
        for (const bool quick : {false, true}) {
            const Score ours = as("overlap", quick);
            for (std::size_t k = 0; k < ours.levels.size(); ++k) {
                EXPECT_LE(ours.levels[k].tested, plain.levels[k].tested + 0.005)
                    << maps.name << (quick ? ", quick" : "") << ", level " << ours.levels[k].level;
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Blocks, CompressedChains, testing::Values(Block::Bc5, Block::Bc7),
                         [](const auto& test) {
                             return test.param == Block::Bc5 ? "Bc5AndBc4" : "Bc7";
                         });

TEST(StoredChains, BytesDoNotDependOnThreads)
{
    const MaterialMaps maps = generate_material(MaterialKind::Brick, 32, 1, 1);
    const Shipped one = shipped(maps, {}), three = shipped(maps, {.threads = 3});
    for (std::size_t k = 1; k < one.chain.roughness.size(); ++k) {
        EXPECT_EQ(one.chain.roughness[k].pixels, three.chain.roughness[k].pixels);
        EXPECT_EQ(one.chain.normal[k].pixels, three.chain.normal[k].pixels);
    }
}

}  // namespace
}  // namespace petrichor::texproc
