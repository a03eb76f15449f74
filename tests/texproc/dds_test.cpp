#include "texproc/codecs/files/detail/dds.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/input_file.h"
#include "tests/support/assets.h"
#include "tests/texproc/textures.h"
#include "texproc/codecs/files/detail/sha1.h"
#include "texproc/filter/bump_slopes.h"

namespace petrichor::texproc {
namespace {

std::vector<std::byte> whole_file(const MipTexture& texture)
{
    return texture_bytes(texture, "dds");
}

class Dds : public TextureFiles {};

TEST_F(Dds, KeepsEveryFormatBitForBit)
{
    for (const std::string& name : texture_format_names()) {
        const bool srgb =
            name == "rgba8" || name == "bgra8" || name == "bc1" || name == "bc3" || name == "bc7";
        for (int label = 0; label <= (srgb ? 1 : 0); ++label) {
            const MipTexture texture = make_texture(small_chain(21, 10, 4, PixelType::U8),
                                                    {.format = name, .srgb = label == 1});
            if (name == "rgb16" || name == "rgb16f" || name.starts_with("uastc") ||
                name.starts_with("astc")) {  // which the container does not have
                EXPECT_THROW(detail::dds_header(texture, 1), Error) << name;
                continue;
            }
            const MipTexture back = detail::parse_dds(whole_file(texture), {});
            EXPECT_EQ(back.width, 21);
            EXPECT_EQ(back.height, 10);
            EXPECT_EQ(back.levels, texture.levels) << name;
            EXPECT_EQ(back.srgb, label == 1) << name;
            EXPECT_EQ(back.format.block, texture.format.block) << name;
            EXPECT_EQ(back.format.type, texture.format.type) << name;
        }
    }
}

// What Unreal's importers know: DXGI's B8G8R8A8, never the masks of the first version.
TEST_F(Dds, BlueFirstHasTheExtendedHeader)
{
    Image red(4, 4, 4, ColorSpace::Data, 0.0f);
    for (std::size_t i = 0; i < red.pixels.size(); i += 4) red.pixels[i] = red.pixels[i + 3] = 1.0f;
    for (const bool srgb : {false, true}) {
        write_mip_chain(folder / "b.dds", std::vector<RawImage>{to_raw(red, PixelType::U8)},
                        {.format = "bgra8", .srgb = srgb});
        const std::string bytes = petrichor::read_file(folder / "b.dds", "dds", 1 << 20);
        std::uint32_t dxgi = 0;
        std::memcpy(&dxgi, &bytes[128], 4);
        EXPECT_EQ(bytes.substr(84, 4), "DX10");
        EXPECT_EQ(dxgi, srgb ? 91u : 87u);
        EXPECT_EQ(bytes.substr(148, 4), std::string("\0\0\xff\xff", 4));
        const MipTexture back = read_texture(folder / "b.dds");
        EXPECT_EQ(back.srgb, srgb);
        EXPECT_EQ(static_cast<int>(back.levels[0][0]), 255) << "read with red first";
    }
    EXPECT_THROW(
        write_mip_chain(folder / "b.ktx2", std::vector<RawImage>{to_raw(red, PixelType::U8)},
                        {.format = "bgra8"}),
        Error);
}

TEST_F(Dds, GoesThroughTheOneReader)
{
    const auto chain = small_chain(20, 12, 4, PixelType::U8);
    write_mip_chain(folder / "a.dds", chain);
    EXPECT_EQ(read_raw(folder / "a.dds").bytes, chain[0].bytes);
    EXPECT_EQ(read_texture(folder / "a.dds").levels.size(), 5u);
    const auto deep = small_chain(8, 8, 2, PixelType::F16);
    write_mip_chain(folder / "b.dds", deep);
    const RawImage back = read_raw(folder / "b.dds");
    EXPECT_EQ(back.type, PixelType::F16);
    EXPECT_EQ(back.bytes, deep[0].bytes);
    write_image(folder / "c.dds", Image(4, 4, 3, ColorSpace::Linear, 0.5f));
    EXPECT_TRUE(read_texture(folder / "c.dds").srgb);
    EXPECT_EQ(static_cast<int>(read_raw(folder / "c.dds").bytes[0]), 188);
    EXPECT_THROW(write_mip_chain(folder / "c.png", chain), Error);
    EXPECT_THROW(read_texture(folder / "none.dds"), Error);
}

TEST_F(Dds, DamagedFilesAreErrorsNotCrashes)
{
    for (const char* name : {"bc7", "bc1", "rgba8", "rgb8", "rg16f"}) {
        const auto file =
            whole_file(make_texture(small_chain(9, 5, 4, PixelType::U8), {.format = name}));
        const ReadOptions limits{.max_pixels = 1 << 16, .max_bytes = 1 << 20};
        const int good = torture(file, [&](auto bytes) { (void)detail::parse_dds(bytes, limits); });
        EXPECT_EQ(good, 0) << name << ": a cut file was taken for whole";
    }
}

TEST_F(Dds, ATruncatedFileSaysSo)
{
    const auto file =
        whole_file(make_texture(small_chain(64, 64, 4, PixelType::U8), {.format = "bc3"}));
    write_bytes(folder / "cut.dds", std::span(file).first(file.size() - 1));
    try {
        (void)read_raw(folder / "cut.dds");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("truncated"));
    }
}

// Masks of the first version: 5:6:5, 10 bits, grey, blue first.
TEST_F(Dds, ReadsTexelsWithMasks)
{
    const auto file = [](std::uint32_t flags, std::uint32_t bits,
                         std::array<std::uint32_t, 4> masks, std::uint32_t texel) {
        MipTexture texture{1, 1, texture_format("rgba8"), false, {std::vector<std::byte>(4)}};
        std::vector<std::byte> bytes = whole_file(texture);
        const auto put = [&](std::size_t at, std::uint32_t v) { std::memcpy(&bytes[at], &v, 4); };
        put(80, flags);
        put(88, bits);
        for (std::size_t c = 0; c < 4; ++c) put(92 + 4 * c, masks[c]);
        put(128, texel);
        return decode_level(detail::parse_dds(bytes, {}), 0);
    };
    const auto code = [](const RawImage& image, std::size_t i) {
        return static_cast<int>(image.bytes[i]);
    };
    const RawImage narrow =
        file(0x40, 16, {0xf800, 0x7e0, 0x1f, 0}, (10u << 11) | (63u << 5) | 31u);
    ASSERT_EQ(narrow.channels, 3);
    EXPECT_EQ(code(narrow, 0), std::lround(10 * 255 / 31.0));
    EXPECT_EQ(code(narrow, 1), 255);
    const RawImage bgra = file(0x41, 32, {0xff0000, 0xff00, 0xff, 0xff000000u}, 0x80112233u);
    EXPECT_EQ(code(bgra, 0), 0x11);
    EXPECT_EQ(code(bgra, 2), 0x33);
    EXPECT_EQ(code(bgra, 3), 0x80);
    const RawImage ten = file(0x41, 32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000u}, 0xc00003ffu);
    EXPECT_EQ(ten.type, PixelType::U16);
    EXPECT_EQ(code(ten, 0) + 256 * code(ten, 1), 65535);
    const RawImage grey = file(0x20000, 8, {0xff, 0, 0, 0}, 77);
    EXPECT_EQ(grey.channels, 1);
    EXPECT_EQ(code(grey, 0), 77);
}

// Decoded texels beside those of the picture that the files were made from.
TEST_F(Dds, ReadsTheSharedFiles)
{
    NEED_ASSETS(assets);
    const std::filesystem::path shared = assets / "formats/dds";
    const MipTexture srgb = read_texture(shared / "dds_dxgi_bc7_srgb.dds");
    EXPECT_TRUE(srgb.srgb);
    EXPECT_EQ(read_raw(shared / "dds_dxgi_bc7_srgb.dds").channels, 4);
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared)) {
        if (entry.path().extension() != ".dds") continue;
        const RawImage image = read_raw(entry.path());
        EXPECT_GT(image.width, 0);
        ++read;
    }
    EXPECT_EQ(read, 9);
}

TEST_F(Dds, ChainsAreChecked)
{
    auto chain = small_chain(16, 8, 3, PixelType::U8);
    EXPECT_EQ(make_texture(chain).format.channels, 4);
    chain[2].width = 3;
    EXPECT_THROW(make_texture(chain), Error);
    EXPECT_THROW(make_texture({}), Error);
    EXPECT_THROW(texture_format("bc9"), Error);
    EXPECT_THROW(make_texture(small_chain(4, 4, 3, PixelType::U8), {.format = "bc2"}), Error);
}

// A plane, a valley and a normal map: a level's squares less the square of its means are the
// variance of the slopes below it.
TEST(BumpSlopes, LevelsHoldTheMomentsOfSlopes)
{
    Image heights(16, 8, 1, ColorSpace::Data);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            heights.at(x, y, 0) =
                0.25f * static_cast<float>(std::abs(x - 8)) + 0.5f * static_cast<float>(y);
    const std::vector<Image> levels = mip_chain(bump_slopes(heights, Edge::Clamp, Edge::Clamp));
    const float* inside = &levels[0].pixels[6 * (3 * 16 + 3)];
    const float expected[] = {2.75f, -0.25f, 0.5f, 0.0625f, 0.25f, -0.125f};
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(inside[c], expected[c], 1e-6f) << c;
    // Of 16 columns 7 fall and 6 rise by 1/4, one is the bottom, at both edges it is half of that.
    const float* whole = &levels[4].pixels[0];
    EXPECT_NEAR(whole[1], -1.0f / 64.0f, 1e-6f);
    EXPECT_NEAR(whole[3], (13.0f / 16.0f + 2.0f / 64.0f) / 16.0f, 1e-6f);
    Image normal(1, 1, 3, ColorSpace::Data);
    normal.pixels = {0.5f + 0.5f * 0.6f, 0.5f, 0.5f + 0.5f * 0.8f};
    const Image slopes = bump_slopes(normal, Edge::Wrap, Edge::Wrap);
    EXPECT_NEAR(slopes.pixels[1], -0.75f, 1e-5f);
    EXPECT_NEAR(slopes.pixels[3], 0.5625f, 1e-5f);
    EXPECT_THROW(bump_slopes(Image(2, 2, 2, ColorSpace::Data), Edge::Wrap, Edge::Wrap), Error);
}

TEST_F(Dds, ExrHoldsLevelsToo)
{
    const auto chain = small_chain(100, 36, 3, PixelType::F32);
    write_mip_chain(folder / "a.exr", chain);
    const RawImage back = read_raw(folder / "a.exr");
    EXPECT_EQ(back.bytes, chain[0].bytes);
    write_mip_chain(folder / "h.exr", chain, {.format = "rgb16f"});
    EXPECT_EQ(read_raw(folder / "h.exr").type, PixelType::F16);
    EXPECT_THROW(write_mip_chain(folder / "b.exr", std::vector<RawImage>{chain[0]}), Error);
    EXPECT_THROW(write_mip_chain(folder / "b.exr", chain, {.format = "bc7"}), Error);
}

TEST_F(Dds, ExrLevelsTellTheirMeanAndTheNameOfTheirContent)
{
    const auto header_of = [&](float first) {
        std::vector<Image> chain;
        for (const int side : {4, 2, 1}) chain.emplace_back(side, side, 3, ColorSpace::Data, 0.25f);
        chain[0].pixels[0] = first;
        write_mip_chain(folder / "a.exr", chain);
        const std::vector<std::byte> bytes = content_of(folder / "a.exr");
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    const auto value_of = [](const std::string& file, const std::string& name) -> std::string {
        const std::string key = name + std::string("\0string\0", 8);
        const std::size_t at = file.find(key);
        if (at == std::string::npos) return "";
        std::uint32_t length = 0;
        std::memcpy(&length, file.data() + at + key.size(), 4);
        return file.substr(at + key.size() + 4, length);
    };
    const std::string even = header_of(0.25f), again = header_of(0.25f), other = header_of(4.25f);
    EXPECT_EQ(value_of(even, "oiio:AverageColor"), "0.25,0.25,0.25");
    EXPECT_EQ(value_of(even, "oiio:ConstantColor"), "0.25,0.25,0.25");
    EXPECT_EQ(value_of(other, "oiio:AverageColor"), "0.5,0.25,0.25");
    EXPECT_EQ(value_of(other, "oiio:ConstantColor"), "");
    EXPECT_EQ(value_of(even, "oiio:SHA-1").size(), 40u);
    EXPECT_EQ(value_of(even, "oiio:SHA-1"), value_of(again, "oiio:SHA-1"));
    EXPECT_NE(value_of(even, "oiio:SHA-1"), value_of(other, "oiio:SHA-1"));
}

// FIPS 180-4, examples of NIST.
TEST(Sha1, KnownDigests)
{
    const auto digest = [](const std::string& text) {
        return detail::sha1(std::as_bytes(std::span(text)));
    };
    EXPECT_EQ(digest(""), "DA39A3EE5E6B4B0D3255BFEF95601890AFD80709");
    EXPECT_EQ(digest("abc"), "A9993E364706816ABA3E25717850C26C9CD0D89D");
    EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "84983E441C3BD26EBAAE4AA1F95129E5E54670F1");
    EXPECT_EQ(digest(std::string(1000000, 'a')), "34AA973CD4C4DAA4F61EEB2BDBAD27316534016F");
}

// Dithering: exact codes stay, the mean of a ramp is kept, nothing is off by a whole code.
TEST_F(Dds, OrderedDitheringKeepsTheMean)
{
    Image image(64, 64, 1, ColorSpace::Data, 100.25f / 255.0f);
    const RawImage raw = to_raw(image, PixelType::U8, Rounding::Ordered);
    int high = 0;
    for (const std::byte b : raw.bytes) {
        ASSERT_TRUE(b == std::byte{100} || b == std::byte{101});
        high += b == std::byte{101};
    }
    EXPECT_EQ(high, 64 * 64 / 4);
    Image codes(256, 8, 1, ColorSpace::Data);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 256; ++x) codes.at(x, y, 0) = static_cast<float>(x) / 255.0f;
    }
    EXPECT_EQ(to_raw(codes, PixelType::U8, Rounding::Ordered).bytes,
              to_raw(codes, PixelType::U8).bytes);
    // A texel alone has no mean to keep: just below a code, the lowest threshold would make it the next one.
    EXPECT_EQ(to_raw(Image(1, 1, 3, ColorSpace::Data, 127.9f / 255.0f), PixelType::U8, Rounding::Ordered).bytes,
              std::vector<std::byte>(3, std::byte{128}));
}

}  // namespace
}  // namespace petrichor::texproc
