// Walls that drink rain.
#include "formulas/weather/soaked_walls.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::shared {
namespace {

TEST(SoakedWalls, AreUprightAndPorous)
{
    EXPECT_EQ(drinking_wall(0.0f, 0.6f), 1.0f);
    EXPECT_EQ(drinking_wall(-0.1f, 1.0f), 1.0f);
    EXPECT_EQ(drinking_wall(0.0f, 0.0f), 0.0f) << "glass and paint";
    EXPECT_EQ(drinking_wall(0.9f, 1.0f), 0.0f) << "ground and roofs";
    EXPECT_EQ(film_not_drunk(0.0f, 0.0f), 1.0f);
    EXPECT_NEAR(film_not_drunk(1.0f, 0.0f), 0.2f, 1e-6f);
    EXPECT_GT(film_not_drunk(1.0f, 1.0f), film_not_drunk(1.0f, 0.0f)) << "water runs over them while it pours";
}

// Over a wall: as dry and as wet at the ends as the weather says, in between wetter than the film, in streaks.
TEST(SoakedWalls, FillBeforeAFilmClosesAndInStreaks)
{
    double before = -1.0;
    for (const float film : {0.0f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 1.0f}) {
        double sum = 0.0, squares = 0.0, along = 0.0, down = 0.0;
        constexpr int kPlaces = 4000;
        for (int i = 0; i < kPlaces; ++i) {
            const float x = 60.0f * hash_f(static_cast<uint>(i)), y = 30.0f * hash_f(static_cast<uint>(i) + 7777u);
            const auto here = static_cast<double>(soaked_share(film, x, y));
            EXPECT_GE(here, 0.0);
            EXPECT_LE(here, 1.0);
            sum += here / kPlaces;
            squares += here * here / kPlaces;
            along += std::abs(static_cast<double>(soaked_share(film, x + 0.2f, y)) - here) / kPlaces;
            down += std::abs(static_cast<double>(soaked_share(film, x, y + 0.2f)) - here) / kPlaces;
        }
        const double deviation = std::sqrt(std::max(squares - sum * sum, 0.0));
        if (film == 0.0f || film == 1.0f) {
            EXPECT_NEAR(sum, static_cast<double>(film), 1e-6);
            EXPECT_NEAR(deviation, 0.0, 1e-6);
        } else {
            EXPECT_GT(sum, static_cast<double>(film));
            EXPECT_GT(along, 3.0 * down) << "streaks run down, at " << film;
        }
        if (film == 0.5f) {
            EXPECT_GT(deviation, 0.08);
        }
        EXPECT_GT(sum, before);
        before = sum;
    }
}

}  // namespace
}  // namespace petrichor::shared
