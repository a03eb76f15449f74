#include "base/words.h"

#include <gtest/gtest.h>

namespace petrichor::cli {
namespace {

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
