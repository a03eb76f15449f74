#include "texproc/filter/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "texproc/filter/fitted_depth.h"
#include "texproc/filter/normal.h"

namespace petrichor::texproc {
namespace {

Image flat(float value)
{
    return Image(32, 32, 1, ColorSpace::Data, value);
}

// A square pit of 6 texels, 0.4 deep.
Image pit()
{
    Image h = flat(0.8f);
    for (int y = 10; y < 16; ++y) {
        for (int x = 10; x < 16; ++x) h.at(x, y, 0) = 0.4f;
    }
    return h;
}

TEST(Bake, AFlatMapSeesTheWholeSkyAndHoldsNoWater)
{
    for (const float v : ambient_occlusion(flat(0.3f)).pixels) EXPECT_FLOAT_EQ(v, 1.0f);
    for (const float v : cavity(flat(0.3f)).pixels) EXPECT_FLOAT_EQ(v, 0.5f);
    for (const float v : curvature(flat(0.3f)).pixels) EXPECT_FLOAT_EQ(v, 0.5f);
    const Hollows h = puddles(flat(0.3f));
    EXPECT_EQ(h.deepest, 0.0f);
    EXPECT_EQ(h.covered[0], 0.0f);
    const Image flow = flow_direction(flat(0.3f));
    for (std::size_t i = 2; i < flow.pixels.size(); i += 3) EXPECT_EQ(flow.pixels[i], 0.0f);
}

// A surface whose depth is known; noise of two codes of 8 bits, which is most of its slopes, moves
// the fit little. A height map of something else says so.
TEST(Bake, DepthIsFittedToTheNormals)
{
    Image height(64, 64, 1, ColorSpace::Data), noisy = height, other = height;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float u = 6.2831853f * static_cast<float>(x) / 64.0f;
            const float v = 6.2831853f * static_cast<float>(y) / 64.0f;
            height.at(x, y, 0) = 0.5f + 0.25f * std::sin(2.0f * u) + 0.2f * std::cos(u + 3.0f * v);
            noisy.at(x, y, 0) =
                height.at(x, y, 0) + static_cast<float>((x * 7 + y * 13) % 5 - 2) / 255.0f;
            other.at(x, y, 0) = 0.5f + 0.4f * std::cos(5.0f * u - 4.0f * v);
        }
    }
    for (const float depth : {0.0046f, 0.062f}) {
        const Image normal = normal_from_height(height, {.depth = depth});
        EXPECT_NEAR(fitted_depth(height, normal).depth, depth, 0.01f * depth);
        EXPECT_GT(fitted_depth(height, normal).agreement, 0.999f);
        EXPECT_NEAR(fitted_depth(noisy, normal).depth, depth, 0.02f * depth);
        EXPECT_LT(std::abs(fitted_depth(other, normal).agreement), 0.05f);
    }
    EXPECT_NEAR(correlation(height, noisy), 1.0, 0.01);
    EXPECT_EQ(correlation(height, Image(64, 64, 1, ColorSpace::Data, 0.5f)), 0.0);
    EXPECT_THROW(correlation(height, flat(0.5f)), Error);
}

TEST(Bake, APitIsDarkHollowAndFull)
{
    const BakeOptions options{.depth = 0.3f, .reach = 0.2f};
    const Image ao = ambient_occlusion(pit(), options);
    EXPECT_LT(ao.at(12, 12, 0), 0.8f);
    EXPECT_FLOAT_EQ(ao.at(2, 2, 0), 1.0f);
    EXPECT_LT(cavity(pit(), options).at(12, 12, 0), 0.4f);
    const Hollows h = puddles(pit(), options);
    EXPECT_NEAR(h.deepest, 0.4f, 1e-6f);
    EXPECT_FLOAT_EQ(h.depth.at(12, 12, 0), 1.0f);
    EXPECT_FLOAT_EQ(h.depth.at(20, 20, 0), 0.0f);
    EXPECT_NEAR(h.covered[0], 36.0f / 1024.0f, 1e-6f);
    EXPECT_TRUE(std::is_sorted(h.covered.rbegin(), h.covered.rend()));
    // Too wide for a crack: the disc of a fifth of the reach fits in.
    EXPECT_LT(cracks(pit(), options).deepest, 0.2f);
}

TEST(Bake, MasksOfARolledMapAreRolled)
{
    Image rolled = flat(0.0f);
    const Image map = pit();
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) rolled.at((x + 21) % 32, y, 0) = map.at(x, y, 0);
    }
    const BakeOptions options{.depth = 0.3f, .reach = 0.2f, .threads = 2};
    const Image a = ambient_occlusion(map, options), b = ambient_occlusion(rolled, options);
    const Image c = puddles(map, options).depth, d = puddles(rolled, options).depth;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            EXPECT_EQ(b.at((x + 21) % 32, y, 0), a.at(x, y, 0));
            EXPECT_EQ(d.at((x + 21) % 32, y, 0), c.at(x, y, 0));
        }
    }
}

// The closing, taken literally: an octagon is a square step and a diamond step in turn.
// Hills that do not tile.
Image uneven(int width, int height)
{
    Image h(width, height, 1, ColorSpace::Data);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = static_cast<float>(x), v = static_cast<float>(y);
            h.at(x, y, 0) = 0.4f + 0.004f * u + 0.006f * v +
                            0.15f * std::sin(0.71f * u + 0.3f * v) * std::cos(0.53f * v - 0.2f * u);
        }
    }
    return h;
}

// A mirrored map is one quarter of a map that tiles: what is baked from the one is a quarter of
// what is baked from the other.
TEST(Bake, MirroredMapsAreAQuarterOfTheTileThatTheyMake)
{
    const Image map = uneven(40, 24);
    Image tile(80, 48, 1, ColorSpace::Data);
    for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x)
            tile.at(x, y, 0) = map.at(x < 40 ? x : 79 - x, y < 24 ? y : 47 - y, 0);
    }
    const BakeOptions mirrored{
        .depth = 0.3f, .reach = 0.2f, .edge_u = Edge::Mirror, .edge_v = Edge::Mirror};
    const BakeOptions wrapped{.depth = 0.15f, .reach = 0.1f};  // of twice the width
    const auto check = [&](const char* what, const Image& part, const Image& whole,
                           float room = 1e-4f) {
        for (int y = 0; y < part.height; ++y) {
            for (int x = 0; x < part.width; ++x) {
                for (int c = 0; c < part.channels; ++c)
                    ASSERT_NEAR(part.at(x, y, c), whole.at(x, y, c), room) << what << x << y;
            }
        }
    };
    check("occlusion", ambient_occlusion(map, mirrored), ambient_occlusion(tile, wrapped));
    check("cavity", cavity(map, mirrored), cavity(tile, wrapped));
    check("curvature", curvature(map, mirrored), curvature(tile, wrapped));
    check("flow", flow_direction(map, mirrored), flow_direction(tile, wrapped));
    // The deepest of four times the texels is another quantile by a hair.
    check("puddle", puddles(map, mirrored).depth, puddles(tile, wrapped).depth, 0.01f);
    check("crack", cracks(map, mirrored).depth, cracks(tile, wrapped).depth, 0.01f);
}

// A slope that tiles has a cliff at its edge; one that goes on as it ends has none.
TEST(Bake, AClampedSlopeHasNoCliff)
{
    Image slope(32, 32, 1, ColorSpace::Data);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) slope.at(x, y, 0) = static_cast<float>(x) / 31.0f;
    }
    const BakeOptions clamped{.depth = 0.2f, .reach = 0.2f, .edge_u = Edge::Clamp};
    BakeOptions wrapped = clamped;
    wrapped.edge_u = Edge::Wrap;
    EXPECT_LT(ambient_occlusion(slope, wrapped).at(0, 9, 0),
              ambient_occlusion(slope, clamped).at(0, 9, 0) - 0.02f);
    EXPECT_EQ(puddles(slope, clamped).deepest, 0.0f);
    EXPECT_GT(puddles(slope, wrapped).deepest, 0.1f);
}

TEST(Bake, HollowsAreTheClosingByAnOctagonOnAnyTorus)
{
    Image map(26, 15, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        map.pixels[i] = static_cast<float>(i * 7919 % 1009) / 1009.0f;
    }
    for (const int radius : {1, 2, 3, 4, 5, 6}) {
        Image closed = map;
        for (const float sign : {1.0f, -1.0f}) {
            for (int step = 0; step < radius; ++step) {
                const Image from = closed;
                for (int y = 0; y < map.height; ++y) {
                    for (int x = 0; x < map.width; ++x) {
                        float best = sign * from.at(x, y, 0);
                        for (int dy = -1; dy <= 1; ++dy) {
                            for (int dx = -1; dx <= 1; ++dx) {
                                if (step % 2 == 1 && dx != 0 && dy != 0) continue;
                                best = std::max(
                                    best, sign * from.at((x + dx + map.width) % map.width,
                                                         (y + dy + map.height) % map.height, 0));
                            }
                        }
                        closed.at(x, y, 0) = sign * best;
                    }
                }
            }
        }
        const float reach = (static_cast<float>(radius) + 0.1f) / 26.0f;
        const Hollows h = puddles(map, {.reach = reach, .threads = 2});
        for (std::size_t i = 0; i < map.pixels.size(); ++i) {
            const float depth = closed.pixels[i] - map.pixels[i];
            ASSERT_NEAR(h.depth.pixels[i], std::min(1.0f, depth / h.deepest), 1e-5f) << radius;
        }
    }
}

TEST(Bake, CurvatureIsBrightOnEdgesAndDarkInCorners)
{
    const Image c = curvature(pit(), {.depth = 0.3f});
    EXPECT_GT(c.at(9, 12, 0), 0.6f);   // the rim
    EXPECT_LT(c.at(10, 12, 0), 0.4f);  // below it
    EXPECT_NEAR(c.at(25, 25, 0), 0.5f, 1e-5f);
}

TEST(Bake, WaterRunsDownhill)
{
    Image h = flat(0.0f);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) h.at(x, y, 0) = static_cast<float>(y) / 64.0f;  // high below
    }
    const Image flow = flow_direction(h, {.depth = 0.5f, .reach = 0.05f});
    EXPECT_NEAR(flow.at(16, 16, 0), 0.5f, 1e-4f);
    EXPECT_NEAR(flow.at(16, 16, 1), 0.0f, 1e-4f);  // up the image
    EXPECT_NEAR(flow.at(16, 16, 2), 0.25f, 1e-3f);
}

TEST(Bake, PorosityFollowsTheReference)
{
    Image rough(3, 1, 1, ColorSpace::Data);
    rough.pixels = {0.3f, 0.7f, 0.95f};
    const Image p = porosity(rough);
    EXPECT_FLOAT_EQ(p.pixels[0], 0.0f);
    EXPECT_NEAR(p.pixels[1], 0.5f, 1e-5f);
    EXPECT_FLOAT_EQ(p.pixels[2], 1.0f);
    EXPECT_EQ(porosity(rough, Image(3, 1, 1, ColorSpace::Data, 1.0f)).pixels[2], 0.0f);
    EXPECT_THROW(porosity(rough, flat(1.0f)), Error);
}

TEST(WeatherTextures, SnowMaskHasItsStatistics)
{
    const Image mask = snow_mask(128, 4);
    std::vector<float> values;
    double sum = 0.0;
    for (std::size_t i = 2; i < mask.pixels.size(); i += 4) {
        values.push_back(mask.pixels[i]);
        sum += static_cast<double>(mask.pixels[i]);
    }
    std::sort(values.begin(), values.end());
    EXPECT_NEAR(sum / static_cast<double>(values.size()), 0.715, 0.002);
    EXPECT_NEAR(values[values.size() / 20], 0.51f, 0.005f);
    EXPECT_NEAR(values[values.size() * 19 / 20], 0.85f, 0.005f);
}

TEST(WeatherTextures, DropsPointAwayFromTheirCentresAndTile)
{
    const Image drops = ripple_drops(256, 1);
    int inside = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const float* c = &drops.pixels[drops.index(x, y, 0)];
            EXPECT_TRUE(c[0] >= 0.0f && c[0] <= 1.0f && c[3] >= 0.0f && c[3] < 1.0f);
            if (c[0] < 0.2f || c[0] > 0.9f) continue;
            ++inside;
            // One texel along the direction the envelope of the same drop is lower.
            const int u = static_cast<int>(std::lround(2.0f * (2.0f * c[1] - 1.0f)));
            const int v = static_cast<int>(std::lround(2.0f * (2.0f * c[2] - 1.0f)));
            const float* d =
                &drops.pixels[drops.index((x + u + 256) % 256, (y + v + 256) % 256, 0)];
            if (d[3] == c[3]) {
                EXPECT_LT(d[0], c[0]);
            }
        }
    }
    EXPECT_GT(inside, 10000);
    EXPECT_EQ(ripple_drops(64, 1).pixels, ripple_drops(64, 1).pixels);
    EXPECT_NE(ripple_drops(64, 1).pixels, ripple_drops(64, 2).pixels);
    EXPECT_THROW(snow_mask(4, 1), Error);
    EXPECT_EQ(snow_water_bump(64, 1).channels, 4);
}

// Codes of Lux's table at (n.l, curvature), linear, 0..255 (docs/lux.md names the reference).
TEST(SkinRing, HasTheValuesOfTheReference)
{
    const Image ring = skin_ring(128);
    const auto code = [&](double facing, double curvature, int channel) {
        const int x = std::min(static_cast<int>((0.5 + 0.5 * facing) * 128.0), 127);
        const int y = std::min(static_cast<int>(curvature * 128.0), 127);
        // Between the two texels around it.
        return 255.0f * 0.5f * (ring.at(x, y, channel) + ring.at(std::max(x - 1, 0), y, channel));
    };
    struct Row {
        double facing, curvature;
        float rgb[3];
    };
    for (const Row& row : {Row{0.0, 0.5, {26, 7, 5}}, Row{0.0, 1.0, {40, 13, 8}},
                           Row{0.25, 1.0, {78, 65, 64}}, Row{-0.25, 1.0, {23, 2, 0}}}) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(code(row.facing, row.curvature, c), row.rgb[c], 1.5f) << row.facing;
    }
    for (int x = 0; x < 128; ++x) {
        const float plane = std::max(0.0f, 2.0f * (static_cast<float>(x) + 0.5f) / 128.0f - 1.0f);
        EXPECT_NEAR(ring.at(x, 0, 1), plane, 0.01f);
        // More light on the lit side, red first past the edge.
        if (x > 0) {
            EXPECT_GE(ring.at(x, 100, 0), ring.at(x - 1, 100, 0));
        }
        if (x < 60) {
            EXPECT_GE(ring.at(x, 100, 0), ring.at(x, 100, 2));
        }
    }
    EXPECT_THROW(skin_ring(4), Error);
}

}  // namespace
}  // namespace petrichor::texproc
