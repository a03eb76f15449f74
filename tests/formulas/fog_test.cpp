#include <gtest/gtest.h>

#include "formulas/light/fog.h"

namespace petrichor::shared {
namespace {

TEST(Fog, LeavesTwoPercentAtTheVisibility)
{
    EXPECT_NEAR(fog_kept(FOG_METRES, 1000.0f, 3.912f / 1000.0f, 0.0f, 0.0f), 0.02f, 1e-4f);
    EXPECT_NEAR(fog_kept(FOG_EXP2, 100.0f, 0.01f, 0.0f, 0.0f), std::exp(-1.0f), 1e-6f);
    EXPECT_FLOAT_EQ(fog_kept(FOG_LINEAR, 30.0f, 1.0f, 20.0f, 40.0f), 0.5f);
    EXPECT_EQ(fog_kept(FOG_LINEAR, 10.0f, 1.0f, 20.0f, 40.0f), 1.0f);
    EXPECT_EQ(fog_kept(FOG_LINEAR, 50.0f, 1.0f, 20.0f, 40.0f), 0.0f);
    EXPECT_EQ(fog_kept(FOG_OFF, 50.0f, 1.0f, 20.0f, 40.0f), 1.0f);
}

TEST(Fog, PathsAddUpAlongARayAndDoNotKnowItsDirection)
{
    for (const float low : {0.0f, 30.0f, 400.0f}) {
        for (const float rise : {0.0f, 0.01f, 20.0f, 900.0f}) {
            const float whole = fog_path(1000.0f, low, low + rise, 120.0f);
            const float parts = fog_path(300.0f, low, low + 0.3f * rise, 120.0f) +
                                fog_path(700.0f, low + 0.3f * rise, low + rise, 120.0f);
            EXPECT_NEAR(parts, whole, 1e-3f * whole) << low << " " << rise;
            EXPECT_FLOAT_EQ(fog_path(1000.0f, low + rise, low, 120.0f), whole);
            EXPECT_LE(whole, 1000.0f);
        }
    }
    EXPECT_EQ(fog_path(70.0f, 5.0f, 90.0f, 0.0f), 70.0f) << "no top";
    EXPECT_GE(fog_path(1e6f, 1e6f, 0.0f, 10.0f), 0.0f) << "and no number that is none";
    EXPECT_NEAR(fog_path(10.0f, -30.0f, -20.0f, 10.0f), 10.0f, 1e-5f) << "below the base";
}

TEST(Fog, TheSkyLiesBehindTheLayer)
{
    EXPECT_NEAR(fog_path_to_sky(1.0f, 0.0f, 120.0f), 120.0f, 0.01f);
    EXPECT_NEAR(fog_path_to_sky(0.0f, 0.0f, 120.0f), std::sqrt(3.14159265f * 6360000.0f * 60.0f),
                10.0f);
    // As far as a very long ray within the layer.
    EXPECT_NEAR(fog_path_to_sky(0.5f, 20.0f, 120.0f), fog_path(1e5f, 20.0f, 20.0f + 5e4f, 120.0f),
                0.5f);
    EXPECT_LT(fog_kept(FOG_METRES, fog_path_to_sky(0.0f, 0.0f, 120.0f), 0.001f, 0.0f, 0.0f), 1e-6f);
    EXPECT_EQ(fog_beyond_haze(3.912f / 25000.0f), 0.0f);
    EXPECT_GT(fog_beyond_haze(3.912f / 5000.0f), 0.0f);
}

TEST(Fog, TheLandLiesBehindTheMoreTheHigherTheEye)
{
    EXPECT_NEAR(fog_path_to_land(-0.5f, 10.0f, 0.0f), 20.0f, 1e-4f) << "even air: the distance";
    EXPECT_NEAR(fog_path_to_land(-1.0f, 1e5f, 120.0f), 120.0f, 0.01f) << "straight down: as straight up";
    float before = 0.0f;
    for (const float above : {0.0f, 1.0f, 2.0f, 10.0f, 50.0f, 200.0f, 1000.0f}) {
        const float path = fog_path_to_land(-0.1f, above, 120.0f);
        EXPECT_GE(path, before);
        before = path;
    }
    // Towards the horizon it meets the sky's.
    EXPECT_EQ(fog_path_to_land(-1e-9f, 2.0f, 120.0f), fog_path_to_sky(0.0f, 0.0f, 120.0f));
    EXPECT_EQ(fog_path_to_land(-0.3f, -5.0f, 120.0f), 0.0f) << "below the land";
}

TEST(Fog, CloudsAreSeenThroughHalfOfWhatRainTakes)
{
    EXPECT_EQ(fog_before_clouds(0.002f, 0.0f), 0.002f) << "fog hides them whole";
    EXPECT_FLOAT_EQ(fog_before_clouds(0.002f, 0.001f), 0.0015f);
    EXPECT_FLOAT_EQ(fog_before_clouds(0.002f, 0.01f), 0.001f) << "of rain that takes more than the sight tells";
}

TEST(Fog, ScattersAllThatItTakes)
{
    double sum = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double c = -1.0 + 2.0 * (i + 0.5) / n;
        sum += static_cast<double>(fog_phase(static_cast<float>(c))) * 2.0 / n * 2.0 *
               3.14159265358979;
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
}

}  // namespace
}  // namespace petrichor::shared
