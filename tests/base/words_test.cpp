#include "base/words.h"

#include <gtest/gtest.h>

namespace petrichor::cli {
namespace {

TEST(Printable, EscapesWhatMovesACursorOrIsNoText)
{
    EXPECT_EQ(printable("wall 3.png"), "wall 3.png");
    EXPECT_EQ(printable("Stra\u00dfe \u6c34 \U0001f327"), "Stra\u00dfe \u6c34 \U0001f327");
    EXPECT_EQ(printable("a\x1b[2Jb\n"), "a\\x1b[2Jb\\x0a");
    EXPECT_EQ(printable("b\xff.epw"), "b\\xff.epw");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\xc2\\x9b"
              "31m");                                                 // CSI as one character
    EXPECT_EQ(printable("\u202etxt.exe"), "\\xe2\\x80\\xaetxt.exe");  // text that runs backwards
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                   // a long form of '/'
    EXPECT_EQ(printable("\xe6\xb0"), "\\xe6\\xb0");                   // cut short
    EXPECT_TRUE(is_utf8("\u6c34"));
    EXPECT_FALSE(is_utf8("\xed\xa0\x80"));
    EXPECT_FALSE(is_utf8("\xf4\x90\x80\x80"));
}

TEST(NearestWord, FindsSlipsOfTheFinger)
{
    const std::vector<std::string> known{"width", "height", "samples", "elevation_degrees"};
    EXPECT_EQ(nearest_word("widht", known), "width");
    EXPECT_EQ(nearest_word("hight", known), "height");
    EXPECT_EQ(nearest_word("Samples", known), "samples");
    EXPECT_EQ(nearest_word("elevation-degree", known), "elevation_degrees");
}

TEST(NearestWord, IsSilentWhenNothingIsNear)
{
    EXPECT_EQ(nearest_word("zzzzz", {"width", "height"}), "");
    EXPECT_EQ(did_you_mean("zzzzz", {"width"}), "");
}

TEST(GlobMatches, StarsAndQuestionMarks)
{
    EXPECT_TRUE(glob_matches("*cobble*", "Old_Cobblestone.001"));
    EXPECT_TRUE(glob_matches("a*b*c", "a1b2b3c"));
    EXPECT_TRUE(glob_matches("road?", "Road1"));
    EXPECT_TRUE(glob_matches("*", ""));
    EXPECT_FALSE(glob_matches("road?", "road"));
    EXPECT_FALSE(glob_matches("a*b", "a1c"));
    EXPECT_FALSE(glob_matches("", "x"));
}

TEST(NumberText, IsShortAndExact)
{
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(-3.0), "-3");
    EXPECT_EQ(std::stod(number_text(1.0 / 3.0)), 1.0 / 3.0);
}

}  // namespace
}  // namespace petrichor::cli
