// Blocks that repeat bytes of earlier ones: smaller under zstd, for no more error than was allowed.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {
namespace {

constexpr Block kBlocks[] = {Block::Bc1, Block::Bc3, Block::Bc4,
                             Block::Bc5, Block::Bc7, Block::Uastc};

// Soft slopes with a little noise: what trades well.
RawImage soft(int width, int height, int channels)
{
    RawImage image{width, height, channels, PixelType::U8, {}, {}};
    std::uint32_t seed = 7;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                seed = seed * 1664525u + 1013904223u;
                const double noise = static_cast<double>(seed >> 30);
                image.bytes.push_back(static_cast<std::byte>(
                    120 + 60 * std::sin(0.02 * x + 0.03 * (c + 1) * y) + noise));
            }
        }
    }
    return image;
}

// Squared error of one block, mean over its channels, summed over its texels.
double error_of(const RawImage& image, const RawImage& back, int bx, int by)
{
    double total = 0.0;
    for (int y = 4 * by; y < 4 * by + 4; ++y) {
        for (int x = 4 * bx; x < 4 * bx + 4; ++x) {
            for (int c = 0; c < back.channels; ++c) {
                const auto at = [&](const RawImage& of) {
                    return std::to_integer<int>(
                        of.bytes[static_cast<std::size_t>((y * of.width + x) * of.channels + c)]);
                };
                total += std::pow(at(image) - at(back), 2) / back.channels;
            }
        }
    }
    return total;
}

TEST(Repeat, NoBlockPaysMoreThanItsBitsAreWorth)
{
    constexpr float kPrice = 2.0f;
    for (const Block block : kBlocks) {
        const RawImage image = soft(64, 48, channels_of(block));
        const auto read = [&](float price) {
            return decode_blocks(encode_blocks(image, block, {.repeat = price}), block, 64, 48);
        };
        const RawImage best = read(0.0f), traded = read(kPrice);
        EXPECT_TRUE(best.bytes != traded.bytes) << static_cast<int>(block);
        const double most =
            static_cast<double>(kPrice) * 8.0 * static_cast<double>(block_bytes(block));
        for (int by = 0; by < 12; ++by)
            for (int bx = 0; bx < 16; ++bx)
                EXPECT_LE(error_of(image, traded, bx, by),
                          error_of(image, best, bx, by) + most + 1e-3)
                    << static_cast<int>(block) << " at " << bx << ", " << by;
    }
}

TEST(Repeat, AHigherPriceMakesASmallerFile)
{
    for (const Block block : kBlocks) {
        const RawImage image = soft(96, 96, channels_of(block));
        std::size_t before = 0;
        for (const float price : {0.0f, 2.0f, 16.0f}) {
            std::string name = block == Block::Bc1   ? "bc1"
                               : block == Block::Bc3 ? "bc3"
                               : block == Block::Bc4 ? "bc4"
                               : block == Block::Bc5 ? "bc5"
                               : block == Block::Bc7 ? "bc7"
                                                     : "uastca";
            const MipTexture texture =
                make_texture(std::vector{image}, {.format = name, .repeat = price});
            const std::size_t size = texture_bytes(texture, "ktx2", 18).size();
            if (before > 0) {
                EXPECT_LT(size, before) << name << " at " << price;
            }
            before = size;
        }
    }
}

// However much a bit is worth, no block gets farther off than it may.
TEST(Repeat, ABoundHoldsForEveryBlock)
{
    constexpr float kMost = 3.0f;  // codes
    constexpr double kMostSum = 16.0 * 3.0 * 3.0;
    for (const Block block : kBlocks) {
        RawImage image = soft(96, 64, channels_of(block));
        for (std::size_t i = 3; block == Block::Bc1 && i < image.bytes.size(); i += 4)
            image.bytes[i] = std::byte{255};  // it holds no other
        const auto encoded = [&](float price, float most) {
            return encode_blocks(image, block, {.repeat = price, .repeat_most = most});
        };
        const auto read = [&](const std::vector<std::byte>& bytes) {
            return decode_blocks(bytes, block, 96, 64);
        };
        const RawImage best = read(encoded(0.0f, kMost));
        double last = -1.0;
        for (const float price : {0.0f, 1.0f, 64.0f}) {
            const RawImage traded = read(encoded(price, kMost));
            double sum = 0.0;
            for (int by = 0; by < 16; ++by) {
                for (int bx = 0; bx < 24; ++bx) {
                    const double own = error_of(image, best, bx, by);
                    const double now = error_of(image, traded, bx, by);
                    EXPECT_LE(now, std::max(own, kMostSum) + 1e-3)
                        << static_cast<int>(block) << " at " << bx << ", " << by;
                    sum += now;
                }
            }
            EXPECT_GT(sum, last) << static_cast<int>(block) << " at " << price;
            last = sum;
        }
        EXPECT_NE(encoded(64.0f, kMost), encoded(64.0f, 100.0f));
    }
}

// Three chunks.
TEST(Repeat, SameBytesForAnyThreads)
{
    const RawImage image = soft(1024, 160, 4);
    const auto bytes = [&](int threads) {
        return encode_blocks(image, Block::Bc7,
                             {.quality = BlockQuality::Fast, .repeat = 1.0f, .threads = threads});
    };
    EXPECT_EQ(bytes(1), bytes(3));
}

TEST(Repeat, OpaqueTexelsStayOpaque)
{
    const RawImage image = soft(64, 64, 3);
    for (const Block block : {Block::Bc1, Block::Bc7}) {
        const RawImage back =
            decode_blocks(encode_blocks(image, block, {.repeat = 2.0f}), block, 64, 64);
        for (std::size_t i = 3; i < back.bytes.size(); i += 4)
            EXPECT_EQ(std::to_integer<int>(back.bytes[i]), 255);
    }
}

TEST(Repeat, FormatsThatCannotSaySo)
{
    const RawImage halves = to_raw(to_image(soft(8, 8, 3), ColorSpace::Data), PixelType::F16);
    EXPECT_THROW(encode_blocks(halves, Block::Bc6h, {.repeat = 1.0f}), Error);
    EXPECT_THROW(encode_blocks(soft(8, 8, 4), Block::Bc7, {.repeat = -1.0f}), Error);
    EXPECT_THROW(encode_blocks(soft(8, 8, 4), Block::Bc7, {.repeat = std::nanf("")}), Error);
    EXPECT_THROW(encode_blocks(soft(8, 8, 4), Block::Bc7, {.repeat = 1.0f, .repeat_most = 0.0f}),
                 Error);
}

}  // namespace
}  // namespace petrichor::texproc
