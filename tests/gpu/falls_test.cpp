// The directions that rain and snow come from.
#include "gpu/frame/falls.h"

#include <gtest/gtest.h>

#include "gpu/frame/view.h"

namespace petrichor::gpu {
namespace {

std::array<glm::vec3, SKY_DIRECTIONS> sky()
{
    std::array<glm::vec3, SKY_DIRECTIONS> directions;
    for (int i = 0; i < SKY_DIRECTIONS; ++i) directions[static_cast<std::size_t>(i)] = sky_direction(i);
    return directions;
}

shared::WeatherMoment windy(float m_s, float mm_h = 5.0f)
{
    shared::WeatherMoment w;
    w.wind_m_s = {m_s, 0.0f};  // the air goes to +x
    w.rain_kg_m2_s = mm_h / 3600.0f;
    return w;
}

glm::vec3 mean_from(const std::vector<Fall>& falls, float Fall::*share)
{
    glm::vec3 sum(0.0f);
    for (const Fall& f : falls) sum += sky_direction(f.direction) * (f.*share);
    return sum;
}

TEST(Falls, SharesSumToOneAndComeFromUpwind)
{
    for (const float wind : {0.0f, 3.0f, 10.0f, 22.0f, 60.0f}) {
        const auto found = falls(windy(wind), sky());
        float rain = 0.0f;
        float snow = 0.0f;
        for (const Fall& f : found) {
            EXPECT_GE(f.rain, 0.0f);
            EXPECT_GE(f.snow, 0.0f);
            rain += f.rain;
            snow += f.snow;
        }
        EXPECT_NEAR(rain, 1.0f, 1e-5f) << wind;
        EXPECT_NEAR(snow, 1.0f, 1e-5f) << wind;
        EXPECT_GE(found.size(), 3u) << "one hard direction is no shelter of weather";
        if (wind < 3.0f) continue;
        EXPECT_LT(mean_from(found, &Fall::rain).x, -0.1f) << wind;
        EXPECT_LT(mean_from(found, &Fall::snow).x, -0.1f) << wind;
    }
}

TEST(Falls, WindTiltsRainAndHeavyRainLess)
{
    const float still = mean_from(falls(windy(0.0f), sky()), &Fall::rain).y;
    const float breeze = mean_from(falls(windy(8.0f), sky()), &Fall::rain).y;
    const float gale = mean_from(falls(windy(25.0f), sky()), &Fall::rain).y;
    EXPECT_GT(still, 0.93f);
    EXPECT_LT(breeze, still);
    EXPECT_LT(gale, breeze);
    EXPECT_GT(mean_from(falls(windy(20.0f, 80.0f), sky()), &Fall::rain).y,
              mean_from(falls(windy(20.0f, 1.0f), sky()), &Fall::rain).y);
}

TEST(Falls, EddiesBringHalfTheSnowFromAbove)
{
    float steep = 0.0f;
    for (const Fall& f : falls(windy(25.0f), sky())) {
        if (sky_direction(f.direction).y > 0.866f) steep += f.snow;
    }
    EXPECT_NEAR(steep, 0.5f, 0.06f);
}

TEST(Falls, ChangeSmoothlyWithTheWind)
{
    std::array<float, SKY_DIRECTIONS> before{};
    for (int i = 0; i <= 2200; ++i) {
        std::array<float, SKY_DIRECTIONS> now{};
        for (const Fall& f : falls(windy(0.01f * static_cast<float>(i)), sky())) {
            now[static_cast<std::size_t>(f.direction)] = f.rain + f.snow;
        }
        if (i > 0) {
            for (std::size_t k = 0; k < now.size(); ++k) EXPECT_NEAR(now[k], before[k], 0.02f) << i;
        }
        before = now;
    }
}

}  // namespace
}  // namespace petrichor::gpu
