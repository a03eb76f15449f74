#include "film/color/display_transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "formulas/color/tone_map.h"
#include "tests/support/color_config.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace testing_program;

class DisplayTransforms : public testing::Test {
protected:
    DisplayTransforms()
        : place_(std::string("display-transform") + testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        write_file(place_ / "c.ocio", color_config());
        write_file(place_ / "half.spi1d", half_table());
    }
    void SetUp() override
    {
        if (!has_color_management()) GTEST_SKIP() << "built without OpenColorIO (libopencolorio-dev)";
    }
    DisplayTransform made(ColorManagement asked) const
    {
        if (asked.config.empty()) asked.config = "c.ocio";
        return DisplayTransform(asked, place_.path());
    }
    // What a config is refused with, and the fix.
    std::string refusal(const ColorManagement& asked) const
    {
        try {
            made(asked);
        } catch (const Error& error) {
            return std::string(error.what()) + " " + error.fix();
        }
        return "";
    }
    Workplace place_;
};

std::uint16_t half(float value)
{
    return glm::packHalf1x16(value);
}

// Greys from black to beyond white, three a row and more rows than are made at a time.
std::vector<float> ramp()
{
    std::vector<float> greys;
    for (int i = 0; i < 3 * 150; ++i) greys.push_back(glm::unpackHalf1x16(half(1.3f * static_cast<float>(i) / 449.0f)));
    return greys;
}

std::vector<std::uint16_t> light_of(const std::vector<float>& greys, glm::vec3 tint = glm::vec3(1.0f))
{
    std::vector<std::uint16_t> light;
    for (const float grey : greys) {
        for (int c = 0; c < 3; ++c) light.push_back(half(grey * tint[c]));
        light.push_back(half(1.0f));
    }
    return light;
}

int code(double value)
{
    return static_cast<int>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

TEST_F(DisplayTransforms, AGreyRampComesOutByTheFormulaOfTheView)
{
    const auto greys = ramp();
    const auto codes = made({}).picture(light_of(greys), 3, false);
    ASSERT_EQ(codes.size(), greys.size() * 4);
    for (std::size_t i = 0; i < greys.size(); ++i) {
        const int wanted = code(std::pow(static_cast<double>(greys[i]), 1.0 / 2.2));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(codes[4 * i + c], wanted, 1) << greys[i];
        EXPECT_EQ(codes[4 * i + 3], 255);
    }
}

TEST_F(DisplayTransforms, AMatrixMixesTheChannelsBeforeTheCurve)
{
    const glm::vec3 tint(0.25f, 0.5f, 1.0f);  // scales halves without rounding
    const auto greys = ramp();
    const auto codes = made({.view = "Tinted"}).picture(light_of(greys, tint), 3, false);
    for (std::size_t i = 0; i < greys.size(); ++i) {
        const double g = static_cast<double>(greys[i]);
        EXPECT_NEAR(codes[4 * i], code(std::sqrt(g * (0.5 * 0.25 + 0.25 * 0.5))), 1);
        EXPECT_NEAR(codes[4 * i + 1], code(std::sqrt(g * 0.5)), 1);
        EXPECT_NEAR(codes[4 * i + 2], code(std::sqrt(g * 0.25)), 1);
    }
}

TEST_F(DisplayTransforms, TheLibrarysAcesIsNearOurFit)
{
    write_file(place_ / "aces.ocio", aces_config());
    const DisplayTransform aces = made({.config = "aces.ocio"});
    EXPECT_EQ(aces.view(), "ACES 1.0 SDR");
    EXPECT_EQ(aces.scene_space(), "Linear Rec.709 (sRGB)");
    for (const glm::vec3 tint : {glm::vec3(1.0f), glm::vec3(1.0f, 0.5f, 0.25f), glm::vec3(0.25f, 0.5f, 1.0f)}) {
        const auto greys = ramp();
        const auto codes = aces.picture(light_of(greys, tint), 3, false);
        for (std::size_t i = 0; i < greys.size(); ++i) {
            const glm::vec3 ours = shared::display_light(TONE_MAP_ACES, greys[i] * tint);
            for (int c = 0; c < 3; ++c) {
                const int fit = code(static_cast<double>(shared::srgb_encode(ours[c])));
                EXPECT_NEAR(codes[4 * i + static_cast<std::size_t>(c)], fit, 8)
                    << greys[i] << " of " << tint[0] << ", channel " << c;
            }
        }
    }
}

TEST_F(DisplayTransforms, OldConfigsAreReadToo)
{
    write_file(place_ / "old.ocio", old_config());
    const DisplayTransform old = made({.config = "old.ocio"});
    EXPECT_EQ(old.view(), "Film");
    EXPECT_EQ(old.scene_space(), "linear");
    EXPECT_NEAR(old.picture(light_of({0.5f}), 1, false)[0], code(std::pow(0.5, 1.0 / 1.8)), 1);
}

TEST_F(DisplayTransforms, DitherIsHalfAStepAroundTheValue)
{
    // 99.5 of 255: as often one code as the next.
    const std::vector<float> even(64 * 64, static_cast<float>(std::pow(99.5 / 255.0, 2.2)));
    const auto codes = made({}).picture(light_of(even), 64, true);
    double sum = 0.0;
    for (std::size_t i = 0; i < even.size(); ++i) {
        EXPECT_GE(codes[4 * i], 99);
        EXPECT_LE(codes[4 * i], 100);
        sum += codes[4 * i];
    }
    EXPECT_NEAR(sum / static_cast<double>(even.size()), 99.5, 0.15);
}

TEST_F(DisplayTransforms, WhatIsNoNumberIsACodeToo)
{
    std::vector<std::uint16_t> light(8, half(1.0f));
    light[0] = 0x7c00;  // infinite
    light[4] = 0x7e00;  // not a number
    const auto codes = made({}).picture(light, 2, true);
    EXPECT_EQ(codes[0], 255);
    EXPECT_EQ(codes[1], 255);
}

TEST_F(DisplayTransforms, ALookTakesThePlaceOfTheViewsOwn)
{
    const auto bright = light_of({0.5f});
    EXPECT_NEAR(made({}).picture(bright, 1, false)[0], code(std::pow(0.5, 1.0 / 2.2)), 1);
    EXPECT_NEAR(made({.look = "dim"}).picture(bright, 1, false)[0], code(std::pow(0.25, 1.0 / 2.2)), 1);
}

TEST_F(DisplayTransforms, DefaultsAreTheConfigsAndKnownNamesAreTaken)
{
    const DisplayTransform own = made({});
    EXPECT_EQ(own.display(), "Monitor");
    EXPECT_EQ(own.view(), "Power");
    EXPECT_EQ(own.scene_space(), "lin_srgb") << "not scene_linear, which is another here";
    EXPECT_EQ(own.notes().size(), 1u);
    const DisplayTransform asked = made({.display = "Projector", .scene_space = "scene_linear"});
    EXPECT_EQ(asked.view(), "Table");
    EXPECT_EQ(asked.scene_space(), "wide");
    EXPECT_NEAR(asked.picture(light_of({0.25f}), 1, false)[0], code(0.25), 1) << "doubled, and halved by the table";
}

TEST_F(DisplayTransforms, AnUnknownSpaceIsReadAsSceneLinearAndSaid)
{
    std::string text = color_config();
    for (std::size_t at = 0; (at = text.find("lin_srgb")) != std::string::npos;) text.replace(at, 8, "house");
    write_file(place_ / "house.ocio", text);
    const DisplayTransform house = made({.config = "house.ocio"});
    EXPECT_EQ(house.scene_space(), "wide");
    ASSERT_EQ(house.notes().size(), 2u);
    EXPECT_THAT(house.notes()[1], AllOf(HasSubstr("\"wide\""), HasSubstr("ocio_scene_space")));
}

TEST_F(DisplayTransforms, WhatIsNotThereIsNamedWithWhatIs)
{
    EXPECT_THAT(refusal({.view = "Powr"}),
                AllOf(HasSubstr("ocio_view"), HasSubstr("\"Powr\""), HasSubstr("Power, Tinted, Plain sRGB"),
                      HasSubstr("Did you mean \"Power\"")));
    EXPECT_THAT(refusal({.display = "Cinema"}), AllOf(HasSubstr("ocio_display"), HasSubstr("Monitor, Projector")));
    EXPECT_THAT(refusal({.scene_space = "acescg"}), AllOf(HasSubstr("ocio_scene_space"), HasSubstr("lin_srgb, wide")));
    EXPECT_THAT(refusal({.look = "warm"}), AllOf(HasSubstr("ocio_look"), HasSubstr("dim")));
    EXPECT_THAT(refusal({.config = "none.ocio"}), AllOf(HasSubstr("ocio_config"), HasSubstr("none.ocio")));
    EXPECT_NE(refusal({.config = "."}), "");
    EXPECT_THAT(refusal({.config = "ocio://no-such-config"}), HasSubstr("ocio://no-such-config"));
}

TEST_F(DisplayTransforms, DamagedConfigsAreRefused)
{
    const std::string whole = color_config();
    for (const std::string& text : {std::string(), std::string("not a config"), whole.substr(0, 40), std::string(40, '\0'),
                                    whole + "\n  - [", std::string(200000, '['), "ocio_profile_version: 99\n" + whole}) {
        write_file(place_ / "bad.ocio", text);
        EXPECT_THAT(refusal({.config = "bad.ocio"}), HasSubstr("bad.ocio")) << text.substr(0, 60);
    }
    // A config without its table is whole for the views that do not read it.
    std::filesystem::remove(place_ / "half.spi1d");
    EXPECT_EQ(refusal({.view = "Tinted"}), "");
    EXPECT_THAT(refusal({.display = "Projector"}), HasSubstr("half.spi1d"));
}

TEST_F(DisplayTransforms, TheFingerprintIsOfAllThatDecidesThePicture)
{
    const std::string table = made({.display = "Projector"}).fingerprint();
    const std::string power = made({}).fingerprint();
    EXPECT_EQ(made({}).fingerprint(), power);
    EXPECT_NE(made({.view = "Tinted"}).fingerprint(), power);
    EXPECT_NE(made({.look = "dim"}).fingerprint(), power);
    EXPECT_NE(made({.scene_space = "wide"}).fingerprint(), power);
    write_file(place_ / "half.spi1d", half_table("0.6"));  // as many bytes
    EXPECT_NE(made({.display = "Projector"}).fingerprint(), table);
    EXPECT_EQ(made({}).fingerprint(), power) << "its view reads no table";
    write_file(place_ / "c.ocio", color_config("2.4"));
    EXPECT_NE(made({}).fingerprint(), power);
}

TEST_F(DisplayTransforms, TheEnvironmentsConfigIsNotRead)
{
    write_file(place_ / "other.ocio", color_config("1.0"));
    ::setenv("OCIO", (place_ / "other.ocio").c_str(), 1);
    const auto codes = made({}).picture(light_of({0.5f}), 1, false);
    ::unsetenv("OCIO");
    EXPECT_NEAR(codes[0], code(std::pow(0.5, 1.0 / 2.2)), 1);
}

}  // namespace
}  // namespace petrichor::film
