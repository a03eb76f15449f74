#include "tests/support/assets.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/blocks/detail/block_table.h"
#include "texproc/codecs/files/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"
#include "texproc/codecs/blocks/detail/encode_kernel.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::texproc {
namespace {

constexpr Block kWritable[] = {Block::Bc1, Block::Bc3, Block::Bc4,
                              Block::Bc5, Block::Bc7, Block::Uastc};

std::uint32_t next(std::uint32_t& seed)
{
    return seed = seed * 1664525u + 1013904223u;
}

// Slopes, noise and edges: what materials are made of.
RawImage material(int width, int height, int channels, std::uint32_t seed = 3)
{
    RawImage image{width, height, channels, PixelType::U8, {}, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const double wave =
                    90 * std::sin(0.11 * x + 0.07 * (c + 1) * y) * std::cos(0.05 * y);
                const double edge = (x / 9 + y / 7 + c) % 3 == 0 ? 40 : 0;
                const double noise = static_cast<double>(next(seed) >> 27);
                const double v = 110 + wave + edge + noise;
                image.bytes.push_back(static_cast<std::byte>(v < 0 ? 0 : v > 255 ? 255 : v));
            }
        }
    }
    return image;
}

// Mean squared error over the channels that the block format keeps.
double error(const RawImage& image, const RawImage& back, int channels)
{
    double total = 0;
    const std::size_t pixels = image.bytes.size() / static_cast<std::size_t>(image.channels);
    for (std::size_t p = 0; p < pixels; ++p) {
        for (int c = 0; c < channels; ++c) {
            const std::size_t at = static_cast<std::size_t>(c);
            const int d =
                static_cast<int>(image.bytes[p * static_cast<std::size_t>(image.channels) + at]) -
                static_cast<int>(back.bytes[p * static_cast<std::size_t>(back.channels) + at]);
            total += d * d;
        }
    }
    return total / static_cast<double>(pixels) / channels;
}

double round_trip(const RawImage& image, Block block, const BlockOptions& options)
{
    const RawImage back =
        decode_blocks(encode_blocks(image, block, options), block, image.width, image.height);
    const int kept = block == Block::Bc1 ? 3 : channels_of(block);
    return error(image, back, std::min(kept, image.channels));
}

TEST(Blocks, ErrorFallsWithQualityAndStaysBounded)
{
    const RawImage image = material(64, 64, 4);
    const double most[] = {150, 150, 8, 8, 60};
    for (std::size_t i = 0; i < 5; ++i) {
        const double fast = round_trip(image, kWritable[i], {.quality = BlockQuality::Fast});
        const double normal = round_trip(image, kWritable[i], {.quality = BlockQuality::Normal});
        const double best = round_trip(image, kWritable[i], {.quality = BlockQuality::Best});
        EXPECT_LE(normal, fast) << i;
        EXPECT_LE(best, normal * 1.0001) << i;
        EXPECT_LT(best, most[i]) << i;
        EXPECT_GT(best, 0.0) << i;
    }
}

TEST(Blocks, OneColourIsExactWhereTheFormatCanSayIt)
{
    std::uint32_t seed = 11;
    for (int round = 0; round < 300; ++round) {
        RawImage image{4, 4, 4, PixelType::U8, {}, {}};
        const std::uint32_t color = next(seed);
        for (int i = 0; i < 64; ++i)
            image.bytes.push_back(static_cast<std::byte>(color >> (8 * (i % 4))));
        EXPECT_EQ(round_trip(image, Block::Bc7, {}), 0.0) << color;
        EXPECT_EQ(round_trip(image, Block::Bc4, {}), 0.0) << color;
        EXPECT_EQ(round_trip(image, Block::Bc5, {}), 0.0) << color;
        EXPECT_LE(round_trip(image, Block::Bc1, {}), 1.0) << color;  // one code a channel at most
    }
}

// Two codes, or a ramp of eight even steps, lie on the palette: nothing is lost.
TEST(Blocks, WhatLiesOnThePaletteIsExact)
{
    RawImage image{4, 4, 1, PixelType::U8, {}, {}};
    for (int t = 0; t < 16; ++t) image.bytes.push_back(static_cast<std::byte>(30 + 7 * (t % 8)));
    EXPECT_EQ(round_trip(image, Block::Bc4, {}), 0.0);
    for (int t = 0; t < 16; ++t)
        image.bytes[static_cast<std::size_t>(t)] = std::byte(t % 3 ? 255 : 0);
    EXPECT_EQ(round_trip(image, Block::Bc4, {}), 0.0);
    for (int t = 0; t < 16; ++t) {  // 0, 255 and a narrow band between: the six-value mode
        constexpr int kBand[4] = {100, 103, 112, 115};
        const int v = t % 4 == 0 ? 0 : t % 4 == 1 ? 255 : kBand[t / 4];
        image.bytes[static_cast<std::size_t>(t)] = static_cast<std::byte>(v);
    }
    EXPECT_EQ(round_trip(image, Block::Bc4, {}), 0.0);
}

// Grey blocks as three lines of eight steps each hold them, whose ends are five bits: for these nothing may be lost,
// alpha included.
TEST(Blocks, GreyOnThreeLinesIsExact)
{
    std::uint32_t seed = 17;
    const auto draw = [&](std::uint32_t below) { return static_cast<int>((next(seed) >> 16) % below); };
    for (int round = 0; round < 400; ++round) {
        const int partition = draw(16);
        int ends[6], index[16], first[3] = {-1, -1, -1}, last[3] = {};
        for (int& end : ends) end = draw(32);
        for (int t = 0; t < 16; ++t) {
            index[t] = draw(8);
            const int subset = detail::bc7_subset(3, partition, t);
            if (first[subset] < 0) first[subset] = t;
            last[subset] = t;
        }
        RawImage image{4, 4, 4, PixelType::U8, {}, {}};
        for (int t = 0; t < 16; ++t) {
            const int subset = detail::bc7_subset(3, partition, t);
            const int i = t == first[subset] ? 0 : t == last[subset] ? 7 : index[t];  // both ends are in use
            const int v = detail::bc7_mix(detail::bc7_widen(ends[2 * subset], 5), detail::bc7_widen(ends[2 * subset + 1], 5),
                                          detail::kBc7Weights3[i]);
            for (int c = 0; c < 4; ++c) image.bytes.push_back(static_cast<std::byte>(c < 3 ? v : 255));
        }
        for (const BlockQuality q : {BlockQuality::Fast, BlockQuality::Normal, BlockQuality::Best})
            EXPECT_EQ(round_trip(image, Block::Bc7, {.quality = q}), 0.0) << round;
    }
}

TEST(Blocks, BytesDoNotDependOnThreadsOrInstructionSet)
{
    const RawImage image = material(61, 47, 4);
    for (const Block block : kWritable) {
        const auto one = encode_blocks(image, block, {.threads = 1});
        EXPECT_EQ(one, encode_blocks(image, block, {.threads = 5}));
    }
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
    std::uint32_t seed = 5;
    for (int round = 0; round < 300; ++round) {
        detail::BlockTexels texels;
        const std::uint32_t spread = next(seed) >> 28;
        for (auto& plane : texels.plane) {
            const std::uint32_t base = next(seed) >> 25;
            for (auto& v : plane)
                v = static_cast<std::uint8_t>(base + (next(seed) >> 24) * spread / 32);
        }
        if (round >= 200) {  // opaque and grey
            for (int c = 1; c < 3; ++c) std::copy_n(texels.plane[0], 16, texels.plane[c]);
            std::fill_n(texels.plane[3], 16, std::uint8_t{255});
        }
        for (const BlockQuality q :
             {BlockQuality::Fast, BlockQuality::Normal, BlockQuality::Best}) {
            std::array<std::byte, 16> a{}, b{};
            const BlockOptions options{.quality = q};
            detail::kEncodeKernelBase.bc7(texels, options, a.data());
            detail::kEncodeKernelAvx2.bc7(texels, options, b.data());
            EXPECT_EQ(a, b) << round;
            detail::kEncodeKernelBase.bc1(
                texels, options, round % 2 ? detail::Bc1Use::Holes : detail::Bc1Use::Opaque,
                a.data());
            detail::kEncodeKernelAvx2.bc1(
                texels, options, round % 2 ? detail::Bc1Use::Holes : detail::Bc1Use::Opaque,
                b.data());
            detail::kEncodeKernelBase.bc4(texels.plane[1], q, a.data() + 8);
            detail::kEncodeKernelAvx2.bc4(texels.plane[1], q, b.data() + 8);
            EXPECT_EQ(a, b) << round;
        }
    }
#endif
}

TEST(Blocks, AlphaOfBc1IsKeptAsHoles)
{
    RawImage image = material(16, 16, 4);
    for (std::size_t p = 0; p < 256; ++p)
        image.bytes[4 * p + 3] = std::byte(p % 5 == 0 || p < 32 ? 20 : 230);
    const auto bytes = encode_blocks(image, Block::Bc1, {.punch_through = true});
    const RawImage back = decode_blocks(bytes, Block::Bc1, 16, 16);
    for (std::size_t p = 0; p < 256; ++p) {
        EXPECT_EQ(static_cast<int>(back.bytes[4 * p + 3]), p % 5 == 0 || p < 32 ? 0 : 255) << p;
    }
    const RawImage opaque = decode_blocks(encode_blocks(image, Block::Bc1), Block::Bc1, 16, 16);
    for (std::size_t p = 0; p < 256; ++p) EXPECT_EQ(static_cast<int>(opaque.bytes[4 * p + 3]), 255);
}

// Within BC3 the colours are read as four whatever the order of the ends: a block of three would
// come out wrong.
TEST(Blocks, ColoursOfBc3AreAlwaysFour)
{
    std::uint32_t seed = 77;
    RawImage image{64, 64, 4, PixelType::U8, {}, {}};
    for (int i = 0; i < 64 * 64 * 4; ++i) {  // two tones and their middle: what three colours suit
        const std::uint32_t pick = next(seed) >> 30;
        image.bytes.push_back(
            static_cast<std::byte>(40 + 60 * static_cast<int>(pick % 3) + (i % 4)));
    }
    for (const BlockQuality q : {BlockQuality::Fast, BlockQuality::Normal, BlockQuality::Best}) {
        const auto bytes = encode_blocks(image, Block::Bc3, {.quality = q});
        for (std::size_t b = 0; b < bytes.size(); b += 16) {
            const int c0 = static_cast<int>(bytes[b + 8]) | static_cast<int>(bytes[b + 9]) << 8;
            const int c1 = static_cast<int>(bytes[b + 10]) | static_cast<int>(bytes[b + 11]) << 8;
            EXPECT_GE(c0, c1);
        }
    }
}

TEST(Blocks, EdgesOfOddSizesAreKept)
{
    for (const Block block : kWritable) {
        const RawImage image = material(5, 3, 4);
        EXPECT_EQ(encode_blocks(image, block).size(), 2 * block_bytes(block));
        EXPECT_LT(round_trip(image, block, {}), 200.0);
    }
    EXPECT_EQ(blocks_size(Block::Bc1, 1, 1), 8u);
}

// Every texel of the palette is the nearest integer to the real number of the format's definition.
TEST(Blocks, StepsAreTheNearestIntegers)
{
    for (int r0 = 0; r0 < 256; r0 += 3) {
        for (int r1 = 0; r1 < 256; ++r1) {
            const auto palette = detail::bc4_palette(r0, r1);
            const int steps = r0 > r1 ? 7 : 5;
            for (int k = 1; k < steps; ++k) {
                const double real = ((steps - k) * r0 + k * r1) / static_cast<double>(steps);
                EXPECT_LE(std::fabs(palette[static_cast<std::size_t>(k + 1)] - real), 0.5);
            }
        }
    }
    for (int v = 0; v < 32; ++v) EXPECT_EQ(detail::widen5(v), std::lround(v * 255 / 31.0));
    for (int v = 0; v < 64; ++v) EXPECT_EQ(detail::widen6(v), std::lround(v * 255 / 63.0));
}

// The partition tables: every partition uses all its subsets, no two are equal, anchors lie in
// theirs.
TEST(Blocks, PartitionsOfBc7AreWhole)
{
    for (const int subsets : {2, 3}) {
        for (int p = 0; p < 64; ++p) {
            EXPECT_EQ(detail::bc7_subset(subsets, p, 0), 0);
            for (int i = 0; i < subsets; ++i) {
                EXPECT_EQ(detail::bc7_subset(subsets, p, detail::bc7_anchor(subsets, p, i)), i)
                    << p;
            }
            for (int other = 0; other < p; ++other) {
                bool same = true;
                for (int t = 0; t < 16; ++t) {
                    same = same && detail::bc7_subset(subsets, p, t) ==
                                       detail::bc7_subset(subsets, other, t);
                }
                EXPECT_FALSE(same) << p << " " << other;
            }
        }
    }
}

// A mode 6 block written by hand: red 10 to 245 in 16 steps, by the format's text.
TEST(Blocks, Bc7DecodesAHandMadeBlock)
{
    detail::BitWriter bits;
    bits.put(1 << 6, 7);
    for (const int code : {5, 122, 0, 0, 127, 127, 127, 127})
        bits.put(code, 7);  // r, g, b, a pairs
    bits.put(0, 1);         // low bit of the first end
    bits.put(1, 1);         // and of the second
    bits.put(0, 3);
    for (int t = 1; t < 16; ++t) bits.put(t, 4);
    std::array<std::byte, 16> block;
    bits.store(block.data());
    const RawImage image = decode_blocks(block, Block::Bc7, 4, 4);
    const int weights[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
    for (std::size_t t = 0; t < 16; ++t) {
        const int expected = (10 * (64 - weights[t]) + 245 * weights[t] + 32) / 64;
        EXPECT_EQ(static_cast<int>(image.bytes[4 * t]), expected);
        EXPECT_EQ(static_cast<int>(image.bytes[4 * t + 1]), (weights[t] + 32) / 64);
        EXPECT_EQ(static_cast<int>(image.bytes[4 * t + 2]),
                  (254 * (64 - weights[t]) + 255 * weights[t] + 32) / 64);
    }
}

// Bit by bit, as the format's text says it.
detail::Rgba8Block bc7_by_the_text(const std::byte* block)
{
    using namespace detail;
    BitReader bits(block);
    int number = 0;
    while (number < 8 && bits.take(1) == 0) ++number;
    Rgba8Block to{};
    if (number == 8) return to;
    const Bc7Mode& mode = kBc7Modes[number];
    const int partition = bits.take(mode.partition_bits), rotation = bits.take(mode.rotation_bits);
    const bool swapped = bits.take(mode.selector_bits) != 0;
    const auto depth = [&](int c) { return c < 3 ? mode.color_bits : mode.alpha_bits; };
    int end[6][4] = {}, low[6] = {};
    for (int c = 0; c < 4; ++c)
        for (int e = 0; e < 2 * mode.subsets; ++e) end[e][c] = bits.take(depth(c));
    for (int e = 0; e < 2 * mode.subsets; ++e) {
        if (mode.endpoint_p_bits) low[e] = bits.take(1);
        if (mode.shared_p_bits) low[e] = e % 2 ? low[e - 1] : bits.take(1);
        for (int c = 0; c < 4; ++c) {
            const bool has_low = mode.endpoint_p_bits || mode.shared_p_bits;
            end[e][c] = depth(c) == 0 ? 255
                        : has_low     ? bc7_widen(2 * end[e][c] + low[e], depth(c) + 1)
                                      : bc7_widen(end[e][c], depth(c));
        }
    }
    int subset[16], index[16], index2[16];
    for (int t = 0; t < 16; ++t) {
        subset[t] = bc7_subset(mode.subsets, partition, t);
        index[t] = bits.take(mode.index_bits - (t == bc7_anchor(mode.subsets, partition, subset[t])));
    }
    for (int t = 0; t < 16; ++t)
        index2[t] = mode.index2_bits ? bits.take(mode.index2_bits - (t == 0)) : index[t];
    for (int t = 0; t < 16; ++t) {
        int color = bc7_weights(mode.index_bits)[index[t]];
        int alpha = bc7_weights(mode.index2_bits ? mode.index2_bits : mode.index_bits)[index2[t]];
        if (swapped) std::swap(color, alpha);
        auto& texel = to[static_cast<std::size_t>(t)];
        for (std::size_t c = 0; c < 4; ++c)
            texel[c] = static_cast<std::uint8_t>(
                bc7_mix(end[2 * subset[t]][c], end[2 * subset[t] + 1][c], c < 3 ? color : alpha));
        if (rotation) std::swap(texel[3], texel[static_cast<std::size_t>(rotation - 1)]);
    }
    return to;
}

TEST(Blocks, Bc7DecodesAnyBytesAsTheTextSays)
{
    std::uint32_t seed = 77;
    for (int mode = 0; mode <= 8; ++mode) {
        for (int round = 0; round < 3000; ++round) {
            std::array<std::byte, 16> block;
            for (std::byte& byte : block) byte = static_cast<std::byte>(next(seed) >> 24);
            block[0] &= static_cast<std::byte>(0xff << mode);
            if (mode < 8) block[0] |= static_cast<std::byte>(1 << mode);
            detail::Rgba8Block read;
            detail::decode_bc7(block.data(), read);
            ASSERT_EQ(read, bc7_by_the_text(block.data())) << "mode " << mode;
        }
    }
}

// With squared differences as costs the chooser is never worse than the plain encoder; with a cost
// that only counts some texels it serves these.
TEST(Blocks, ChoosesByTheCallersCosts)
{
    std::uint32_t seed = 9;
    for (int round = 0; round < 20; ++round) {
        std::array<std::uint8_t, 16> values;
        for (auto& v : values) v = static_cast<std::uint8_t>(80 + (next(seed) >> 26));
        auto costs = std::make_unique<TexelCosts>();
        for (std::size_t t = 0; t < 16; ++t) {
            for (std::size_t code = 0; code < 256; ++code) {
                const float d = static_cast<float>(code) - static_cast<float>(values[t]);
                (*costs)[t][code] = d * d;
            }
        }
        const Bc4Choice choice = encode_bc4_block(*costs);
        std::array<std::byte, 8> plain;
        const auto block = encode_bc4_block(values, BlockQuality::Normal);
        std::transform(block.begin(), block.end(), plain.begin(),
                       [](std::uint8_t b) { return std::byte{b}; });
        double cost = 0;
        const auto decoded = detail::decode_bc4(plain.data());
        for (std::size_t t = 0; t < 16; ++t) cost += static_cast<double>((*costs)[t][decoded[t]]);
        EXPECT_LE(choice.cost, cost + 2.0) << round;
        std::array<std::byte, 8> chosen;
        std::transform(choice.block.begin(), choice.block.end(), chosen.begin(),
                       [](std::uint8_t b) { return std::byte{b}; });
        EXPECT_EQ(detail::decode_bc4(chosen.data()), choice.values);
        for (std::size_t t = 2; t < 16; ++t) (*costs)[t].fill(0.0f);
        EXPECT_EQ(encode_bc4_block(*costs, 40).cost, 0.0);
    }
}

TEST(Blocks, RefusesWithTheReason)
{
    EXPECT_THROW(encode_blocks(material(4, 4, 3), Block::Bc2), Error);
    EXPECT_THROW(encode_blocks(material(4, 4, 3), Block::Bc6h), Error);  // which wants halves
    EXPECT_THROW(encode_blocks(RawImage{4, 4, 1, PixelType::U16, {}, {}}, Block::Bc4), Error);
    EXPECT_THROW(encode_blocks(RawImage{}, Block::Bc4), Error);
    const std::vector<std::byte> few(15);
    EXPECT_THROW(decode_blocks(few, Block::Bc7, 4, 4), Error);
    EXPECT_THROW(decode_blocks(few, Block::Bc1, 0, 4), Error);
}

// Data without alpha: 254 in its place lets the other channels come closer. Colours stay opaque.
TEST(Blocks, Bc7TakesNoHeedOfAnAlphaThatNobodyReads)
{
    const RawImage brightness = material(64, 64, 1, 5);
    RawImage grey{64, 64, 3, PixelType::U8, {}, {}}, opaque{64, 64, 4, PixelType::U8, {}, {}};
    for (const std::byte byte : brightness.bytes) {
        const std::byte v = static_cast<std::byte>(96 + std::to_integer<int>(byte) / 4);  // a few steps of the line apart, where ends decide
        grey.bytes.insert(grey.bytes.end(), {v, v, v});
        opaque.bytes.insert(opaque.bytes.end(), {v, v, v, std::byte{255}});
    }
    const auto there_and_back = [](const RawImage& image, bool srgb) {
        return decode_blocks(encode_blocks(image, Block::Bc7, {.srgb = srgb}), Block::Bc7, image.width, image.height);
    };
    const auto see_through = [](const RawImage& image) {
        int count = 0;
        for (std::size_t i = 3; i < image.bytes.size(); i += 4) {
            EXPECT_GE(std::to_integer<int>(image.bytes[i]), 254);
            count += image.bytes[i] != std::byte{255};
        }
        return count;
    };
    const RawImage data = there_and_back(grey, false), color = there_and_back(grey, true);
    EXPECT_LT(error(grey, data, 3), 0.9 * error(grey, color, 3));
    EXPECT_GT(see_through(data), 64 * 64 / 10);
    EXPECT_LT(see_through(color), 64 * 64 / 12);
    EXPECT_EQ(there_and_back(opaque, false).bytes, color.bytes) << "an alpha of its own counts";
}

// The corner of a map, 128 x 128.
RawImage corner(const std::filesystem::path& path)
{
    constexpr int kSide = 128;
    const RawImage whole = read_raw(path);
    RawImage image{kSide, kSide, whole.channels, PixelType::U8, {}, {}};
    const std::ptrdiff_t pixel = whole.channels;
    for (int y = 0; y < kSide; ++y) {
        const auto row = whole.bytes.begin() + y * pixel * whole.width;
        image.bytes.insert(image.bytes.end(), row, row + pixel * kSide);
    }
    return image;
}

// Real materials: floors a little below what was measured, so that a step back shows.
TEST(Blocks, QualityOnARealMaterial)
{
    NEED_ASSETS(assets);
    const auto psnr = [](const RawImage& image, Block block, BlockQuality quality = BlockQuality::Normal) {
        return 10 * std::log10(255.0 * 255.0 / round_trip(image, block, {.quality = quality}));
    };
    const RawImage color = corner(assets / "materials/Rock020/Rock020_1K_Color.jpg");
    EXPECT_GT(psnr(color, Block::Bc1), 38.4);
    EXPECT_GT(psnr(color, Block::Bc5), 48.5);
    const auto bc7 = [&](const RawImage& image, double fast, double normal, double best) {
        EXPECT_GT(psnr(image, Block::Bc7, BlockQuality::Fast), fast);
        EXPECT_GT(psnr(image, Block::Bc7), normal);
        EXPECT_GT(psnr(image, Block::Bc7, BlockQuality::Best), best);
    };
    bc7(color, 45.3, 45.4, 45.6);
    bc7(corner(assets / "materials/Rock020/Rock020_1K_Normal.jpg"), 38.7, 39.9, 40.1);
    // Grey and smooth: how the ends round is everything.
    bc7(corner(assets / "materials/Tiles036/Tiles036_1K_Color.jpg"), 60.0, 60.2, 60.3);
    // Three lines a block.
    bc7(corner(assets / "models/dutch_ship_medium/textures/dutch_ship_medium_hull_nor_gl_1k.jpg"), 40.8, 42.1, 42.4);
}

TEST(BlockTable, RowsStandInTheOrderOfTheFormats)
{
    int at = 0;
    for (const detail::BlockRow& row : detail::block_table()) {
        EXPECT_EQ(static_cast<int>(row.block), at++) << row.title;
        EXPECT_FALSE(row.labels.empty()) << row.title;
        for (const detail::BlockLabel& label : row.labels) {
            const bool named = label.dxgi + label.vulkan != 0;  // Basis Universal has no number
            EXPECT_EQ(named, row.block != Block::Uastc) << label.name;
            EXPECT_EQ(texture_format(label.name).block, row.block) << label.name;
        }
    }
}

}  // namespace
}  // namespace petrichor::texproc
