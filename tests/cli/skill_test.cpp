// The skill board: every shared data set keeps its stated score; the board itself on made-up data.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "cli/bench/skill/board.h"
#include "cli/bench/skill/find_sets.h"
#include "cli/bench/skill/longwave.h"
#include "tests/support/assets.h"

namespace petrichor::cli {
namespace {

TEST(Skill, SharedDataKeepTheirStatedScores)
{
    NEED_ASSETS(assets);
    const Board board = skill_board({.data = (assets / "weather").string()});
    int stated = 0;
    for (const BoardRow& row : board.rows) {
        if (!row.stated) continue;
        ++stated;
        EXPECT_FALSE(row.worse()) << row.ours.set << ", " << row.ours.quantity << ": "
                                  << row.ours.score << ", stated " << row.stated->stated << " + "
                                  << row.stated->margin;
    }
    EXPECT_GE(stated, 80);
    std::printf("%s", board_text(board).c_str());
}

// What the release promises over all shared winters and roads.
TEST(Skill, MeansOverTheSharedData)
{
    NEED_ASSETS(assets);
    const Board board = skill_board({.data = (assets / "weather").string()});
    const auto mean = [&](const std::string& quantity, const char* but_not) {
        ErrorSum sum;
        for (const BoardRow& row : board.rows) {
            const bool broken = row.ours.set == "case040" || row.ours.set == "case044";
            if (row.ours.quantity == quantity && row.ours.set.rfind("mean", 0) != 0 &&
                !(broken && *but_not))
                sum.add(row.ours.score);
        }
        return sum.bias();
    };
    EXPECT_LE(mean("snow depth", ""), 0.115);
    EXPECT_LE(mean("SWE", ""), 43.0);
    EXPECT_LE(mean("snow depth without longwave", ""), 1.5 * mean("snow depth", ""));
    // Two cases hold what never fell (70 mm/h of snow, 10 m/h of rain).
    EXPECT_LE(mean("road beside METRo", "but not the broken"), 1.0);
    EXPECT_LE(mean("road beside METRo", "but not the broken"),
              0.5 * mean("air beside METRo", "but not the broken"));
    EXPECT_LT(mean("road measured", ""), mean("air beside the measured road", ""));
}

TEST(Skill, AFolderWithoutDataIsNamed)
{
    const auto folder = std::filesystem::temp_directory_path() / "petrichor_skill_empty";
    std::filesystem::create_directories(folder);
    EXPECT_THROW(find_skill_sets(folder.string()), Error);
    EXPECT_THROW(find_skill_sets((folder / "none").string()), Error);
}

// A perfect model has no error, one that is 0.2 m too deep has 0.2 m.
TEST(Skill, ErrorsAreThoseOfTheModel)
{
    Winter winter;
    winter.name = "made up";
    winter.observed.daily = true;
    SnowHours model;
    for (int day = 0; day < 10; ++day) {
        const double depth = day < 6 ? 1.0 : 0.0;
        if (winter.observed.columns.empty())
            winter.observed.columns.push_back({"snow_depth_m", {}, {}});
        winter.observed.columns[0].time_us.push_back(day * 86400000000LL);
        winter.observed.columns[0].values.push_back(depth);
        for (int h = 0; h < 24; ++h)
            model.hours.push_back({day < 7 ? depth + 0.2 : 0.0, 0, 0, 0, 0});
    }
    const auto rows = winter_rows(winter, model);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].quantity, "snow depth");
    EXPECT_NEAR(rows[0].score, std::sqrt(7 * 0.04 / 10), 1e-12);
    EXPECT_NEAR(rows[0].bias, 0.14, 1e-12);
    EXPECT_EQ(rows[1].quantity, "snow off");
    EXPECT_NEAR(rows[1].bias, 1.0, 1e-12);
}

}  // namespace
}  // namespace petrichor::cli
