#include "film/jobs/air_travel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::film {
namespace {

glm::dvec2 gusty(double clock_s)
{
    return {3.0 + 2.0 * std::sin(0.7 * clock_s), clock_s < 20.0 ? 0.0 : -4.0};
}

TEST(AirTravel, IsTheIntegralOfTheWindOverTheFilm)
{
    // 40 s of the clock in 8 s of film.
    const AirTravel air(gusty, 0.0, 40.0, 8.0);
    for (const double t : {0.0, 0.1, 7.3, 19.9, 33.3, 40.0}) {
        const double x = (3.0 * t + 2.0 / 0.7 * (1.0 - std::cos(0.7 * t))) * 0.2;
        EXPECT_NEAR(air.at(t).x, x, 2e-3 * (1.0 + x)) << t;
        EXPECT_NEAR(air.at(t).y, -4.0 * std::max(t - 20.0, 0.0) * 0.2, 0.11) << t;
    }
    EXPECT_EQ(air.at(-5.0), glm::dvec2(0.0));
    EXPECT_EQ(air.at(500.0), air.at(40.0));
    EXPECT_EQ(AirTravel().at(3.0), glm::dvec2(0.0));
}

TEST(AirTravel, NeverJumpsAndDoesNotKnowWhatWasAsked)
{
    const AirTravel air(gusty, 10.0, 5000.0, 400.0);
    const glm::dvec2 alone = air.at(1234.5);
    glm::dvec2 last = air.at(10.0);
    for (double t = 10.0; t < 200.0; t += 0.01) {
        const glm::dvec2 now = air.at(t);
        EXPECT_LT(glm::length(now - last), 0.01 * 0.08 * 8.0);
        last = now;
    }
    EXPECT_EQ(air.at(1234.5), alone);
    EXPECT_EQ(AirTravel(gusty, 10.0, 5000.0, 400.0).at(1234.5), alone);
}

}  // namespace
}  // namespace petrichor::film
