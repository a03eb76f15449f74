#include "texproc/codecs/files/detail/ktx2.h"

#include <cstring>
#include <fstream>
#include <initializer_list>
#include <utility>

#include "base/error.h"
#include "tests/texproc/textures.h"

namespace petrichor::texproc {
namespace {

class Ktx2 : public TextureFiles {};

std::uint64_t number(const std::vector<std::byte>& file, std::size_t at, std::size_t size)
{
    std::uint64_t v = 0;
    for (std::size_t i = 0; i < size; ++i)
        v |= static_cast<std::uint64_t>(file.at(at + i)) << (8 * i);
    return v;
}

TEST_F(Ktx2, KeepsEveryFormatBitForBitPlainAndCompressed)
{
    for (const std::string& name : texture_format_names()) {
        for (const int zstd : {0, 3}) {
            const MipTexture texture =
                make_texture(small_chain(21, 10, 4, PixelType::U8), {.format = name});
            const MipTexture back = detail::parse_ktx2(detail::ktx2_file(texture, zstd), {});
            EXPECT_EQ(back.levels, texture.levels) << name;
            EXPECT_EQ(back.format, texture.format) << name;
            EXPECT_EQ(back.width, 21);
            EXPECT_EQ(back.height, 10);
            EXPECT_FALSE(back.srgb);
        }
    }
    for (const char* name : {"r8", "rgba8", "bc1", "bc1a", "bc3", "bc7"}) {
        const MipTexture texture =
            make_texture(small_chain(8, 8, 4, PixelType::U8), {.format = name, .srgb = true});
        EXPECT_TRUE(detail::parse_ktx2(detail::ktx2_file(texture, 0), {}).srgb) << name;
    }
    const MipTexture normal =
        make_texture(small_chain(8, 8, 2, PixelType::U8), {.format = "bc5", .srgb = true});
    EXPECT_THROW(detail::ktx2_file(normal, 0), Error);
}

// The container's rules: levels from the smallest up, each aligned; descriptor sizes; sorted keys.
TEST_F(Ktx2, FollowsTheRulesOfTheContainer)
{
    for (const char* name : {"bc7", "bc1", "rgb8", "rgba16f", "r8", "rgb32f"}) {
        const MipTexture texture =
            make_texture(small_chain(36, 20, 4, PixelType::U8), {.format = name, .srgb = false});
        const auto file = detail::ktx2_file(texture, 0);
        const std::size_t levels = number(file, 40, 4);
        ASSERT_EQ(levels, texture.levels.size());
        const std::size_t texel =
            texture.format.block
                ? block_bytes(*texture.format.block)
                : static_cast<std::size_t>(texture.format.channels) * size_of(texture.format.type);
        std::size_t before = number(file, 56, 4) + number(file, 60, 4);
        for (std::size_t k = levels; k-- > 0;) {
            const std::size_t at = number(file, 80 + 24 * k, 8);
            EXPECT_GE(at, before);
            EXPECT_EQ(at % texel, 0u) << name;
            EXPECT_EQ(at % 4, 0u) << name;
            EXPECT_LT(at - before, 4 * texel);
            before = at + number(file, 88 + 24 * k, 8);
            EXPECT_EQ(number(file, 88 + 24 * k, 8), number(file, 96 + 24 * k, 8));
        }
        EXPECT_EQ(before, file.size());
        const std::size_t dfd = number(file, 48, 4);
        EXPECT_EQ(dfd, 80 + 24 * levels);
        EXPECT_EQ(number(file, dfd, 4), number(file, 52, 4));
        EXPECT_EQ(number(file, dfd + 10, 2) + 4, number(file, 52, 4));
        EXPECT_EQ(number(file, dfd + 20, 8), texel) << "bytes of a texel";
        EXPECT_EQ(number(file, dfd + 14, 1), 1u) << "linear";
    }
    const auto srgb = detail::ktx2_file(
        make_texture(small_chain(4, 4, 4, PixelType::U8), {.format = "rgba8", .srgb = true}), 0);
    const std::size_t dfd = number(srgb, 48, 4);
    EXPECT_EQ(number(srgb, dfd + 14, 1), 2u) << "sRGB";
    EXPECT_EQ(number(srgb, dfd + 28 + 3 * 16 + 3, 1), 0x1fu) << "alpha is linear";
    const std::string text(reinterpret_cast<const char*>(srgb.data()), srgb.size());
    EXPECT_NE(text.find("KTXwriter"), std::string::npos);
    EXPECT_LT(text.find("KTXorientation"), text.find("KTXwriter"));
}

TEST_F(Ktx2, GoesThroughTheOneReader)
{
    const auto chain = small_chain(40, 24, 4, PixelType::U16);
    write_mip_chain(folder / "a.ktx2", chain, {.zstd = 5});
    const RawImage back = read_raw(folder / "a.ktx2");
    EXPECT_EQ(back.type, PixelType::U16);
    EXPECT_EQ(back.bytes, chain[0].bytes);
    EXPECT_THROW(read_raw(folder / "a.ktx2", {.max_pixels = 100}), Error);
    EXPECT_THROW(write_mip_chain(folder / "a.ktx2", chain, {.zstd = 30}), Error);
    EXPECT_THROW(write_mip_chain(folder / "a.dds", chain, {.zstd = 5}), Error);
    write_mip_chain(folder / "b.ktx2", chain, {.format = "bc7"});
    EXPECT_EQ(read_raw(folder / "b.ktx2").channels, 4);
}

TEST_F(Ktx2, SaysHowManyImagesAFileHolds)
{
    const auto chain = small_chain(8, 8, 4, PixelType::U8);
    const auto images_of = [&](std::vector<std::byte> bytes, const char* name, std::initializer_list<std::pair<std::size_t, int>> changes) {
        for (const auto& [at, value] : changes) bytes[at] = static_cast<std::byte>(value);
        std::ofstream(folder / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return images_of_texture(folder / name);
    };
    const auto ktx2 = texture_bytes(make_texture(chain, {.format = "rgba8"}), "ktx2");
    EXPECT_EQ(images_of(ktx2, "one.ktx2", {}), 1u);
    EXPECT_EQ(images_of(ktx2, "array_of_cubes.ktx2", {{32, 3}, {36, 6}}), 18u);
    const auto dds = texture_bytes(make_texture(chain, {.format = "bc7"}), "dds");
    EXPECT_EQ(images_of(dds, "one.dds", {}), 1u);
    EXPECT_EQ(images_of(dds, "array.dds", {{140, 5}}), 5u);
    EXPECT_EQ(images_of(dds, "cubes.dds", {{140, 2}, {136, 4}}), 12u);
    const auto old = texture_bytes(make_texture(chain, {.format = "bc1"}), "dds");
    if (std::memcmp(old.data() + 84, "DX10", 4) != 0) {
        EXPECT_EQ(images_of(old, "cube.dds", {{113, 0xfe}}), 6u);
    }
    EXPECT_EQ(images_of({std::byte{1}}, "short", {}), 1u);
    EXPECT_EQ(images_of_texture(folder / "gone"), 1u);
}

TEST_F(Ktx2, DamagedFilesAreErrorsNotCrashes)
{
    for (const char* name : {"bc7", "rgba8"}) {
        for (const int zstd : {0, 3}) {
            const auto file = detail::ktx2_file(
                make_texture(small_chain(9, 5, 4, PixelType::U8), {.format = name}), zstd);
            const ReadOptions limits{.max_pixels = 1 << 16, .max_bytes = 1 << 20};
            const int good =
                torture(file, [&](auto bytes) { (void)detail::parse_ktx2(bytes, limits); });
            EXPECT_EQ(good, 0) << name << " " << zstd;
        }
    }
}

// A few bytes that claim a huge texture, compressed: refused before memory is taken.
TEST_F(Ktx2, ASmallFileCannotAskForMuch)
{
    auto file = detail::ktx2_file(make_texture(small_chain(4, 4, 4, PixelType::U8)), 3);
    const std::uint32_t huge = 1u << 19;
    std::memcpy(&file[20], &huge, 4);
    std::memcpy(&file[24], &huge, 4);
    EXPECT_THROW(detail::parse_ktx2(file, {}), std::runtime_error);
}

}  // namespace
}  // namespace petrichor::texproc
