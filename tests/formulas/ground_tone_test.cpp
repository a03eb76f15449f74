#include "formulas/weather/ground_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/weather/ground_fields.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/surface_weather.h"
#include "formulas/weather/weather_maps.h"

namespace petrichor::shared {
namespace {

struct Spread {
    double mean = 0.0, deviation = 0.0, least = 1e9, most = -1e9;
};

template <typename Value>
Spread spread_of(int count, Value value)
{
    Spread s;
    double squares = 0.0;
    for (int i = 0; i < count; ++i) {
        const vec2 at(40000.0f * hash_f(static_cast<uint>(i)) - 20000.0f,
                      40000.0f * hash_f(static_cast<uint>(i) + 99991u) - 20000.0f);
        const double v = static_cast<double>(value(at));
        s.mean += v / count;
        squares += v * v / count;
        s.least = std::min(s.least, v);
        s.most = std::max(s.most, v);
    }
    s.deviation = std::sqrt(squares - s.mean * s.mean);
    return s;
}

// Ground is as bright as its texture says, here more and there less.
TEST(GroundTone, VariesAboutWhatTheTextureSays)
{
    for (int channel = 0; channel < 3; ++channel) {
        const Spread s = spread_of(40000, [&](vec2 at) { return ground_tone(at, 0.0f, 1.0f)[channel]; });
        EXPECT_NEAR(s.mean, 1.0, 0.005) << channel;
        EXPECT_GT(s.deviation, 0.04) << channel;
        EXPECT_LT(s.deviation, 0.16) << channel;
        EXPECT_GT(s.least, 0.5) << channel;
        EXPECT_LT(s.most, 1.5) << channel;
    }
    const Spread moist = spread_of(40000, [](vec2 at) { return ground_moisture(at, 0.0f); });
    EXPECT_NEAR(moist.mean, 0.0, 0.01);
    EXPECT_NEAR(moist.deviation, 0.2, 0.06);
    EXPECT_GT(moist.least, -1.0);
    EXPECT_LT(moist.most, 1.0);
}

// What grows there is a second thing, so that a field differs in hue and not in brightness alone; and a wide one goes on varying over a
// kilometre.
TEST(GroundTone, VariesInHueToo)
{
    const Spread hue = spread_of(40000, [](vec2 at) {
        const vec3 tone = ground_tone(at, 0.0f, 1.0f);
        return tone.x / tone.y;
    });
    EXPECT_GT(hue.deviation, 0.055);
    const auto together = spread_of(40000, [](vec2 at) {
        const GroundGrowth growth = ground_growth(at, 0.0f);
        return growth.moist * growth.other;
    });
    EXPECT_NEAR(together.mean, 0.0, 0.006);
    const double far = spread_of(20000, [](vec2 at) { return ground_moisture(at, 300.0f); }).deviation;
    EXPECT_GT(far, 0.09);
}

TEST(GroundFields, AreAsBrightAsTheirTextureInTheMean)
{
    for (const float width_m : {0.0f, 20.0f, 200.0f}) {
        for (int channel = 0; channel < 3; ++channel) {
            const Spread s = spread_of(100000, [&](vec2 at) { return field_tone(at, width_m, 1.0f)[channel]; });
            EXPECT_NEAR(s.mean, 1.0, 0.008) << width_m << " " << channel;
            EXPECT_GT(s.least, 0.1);
            EXPECT_LT(s.most, 1.9);
            if (width_m == 0.0f) {
                EXPECT_GT(s.deviation, 0.15) << "land of many colours";
                EXPECT_LT(s.deviation, 0.38);
            }
            if (width_m == 200.0f) {
                EXPECT_LT(s.deviation, 0.13) << "parcels of a pixel are one colour";
            }
        }
    }
}

// Inside a parcel all is alike, and the next but one tells nothing of it; from one to the next there is a border and no step.
TEST(GroundFields, AreParcelsOfOneCropEach)
{
    const auto alike = [](float apart_m) {
        double products = 0.0, squares = 0.0;
        for (uint i = 0; i < 20000u; ++i) {
            const vec2 at(40000.0f * hash_f(i), 40000.0f * hash_f(i + 77777u));
            const double a = static_cast<double>(field_tone(at, 0.0f, 1.0f).x) - 1.0;
            const double b = static_cast<double>(field_tone(at + vec2(0.6f, 0.8f) * apart_m, 0.0f, 1.0f).x) - 1.0;
            products += a * b;
            squares += a * a;
        }
        return products / squares;
    };
    EXPECT_GT(alike(20.0f), 0.6);
    EXPECT_LT(std::abs(alike(900.0f)), 0.1);
    float step = 0.0f;
    for (float x = 0.0f; x < 4000.0f; x += 0.05f)
        step = std::max(step, std::abs(field_tone({x + 0.05f, 0.3f * x}, 0.0f, 1.0f).x - field_tone({x, 0.3f * x}, 0.0f, 1.0f).x));
    EXPECT_LT(step, 0.03f);
}

// As much of the land is hedges in pixels of any width, and they stand out of the snow.
TEST(GroundFields, HedgesAreThatMuchOfTheLandAndStandOutOfSnow)
{
    for (const float width_m : {0.0f, 20.0f, 60.0f, 300.0f}) {
        const Spread s = spread_of(100000, [&](vec2 at) { return field_at(at, width_m, 1.0f).hedge; });
        EXPECT_NEAR(s.mean, static_cast<double>(kHedged), 0.006) << width_m;
        EXPECT_GE(s.least, 0.0);
        EXPECT_LE(s.most, 1.0);
        if (width_m == 0.0f) {
            EXPECT_GT(s.most, 0.99);
        }
    }
    EXPECT_EQ(snow_beside_hedges(0.8f, 0.0f), 0.8f);
    EXPECT_LT(snow_beside_hedges(0.8f, 1.0f), 0.25f);
    EXPECT_EQ(field_at({900.0f, 40.0f}, 3.0f, 0.0f).hedge, 0.0f);
}

TEST(GroundFields, AreOfLevelGreenGroundFarFromTheScene)
{
    const vec3 green(0.1f, 0.17f, 0.05f), soil(0.2f, 0.16f, 0.12f), grey(0.15f);
    EXPECT_EQ(farmed_share({900.0f, 0.0f}, 1.0f, green), 1.0f);
    EXPECT_EQ(farmed_share({90.0f, 60.0f}, 1.0f, green), 0.0f);
    EXPECT_EQ(farmed_share({900.0f, 0.0f}, 0.9f, green), 0.0f) << "26 degrees";
    EXPECT_EQ(farmed_share({900.0f, 0.0f}, 1.0f, soil), 0.0f);
    EXPECT_EQ(farmed_share({900.0f, 0.0f}, 1.0f, grey), 0.0f);
    EXPECT_EQ(farmed_share({900.0f, 0.0f}, 1.0f, vec3(0.0f)), 0.0f);
    EXPECT_EQ(field_tone({900.0f, 40.0f}, 3.0f, 0.0f), vec3(1.0f));
}

TEST(GroundTone, IsOffAtNoneAndGoneInAWidePixel)
{
    for (float x = -900.0f; x < 900.0f; x += 37.0f) {
        EXPECT_EQ(ground_tone(vec2(x, 3.0f * x), 0.5f, 0.0f), vec3(1.0f));
        EXPECT_NEAR(ground_tone(vec2(x, 3.0f * x), 1.0e5f, 1.0f).y, 1.0f, 2e-3f);
    }
    // The wider the pixel the less is left.
    double before = 1.0;
    for (const float width_m : {0.0f, 5.0f, 20.0f, 80.0f, 300.0f, 1000.0f}) {
        const double now = spread_of(8000, [&](vec2 at) { return ground_moisture(at, width_m); }).deviation;
        EXPECT_LT(now, before) << width_m;
        before = now;
    }
}

// Over metres, tens and hundreds of metres: each of these steps finds other ground, and a hand's width does not.
TEST(GroundTone, VariesOverMetresToHundredsOfMetres)
{
    double before = 0.0;
    for (const float step_m : {0.1f, 4.0f, 20.0f, 60.0f, 250.0f}) {
        const double differs = spread_of(20000, [&](vec2 at) {
                                   return ground_moisture(at + vec2(step_m, 0.0f), 0.0f) - ground_moisture(at, 0.0f);
                               }).deviation;
        EXPECT_GT(differs, before) << step_m;
        if (step_m < 1.0f) {
            EXPECT_LT(differs, 0.01);
        }
        before = differs;
    }
    EXPECT_GT(before, 0.2);
}

// Slopes along two axes at right angles against those between: 0 where no direction is preferred, 1 where two alone are.
template <typename Value>
double squareness(Value value)
{
    double along = 0.0, across = 0.0, all = 0.0;
    for (uint i = 0; i < 60000u; ++i) {
        const vec2 at(900.0f * hash_f(i) - 450.0f, 900.0f * hash_f(i + 7777777u) - 450.0f);
        const double x = static_cast<double>(value(at + vec2(1.0f, 0.0f)) - value(at - vec2(1.0f, 0.0f)));
        const double z = static_cast<double>(value(at + vec2(0.0f, 1.0f)) - value(at - vec2(0.0f, 1.0f)));
        const double square = x * x + z * z;
        const double turn = 4.0 * std::atan2(z, x);
        along += square * std::cos(turn);
        across += square * std::sin(turn);
        all += square;
    }
    return std::hypot(along, across) / all;
}

// Puddles are no boxes along the axes of the world, as those of noise of one lattice are.
TEST(GroundRelief, HasNoDirectionOfItsOwn)
{
    EXPECT_LT(squareness([](vec2 at) { return ground_relief(at); }), 0.06);
    EXPECT_GT(squareness([](vec2 at) { return endless_noise(at * 0.43f, 131u); }), 0.15);
}

// Shores wind within a hand's breadth too: over 6 cm, how far a place lies from the middle of those beside it.
TEST(GroundRelief, GoesOnToAHandsBreadth)
{
    const Spread bend = spread_of(40000, [](vec2 at) {
        const vec2 beside(0.06f, 0.0f), here = at * 0.02f;
        return ground_relief(here + beside) + ground_relief(here - beside) - 2.0f * ground_relief(here);
    });
    EXPECT_GT(bend.deviation, 0.015);
}

// Hollows that are four times narrower have no finer parts that are four times steeper too: over a finger's breadth of theirs shores are
// smoother than a copy made smaller would be, and each hollow is where it was.
TEST(GroundRelief, NarrowHollowsHaveNoRaggedShores)
{
    const auto bend = [](float narrower) {
        return spread_of(40000, [narrower](vec2 at) {
            const vec2 beside(0.06f, 0.0f), here = at * 0.02f;
            return ground_relief_of(here + beside, narrower) + ground_relief_of(here - beside, narrower) - 2.0f * ground_relief_of(here, narrower);
        });
    };
    EXPECT_LT(bend(4.0f).deviation, 0.25 * bend(1.0f).deviation);
    EXPECT_EQ(bend(0.5f).deviation, bend(1.0f).deviation) << "wider ones are copies";
    const Spread apart = spread_of(40000, [](vec2 at) { return ground_relief_of(at, 4.0f) - ground_relief(at); });
    const Spread all = spread_of(40000, [](vec2 at) { return ground_relief_of(at, 4.0f); });
    EXPECT_LT(apart.deviation, 0.5 * all.deviation);
    EXPECT_NEAR(all.deviation, 0.14, 0.02);
}

// A green that no meadow has becomes one that some have; what is no such green, and all where the ground does not vary, stays as it is.
TEST(MeadowTone, ANeonGreenIsDulledAndStoneIsNot)
{
    const vec3 neon(0.25f, 0.43f, 0.058f);
    const vec3 dull = meadow_tone(neon, 1.0f);
    EXPECT_LT(dull.y, 0.7f * neon.y);
    EXPECT_LT(dull.y / dull.x, 0.85f * neon.y / neon.x);
    EXPECT_GT(dull.y, 1.15f * dull.x) << "still green";
    for (const vec3& kept : {vec3(0.095f, 0.118f, 0.047f), vec3(0.3f), vec3(0.25f, 0.2f, 0.15f), vec3(0.0f), vec3(0.3f, 0.35f, 0.4f)}) {
        EXPECT_EQ(meadow_tone(kept, 1.0f), kept);
        EXPECT_EQ(meadow_tone(neon, 0.0f), neon);
    }
    // No step, no more light than before, and brighter stays brighter.
    vec3 before(0.0f);
    for (float bright = 0.02f; bright < 2.0f; bright += 0.02f) {
        const vec3 now = meadow_tone(bright * neon, 1.0f);
        EXPECT_LE(dot(now, vec3(0.30f, 0.59f, 0.11f)), 1.001f * dot(bright * neon, vec3(0.30f, 0.59f, 0.11f)));
        EXPECT_GT(now.y, before.y);
        before = now;
    }
}

// A pond of wide ground ends in a marsh: never wider than the water, the deeper the more of it, whole in the end.
TEST(MarshCover, RisesWithTheDepthWithinThePond)
{
    for (const float stands_m : {-0.05f, 0.0f, 0.04f}) {
        EXPECT_EQ(marsh_cover(0.0f, stands_m).anywhere, 0.0f);
        EXPECT_EQ(marsh_cover(-0.3f, stands_m).deep, 0.0f);
        WaterCover before = marsh_cover(0.0f, stands_m);
        for (float depth_m = 0.002f; depth_m < 0.3f; depth_m += 0.002f) {
            const WaterCover now = marsh_cover(depth_m, stands_m);
            EXPECT_GE(now.anywhere, before.anywhere);
            EXPECT_GE(now.deep, before.deep);
            EXPECT_LE(now.anywhere, pond_cover(depth_m, stands_m).anywhere);
            EXPECT_LE(now.deep, now.anywhere);
            before = now;
        }
        EXPECT_EQ(before.anywhere, 1.0f);
        EXPECT_EQ(before.deep, 1.0f);
    }
    const Spread relief = spread_of(40000, [](vec2 at) { return wide_relief_m(at, 0.0f); });
    EXPECT_NEAR(relief.mean, 0.0, 0.001);
    EXPECT_NEAR(relief.deviation, 0.02, 0.006);
    EXPECT_LT(spread_of(4000, [](vec2 at) { return wide_relief_m(at, 30.0f); }).deviation, 0.2 * relief.deviation);
}

// One map alone has itself again a step of its tile on; with its second reading no step has.
TEST(SnowMaskOfTwo, RepeatsNowhere)
{
    const float tile_m = 1.0f / 0.09f;
    const auto map = [](vec2 p) { return snow_texel(p, 1.0f / 512.0f).z; };
    const auto one = [&](vec2 at) { return map(at * 0.09f); };
    double sum = 0.0;
    for (int i = 0; i < 4000; ++i)
        sum += static_cast<double>(map(vec2(hash_f(static_cast<uint>(i)), hash_f(static_cast<uint>(i) + 7919u))));
    const float mean = static_cast<float>(sum / 4000.0);
    const auto both = [&](vec2 at) { return mask_of_two(one(at), map(place_across(at * 0.09f)), mean); };
    const auto near = [](vec2 at) { return at * 0.01f; };  // 400 m
    const Spread of_one = spread_of(4000, [&](vec2 at) { return one(near(at)); });
    const Spread of_both = spread_of(4000, [&](vec2 at) { return both(near(at)); });
    EXPECT_NEAR(of_both.mean, of_one.mean, 0.02);
    EXPECT_NEAR(of_both.deviation, of_one.deviation, 0.1 * of_one.deviation);
    const double apart = std::sqrt(2.0) * of_both.deviation;  // of two places that know nothing of each other
    for (int tiles = 1; tiles <= 12; ++tiles) {
        for (const vec2 way : {vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
            const vec2 step = way * (tile_m * static_cast<float>(tiles));
            const auto differs = [&](const auto& mask) {
                return spread_of(1500, [&](vec2 at) { return mask(near(at) + step) - mask(near(at)); }).deviation;
            };
            EXPECT_LT(differs(one), 0.02) << tiles;
            EXPECT_GT(differs(both), 0.5 * apart) << tiles << " of (" << way.x << ", " << way.y << ")";
        }
    }
}

// Steep wide ground: where snow ends is not one slope but some degrees of them, and as much of it lies as before.
TEST(SnowHolds, IsNothingInTheMeanAndLessInAWidePixel)
{
    const auto holds = [](vec2 at, float width_m) { return snow_holds(slope_relief(vec3(at.x, 0.7f * at.x, at.y), width_m)); };
    const Spread s = spread_of(40000, [&](vec2 at) { return holds(at, 0.0f); });
    EXPECT_NEAR(s.mean, 0.0, 0.005);
    EXPECT_GT(s.deviation, 0.05);
    EXPECT_LE(s.most, 0.35);
    EXPECT_GE(s.least, -0.35);
    EXPECT_LT(spread_of(4000, [&](vec2 at) { return holds(at, 30.0f); }).deviation, 0.2 * s.deviation);
}

// Parts at each of its sizes; and nothing is drawn out down a slope, however steep: steps down it find other ground sooner than
// steps along it.
TEST(SlopeRelief, HasPartsOfManySizesAndNoStreaks)
{
    const auto flatter = [](vec3 p) { return slope_relief(p, 0.0f).flatter; };
    for (const float degrees : {35.0f, 60.0f, 80.0f, 89.0f}) {
        const float rise = std::tan(degrees * 0.01745329f);
        const auto on_slope = [&](vec2 at) { return vec3(at.x, rise * at.y, at.y); };
        const Spread all = spread_of(20000, [&](vec2 at) { return flatter(on_slope(at)); });
        EXPECT_NEAR(all.mean, 0.0, 0.03) << degrees;
        EXPECT_NEAR(all.deviation, 1.0, 0.07) << degrees;
        double before = 0.0;
        for (const float step_m : {0.05f, 0.3f, 1.0f, 3.0f}) {
            const vec3 down = step_m * vec3(0.0f, rise, 1.0f) / std::sqrt(1.0f + rise * rise);
            const double along = spread_of(20000, [&](vec2 at) { return flatter(on_slope(at) + vec3(step_m, 0, 0)) - flatter(on_slope(at)); }).deviation;
            const double below = spread_of(20000, [&](vec2 at) { return flatter(on_slope(at) + down) - flatter(on_slope(at)); }).deviation;
            EXPECT_GT(below, 0.99 * along) << degrees << " " << step_m;
            EXPECT_GT(along, before + 0.12) << degrees << " " << step_m;
            before = along;
        }
    }
}

// A third of the ground holds snow at 60 degrees, a tenth at 70; a wide pixel has the mean of its places.
TEST(SnowCaught, ThinsOutOverTheSlopesOfItsRelief)
{
    const auto share = [](float degrees, float width_m) {
        const float up = std::cos(degrees * 0.01745329f);
        return spread_of(20000, [&](vec2 at) { return snow_caught(up, slope_relief(vec3(at.x, 0.71f * at.x - 0.4f * at.y, at.y), width_m)); });
    };
    EXPECT_GT(share(35, 0).mean, 0.9);
    EXPECT_NEAR(share(60, 0).mean, 0.35, 0.06);
    EXPECT_NEAR(share(70, 0).mean, 0.1, 0.05);
    EXPECT_LT(share(80, 0).mean, 0.03);
    EXPECT_GT(share(60, 0).deviation, 0.3) << "in places, not as a veil";
    double before = 1.1;
    for (float degrees = 30; degrees <= 85; degrees += 5) {
        const double here = share(degrees, 0).mean;
        EXPECT_LE(here, before);
        EXPECT_NEAR(share(degrees, 0.7f).mean, here, 0.05) << degrees;
        EXPECT_NEAR(share(degrees, 20.0f).mean, here, 0.05) << degrees;
        before = here;
    }
    EXPECT_LT(share(60, 20.0f).deviation, 0.03);
}

}  // namespace
}  // namespace petrichor::shared
