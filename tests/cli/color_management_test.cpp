// Pictures by an OpenColorIO config, through whole renders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "film/color/display_transform.h"
#include "film/frames/frames_jsonl.h"
#include "tests/support/color_config.h"
#include "tests/support/tiny_render.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace testing_program;

const std::string kConfig = "ocio_config = \"c.ocio\"\n";

class ColorManaged : public TinyRender {
protected:
    // [camera] is left open.
    ColorManaged() : TinyRender("color-managed", "")
    {
        write_file(place_ / "c.ocio", color_config());
        write_file(place_ / "half.spi1d", half_table());
    }
    void SetUp() override
    {
        if (!film::has_color_management()) GTEST_SKIP() << "built without OpenColorIO (libopencolorio-dev)";
        TinyRender::SetUp();
    }
    // Codes of the picture.
    std::vector<int> codes(const std::string& more, const std::string& folder)
    {
        const Outcome outcome = render(more, folder);
        EXPECT_EQ(outcome.exit_code, 0) << more << outcome.err;
        const texproc::RawImage image = texproc::read_raw(place_ / folder / "frame_0000.png");
        std::vector<int> all;
        for (const std::byte byte : image.bytes) all.push_back(static_cast<int>(byte));
        return all;
    }
    std::string beauty(const std::string& folder) const
    {
        return film::read_frame_records(place_ / folder).begin()->second.beauty_hash;
    }
    Outcome again(const std::string& folder)
    {
        return run_petrichor({.arguments = {"render", "s.toml", "-o", folder, "--resume"}}, place_.path());
    }
};

int largest_difference(const std::vector<int>& a, const std::vector<int>& b)
{
    EXPECT_EQ(a.size(), b.size());
    int most = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

// The config's own sRGB curve is ours: glare, white balance, exposure and dither are those of any picture.
TEST_F(ColorManaged, AViewOfPlainSrgbIsThePictureWithoutACurve)
{
    const std::string lens = "bloom = 0.3\nwet_lens = 0.8\nwhite_balance_k = 4000\n[render]\n";
    const auto ours = codes(lens + "tone_map = \"linear\"\n", "ours");
    const auto managed = codes(lens + kConfig + "ocio_view = \"Plain sRGB\"\n", "managed");
    EXPECT_LE(largest_difference(ours, managed), 1);
    EXPECT_EQ(beauty("ours"), beauty("managed"));
    const auto sharp = codes("bloom = 0.0\n[render]\n" + kConfig + "ocio_view = \"Plain sRGB\"\n", "sharp");
    EXPECT_GT(largest_difference(managed, sharp), 8) << "what the lens does is seen";
}

TEST_F(ColorManaged, FramesDifferByTheViewAndTheirLightDoesNot)
{
    const auto ours = codes("", "ours");
    const auto tinted = codes("[render]\n" + kConfig + "ocio_view = \"Tinted\"\n", "tinted");
    const auto table = codes("[render]\n" + kConfig + "ocio_display = \"Projector\"\n", "table");
    EXPECT_GT(largest_difference(ours, tinted), 20);
    EXPECT_GT(largest_difference(tinted, table), 20);
    EXPECT_LE(*std::max_element(table.begin(), table.end()), 128) << "the table ends at a half";
    EXPECT_EQ(beauty("ours"), beauty("tinted"));
    EXPECT_EQ(beauty("ours"), beauty("table"));
}

TEST_F(ColorManaged, ResumeRendersAgainWhenTheConfigOrItsTableChanges)
{
    const Outcome first = render("[render]\n" + kConfig + "ocio_display = \"Projector\"\n", "out");
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.err, AllOf(HasSubstr("view \"Table\" of display \"Projector\""), HasSubstr("read as \"lin_srgb\"")));
    EXPECT_THAT(again("out").err, HasSubstr("0 frames rendered, 1 kept"));
    write_file(place_ / "half.spi1d", half_table("0.6"));
    EXPECT_THAT(again("out").err, AllOf(HasSubstr("color management changed"), HasSubstr("1 frames rendered")));
    write_file(place_ / "c.ocio", color_config("2.4"));
    EXPECT_THAT(again("out").err, AllOf(HasSubstr("color management changed"), HasSubstr("1 frames rendered")));
    EXPECT_THAT(again("out").err, HasSubstr("0 frames rendered, 1 kept"));
}

TEST_F(ColorManaged, WhatDoesNotFitIsRefusedBeforeTheFirstFrame)
{
    const auto refused = [&](const std::string& keys) {
        const Outcome outcome = render("[render]\n" + keys, "refused");
        EXPECT_EQ(outcome.exit_code, 2) << keys;
        EXPECT_FALSE(std::filesystem::exists(place_ / "refused")) << keys;
        return outcome.err;
    };
    EXPECT_THAT(refused(kConfig + "ocio_view = \"Powr\"\n"), AllOf(HasSubstr("Powr"), HasSubstr("Power, Tinted")));
    EXPECT_THAT(refused("ocio_config = \"none.ocio\"\n"), HasSubstr("none.ocio"));
    EXPECT_THAT(refused("ocio_view = \"Power\"\n"), HasSubstr("ocio_config"));
    EXPECT_THAT(refused(kConfig + "tone_map = \"agx\"\n"), HasSubstr("tone_map"));
    EXPECT_THAT(refused(kConfig + "color_space = \"gamma\"\n"), HasSubstr("gamma"));
}

}  // namespace
}  // namespace petrichor::cli
