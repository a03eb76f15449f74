// KTX2 in ETC1S (BasisLZ): files of Basis Universal's encoder, as its transcoder decodes them.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>

#include "texproc/codecs/files/detail/basis_lz.h"
#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {
namespace {

// A picture of 20 x 13 texels with a ramp, an edge, a chequer and alpha (basisu 1.16: -ktx2 -mipmap -q 128), and the same
// without alpha as data (-ktx2 -linear).
constexpr const char* kWithAlpha =
    "ab4b5458203230bb0d0a1a0a0000000001000000140000000d0000000000000000000000010000000500000001000000"
    "c80000003c000000040100002400000028010000000000009f01000000000000e2020000000000001f00000000000000"
    "0000000000000000d5020000000000000d000000000000000000000000000000cf020000000000000600000000000000"
    "0000000000000000cb0200000000000004000000000000000000000000000000c7020000000000000400000000000000"
    "00000000000000003c0000000000000002003800a301020003030000000000000000000000003f000000000000000000"
    "ffffffff40003f0f0000000000000000ffffffff1f0000004b545877726974657200426173697320556e697665727361"
    "6c20312e3136000028001b00820000006000000045000000000000000000000000000000160000001600000009000000"
    "000000000000000007000000070000000600000000000000000000000300000003000000030000000000000000000000"
    "020000000200000002000000000000000000000002000000020000000200000016c01b80010004413a89a371942808f0"
    "0862000461d846d786659ec418820f1dc01b0001000461d229cec3e54812019800000080200880d0afb8e770c22230c4"
    "68e9efa07cfb866c4b47192b0c2e1a2c3fd1b7e9f9919d7c4d9cba9c884412c9c26d4191945da6c6ddf493bd011649d3"
    "7bffd5772aeda9f75695376af3d8e75b070f0008e2060802411045df9ff98120c220176c7089150856b005186831e696"
    "60626e29579217dfc2a1a2a2a21211012490f447ef5455956d4b52028a88d65a93a497247b9ebf9793f93ca76eb2d6fb"
    "641228f4bf1ee1fd5b80658791631cb6db1901c19c800100804100a6921be50b523a1460128000080241006caea0fef5"
    "0d45d4e5021ac90ec010343dd2f3f518b43e2006cc840d3c847558006600000000000090070400f6064200e6019604fa"
    "8d010618013e518f7372a108fd4f302ba60c8e0fbee0fd86fb5524fbc5633327b7965a8bc0898f017d01962f3b46ab2e"
    "39";
constexpr const char* kOpaque =
    "ab4b5458203230bb0d0a1a0a0000000001000000140000000d0000000000000000000000010000000100000001000000"
    "680000002c0000009400000024000000b800000000000000ee00000000000000a6010000000000001000000000000000"
    "00000000000000002c0000000000000002002800a301010003030000000000000000000000003f000000000000000000"
    "ffffffff1f0000004b545877726974657200426173697320556e6976657273616c20312e313600001300100056000000"
    "3c0000003400000000000000000000000000000010000000000000000000000017401c000100004198517e41c74210e0"
    "11800000c1c0e14ea6e4b1425803019e300c00000862460f2622c30098000000002004801ab38eb1005dd954b4633b46"
    "b81417f4918678f15c48aef3acf2c19e777edf6a10133007de06088040104b4c2708378043c4561062ffc5ad69f743fc"
    "2a565555d7cfe94a1292b4ed055fcbef788e114822800de9ee82249d0501c2ffdd3b01c144000000000000f25fcd0430"
    "07600000200086e9e116ab011a09080030a4566be3802337bc000900260000000000001040008648a188ef1aa81d81c1"
    "b67ded95f919";
// FNV-1a of the RGBA texels of each level, by the transcoder in three.js r187.
constexpr std::uint32_t kLevels[] = {0x0a317b8du, 0xa0200105u, 0x5c1c8003u, 0x4ce55165u, 0x25398d28u};
constexpr std::uint32_t kOpaqueLevel = 0x638b88d3u;

std::vector<std::byte> bytes_of(const char* hex)
{
    std::vector<std::byte> to;
    for (const char* at = hex; *at; at += 2)
        to.push_back(static_cast<std::byte>(std::stoi(std::string(at, 2), nullptr, 16)));
    return to;
}

std::uint32_t fnv_of_rgba(const MipTexture& texture, std::size_t level)
{
    std::uint32_t hash = 2166136261u;
    const auto& bytes = texture.levels[level];
    const std::size_t channels = static_cast<std::size_t>(texture.format.channels);
    for (std::size_t i = 0; i < bytes.size(); i += channels)
        for (std::size_t c = 0; c < 4; ++c) {
            const std::uint32_t code =
                c < channels ? std::to_integer<std::uint32_t>(bytes[i + c]) : 255u;
            hash = (hash ^ code) * 16777619u;
        }
    return hash;
}

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value)
{
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

// The message with which a changed file is refused; "" when it is read.
std::string refusal(const std::function<void(std::vector<std::byte>&)>& change)
{
    auto bytes = bytes_of(kWithAlpha);
    change(bytes);
    try {
        detail::parse_ktx2(bytes, {});
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(Etc1s, LevelsAreThoseOfTheTranscoder)
{
    const MipTexture texture = detail::parse_ktx2(bytes_of(kWithAlpha), {});
    EXPECT_EQ(texture.width, 20);
    EXPECT_EQ(texture.height, 13);
    EXPECT_EQ(name_of(texture.format), "rgba8");
    EXPECT_TRUE(texture.srgb);
    ASSERT_EQ(texture.levels.size(), std::size(kLevels));
    for (std::size_t k = 0; k < std::size(kLevels); ++k)
        EXPECT_EQ(fnv_of_rgba(texture, k), kLevels[k]) << k;
    // Every block is near the picture that was encoded, to which the hashes are blind.
    const RawImage top = decode_level(texture, 0);
    for (int x : {2, 10, 18})
        EXPECT_NEAR(std::to_integer<int>(top.bytes[static_cast<std::size_t>(4 * x + 3)]),
                    255 * (x + 1) / 21, 24);
}

TEST(Etc1s, WithoutAlphaThereAreThreeChannelsOfData)
{
    const MipTexture texture = detail::parse_ktx2(bytes_of(kOpaque), {});
    EXPECT_EQ(name_of(texture.format), "rgb8");
    EXPECT_FALSE(texture.srgb);
    ASSERT_EQ(texture.levels.size(), 1u);
    EXPECT_EQ(fnv_of_rgba(texture, 0), kOpaqueLevel);
}

// Channels of the planes: the descriptor's samples of 16 bytes from byte 28 of it on, type in the low bits of byte 3.
TEST(Etc1s, PlanesMeanWhatTheDescriptorSays)
{
    auto bytes = bytes_of(kWithAlpha);
    std::uint32_t descriptor = 0;
    std::memcpy(&descriptor, bytes.data() + 48, 4);
    const auto channel = [&](std::size_t plane, int type) {
        bytes[descriptor + 28 + 3 + 16 * plane] = static_cast<std::byte>(type);
    };
    channel(0, 3);
    channel(1, 4);
    EXPECT_EQ(name_of(detail::parse_ktx2(bytes, {}).format), "rg8");
    channel(1, 15);
    EXPECT_THROW(detail::parse_ktx2(bytes, {}), std::runtime_error);
    channel(0, 0);
    EXPECT_EQ(name_of(detail::parse_ktx2(bytes, {}).format), "rgba8");
    EXPECT_NE(refusal([&](auto& b) { b[descriptor + 12] = std::byte{167}; }).find("not ETC1S"),
              std::string::npos);
}

TEST(Etc1s, DamageIsNamed)
{
    std::uint32_t shared = 0;
    std::memcpy(&shared, bytes_of(kWithAlpha).data() + 64, 4);
    EXPECT_NE(refusal([&](auto& b) { put(b, shared, 0); }).find("no colours"), std::string::npos);
    EXPECT_NE(refusal([&](auto& b) { put(b, shared + 20, 2); }).find("one before it"),
              std::string::npos);
    EXPECT_NE(refusal([&](auto& b) { put(b, shared + 36, 0); }).find("two planes"),
              std::string::npos);
    EXPECT_NE(refusal([&](auto& b) { put(b, shared + 24, 1u << 30); }).find("truncated"),
              std::string::npos);
    EXPECT_NE(refusal([&](auto& b) { put(b, 32, 1u << 30); }).find("images"), std::string::npos);
}

// Whatever a bit does, the file is read or refused; a shorter one is never read past its end.
TEST(Etc1s, AnyBitMayBeWrong)
{
    const auto whole = bytes_of(kWithAlpha);
    int refused = 0;
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit)
        refused += refusal([&](auto& b) { b[bit / 8] ^= std::byte(1 << (bit % 8)); }).empty() ? 0 : 1;
    EXPECT_GT(refused, 1000);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::vector<std::byte> cut(whole.begin(),
                                         whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_THROW(detail::parse_ktx2(cut, {}), std::runtime_error) << size;
    }
}

TEST(Etc1s, HuffmanCodesAreWhole)
{
    using Lengths = std::vector<std::uint8_t>;
    const detail::BasisLzCode code(Lengths{2, 0, 1, 2});
    EXPECT_EQ(code.symbols, (std::vector<std::uint16_t>{2, 0, 3}));
    EXPECT_THROW(detail::BasisLzCode(Lengths{1, 1, 1}), std::runtime_error);
    EXPECT_THROW(detail::BasisLzCode(Lengths{1, 2, 2, 2}), std::runtime_error);
}

}  // namespace
}  // namespace petrichor::texproc
