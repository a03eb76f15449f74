// The comparer itself: what must fail fails, what may differ may, files keep every bit.
#include "tests/golden/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/program.h"

namespace petrichor::golden {
namespace {

using testing::HasSubstr;

Picture ramp()
{
    Picture picture{40, 25, {}};
    for (const char* name : {"R", "G", "B", "A", "depth.Z"}) {
        Channel channel{name, std::string(name) != "depth.Z", {}};
        for (int i = 0; i < 1000; ++i) {
            channel.values.push_back(channel.name == "A" ? 1.0f : static_cast<float>(i));
        }
        picture.channels.push_back(channel);
    }
    picture.channels[4].values[7] = std::numeric_limits<float>::infinity();
    return picture;
}

TEST(GoldenCompare, TheSamePictureIsEqual)
{
    const Comparison same = compare(ramp(), ramp(), kExact);
    EXPECT_TRUE(same.equal());
    EXPECT_TRUE(passes(same, kExact));
    EXPECT_EQ(same.values, 5000u);
    EXPECT_EQ(summary(same), "equal, 5000 values");
}

TEST(GoldenCompare, OneValueFarOffFails)
{
    Picture changed = ramp();
    changed.channels[1].values[500] *= 2.5f;
    const Comparison c = compare(changed, ramp(), Tolerance{});
    EXPECT_FALSE(passes(c, Tolerance{}));
    EXPECT_EQ(c.differ, 1u);
    EXPECT_NEAR(c.largest, 1.5f, 1e-6f);
    EXPECT_THAT(summary(c), HasSubstr("G at 20, 12: 1250, expected 500"));
}

TEST(GoldenCompare, ManyValuesALittleOffFail)
{
    for (const int changed_values : {20, 30}) {  // 0.4 % and 0.6 % of 5000
        Picture changed = ramp();
        for (int i = 0; i < changed_values; ++i) {
            changed.channels[0].values[static_cast<std::size_t>(900 + i)] *= 1.03f;
        }
        const Comparison c = compare(changed, ramp(), Tolerance{});
        EXPECT_EQ(c.over, static_cast<std::size_t>(changed_values));
        EXPECT_EQ(passes(c, Tolerance{}), changed_values == 20);
    }
}

TEST(GoldenCompare, TheLastBitFailsOnlyWhenAllBitsAreAskedFor)
{
    Picture changed = ramp();
    changed.channels[4].values[900] = std::nextafter(900.0f, 1000.0f);
    const Comparison c = compare(changed, ramp(), Tolerance{});
    EXPECT_TRUE(passes(c, Tolerance{}));
    EXPECT_FALSE(c.equal());
    EXPECT_FALSE(passes(compare(changed, ramp(), kExact), kExact));
}

// Dark values are measured by the mean of the channels beside them, not by themselves.
TEST(GoldenCompare, ADarkCornerIsMeasuredByThePicture)
{
    Picture changed = ramp();
    changed.channels[0].values[0] = 5.0f;  // expected 0; the mean is 499.5
    EXPECT_NEAR(compare(changed, ramp(), Tolerance{}).largest, 5.0f / 499.5f, 1e-6f);
}

TEST(GoldenCompare, WhatIsNotFiniteMustStaySo)
{
    Picture changed = ramp();
    changed.channels[4].values[7] = 1e30f;
    EXPECT_FALSE(passes(compare(changed, ramp(), Tolerance{}), Tolerance{}));
    changed = ramp();
    changed.channels[0].values[3] = NAN;
    EXPECT_FALSE(passes(compare(changed, ramp(), Tolerance{}), Tolerance{}));
    EXPECT_TRUE(compare(changed, changed, kExact).equal());
}

TEST(GoldenCompare, OtherShapesFail)
{
    Picture other = ramp();
    other.channels.pop_back();
    EXPECT_THAT(summary(compare(other, ramp(), Tolerance{})), HasSubstr("depth.Z is missing"));
    EXPECT_FALSE(passes(compare(other, ramp(), Tolerance{}), Tolerance{}));
    EXPECT_THAT(summary(compare(ramp(), other, Tolerance{})), HasSubstr("depth.Z is new"));
    Picture turned = ramp();
    std::swap(turned.width, turned.height);
    EXPECT_THAT(summary(compare(turned, ramp(), Tolerance{})), HasSubstr("25 x 40 pixels"));
}

TEST(GoldenCompare, FilesKeepEveryBit)
{
    const testing_program::Workplace place("golden_compare");
    Picture picture = ramp();
    picture.channels[4].values[3] = 0.1f;  // a float that no half holds
    picture.channels[0].values[3] = 65504.0f;
    write_picture(place / "p.exr", picture);
    const Comparison c = compare(read_picture(place / "p.exr"), picture, kExact);
    EXPECT_TRUE(c.equal()) << summary(c);
}

}  // namespace
}  // namespace petrichor::golden
