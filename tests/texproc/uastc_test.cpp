#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "base/error.h"
#include "tests/support/assets.h"
#include "tests/texproc/textures.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/blocks/detail/decode_block.h"
#include "texproc/codecs/blocks/detail/encode_kernel.h"
#include "texproc/codecs/blocks/detail/uastc_tables.h"
#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::texproc {
namespace {

struct Vector {
    int mode;
    const char* block;      // sixteen bytes
    std::uint32_t hash;     // FNV-1a of the 64 bytes that it stands for
    std::uint8_t texel[4];  // number 5
};
// Random payloads under every mode number, as the transcoder of Basis Universal (three.js r187)
// decodes them to RGBA.
constexpr Vector kVectors[] = {
    {0, "01048ba2e81c7e8c98c80abef712b375", 0xc17815bbu, {247, 28, 186, 255}},
    {0, "61f567f3fea96c7f496cac2716da4f01", 0x73d56543u, {136, 152, 154, 255}},
    {1, "754a92f603c74d52f48baaa89f29edc4", 0x29018a66u, {80, 92, 157, 255}},
    {1, "75b954b693c2713474ab85df64ecbe24", 0xe6d75e8du, {164, 102, 162, 255}},
    {2, "bd595bcbcb2d1e67dfb9893f64ded05f", 0xcf3fa836u, {136, 187, 238, 255}},
    {2, "ddb187e5a1eb62c8d3189e9c1c94e317", 0x99c5a48eu, {26, 116, 139, 255}},
    {3, "6334add2ff00a8055a1b82e9fc4d56ee", 0x3b491f99u, {193, 53, 15, 255}},
    {3, "03a0ab72d924219a93a37375935ca21f", 0xcccfa225u, {187, 225, 69, 255}},
    {4, "532f940019df3fea175a8d013625c538", 0x40b92fd0u, {32, 158, 249, 255}},
    {4, "13549761adb91e189b20641345c54486", 0xeec89c4au, {96, 128, 140, 255}},
    {5, "4b69bbbe20a5fd173d62deee6a976a38", 0x2e46bdd0u, {11, 218, 209, 255}},
    {5, "2bb6bbda4f6b64f72688fcb94b53af63", 0xb30e9a7cu, {253, 70, 111, 255}},
    {6, "db85d5a4beb6f276d501ad0cdd1c8c92", 0x2946f77cu, {167, 96, 171, 255}},
    {6, "fb2e98c1e6252e9077559983b1934958", 0x64f275ffu, {105, 188, 81, 255}},
    {7, "470e755a5833c6da2d7856b42de3c010", 0x7f63ddfeu, {71, 164, 71, 255}},
    {7, "c716789233bd73cf6a97d09ff0386a0e", 0x5fba0b28u, {203, 242, 190, 255}},
    {8, "97dc4afe710b67a549d33783f3d2ee89", 0x37ad9665u, {228, 86, 242, 143}},
    {8, "f76b7e73dbc8a59d7b94a7da068c8109", 0x3a9bdfc5u, {95, 243, 155, 219}},
    {9, "af4eac715e01c5298ccba70fc82cd40b", 0x1fc9021du, {204, 238, 221, 0}},
    {9, "efa03fb15d38c8773103f90df474e992", 0x0230176du, {101, 78, 182, 187}},
    {10, "f21d45b70073e404986d6bd4b332e1b9", 0x27d8a044u, {36, 207, 89, 11}},
    {10, "a2323f60834e592bb7f2a604eb50cc40", 0x9d768953u, {109, 122, 89, 192}},
    {11, "cc09f1778b063bb5a047fe728fe67a1d", 0x00d11455u, {81, 103, 32, 16}},
    {11, "90a1343c6d8e496bcbf443b4ef47490e", 0x3e019036u, {174, 234, 70, 81}},
    {12, "a6d4c1fd899fb6a16b6d8eb00812f725", 0x77872b92u, {26, 105, 58, 179}},
    {12, "867109a18ec3fecdbc1d1732d743725c", 0x0dcedbd4u, {242, 128, 133, 184}},
    {13, "ff45fb39d76bb4105577fd76a342a621", 0x5c1ae384u, {92, 209, 84, 219}},
    {13, "5f2cdd92aef951cc73071dba50f24eec", 0xe13521d1u, {230, 71, 29, 232}},
    {14, "6d2517c0a6d7072e4e80e0cfb3c5c6c8", 0xe29e88a2u, {113, 158, 153, 89}},
    {14, "cd5d03b3e68190c567cf07aadbc6d7e7", 0x70f4feceu, {55, 62, 206, 148}},
    {15, "8544c1c77b98f90cd92881ee65af8b32", 0x754e2da9u, {239, 239, 239, 230}},
    {15, "85960250a7f17bfda7173785cbf5fbd7", 0x2c5b39a0u, {187, 187, 187, 244}},
    {16, "9574dc2d30a4449e0e92de27b5d91fdc", 0x50163510u, {31, 31, 31, 160}},
    {16, "d56b9556b3204997d405c6f248799eac", 0x5c52bf89u, {63, 63, 63, 94}},
    {17, "e58b7b6ff23617bc9966aaf376df9da8", 0xc4b1655cu, {147, 147, 147, 198}},
    {17, "a574ab56222da3a0244280bb4f1094b9", 0xe39ec18du, {18, 18, 18, 25}},
    {18, "8964e8b241cd1723b9d049ee4f2017dc", 0x5f30abd1u, {217, 113, 219, 255}},
    {18, "594d66875f77a60461fce4d0b03da9b5", 0xe14493f6u, {58, 191, 59, 255}},
};

std::vector<std::byte> bytes_of(const char* hex)
{
    std::vector<std::byte> to;
    for (const char* at = hex; *at; at += 2)
        to.push_back(static_cast<std::byte>(std::stoi(std::string(at, 2), nullptr, 16)));
    return to;
}

std::uint32_t fnv(const detail::Rgba8Block& texels)
{
    std::uint32_t hash = 2166136261u;
    for (const auto& texel : texels) {
        for (const std::uint8_t v : texel) hash = (hash ^ v) * 16777619u;
    }
    return hash;
}

TEST(Uastc, DecodesEveryModeAsTheReferenceDoes)
{
    int modes = 0;
    for (const Vector& vector : kVectors) {
        modes |= 1 << vector.mode;
        detail::Rgba8Block texels;
        detail::decode_uastc(bytes_of(vector.block).data(), texels);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(texels[5][c], vector.texel[c]) << vector.mode << " " << vector.block;
        EXPECT_EQ(fnv(texels), vector.hash) << vector.mode << " " << vector.block;
    }
    EXPECT_EQ(modes, (1 << 19) - 1) << "a mode without a vector";
}

TEST(Uastc, WhatIsNoBlockIsTransparentBlack)
{
    std::vector<std::byte> none(16, std::byte{0xff});
    none[0] = std::byte{69};  // a number that no mode has
    detail::Rgba8Block texels;
    detail::decode_uastc(none.data(), texels);
    EXPECT_EQ(fnv(texels), fnv({}));
    none[0] = std::byte{19};  // mode 4, of whose 32 patterns 30 exist
    detail::decode_uastc(none.data(), texels);
    EXPECT_EQ(fnv(texels), fnv({}));
}

// ASTC, "Endpoint unquantization": the ends of every range reach 0 and 255 and are symmetric.
TEST(Uastc, EndsOfEveryRangeAreSymmetric)
{
    for (int r = 0; r < static_cast<int>(detail::kUastcRanges.size()); ++r) {
        std::vector<bool> has(256, false);
        const int levels = detail::kUastcRanges[static_cast<std::size_t>(r)].levels();
        for (int code = 0; code < levels; ++code)
            has.at(static_cast<std::size_t>(detail::uastc_end(code, r))) = true;
        int count = 0;
        for (std::size_t v = 0; v < 256; ++v) {
            count += has[v];
            EXPECT_EQ(has[v], has[255 - v]) << r << " " << v;
        }
        EXPECT_EQ(count, levels) << r;
        EXPECT_TRUE(has[0] && has[255]) << r;
    }
}

RawImage texels(int channels, const std::function<int(int, int)>& value)
{
    RawImage image{4, 4, channels, PixelType::U8, {}, {}};
    for (int t = 0; t < 16; ++t) {
        for (int c = 0; c < channels; ++c) image.bytes.push_back(std::byte(value(t, c)));
    }
    return image;
}

int largest_error(const RawImage& image)
{
    const RawImage back =
        decode_blocks(encode_blocks(image, Block::Uastc), Block::Uastc, image.width, image.height);
    int most = 0;
    for (std::size_t p = 0; p < 16; ++p) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(image.channels); ++c) {
            const std::size_t step = static_cast<std::size_t>(image.channels);
            most = std::max(most, std::abs(static_cast<int>(image.bytes[p * step + c]) -
                                           static_cast<int>(back.bytes[p * 4 + c])));
        }
    }
    return most;
}

TEST(Uastc, ColoursRampsAndMasksComeBack)
{
    for (int v = 0; v < 256; v += 5)
        EXPECT_EQ(largest_error(texels(4, [&](int, int c) { return (v + 60 * c) % 256; })), 0);
    EXPECT_EQ(largest_error(texels(3, [](int t, int) { return t % 2 ? 255 : 0; })), 0);
    EXPECT_LE(largest_error(texels(3, [](int t, int) { return 40 + 8 * t; })), 2) << "grey ramp";
    EXPECT_LE(largest_error(texels(3, [](int t, int c) { return 40 + (c + 3) * t; })), 2);
    EXPECT_LE(largest_error(texels(4, [](int t, int c) { return c < 3 ? 90 : 16 * t; })), 4);
    // A cut-out: a colour under alpha of 0 and 255.
    EXPECT_LE(
        largest_error(texels(4, [](int t, int c) { return c < 3 ? 30 * c + 50 : t / 8 * 255; })),
        1);
}

TEST(Uastc, BytesDoNotDependOnThreadsOrInstructionSet)
{
    const auto chain = small_chain(61, 47, 4, PixelType::U8);
    for (const int channels : {1, 3, 4}) {
        const auto image = small_chain(61, 47, channels, PixelType::U8)[0];
        EXPECT_EQ(encode_blocks(image, Block::Uastc, {.threads = 1}),
                  encode_blocks(image, Block::Uastc, {.threads = 5}));
    }
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
    std::uint32_t seed = 5;
    for (int round = 0; round < 300; ++round) {
        detail::BlockTexels block;
        for (auto& plane : block.plane) {
            for (std::uint8_t& v : plane) {
                seed = seed * 1664525u + 1013904223u;
                v = static_cast<std::uint8_t>(seed >> (round % 3 ? 24 : 28));
            }
        }
        if (round % 2) std::memset(block.plane[3], 255, 16);
        for (const auto quality : {BlockQuality::Fast, BlockQuality::Normal, BlockQuality::Best}) {
            std::array<std::byte, 16> a, b;
            detail::kEncodeKernelBase.uastc(block, {.quality = quality}, a.data());
            detail::kEncodeKernelAvx2.uastc(block, {.quality = quality}, b.data());
            ASSERT_EQ(a, b) << round;
        }
    }
#endif
}

// The container says what KHR_texture_basisu asks for.
TEST(Uastc, FilesAreWhatGltfAsksFor)
{
    for (const bool srgb : {false, true}) {
        const auto file = detail::ktx2_file(
            make_texture(small_chain(16, 8, 4, PixelType::U8), {.format = "uastca", .srgb = srgb}),
            5);
        const auto byte = [&](std::size_t at) { return std::to_integer<int>(file.at(at)); };
        const std::size_t dfd = static_cast<std::size_t>(byte(48) | byte(49) << 8);
        EXPECT_EQ(byte(12) | byte(13), 0) << "no Vulkan format";
        EXPECT_EQ(byte(44), 2) << "zstd";
        EXPECT_EQ(byte(dfd + 12), 166) << "UASTC";
        EXPECT_EQ(byte(dfd + 13), srgb ? 1 : 0) << "primaries";
        EXPECT_EQ(byte(dfd + 14), srgb ? 2 : 1) << "transfer";
        EXPECT_EQ(byte(dfd + 30), 127) << "bits";
        EXPECT_EQ(byte(dfd + 31), 3) << "RGBA";
        EXPECT_EQ(detail::parse_ktx2(file, {}).srgb, srgb);
    }
}

// Floors a little below what was measured, so that a step back shows.
TEST(Uastc, QualityOnARealMaterial)
{
    NEED_ASSETS(assets);
    const auto psnr = [&](const char* name) {
        const RawImage image = read_raw(assets / "materials/Rock020" / name);
        const RawImage back = decode_blocks(encode_blocks(image, Block::Uastc), Block::Uastc,
                                            image.width, image.height);
        double total = 0;
        for (std::size_t p = 0; p < image.bytes.size() / 3; ++p) {
            for (std::size_t c = 0; c < 3; ++c) {
                const int d = static_cast<int>(image.bytes[3 * p + c]) -
                              static_cast<int>(back.bytes[4 * p + c]);
                total += d * d;
            }
        }
        return 10 * std::log10(255.0 * 255.0 * static_cast<double>(image.bytes.size()) / total);
    };
    EXPECT_GT(psnr("Rock020_1K_Color.jpg"), 44.3);   // BC7 45.3
    EXPECT_GT(psnr("Rock020_1K_Normal.jpg"), 36.7);  // BC7 38.4
}

}  // namespace
}  // namespace petrichor::texproc
