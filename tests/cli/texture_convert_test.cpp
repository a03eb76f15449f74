// petrichor texture convert: what comes out, and what is said when nothing can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST_F(Convert, LevelZeroKeepsItsCodes)
{
    EXPECT_EQ(convert({"in.png", "-o", "a.dds", "--srgb", "--mips"}).exit_code, 0);
    const texproc::MipTexture texture = texproc::read_texture(place / "a.dds");
    EXPECT_EQ(texture.levels.at(0), texproc::read_raw(place / "in.png").bytes);
    EXPECT_EQ(convert({"in.png", "-o", "deep.png", "--bits", "16"}).exit_code, 0);
    EXPECT_EQ(texproc::read_raw(place / "deep.png").type, texproc::PixelType::U16);
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

}  // namespace
}  // namespace petrichor::cli
