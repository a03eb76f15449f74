// Maps of a user's own instead of those that the renderer draws, through whole renders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/frames/frames_jsonl.h"
#include "tests/support/tiny_render.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;

class WeatherTextureFiles : public TinyRender {
protected:
    WeatherTextureFiles() : TinyRender("weather-textures-cli", "[render]\n") {}
    void generate(const std::string& kind, const std::string& seed, const std::string& size)
    {
        const Outcome made =
            run_petrichor({.arguments = {"texture", "generate", kind, "--seed", seed, "--size",
                                         size, "-o", "maps" + seed}},
                          place_.path());
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
};

TEST_F(WeatherTextureFiles, EachChangesThePicture)
{
    const std::string plain = picture("", "plain");
    for (const std::string kind : {"ripple", "snow_mask", "snow_water_bump"}) {
        generate(kind, "9", "128");
        const std::string key = kind + "_texture = \"maps9/" + kind + ".png\"\n";
        EXPECT_NE(picture(key, kind), plain) << kind;
        const auto record = film::read_frame_records(place_ / kind).begin()->second;
        EXPECT_TRUE(record.made_from.contains("weather textures"));
    }
}

// `texture generate` and the renderer draw the drops by one text.
TEST_F(WeatherTextureFiles, TheDropsOfTheSameSeedAreThoseThatAreDrawn)
{
    generate("ripple", "0", "512");
    // Pixels only: what a picture was made from stands in front of them.
    const auto pixels = [](const std::string& png) { return png.substr(png.find("IDAT")); };
    EXPECT_TRUE(pixels(picture("ripple_texture = \"maps0/ripple.png\"\n", "own")) ==
                pixels(picture("", "plain")));
}

TEST_F(WeatherTextureFiles, WhatDoesNotFitIsRefused)
{
    generate("snow_mask", "9", "64");
    generate("snow_water_bump", "9", "128");
    const Outcome sizes = render("snow_mask_texture = \"maps9/snow_mask.png\"\n"
                                 "snow_water_bump_texture = \"maps9/snow_water_bump.png\"\n",
                                 "sizes");
    EXPECT_EQ(sizes.exit_code, 2);
    EXPECT_THAT(sizes.err, HasSubstr("64 texels a side, snow_water_bump_texture 128"));
    const Outcome missing = render("ripple_texture = \"none.png\"\n", "missing");
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_THAT(missing.err, HasSubstr("none.png"));
    const std::vector<std::uint8_t> grey(16 * 16, 120);
    const auto bytes = texproc::encode_png8(16, 16, 1, grey);
    write_file(place_ / "grey.png",
               std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    const Outcome channels = render("ripple_texture = \"grey.png\"\n", "channels");
    EXPECT_EQ(channels.exit_code, 2);
    EXPECT_THAT(channels.err, HasSubstr("has 1 channels, not 4"));
    EXPECT_EQ(render("snow_mask_texture = \"grey.png\"\n", "grey").exit_code, 0);
}

}  // namespace
}  // namespace petrichor::cli
