// ASTC: blocks of known colours, round trips, files of KTX2. Without the library for it: that it says so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/generate/generate.h"

namespace petrichor::texproc {
namespace {

struct Size {
    Block block;
    int side;
    const char* name;
    std::uint32_t vulkan, vulkan_srgb;
    double least_db;  // of the colour of cobbles
};
constexpr Size kSizes[] = {{Block::Astc4, 4, "astc-4x4", 157, 158, 38.0},
                           {Block::Astc5, 5, "astc-5x5", 161, 162, 34.0},
                           {Block::Astc6, 6, "astc-6x6", 165, 166, 31.0},
                           {Block::Astc8, 8, "astc-8x8", 171, 172, 27.0}};

RawImage cobbles(int size = 128)
{
    return to_raw(generate_material(MaterialKind::Cobble, size, 1, 1).albedo, PixelType::U8);
}

double psnr(const RawImage& a, const RawImage& b)
{
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; 3 * i < a.bytes.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c, ++count) {
            const double d = std::to_integer<int>(a.bytes[3 * i + c]) - std::to_integer<int>(b.bytes[4 * i + c]);
            squares += d * d;
        }
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(count) / squares);
}

std::uint32_t word(const std::vector<std::byte>& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes[at], 4);
    return value;
}

class Astc : public testing::Test {
protected:
    void SetUp() override
    {
        if (!has_astc()) GTEST_SKIP() << "built without Arm's library for ASTC (libastcenc-dev)";
    }
};

TEST(AstcBlocks, KnowTheirSizeAndWhetherTheyCanBeMade)
{
    for (const Size& size : kSizes) {
        EXPECT_EQ(block_side(size.block), size.side);
        EXPECT_EQ(block_bytes(size.block), 16u);
        EXPECT_EQ(blocks_size(size.block, size.side + 1, 2 * size.side), 16u * 4);
        EXPECT_EQ(texture_format(size.name).block, size.block);
        if (!has_astc()) {
            EXPECT_THROW(encode_blocks(cobbles(16), size.block), Error);
            EXPECT_THROW(decode_blocks(std::vector<std::byte>(16), size.block, 1, 1), Error);
        }
    }
}

// A void extent (Khronos Data Format 1.3, 23.22): one colour in 16 bits a channel.
TEST_F(Astc, ABlockOfOneColorIsThat)
{
    std::vector<std::byte> block;
    for (const int b : {0xfc, 0xfd, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x33, 0x33, 0x99, 0x99, 0xff, 0xff, 0, 0x80})
        block.push_back(static_cast<std::byte>(b));
    for (const Size& size : kSizes) {
        const RawImage image = decode_blocks(block, size.block, size.side, size.side);
        const int color[] = {0x33, 0x99, 0xff, 0x80};
        for (std::size_t i = 0; i < image.bytes.size(); ++i)
            EXPECT_NEAR(std::to_integer<int>(image.bytes[i]), color[i % 4], 1) << size.name;
    }
}

TEST_F(Astc, KeepsPicturesTheBetterTheSmallerItsBlocks)
{
    const RawImage image = cobbles();
    double before = 100.0;
    for (const Size& size : kSizes) {
        const auto bytes = encode_blocks(image, size.block, {.srgb = true});
        const double db = psnr(image, decode_blocks(bytes, size.block, 128, 128, BlockSign::Unsigned, 0, true));
        EXPECT_GT(db, size.least_db) << size.name;
        EXPECT_LT(db, before);
        before = db;
        EXPECT_EQ(bytes, encode_blocks(image, size.block, {.srgb = true, .threads = 1})) << "any number of threads";
        EXPECT_EQ(bytes, encode_blocks(image, size.block, {.srgb = true, .threads = 7}));
    }
    const auto fast = encode_blocks(image, Block::Astc6, {.quality = BlockQuality::Fast});
    const auto best = encode_blocks(image, Block::Astc6, {.quality = BlockQuality::Best});
    EXPECT_GT(psnr(image, decode_blocks(best, Block::Astc6, 128, 128)), psnr(image, decode_blocks(fast, Block::Astc6, 128, 128)));
}

// Sides that are no multiples, one to four channels.
TEST_F(Astc, OddSizesAndFewChannels)
{
    for (const Size& size : kSizes) {
        for (int channels = 1; channels <= 4; ++channels) {
            RawImage image{13, 7, channels, PixelType::U8, {}, {}};
            image.bytes.assign(image.values(), std::byte{90});
            const RawImage back = decode_blocks(encode_blocks(image, size.block), size.block, 13, 7);
            ASSERT_EQ(back.bytes.size(), 4u * 13 * 7);
            const int wanted[] = {90, 90, channels == 2 ? 0 : 90, channels > 3 ? 90 : 255};
            for (std::size_t i = 0; i < back.bytes.size(); ++i)
                EXPECT_NEAR(std::to_integer<int>(back.bytes[i]), wanted[i % 4], 1) << size.name << " " << channels;
        }
    }
}

// Whatever the bytes are: no crash, and every texel is written.
TEST_F(Astc, AnyBytesAreDecoded)
{
    std::uint32_t state = 12345;
    std::vector<std::byte> bytes(16 * 64 * 64);
    for (std::byte& b : bytes) {
        state = state * 1664525u + 1013904223u;
        b = static_cast<std::byte>(state >> 24);
    }
    for (const Size& size : kSizes) {
        const int side = 64 * size.side;
        const RawImage image = decode_blocks(bytes, size.block, side, side);
        EXPECT_EQ(image.bytes.size(), 4u * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        EXPECT_THROW(decode_blocks(bytes, size.block, side + 1, side), Error) << "a block short";
    }
}

TEST_F(Astc, FilesOfKtx2SayWhatIsInThem)
{
    const RawImage level0 = cobbles(32);
    for (const Size& size : kSizes) {
        for (const bool srgb : {false, true}) {
            const std::vector<RawImage> levels{level0};
            const MipTexture texture = make_texture(levels, {.format = size.name, .srgb = srgb});
            const auto file = texture_bytes(texture, "ktx2", 5);
            EXPECT_EQ(word(file, 12), srgb ? size.vulkan_srgb : size.vulkan);
            const std::size_t dfd = word(file, 48) + 4;
            EXPECT_EQ(std::to_integer<int>(file[dfd + 8]), 162) << "colour model";
            EXPECT_EQ(std::to_integer<int>(file[dfd + 10]), srgb ? 2 : 1) << "transfer";
            EXPECT_EQ(word(file, dfd + 12), static_cast<std::uint32_t>((size.side - 1) * 257)) << "texel block";
            EXPECT_EQ(std::to_integer<int>(file[dfd + 26]), 127) << "bits of the sample, less one";
            const MipTexture back = decode_texture(file, "file");
            EXPECT_EQ(name_of(back.format), size.name);
            EXPECT_EQ(back.srgb, srgb);
            EXPECT_EQ(back.levels, texture.levels);
            EXPECT_GT(psnr(level0, decode_level(back, 0)), size.least_db - 4.0);
            EXPECT_THROW(texture_bytes(texture, "dds"), Error) << "DXGI has no name for it";
        }
    }
}

}  // namespace
}  // namespace petrichor::texproc
