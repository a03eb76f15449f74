#include "texproc/material/pack.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"

namespace petrichor::texproc {
namespace {

RawImage grey8(std::initializer_list<int> codes)
{
    RawImage image{static_cast<int>(codes.size()), 1, 1, PixelType::U8, {}, {}};
    for (const int c : codes) image.bytes.push_back(static_cast<std::byte>(c));
    return image;
}

RawImage grey16(std::initializer_list<int> codes)
{
    RawImage image{static_cast<int>(codes.size()), 1, 1, PixelType::U16, {}, {}};
    image.bytes.resize(2 * codes.size());
    std::size_t i = 0;
    for (const int c : codes) {
        const auto code = static_cast<std::uint16_t>(c);
        std::memcpy(&image.bytes[2 * i++], &code, 2);
    }
    return image;
}

int code(const RawImage& image, std::size_t value)
{
    if (image.type == PixelType::U8) return static_cast<int>(image.bytes[value]);
    std::uint16_t c;
    std::memcpy(&c, &image.bytes[2 * value], 2);
    return c;
}

TEST(Pack, HdrpMaskCopiesCodesAndFillsWhatIsMissing)
{
    const auto out = pack(pack_preset("unity-hdrp-mask"),
                          {{"metallic", grey8({1, 2})}, {"roughness", grey8({10, 255})}});
    ASSERT_EQ(out.channels, 4);
    const int wanted[8] = {1, 255, 255, 245, 2, 255, 255, 0};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(code(out, i), wanted[i]) << i;
}

TEST(Pack, GltfOrm)
{
    const auto out =
        pack(pack_preset("gltf-orm"), {{"smoothness", grey8({55})}, {"occlusion", grey8({7})}});
    ASSERT_EQ(out.channels, 3);
    EXPECT_EQ(code(out, 0), 7);
    EXPECT_EQ(code(out, 1), 200);
    EXPECT_EQ(code(out, 2), 0);
}

TEST(Pack, DepthsMixWithoutLosingACode)
{
    const auto out =
        pack(pack_preset("gltf-orm"), {{"roughness", grey16({513})}, {"metallic", grey8({3})}});
    EXPECT_EQ(out.type, PixelType::U16);
    EXPECT_EQ(code(out, 1), 513);
    EXPECT_EQ(code(out, 2), 3 * 257);
    const auto narrow = pack(pack_preset("gltf-orm"), {{"roughness", grey16({513})}}, 8);
    EXPECT_EQ(code(narrow, 1), 2);
}

TEST(Pack, AMapWithoutTheChannelGivesWayToTheNextAlternative)
{
    const PackPreset preset{"alpha", "", {"albedo.r", "opacity | albedo.a | 1"}, {}};
    RawImage rgb{1, 1, 3, PixelType::U8, {}, {std::byte{9}, std::byte{8}, std::byte{7}}};
    EXPECT_EQ(code(pack(preset, {{"albedo", rgb}}), 1), 255);
    RawImage rgba{
        1, 1, 4, PixelType::U8, {}, {std::byte{9}, std::byte{8}, std::byte{7}, std::byte{6}}};
    EXPECT_EQ(code(pack(preset, {{"albedo", rgba}}), 1), 6);
    EXPECT_EQ(code(pack(preset, {{"albedo", rgba}, {"opacity", grey8({33})}}), 1), 33);
}

TEST(Pack, FloatsStayFloatsWhenAsked)
{
    Image half(2, 1, 1, ColorSpace::Data);
    half.pixels = {0.125f, 1.75f};
    const RawImage out =
        pack({"x", "", {"height", "1 - roughness", "0.25"}, {}},
             {{"height", to_raw(half, PixelType::F32)}, {"roughness", grey8({51, 255})}}, 32);
    ASSERT_EQ(out.type, PixelType::F32);
    const Image image = to_image(out, ColorSpace::Data);
    EXPECT_EQ(image.at(1, 0, 0), 1.75f);
    EXPECT_FLOAT_EQ(image.at(0, 0, 1), 0.8f);
    EXPECT_EQ(image.at(0, 0, 2), 0.25f);
}

TEST(Pack, BytesDoNotDependOnThreads)
{
    RawImage big{67, 129, 1, PixelType::U16, {}, {}};
    big.bytes.resize(big.values() * 2);
    for (std::size_t i = 0; i < big.bytes.size(); ++i)
        big.bytes[i] = static_cast<std::byte>(i * 31 + i / 7);
    const std::map<std::string, RawImage> maps{{"roughness", big}, {"metallic", big}};
    const RawImage one = pack(pack_preset("gltf-orm"), maps, 8, 1);
    EXPECT_EQ(one.bytes, pack(pack_preset("gltf-orm"), maps, 8, 5).bytes);
}

// Four greys of the packed type are written in one sweep; in one channel of a colour image the same
// codes go channel by channel.
TEST(Pack, GreysPackLikeTheSameChannelsOfColours)
{
    for (const PixelType type : {PixelType::U8, PixelType::U16}) {
        std::map<std::string, RawImage> greys, colours;
        int seed = 1;
        for (const char* role : {"metallic", "occlusion", "detail", "roughness"}) {
            RawImage grey{37, 5, 1, type, {}, {}}, colour{37, 5, 3, type, {}, {}};
            const std::size_t bytes = size_of(type);
            for (std::size_t i = 0; i < grey.values() * bytes; ++i)
                grey.bytes.push_back(static_cast<std::byte>(i * 73 + i / 11 * 5 + seed * 41));
            for (std::size_t i = 0; i < grey.values() * 3; ++i)
                for (std::size_t b = 0; b < bytes; ++b)
                    colour.bytes.push_back(grey.bytes[i / 3 * bytes + b]);
            ++seed;
            // The fill of a channel without a map, and its inverse, are swept too.
            if (std::string(role) == "detail") continue;
            greys.emplace(role, grey);
            colours.emplace(role, colour);
        }
        const PackPreset preset = pack_preset("unity-hdrp-mask");
        const RawImage swept = pack(preset, greys, 0, 2), single = pack(preset, colours, 0, 2);
        EXPECT_EQ(swept.type, type);
        EXPECT_EQ(swept.bytes, single.bytes);
    }
}

// Every preset: what was packed comes back, bit for bit.
TEST(Pack, UnpackIsTheInverse)
{
    for (const PackPreset& preset : pack_presets()) {
        std::map<std::string, RawImage> maps;
        int n = 3;
        for (const std::string& text : preset.channels) {
            const PackSource source = parse_pack_channel(text).front();
            if (source.role.empty()) continue;
            RawImage& map = maps[source.role];
            if (map.bytes.empty()) {
                map = RawImage{2, 1, 4, PixelType::U8, {}, {}};
                for (int i = 0; i < 8; ++i) map.bytes.push_back(static_cast<std::byte>(n += 11));
            }
        }
        const auto back = unpack(preset, pack(preset, maps));
        EXPECT_FALSE(back.empty()) << preset.name;
        for (const auto& [name, image] : back) {
            const std::size_t dot = name.find('.');
            const int channel =
                dot == std::string::npos
                    ? 0
                    : static_cast<int>(std::string("rgba").find(name.substr(dot + 1)));
            EXPECT_EQ(image.bytes, channel_of(maps.at(name.substr(0, dot)), channel).bytes)
                << preset.name << " " << name;
        }
    }
}

TEST(Pack, ReadsChannelTexts)
{
    const PackChannel c = parse_pack_channel("albedo.g | 1 - roughness|0.25");
    ASSERT_EQ(c.size(), 3u);
    EXPECT_EQ(c[0].role, "albedo");
    EXPECT_EQ(c[0].channel, 1);
    EXPECT_TRUE(c[1].invert);
    EXPECT_EQ(c[1].role, "roughness");
    EXPECT_EQ(c[2].constant, 0.25);
    for (const char* bad : {"", "2", "-1", "1 +a", "a.x", "a.rg", "a||b", "Rough ness", "2 - a"}) {
        EXPECT_THROW(parse_pack_channel(bad), Error) << bad;
    }
}

TEST(Pack, RefusesWhatDoesNotFit)
{
    EXPECT_THROW(pack_preset("unity"), Error);
    EXPECT_THROW(pack(pack_preset("gltf-orm"), {}), Error);
    EXPECT_THROW(
        pack(pack_preset("gltf-orm"), {{"roughness", grey8({1, 2})}, {"metallic", grey8({1})}}),
        Error);
    EXPECT_THROW(pack(pack_preset("normal-rg"), {{"roughness", grey8({1})}}), Error);
    EXPECT_THROW(pack(pack_preset("normal-rg"), {{"normal", grey8({1})}}), Error);
}

// docs/lux.md, 7.
TEST(Pack, HoldsTheLayoutsOfLux)
{
    const auto one = [](int value) {
        return RawImage{1, 1, 1, PixelType::U8, {}, {static_cast<std::byte>(value)}};
    };
    const RawImage tangent{1, 1, 3, PixelType::U8, {}, {std::byte{8}, std::byte{9}, std::byte{10}}};
    const std::map<std::string, RawImage> maps{
        {"puddle", one(1)},    {"height", one(2)},    {"mix", one(3)},
        {"secondheight", one(4)},  {"occlusion", one(5)}, {"translucency", one(6)},
        {"curvature", one(7)}, {"tangent", tangent},  {"detail", one(11)}};
    const auto packed = [&](const char* preset) {
        std::vector<int> values;
        for (const std::byte b : pack(pack_preset(preset), maps).bytes)
            values.push_back(std::to_integer<int>(b));
        return values;
    };
    EXPECT_EQ(packed("lux-height"), (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(packed("lux-combined"), (std::vector<int>{0, 5, 6}));
    EXPECT_EQ(packed("lux-skin"), (std::vector<int>{0, 6, 7, 5}));
    EXPECT_EQ(packed("lux-tangent"), (std::vector<int>{255, 9, 255, 8}));
    EXPECT_EQ(packed("lux-occlusion"), (std::vector<int>{0, 5, 0}));
    EXPECT_EQ(packed("lux-detail-mask"), (std::vector<int>{0, 3, 0, 11}));
}

}  // namespace
}  // namespace petrichor::texproc
