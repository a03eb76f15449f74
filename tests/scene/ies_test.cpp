// Photometry of lamps (LM-63): what it says, and what is refused.
#include "scene/ies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace petrichor::scene {
namespace {

std::string head(const std::string& counts)
{
    return "IESNA:LM-63-2002\n[TEST] ours\n[MANUFAC] nobody\nTILT=NONE\n1 1000 2.0 " + counts +
           " 2 0 0 0\n0.5 1 60\n";
}

const std::string kCone = head("3 1 1") + "0 45 90\n0\n100, 50 0\n";

float at(const IesLight& light, double down_degrees, double turn_degrees)
{
    const int side = kLightProfileSide;
    const auto y = static_cast<std::size_t>(std::lround(down_degrees / 180.0 * (side - 1)));
    const auto x = static_cast<std::size_t>(std::lround(turn_degrees / 360.0 * side)) %
                   static_cast<std::size_t>(side);
    return light.profile.texels[y * static_cast<std::size_t>(side) + x].x;
}

std::string said(const std::string& text)
{
    try {
        read_ies(text, "lamp.ies");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Ies, ARoundConeIsReadWithItsCandela)
{
    const IesLight light = read_ies(kCone, "lamp.ies");
    EXPECT_NEAR(light.peak_cd, 100.0f, 1e-4f) << "100 times 2 times a ballast of one half";
    EXPECT_FALSE(light.profile.picture);
    ASSERT_EQ(light.profile.texels.size(), 128u * 128u);
    for (const double turn : {0.0, 77.0, 200.0}) {
        EXPECT_EQ(at(light, 0.0, turn), 1.0f);
        EXPECT_NEAR(at(light, 45.0, turn), 0.5f, 0.01f);
        EXPECT_NEAR(at(light, 22.5, turn), 0.75f, 0.01f);
        EXPECT_EQ(at(light, 120.0, turn), 0.0f) << "it was not measured there: dark";
    }
}

TEST(Ies, SymmetriesFillTheTurn)
{
    const IesLight quarter = read_ies(head("2 2 1") + "0 90\n0 90\n10 8\n10 2\n", "q");
    for (const double turn : {0.0, 180.0}) EXPECT_NEAR(at(quarter, 90.0, turn), 0.8f, 0.01f);
    for (const double turn : {90.0, 270.0}) EXPECT_NEAR(at(quarter, 90.0, turn), 0.2f, 0.02f);
    const IesLight half = read_ies(head("2 2 1") + "0 90\n0 180\n10 8\n10 2\n", "h");
    EXPECT_NEAR(at(half, 90.0, 180.0), 0.2f, 0.01f);
    EXPECT_NEAR(at(half, 90.0, 90.0), at(half, 90.0, 270.0), 1e-5f);
    const IesLight full =
        read_ies(head("2 5 1") + "0 90\n0 90 180 270 360\n10 8\n10 6\n10 4\n10 2\n10 8\n", "f");
    EXPECT_NEAR(at(full, 90.0, 90.0), 0.6f, 0.01f);
    EXPECT_NEAR(at(full, 90.0, 270.0), 0.2f, 0.02f);
}

TEST(Ies, TiltIsReadAndLeftAlone)
{
    std::string tilted = kCone;
    tilted.replace(tilted.find("NONE\n"), 5, "INCLUDE\n1\n2\n0 90\n1.0 0.8\n");
    EXPECT_EQ(at(read_ies(tilted, "t"), 0.0, 0.0), 1.0f);
}

TEST(Ies, WhatIsDamagedIsRefused)
{
    EXPECT_NE(said("").find("lamp.ies: no TILT"), std::string::npos);
    EXPECT_NE(said("TILT=other.tlt\n1").find("NONE or INCLUDE"), std::string::npos);
    EXPECT_NE(said(head("3 1 2") + "0 45 90\n0\n1 1 1\n").find("type B"), std::string::npos);
    EXPECT_NE(said(head("3 1 1") + "0 45 45\n0\n1 1 1\n").find("must grow"), std::string::npos);
    EXPECT_NE(said(head("3 1 1") + "0 45 200\n0\n1 1 1\n").find("0 to 180"), std::string::npos);
    EXPECT_NE(said(head("2 2 1") + "0 90\n0 70\n1 1\n1 1\n").find("horizontal angles"), std::string::npos);
    EXPECT_NE(said(head("3 1 1") + "0 45 90\n0\n1 -1 1\n").find("0 or more"), std::string::npos);
    EXPECT_NE(said(head("3 1 1") + "0 45 90\n0\n0 0 0\n").find("all candelas are 0"), std::string::npos);
    EXPECT_NE(said(head("3 1 1") + "0 45 90\n0\n1 nan 1\n").find("must be a number"), std::string::npos);
    EXPECT_NE(said(head("1e9 1 1")).find("whole number"), std::string::npos);
    EXPECT_NE(said(head("-3 1 1")).find("whole number"), std::string::npos);
    // Cut anywhere, it is refused or it is whole.
    for (std::size_t n = 0; n + 3 < kCone.size(); ++n) EXPECT_NE(said(kCone.substr(0, n)), "") << n;
}

}  // namespace
}  // namespace petrichor::scene
