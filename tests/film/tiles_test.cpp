// Pictures in tiles: how they are cut, and that what is made of pieces is what is made of the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "base/hash.h"
#include "film/tiles/tile_plan.h"
#include "texproc/codecs/files/exr_strips.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

std::string bytes_of(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(TilePlan, KeptPartsAreThePictureOnceAndLieWithinTheirWindows)
{
    for (const auto& [width, height, asked] :
         {std::array{200, 150, 64}, {1920, 1080, 480}, {16384, 16384, 0}, {8193, 8193, 0}, {65, 1000, 32}}) {
        const TilePlan plan = plan_tiles(width, height, asked);
        ASSERT_GT(plan.count(), 1);
        std::int64_t pixels = 0;
        int right = 0, low = 0;
        for (int row = 0; row < plan.rows; ++row) {
            for (int column = 0; column < plan.columns; ++column) {
                const auto [window, kept] = tile_at(plan, column, row);
                EXPECT_EQ(kept.x, column * plan.tile);
                EXPECT_EQ(kept.y, row * plan.tile);
                pixels += static_cast<std::int64_t>(kept.width) * kept.height;
                right = std::max(right, kept.x + kept.width);
                low = std::max(low, kept.y + kept.height);
                EXPECT_EQ(window.x % gpu::kTileStep, 0);
                EXPECT_EQ(window.y % gpu::kTileStep, 0);
                EXPECT_EQ(window.width, plan.window_width());
                EXPECT_EQ(window.height, plan.window_height());
                // A whole border, but at the picture's edges.
                EXPECT_LE(window.x, std::max(kept.x - plan.border, 0));
                EXPECT_LE(window.y, std::max(kept.y - plan.border, 0));
                EXPECT_GE(window.x + window.width, std::min(kept.x + kept.width + plan.border, width));
                EXPECT_GE(window.y + window.height, std::min(kept.y + kept.height + plan.border, height));
            }
        }
        EXPECT_EQ(pixels, static_cast<std::int64_t>(width) * height);
        EXPECT_EQ(right, width);
        EXPECT_EQ(low, height);
    }
}

TEST(TilePlan, SmallPicturesAreWholeUnlessAskedFor)
{
    EXPECT_FALSE(is_tiled(4096, 4096, 0));
    EXPECT_TRUE(is_tiled(4097, 4096, 0));
    EXPECT_FALSE(is_tiled(64, 64, 64));
    EXPECT_TRUE(is_tiled(65, 64, 64));
    const TilePlan whole = plan_tiles(640, 360, 0);
    EXPECT_EQ(whole.count(), 1);
    EXPECT_EQ(whole.window_width(), 640);
    EXPECT_EQ(whole.window_height(), 360);
}

TEST(PiecewiseHash, IsThatOfAllBytesAtOnce)
{
    for (const std::size_t size : {8u, 24u, 1016u, 1024u, 1040u, 8u * 333u * 7u}) {
        std::vector<std::byte> bytes(size);
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 37 + i / 251);
        Hasher whole;
        whole.add_bytes(bytes);
        for (const std::size_t piece : {1u, 8u, 333u, 4096u}) {
            PiecewiseHasher pieces(size);
            for (std::size_t at = 0; at < size; at += piece)
                pieces.add(std::span(bytes).subspan(at, std::min(piece, size - at)));
            EXPECT_EQ(pieces.text(), whole.text()) << size << " by " << piece;
        }
    }
}

class TiledFile : public testing::Test {
protected:
    TiledFile() : folder_(std::filesystem::path(testing::TempDir()) / "petrichor_tiles_test")
    {
        std::filesystem::create_directories(folder_);
    }
    ~TiledFile() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

TEST_F(TiledFile, AnExrOfStripsHasTheBytesOfOneInOnePiece)
{
    constexpr int kWidth = 37, kHeight = 83;
    std::vector<texproc::ExrChannel> whole{{"R", std::vector<std::uint16_t>(kWidth * kHeight), {}},
                                           {"depth.Z", {}, std::vector<float>(kWidth * kHeight)}};
    for (std::size_t i = 0; i < whole[0].half_bits.size(); ++i) {
        whole[0].half_bits[i] = static_cast<std::uint16_t>(i * 7 % 20000);
        whole[1].floats[i] = static_cast<float>(i) * 0.25f;
    }
    texproc::write_exr(folder_ / "whole.exr", kWidth, kHeight, whole, {{"software", "test"}});
    {
        texproc::ExrStrips strips(folder_ / "strips.exr", kWidth, kHeight, {{"R", true}, {"depth.Z", false}},
                                  {{"software", "test"}});
        for (int first = 0; first < kHeight; first += 32) {
            const int rows = std::min(32, kHeight - first);
            const auto from = first * kWidth, end = (first + rows) * kWidth;
            strips.write(rows, {{"R", {whole[0].half_bits.begin() + from, whole[0].half_bits.begin() + end}, {}},
                                {"depth.Z", {}, {whole[1].floats.begin() + from, whole[1].floats.begin() + end}}});
            EXPECT_FALSE(std::filesystem::exists(folder_ / "strips.exr"));
        }
        strips.finish();
    }
    EXPECT_EQ(bytes_of(folder_ / "strips.exr"), bytes_of(folder_ / "whole.exr"));
    texproc::ExrStrips early(folder_ / "early.exr", kWidth, kHeight, {{"R", true}}, {});
    EXPECT_THROW(early.finish(), Error);
    EXPECT_THROW(early.write(1, {{"G", std::vector<std::uint16_t>(kWidth), {}}}), Error);
}

TEST_F(TiledFile, APngOfRowsHasTheBytesOfOneInOnePiece)
{
    constexpr int kWidth = 700, kHeight = 900;  // more than a block of the encoder
    std::vector<std::uint8_t> pixels(3u * kWidth * kHeight);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i / 5 + i * i % 13);
    texproc::write_png8(folder_ / "whole.png", kWidth, kHeight, 3, pixels, {{"software", "test"}});
    texproc::write_png8(
        folder_ / "rows.png", kWidth, kHeight, 3,
        [&](std::size_t first, std::size_t end) {
            std::vector<std::byte> rows(3 * kWidth * (end - first));
            std::memcpy(rows.data(), &pixels[3 * kWidth * first], rows.size());
            return rows;
        },
        {{"software", "test"}});
    EXPECT_EQ(bytes_of(folder_ / "rows.png"), bytes_of(folder_ / "whole.png"));
}

}  // namespace
}  // namespace petrichor::film
