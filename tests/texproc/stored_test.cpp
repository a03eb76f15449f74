#include "texproc/prefilter/stored.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "texproc/generate/generate.h"
#include "texproc/prefilter/score.h"

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

struct Shipped {
    Prefiltered chain;
    double error;
};

// The lobe error of BC5 normals and BC4 roughness, by squared error of codes or fitted.
Shipped shipped(const MaterialMaps& maps, bool fitted, int threads)
{
    PrefilterOptions options{.rule = "overlap", .threads = threads};
    const RawImage normal = to_raw(maps.normal, PixelType::U16);
    const RawImage roughness = to_raw(maps.roughness, PixelType::U16);
    Prefiltered chain = prefilter_raw(normal, roughness, options);
    LobeWeights weights;
    if (fitted) weights = lobe_weights(chain, options);
    chain.normal = through_blocks(chain.normal, weights.normal, {.block = Block::Bc5});
    for (std::size_t k = 1; k < chain.normal.size(); ++k) {
        const Image xy = chain.normal[k];
        chain.normal[k] = Image(xy.width, xy.height, 3, ColorSpace::Data);
        for (std::size_t i = 0; 2 * i < xy.pixels.size(); ++i) {
            const float x = xy.pixels[2 * i], y = xy.pixels[2 * i + 1];
            const float u = 2.0f * x - 1.0f, v = 2.0f * y - 1.0f;
            chain.normal[k].pixels[3 * i] = x;
            chain.normal[k].pixels[3 * i + 1] = y;
            chain.normal[k].pixels[3 * i + 2] =
                0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - u * u - v * v));
        }
    }
    if (fitted) chain.roughness = aim_roughness(normal, roughness, chain, options);
    chain.roughness = through_blocks(chain.roughness, weights.roughness, {.block = Block::Bc4});
    const Score score = texproc::score(normal, roughness, chain, options, {.texels = 64});
    return {chain, score.fine().tested};
}

// Polished metal has narrow lobes, which half a code of the normal turns by much of their width.
TEST(StoredChains, FittedBlocksLoseLessLight)
{
    const MaterialMaps maps = generate_material(MaterialKind::MetalPlate, 64, 1, 1);
    EXPECT_LT(shipped(maps, true, 1).error, shipped(maps, false, 1).error);
}

TEST(StoredChains, BytesDoNotDependOnThreads)
{
    const MaterialMaps maps = generate_material(MaterialKind::Brick, 32, 1, 1);
    const Shipped one = shipped(maps, true, 1), three = shipped(maps, true, 3);
    for (std::size_t k = 1; k < one.chain.roughness.size(); ++k) {
        EXPECT_EQ(one.chain.roughness[k].pixels, three.chain.roughness[k].pixels);
        EXPECT_EQ(one.chain.normal[k].pixels, three.chain.normal[k].pixels);
    }
}

}  // namespace
}  // namespace petrichor::texproc
