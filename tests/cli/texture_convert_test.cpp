// petrichor texture convert: what comes out, and what is said when nothing can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/program.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::cli {
namespace {

using namespace testing_program;

class Convert : public testing::Test {
protected:
    Convert() : place("convert")
    {
        texproc::RawImage image{20, 12, 4, texproc::PixelType::U8, {}, {}};
        for (std::size_t i = 0; i < image.values(); ++i) {
            image.bytes.push_back(static_cast<std::byte>((i * i / 7 + 3 * i) & 255));
        }
        texproc::write_raw(place / "in.png", image);
    }
    Outcome convert(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {"texture", "convert"});
        return run_petrichor({arguments}, place.path());
    }
    Workplace place;
};

// The same in every channel.
Image waves(int channels)
{
    Image image(16, 8, channels, ColorSpace::Data);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < channels; ++c)
                image.at(x, y, c) = 0.5f + 0.4f * std::sin(0.8f * static_cast<float>(x + 2 * y));
    return image;
}

TEST_F(Convert, PlainNumbersComeBackThroughEveryContainer)
{
    const auto original = texproc::read_raw(place / "in.png").bytes;
    for (const char* name : {"a.dds", "a.ktx2", "a.tif", "a.tga"}) {
        EXPECT_EQ(convert({"in.png", "-o", name}).exit_code, 0);
        EXPECT_EQ(convert({name, "-o", "back.png"}).exit_code, 0);
        EXPECT_EQ(texproc::read_raw(place / "back.png").bytes, original) << name;
    }
}

TEST_F(Convert, WritesLevelsInBlocksWithTheirLabel)
{
    const Outcome done = convert({"in.png", "-o", "a.ktx2", "--format", "bc7", "--srgb", "--mips",
                                  "--zstd", "5", "--quality", "fast"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, testing::HasSubstr("5 levels"));
    const texproc::MipTexture texture = texproc::read_texture(place / "a.ktx2");
    EXPECT_TRUE(texture.srgb);
    EXPECT_EQ(texproc::name_of(texture.format), "bc7");
    EXPECT_EQ(texture.levels.size(), 5u);
    EXPECT_EQ(convert({"in.png", "-o", "one.dds", "--format", "bc1", "--threads", "1"}).exit_code,
              0);
    EXPECT_EQ(convert({"in.png", "-o", "five.dds", "--format", "bc1", "--threads", "5"}).exit_code,
              0);
    EXPECT_EQ(read_file(place / "one.dds"), read_file(place / "five.dds"));
}

TEST_F(Convert, TradesErrorForSizeWhereThereAreBlocks)
{
    const auto size_at = [&](const char* price) {
        const Outcome done =
            convert({"in.png", "-o", "a.ktx2", "--format", "bc7", "--zstd", "18", "--rdo", price});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return read_file(place / "a.ktx2").size();
    };
    EXPECT_LT(size_at("1000"), size_at("0"));
    const Outcome plain = convert({"in.png", "-o", "a.ktx2", "--rdo", "1"});
    EXPECT_EQ(plain.exit_code, 2);
    EXPECT_THAT(plain.err, testing::HasSubstr("--rdo is for formats of blocks"));
    EXPECT_EQ(convert({"in.png", "-o", "a.dds", "--format", "bc6h", "--rdo", "1"}).exit_code, 2);
    const Outcome loss = convert({"in.png", "-o", "a.dds", "--format", "bc7", "--rdo-most", "1"});
    EXPECT_EQ(loss.exit_code, 2);
    EXPECT_THAT(loss.err, testing::HasSubstr("--rdo-most bounds what --rdo costs"));
}

TEST_F(Convert, LevelZeroKeepsItsCodes)
{
    EXPECT_EQ(convert({"in.png", "-o", "a.dds", "--srgb", "--mips"}).exit_code, 0);
    const texproc::MipTexture texture = texproc::read_texture(place / "a.dds");
    EXPECT_EQ(texture.levels.at(0), texproc::read_raw(place / "in.png").bytes);
    EXPECT_EQ(convert({"in.png", "-o", "deep.png", "--bits", "16"}).exit_code, 0);
    EXPECT_EQ(texproc::read_raw(place / "deep.png").type, texproc::PixelType::U16);
}

// Half the size is the mean of four; colour is averaged as light, normals keep their length.
TEST_F(Convert, SaysWhatIntegersCut)
{
    Image light(8, 4, 1, ColorSpace::Data, 0.5f);
    light.pixels[0] = 7.0f, light.pixels[1] = 1.5f, light.pixels[2] = -1.0f;
    light.pixels[3] = std::nanf("");
    texproc::write_raw(place / "light.exr", texproc::to_raw(light, texproc::PixelType::F32));
    for (const std::vector<std::string>& to :
         std::vector<std::vector<std::string>>{{"o.png"}, {"o.dds", "--format", "bc4"}, {"o.ktx2", "--format", "r8"}}) {
        std::vector<std::string> arguments{"light.exr", "-o"};
        arguments.insert(arguments.end(), to.begin(), to.end());
        const std::string err = convert(arguments).err;
        EXPECT_THAT(err, testing::HasSubstr("2 of 32 numbers are above 1 and become 1")) << to[0];
        EXPECT_THAT(err, testing::HasSubstr("1 of 32 numbers are below 0 and become 0")) << to[0];
        EXPECT_THAT(err, testing::HasSubstr("1 of 32 numbers are not numbers")) << to[0];
    }
    EXPECT_EQ(convert({"light.exr", "-o", "o.dds"}).err, "");
    EXPECT_EQ(convert({"light.exr", "-o", "o.ktx2", "--format", "r16f"}).err, "");
    EXPECT_EQ(convert({"in.png", "-o", "o.png"}).err, "");
}

TEST_F(Convert, ResamplesToASizeOrByAFactor)
{
    Image checker(8, 4, 3, ColorSpace::Data);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            for (int c = 0; c < 3; ++c) checker.at(x, y, c) = (x + y) % 2 != 0 ? 1.0f : 0.0f;
        }
    }
    texproc::write_image(place / "checker.png", checker);
    const auto texel = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"checker.png", "-o", "out.png"});
        EXPECT_EQ(convert(arguments).exit_code, 0);
        const texproc::RawImage made = texproc::read_raw(place / "out.png");
        EXPECT_EQ(made.width, 4);
        EXPECT_EQ(made.height, 2);
        return static_cast<int>(made.bytes[0]);
    };
    EXPECT_EQ(texel({"--size", "4"}), 128);
    EXPECT_EQ(texel({"--scale", "0.5"}), 128);
    EXPECT_EQ(texel({"--size", "4x2", "--srgb"}), 188);
}

// Diffuse and specular of a metal: base colour from the specular, no gloss left over.
TEST_F(Convert, SpecularMapsBecomeMetallicOnes)
{
    const auto put = [&](const char* name, int channels, float v) {
        texproc::write_image(place / name, Image(2, 2, channels, ColorSpace::Data, v));
    };
    put("diffuse.png", 3, 0.0f);
    put("specular.png", 3, 0.8f);
    put("gloss.png", 1, 0.25f);
    const Outcome made = run({"texture", "workflow", "--to", "metallic", "--color", "diffuse.png",
                              "--specular", "specular.png", "--gloss", "gloss.png", "-o", "m"},
                             place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto code = [&](const char* name) {
        return static_cast<int>(texproc::read_raw(place / name).bytes[0]);
    };
    EXPECT_EQ(code("m_metallic.png"), 255);
    EXPECT_NEAR(code("m_albedo.png"), 204, 1);
    EXPECT_EQ(code("m_roughness.png"), 191);
    EXPECT_EQ(run({"texture", "workflow", "--to", "metallic", "--color", "diffuse.png", "-o", "m"},
                  place)
                  .exit_code,
              2);
}

struct Mistake {
    std::vector<std::string> arguments;
    const char* said;
};

TEST_F(Convert, MistakesExitWithTwoAndSayWhat)
{
    const Mistake mistakes[] = {
        {{"in.png", "-o", "a.dds", "--format", "bc77"}, "Did you mean \"bc7\""},
        {{"in.png", "-o", "a.png", "--mips"}, "does not hold mip levels"},
        {{"in.png", "-o", "a.png", "--format", "bc7"}, "--format is for"},
        {{"in.png", "-o", "a.dds", "--zstd", "3"}, "--zstd is for .ktx2"},
        {{"in.png", "-o", "a.dds", "--format", "bc5", "--srgb"}, "no sRGB bc5"},
        {{"in.png", "-o", "a.dds", "--size", "0x4"}, "--size takes"},
        {{"in.png", "-o", "a.dds", "--size", "4", "--scale", "2"}, "exclude each other"},
        {{"in.png", "-o", "a.xyz"}, "'.xyz'"},
        {{"none.png", "-o", "a.dds"}, "no such file"},
        {{"in.png", "-o", "a.dds", "--srgb", "--linear"}, "exclude each other"},
        {{"in.png", "-o", "a.dds", "--max-pixels", "10"}, "limit of 10 pixels"}};
    for (const Mistake& mistake : mistakes) {
        const Outcome outcome = convert(mistake.arguments);
        EXPECT_EQ(outcome.exit_code, 2) << mistake.said;
        EXPECT_THAT(outcome.err, testing::HasSubstr(mistake.said));
        EXPECT_FALSE(std::filesystem::exists(place / "a.dds")) << mistake.said;
    }
}

// Slopes of bumps are floats of a height map: whatever else is asked for is refused, and nothing written.
TEST_F(Convert, SlopesOfBumpsAreRefusedWhereTheyCannotBe)
{
    texproc::write_image(place / "height.png", waves(1));
    texproc::write_image(place / "gray.png", waves(3));
    const Mistake mistakes[] = {
        {{"height.png", "-o", "a.dds", "--mips"}, "--bump-slopes is for .exr with --mips, not '.dds'"},
        {{"height.png", "-o", "a.tif", "--mips"}, "'.tif' does not hold mip levels"},
        {{"height.png", "-o", "a.png"}, "--bump-slopes is for .exr with --mips, not '.png'"},
        {{"height.png", "-o", "a.exr"}, "--bump-slopes is for .exr with --mips"},
        {{"height.png", "-o", "a.exr", "--mips", "--srgb"}, "six channels of 32-bit floats"},
        {{"height.png", "-o", "a.exr", "--mips", "--format", "rgba16f"}, "six channels of 32-bit floats"},
        {{"height.png", "-o", "a.exr", "--mips", "--bits", "8"}, "six channels of 32-bit floats"},
        {{"height.png", "-o", "a.exr", "--mips", "--bits", "16"}, "six channels of 32-bit floats"},
        {{"height.png", "-o", "a.exr", "--mips", "--bits", "32"}, "six channels of 32-bit floats"},
        {{"height.png", "-o", "a.exr", "--mips", "--normals"}, "--normals needs 3 channels, 'height.png' has 1"},
        {{"in.png", "-o", "a.exr", "--mips"}, "needs heights, 'in.png' is coloured"}};
    for (const Mistake& mistake : mistakes) {
        std::vector<std::string> arguments = mistake.arguments;
        arguments.push_back("--bump-slopes");
        const Outcome outcome = convert(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << mistake.said;
        EXPECT_THAT(outcome.err, testing::HasSubstr(mistake.said));
        EXPECT_THAT(outcome.err, testing::HasSubstr("\n  ")) << "says what to do";
        EXPECT_FALSE(std::filesystem::exists(place / arguments[2])) << mistake.said;
    }
    // Gray in three channels is heights; a coloured map may be normals.
    for (const std::vector<std::string>& right :
         {std::vector<std::string>{"gray.png"}, {"height.png"}, {"in.png", "--normals"}}) {
        std::vector<std::string> arguments = right;
        arguments.insert(arguments.end(), {"-o", "a.exr", "--mips", "--bump-slopes"});
        const Outcome outcome = convert(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(std::filesystem::remove(place / "a.exr"));
    }
}

}  // namespace
}  // namespace petrichor::cli
