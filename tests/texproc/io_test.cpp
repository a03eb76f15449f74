#include "texproc/codecs/files/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "tests/support/assets.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {
namespace {

namespace fs = std::filesystem;

class Io : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder = fs::temp_directory_path() /
                 ("petrichor-io-" + std::string(info->name()) + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path write_file(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder / name, std::ios::binary) << content;
        return folder / name;
    }

    fs::path folder;
};

// Every code once, and rows that differ, so that filters and blocks are all used.
RawImage ramp(int width, int height, int channels, PixelType type)
{
    RawImage image{width, height, channels, type, {}, {}};
    image.bytes.resize(image.values() * size_of(type));
    std::uint32_t seed = 7;
    for (std::size_t i = 0; i < image.bytes.size(); ++i) {
        seed = seed * 1664525u + 1013904223u;
        image.bytes[i] = static_cast<std::byte>(i % 3 == 0 ? (seed >> 24) : (i / 5) & 255);
    }
    return image;
}

struct Kind {
    const char* name;
    int channels;
    PixelType type;
};
void PrintTo(const Kind& kind, std::ostream* out)
{
    *out << kind.name << kind.channels;
}

class RoundTrip : public Io, public testing::WithParamInterface<Kind> {};
TEST_P(RoundTrip, KeepsEveryCode)
{
    const Kind& kind = GetParam();
    const RawImage image = ramp(700, 400, kind.channels, kind.type);
    const fs::path path = folder / kind.name;
    write_raw(path, image);
    const RawImage back = read_raw(path);
    ASSERT_EQ(back.width, 700);
    ASSERT_EQ(back.height, 400);
    ASSERT_EQ(back.channels, kind.channels);
    ASSERT_EQ(back.type, kind.type);
    EXPECT_EQ(back.bytes, image.bytes);
}
INSTANTIATE_TEST_SUITE_P(
    Table, RoundTrip,
    testing::Values(Kind{"a.png", 1, PixelType::U8}, Kind{"a.png", 2, PixelType::U8},
                    Kind{"a.png", 3, PixelType::U8}, Kind{"a.png", 4, PixelType::U8},
                    Kind{"b.png", 1, PixelType::U16}, Kind{"b.png", 2, PixelType::U16},
                    Kind{"b.png", 3, PixelType::U16}, Kind{"b.png", 4, PixelType::U16},
                    Kind{"a.tga", 3, PixelType::U8}, Kind{"a.tga", 4, PixelType::U8},
                    Kind{"a.tif", 4, PixelType::U8}, Kind{"a.tif", 1, PixelType::U16},
                    Kind{"a.tif", 4, PixelType::U16}, Kind{"f.exr", 4, PixelType::F32}));

TEST_F(Io, ExrKeepsNamesHalvesAndFloats)
{
    ExrChannel half{"albedo.R", {0x3c00, 0x4000, 0x0001, 0xbc00}, {}};
    ExrChannel depth{"depth.Z", {}, {1.0f, 1e-30f, 3.25f, 1e30f}};
    write_exr(folder / "a.exr", 2, 2, {half, depth}, {{"command", "test"}});
    const Image back = read_image(folder / "a.exr");
    ASSERT_EQ(back.channels, 2);
    const RawImage raw = read_raw(folder / "a.exr");
    ASSERT_EQ(raw.channel_names.size(), 2u);
    EXPECT_EQ(raw.channel_names[0], "albedo.R");
    EXPECT_EQ(raw.channel_names[1], "depth.Z");
    EXPECT_FLOAT_EQ(back.at(0, 0, 0), 1.0f);
    EXPECT_FLOAT_EQ(back.at(1, 1, 0), -1.0f);
    EXPECT_FLOAT_EQ(back.at(1, 0, 1), 1e-30f);
    EXPECT_FLOAT_EQ(back.at(1, 1, 1), 1e30f);
}

TEST_F(Io, LinearColourGoesThroughTheSrgbCurveAndAlphaDoesNot)
{
    const std::uint8_t codes[4] = {188, 0, 255, 128};
    write_png8(folder / "a.png", 1, 1, 4, codes);
    const Image linear = read_image(folder / "a.png", {.space = ColorSpace::Linear});
    EXPECT_NEAR(linear.pixels[0], 0.5029f, 1e-4f);  // 188 / 255 through the inverse curve
    EXPECT_FLOAT_EQ(linear.pixels[2], 1.0f);
    EXPECT_NEAR(linear.pixels[3], 128.0f / 255.0f, 1e-6f);
    const Image data = read_image(folder / "a.png");
    EXPECT_NEAR(data.pixels[0], 188.0f / 255.0f, 1e-6f);
    write_image(folder / "b.png", linear);
    EXPECT_EQ(read_raw(folder / "b.png").bytes, read_raw(folder / "a.png").bytes);
}

TEST_F(Io, AlphaIsDataAndLeavesColourAlone)
{
    // Colour under alpha 0 and 3: a library that multiplies or divides by alpha loses it.
    const std::uint8_t codes[8] = {200, 150, 100, 0, 200, 150, 100, 3};
    for (const char* name : {"a.png", "a.tga", "a.tif"}) {
        RawImage image{2, 1, 4, PixelType::U8, {}, {}};
        for (const std::uint8_t c : codes) image.bytes.push_back(static_cast<std::byte>(c));
        write_raw(folder / name, image);
        EXPECT_EQ(read_raw(folder / name).bytes, image.bytes) << name;
    }
}

TEST_F(Io, BytesInMemoryDecodeLikeTheFile)
{
    const RawImage image = ramp(33, 17, 3, PixelType::U8);
    write_raw(folder / "a.png", image);
    std::ifstream in(folder / "a.png", std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(in)), {});
    const auto bytes = std::as_bytes(std::span(content));
    EXPECT_EQ(decode_raw(bytes, "embedded image 3").bytes, image.bytes);
    EXPECT_THROW(decode_raw(bytes.subspan(0, 20), "cut"), Error);
    EXPECT_THROW(decode_raw({}, "empty"), Error);
}

TEST_F(Io, PngBytesDoNotDependOnThreads)
{
    const RawImage image = ramp(1000, 900, 3, PixelType::U16);
    write_raw(folder / "1.png", image, {.threads = 1});
    write_raw(folder / "5.png", image, {.threads = 5});
    const auto content = [](const fs::path& p) {
        std::ifstream in(p, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(in)), {});
    };
    EXPECT_EQ(content(folder / "1.png"), content(folder / "5.png"));
    EXPECT_GT(content(folder / "1.png").size(), 1000u);
}

// Grain above, where looking for repeats is in vain; below it a pattern that comes again.
TEST_F(Io, PngOfGrainAndPatternReadsBackAndThePatternNearlyVanishes)
{
    RawImage image = ramp(1024, 1024, 2, PixelType::U16);
    std::uint32_t state = 1;
    const std::size_t half = image.bytes.size() / 2, period = 2 * image.bytes.size() / 1024;
    for (std::size_t i = 0; i < image.bytes.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        image.bytes[i] = i < half ? static_cast<std::byte>(state >> 24) : image.bytes[i - period];
    }
    write_raw(folder / "both.png", image, {.threads = 2});
    EXPECT_EQ(read_raw(folder / "both.png").bytes, image.bytes);
    EXPECT_LT(fs::file_size(folder / "both.png"), half + half / 8);
}

TEST_F(Io, RefusesWithTheReason)
{
    const auto problem = [](const auto& act) {
        try {
            act();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_THAT(problem([&] { read_image(folder / "none.png"); }),
                testing::HasSubstr("no such file"));
    EXPECT_THAT(problem([&] { read_image(folder); }), testing::HasSubstr("not a file"));
    const fs::path text = write_file("text.png", "this is not an image at all, really");
    EXPECT_THAT(problem([&] { read_image(text); }), testing::HasSubstr("none of PNG"));
    const fs::path empty = write_file("empty.png", "");
    EXPECT_THAT(problem([&] { read_image(empty); }), testing::HasSubstr("empty"));
    write_raw(folder / "a.png", ramp(300, 200, 1, PixelType::U8));
    EXPECT_THAT(problem([&] { read_image(folder / "a.png", {.max_pixels = 1000}); }),
                testing::HasSubstr("300 x 200"));
    EXPECT_THAT(problem([&] { read_image(folder / "a.png", {.max_bytes = 1000}); }),
                testing::HasSubstr("MiB"));
    EXPECT_THAT(problem([&] { write_image("/proc/none/a.png", Image(1, 1, 1, ColorSpace::Data)); }),
                testing::HasSubstr("/proc/none"));
    EXPECT_THAT(problem([&] { write_image(folder / "a.xyz", Image(1, 1, 1, ColorSpace::Data)); }),
                testing::HasSubstr(".xyz"));
}

TEST_F(Io, ManyThreadsReadAtOnce)
{
    std::vector<RawImage> images;
    for (int i = 0; i < 8; ++i) {
        images.push_back(ramp(64 + i, 64, 3, PixelType::U8));
        write_raw(folder / (std::to_string(i) + ".png"), images.back());
    }
    std::vector<int> good(8, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 8; ++t) {
        threads.emplace_back([&, t] {
            const RawImage back = read_raw(folder / (std::to_string(t) + ".png"));
            good[t] = back.bytes == images[t].bytes;
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const int ok : good) EXPECT_EQ(ok, 1);
}

// What we encode, the image library decodes to the same pixels; bytes that do not fit are refused.
TEST_F(Io, EncodedPngBytesDecodeToTheSamePixels)
{
    for (const int channels : {1, 2, 3, 4}) {
        std::vector<std::uint8_t> pixels;
        for (int k = 0; k < 37 * 23 * channels; ++k) {
            pixels.push_back(static_cast<std::uint8_t>((k * k * 7 + k / 5) & 0xff));
        }
        const Image back = decode_image(encode_png8(37, 23, channels, pixels), "picture");
        ASSERT_EQ(back.width, 37);
        ASSERT_EQ(back.channels, channels);
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            ASSERT_EQ(std::lround(back.pixels[k] * 255.0f), pixels[k]) << channels << " " << k;
        }
    }
    const std::vector<std::uint8_t> few(5);
    EXPECT_THROW(encode_png8(2, 2, 1, few), Error);
    EXPECT_THROW(encode_png8(0, 2, 1, {}), Error);
    EXPECT_THROW(encode_png8(1, 1, 5, few), Error);
}

// A PSD of 2 x 2 texels with channels of one byte, plain or run-length coded. `layers` negative:
// the fourth channel is the transparency of the merged picture.
std::string small_psd(int channels, const std::string& planes, bool runs, int layers)
{
    const auto big = [](std::uint64_t value, int size) {
        std::string text;
        for (int i = size; i-- > 0;) text += static_cast<char>(value >> (8 * i));
        return text;
    };
    std::string file = "8BPS" + big(1, 2) + std::string(6, '\0') +
                       big(static_cast<std::uint64_t>(channels), 2) + big(2, 4) + big(2, 4) +
                       big(8, 2) + big(3, 2) + big(0, 4) + big(0, 4);
    file += big(8, 4) + big(4, 4) + big(static_cast<std::uint16_t>(layers), 2) + big(0, 2);
    file += big(runs ? 1 : 0, 2);
    if (!runs) return file + planes;
    for (int row = 0; row < 2 * channels; ++row) file += big(3, 2);
    for (int row = 0; row < 2 * channels; ++row) {
        file += '\1';  // two literal bytes
        file += planes.substr(2 * static_cast<std::size_t>(row), 2);
    }
    return file;
}

TEST_F(Io, PsdKeepsItsFourthChannel)
{
    const std::string planes{"\x10\x20\x30\x40\x11\x21\x31\x41\x12\x22\x32\x42\x05\x80\xff\x00",
                             16};
    for (const bool runs : {false, true}) {
        const RawImage image = read_raw(write_file("a.psd", small_psd(4, planes, runs, 1)));
        ASSERT_EQ(image.channels, 4);
        for (std::size_t t = 0; t < 4; ++t) {
            for (std::size_t c = 0; c < 4; ++c) {
                EXPECT_EQ(static_cast<char>(image.bytes[4 * t + c]), planes[4 * c + t]) << t << c;
            }
        }
        EXPECT_EQ(
            read_raw(write_file("b.psd", small_psd(3, planes.substr(0, 12), runs, 1))).channels, 3);
    }
    // On white at half transparency: 0xbf was seen where the colour is 0x7f.
    const std::string seen = std::string(12, '\xbf') + std::string("\x80\xff\x00\x80", 4);
    const RawImage image = read_raw(write_file("c.psd", small_psd(4, seen, false, -1)));
    EXPECT_EQ(static_cast<int>(image.bytes[0]), std::lround((0xbf - 0x7f) * 255 / 128.0));
    EXPECT_EQ(static_cast<int>(image.bytes[4]), 0xbf);
    const std::string whole = small_psd(4, planes, true, 1);
    for (std::size_t size = 1; size < whole.size(); ++size) {
        EXPECT_THROW(read_raw(write_file("cut.psd", whole.substr(0, size))), Error) << size;
    }
}

TEST_F(Io, ACutPngIsAnError)
{
    write_raw(folder / "a.png", ramp(40, 30, 4, PixelType::U16));
    std::ifstream in(folder / "a.png", std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t size = 8; size + 12 < whole.size(); size += 97) {
        EXPECT_THROW(read_raw(write_file("cut.png", whole.substr(0, size))), Error) << size;
    }
    // A text of a gigabyte, says the file: refused without taking it.
    std::string huge = whole.substr(0, 33) + std::string("\x3f\xff\xff\xffzTXtkey", 11);
    EXPECT_THROW(read_raw(write_file("huge.png", huge)), Error);
}

// The library would fill the rest with grey.
TEST_F(Io, ACutJpegIsAnError)
{
    Image image(96, 64, 3, ColorSpace::Linear);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = static_cast<float>((i * 2654435761u) >> 16 & 255) / 255.0f;
    write_image(folder / "whole.jpg", image);
    std::ifstream file(folder / "whole.jpg", std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(read_raw(folder / "whole.jpg").width, 96);
    std::ofstream(folder / "tail.jpg", std::ios::binary) << whole << "what some tools append";
    EXPECT_EQ(read_raw(folder / "tail.jpg").bytes, read_raw(folder / "whole.jpg").bytes);
    for (const double share : {0.3, 0.6, 0.95}) {
        const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
        std::ofstream(folder / "cut.jpg", std::ios::binary) << whole.substr(0, size);
        try {
            read_raw(folder / "cut.jpg");
            ADD_FAILURE() << share;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("cut short"), std::string::npos)
                << error.what();
        }
    }
}

TEST_F(Io, EveryPngAndPsdOfTheSharedSetIsRead)
{
    NEED_ASSETS(assets);
    for (const char* kind : {"png", "psd"}) {
        int read = 0;
        for (const auto& entry : fs::directory_iterator(assets / "formats" / kind)) {
            EXPECT_GT(read_raw(entry.path()).bytes.size(), 0u) << entry.path();
            ++read;
        }
        EXPECT_GT(read, 5);
    }
    EXPECT_EQ(read_raw(assets / "formats/psd/rgba.psd").channels, 4);
}

// A file on which the image library itself aborts is an error, and the next file is read.
TEST_F(Io, ACrashOfTheImageLibraryIsAnError)
{
    NEED_ASSETS(assets);
    write_raw(folder / "a.png", ramp(8, 8, 3, PixelType::U8));
    for (const char* name : {"tga/crash1.tga", "exr/memory_DOS_2.1", "psd/crash-bomb-30000.psd"}) {
        try {
            (void)read_image(assets / "bad" / name);
        } catch (const Error&) {
        }
        EXPECT_EQ(read_raw(folder / "a.png").width, 8) << "after " << name;
    }
}

// Reduced while it is decoded, an image is the level of its box mip chain that fits: row by row
// (PNG, EXR, TIFF) as all at once (DDS, TGA read whole), odd sizes included, colour as light.
TEST_F(Io, AMaximumSideGivesTheMipLevelThatFits)
{
    for (const ColorSpace space : {ColorSpace::Data, ColorSpace::Linear}) {
        for (const char* name : {"a.png", "a.tif", "a.exr", "a.tga", "a.jpg"}) {
            const bool exr = std::string(name) == "a.exr";
            write_raw(folder / name, ramp(75, 53, 3, exr ? PixelType::F16 : PixelType::U8));
            const Image full = read_image(folder / name, {.space = space});
            const Image small = read_image(folder / name, {.space = space, .max_side = 20});
            const Image expected = mip_chain(full)[2];
            ASSERT_EQ(small.width, 18);
            ASSERT_EQ(small.height, 13);
            ASSERT_EQ(small.pixels.size(), expected.pixels.size());
            for (std::size_t k = 0; k < small.pixels.size(); ++k) {
                const float tolerance = 1e-5f * std::max(1.0f, std::abs(expected.pixels[k]));
                if (!std::isfinite(expected.pixels[k])) continue;
                ASSERT_NEAR(small.pixels[k], expected.pixels[k], tolerance) << name << " " << k;
            }
        }
    }
    const Image same = read_image(folder / "a.png", {.max_side = 75});
    EXPECT_EQ(same.pixels, read_image(folder / "a.png").pixels);
}

}  // namespace
}  // namespace petrichor::texproc
