#include "texproc/prefilter/prefilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "texproc/prefilter/lux.h"

namespace petrichor::texproc {
namespace {

// Slopes of a normal distribution of `sigma` per axis; alpha^2 grows by 2 sigma^2.
Image gaussian_normals(int size, float sigma)
{
    Image image(size, size, 3, ColorSpace::Data);
    std::uint64_t seed = 88172645463325252ull;
    const auto uniform = [&] {
        seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
        return static_cast<double>(seed >> 11) / 9007199254740992.0;
    };
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const double r = static_cast<double>(sigma) * std::sqrt(-2.0 * std::log(1.0 - uniform()));
        const double a = 6.283185307179586 * uniform();
        const double x = -r * std::cos(a), y = -r * std::sin(a);
        const double s = 1.0 / std::sqrt(1.0 + x * x + y * y);
        image.pixels[i] = static_cast<float>(0.5 + 0.5 * x * s);
        image.pixels[i + 1] = static_cast<float>(0.5 + 0.5 * y * s);
        image.pixels[i + 2] = static_cast<float>(0.5 + 0.5 * s);
    }
    return image;
}

Image flat_normals(int width, int height)
{
    Image image(width, height, 3, ColorSpace::Data, 0.5f);
    for (std::size_t i = 2; i < image.pixels.size(); i += 3) image.pixels[i] = 1.0f;
    return image;
}

struct LuxCase {
    const char* name;
    float g, l, result;
};
void PrintTo(const LuxCase& c, std::ostream* out)
{
    *out << c.name;
}

class LuxValues : public testing::TestWithParam<LuxCase> {};
TEST_P(LuxValues, AreThoseOfTheTool)
{
    EXPECT_NEAR(lux_smoothness(GetParam().g, GetParam().l), GetParam().result, 6e-5f);
}
INSTANTIATE_TEST_SUITE_P(Table, LuxValues,
                         testing::Values(LuxCase{"flat", 1.0f, 1.0f, 0.99f},
                                         LuxCase{"smooth", 1.0f, 0.9f, 0.6895f},
                                         LuxCase{"half", 0.5f, 0.9f, 0.4114f},
                                         LuxCase{"nearly_flat", 1.0f, 0.99f, 0.9002f},
                                         LuxCase{"opposite", 1.0f, 0.0f, 0.0f}),
                         [](const auto& test) { return test.param.name; });

// Codes by hand: flat normals (x = y = 127.5 cannot be stored, so 128) and smoothness 255.
TEST(LuxCompatible, TruncatesTo252OnAFlatMap)
{
    const auto out = lux_smoothness_mips({128, 128, 128, 128}, {128, 128, 128, 128}, {{255}}, 2);
    ASSERT_EQ(out.size(), 1u);
    EXPECT_GE(out[0][0],
              252);  // 252, or up to 254 where rounding left l a little below 1 (defect 10)
    EXPECT_LE(out[0][0], 254);
    // One texel whose x^2 + y^2 exceeds 1 poisons its footprint (defect 5).
    EXPECT_EQ(lux_smoothness_mips({255, 128, 128, 128}, {255, 128, 128, 128}, {{255}}, 2)[0][0], 0);
    EXPECT_THROW(lux_smoothness_mips({1, 2, 3}, {1, 2, 3}, {{1}}, 3), Error);
}

TEST(LuxCompatible, RunsAsARule)
{
    Image normal = flat_normals(2, 2);
    normal.at(0, 0, 0) = 230.0f / 255.0f;  // one normal leans along +x
    const Image smooth(2, 2, 1, ColorSpace::Data, 1.0f);
    const auto out = prefilter(normal, smooth, {.rule = "lux", .smoothness = true});
    const float x = 2.0f * 230.0f / 255.0f - 1.0f;
    const float nx = (x + 3.0f / 255.0f) / 4.0f;
    const float nz = (std::sqrt(1.0f - x * x) + 3.0f) / 4.0f;
    const float l = std::sqrt(nx * nx + nz * nz);
    EXPECT_NEAR(out.roughness[1].pixels[0], lux_smoothness(1.0f, l), 1.5f / 255.0f);
    EXPECT_THROW(prefilter(flat_normals(4, 2), Image(4, 2, 1, ColorSpace::Data), {.rule = "lux"}),
                 Error);
}

// The law: slope variance per axis and alpha^2 / 2 add.
TEST(Moments, GaussianSlopesAddTheirVarianceToAlphaSquared)
{
    const float p = 0.25f;  // alpha 0.0625
    const auto out =
        prefilter(gaussian_normals(128, 0.1f), Image(128, 128, 1, ColorSpace::Data, p));
    const float alpha = std::pow(out.roughness.back().pixels[0], 2.0f);
    // 2 sigma^2 = 0.02; the spherical estimate differs from slopes in the next order.
    EXPECT_NEAR(alpha, std::sqrt(0.0625f * 0.0625f + 0.02f), 0.003f);
}

TEST(Moments, WorkedExampleOfTheReference)
{
    // alpha 0.04, kappa about 100: right 0.147, Lux 0.050.
    const auto right =
        prefilter(gaussian_normals(128, 0.1f), Image(128, 128, 1, ColorSpace::Data, 0.2f));
    EXPECT_NEAR(std::pow(right.roughness.back().pixels[0], 2.0f), 0.147f, 0.003f);
    const auto lux = prefilter(gaussian_normals(128, 0.1f),
                               Image(128, 128, 1, ColorSpace::Data, 0.2f), {.rule = "lux-formula"});
    EXPECT_NEAR(std::pow(lux.roughness.back().pixels[0], 2.0f), 0.050f, 0.001f);
}

TEST(Moments, AFlatMapChangesNothing)
{
    for (const bool smooth : {false, true}) {
        const Image map(13, 6, 1, ColorSpace::Data, 0.3f);
        const auto out = prefilter(flat_normals(13, 6), map, {.smoothness = smooth});
        ASSERT_EQ(out.roughness.size(), 4u);
        for (const Image& level : out.roughness) {
            for (const float v : level.pixels) EXPECT_NEAR(v, 0.3f, 1e-5f);
        }
        for (const Image& level : out.normal) {
            for (std::size_t i = 2; i < level.pixels.size(); i += 3)
                EXPECT_EQ(level.pixels[i], 1.0f);
        }
    }
}

TEST(Moments, SmoothnessIsOneMinusRoughness)
{
    const Image normal = gaussian_normals(32, 0.3f);
    Image rough(32, 32, 1, ColorSpace::Data), smooth = rough;
    for (std::size_t i = 0; i < rough.pixels.size(); ++i) {
        rough.pixels[i] = static_cast<float>(i % 8) / 8.0f;
        smooth.pixels[i] = 1.0f - rough.pixels[i];
    }
    const auto a = prefilter(normal, rough), b = prefilter(normal, smooth, {.smoothness = true});
    for (std::size_t k = 0; k < a.roughness.size(); ++k) {
        for (std::size_t i = 0; i < a.roughness[k].pixels.size(); ++i) {
            EXPECT_NEAR(a.roughness[k].pixels[i], 1.0f - b.roughness[k].pixels[i], 1e-6f);
        }
    }
}

TEST(Moments, NeverLosesRoughnessAndStaysInRange)
{
    const auto out =
        prefilter(gaussian_normals(64, 2.0f), Image(64, 64, 1, ColorSpace::Data, 0.1f));
    for (const Image& level : out.roughness) {
        for (const float v : level.pixels) {
            EXPECT_GE(v, 0.1f - 1e-6f);
            EXPECT_LE(v, 1.0f);
        }
    }
}

TEST(Prefilter, SameBytesForAnyThreadCount)
{
    const Image normal = gaussian_normals(65, 0.2f);
    const Image map(65, 65, 1, ColorSpace::Data, 0.4f);
    const auto one = prefilter(normal, map, {.threads = 1});
    const auto five = prefilter(normal, map, {.threads = 5});
    for (std::size_t k = 0; k < one.roughness.size(); ++k) {
        EXPECT_EQ(one.roughness[k].pixels, five.roughness[k].pixels);
        EXPECT_EQ(one.normal[k].pixels, five.normal[k].pixels);
    }
}

TEST(Prefilter, RefusesWhatDoesNotFit)
{
    const Image map(8, 8, 1, ColorSpace::Data);
    EXPECT_THROW(prefilter(flat_normals(8, 4), map), Error);
    EXPECT_THROW(prefilter(Image(8, 8, 1, ColorSpace::Data), map), Error);
    EXPECT_THROW(prefilter(flat_normals(8, 8), Image(8, 8, 3, ColorSpace::Data)), Error);
    EXPECT_THROW(prefilter({}, {}), Error);
    EXPECT_THROW(prefilter(flat_normals(8, 8), map, {.rule = "best"}), Error);
    Image broken = flat_normals(8, 8);
    broken.pixels[5] = std::nanf("");
    EXPECT_THROW(prefilter(broken, map), Error);
}

// A texel is made from its own area: whether a map wraps or mirrors, its levels are the same.
TEST(Prefilter, LevelsDoNotLookPastTheEdge)
{
    constexpr int kSize = 16;
    Image normal(kSize, kSize, 3, ColorSpace::Data);
    Image rough(kSize, kSize, 1, ColorSpace::Data);
    std::uint32_t state = 7;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float nx = next() - 0.5f, ny = next() - 0.5f;
            const float s = 0.5f / std::sqrt(1.0f + nx * nx + ny * ny);
            normal.at(x, y, 0) = 0.5f + s * nx;
            normal.at(x, y, 1) = 0.5f + s * ny;
            normal.at(x, y, 2) = 0.5f + s;
            rough.at(x, y, 0) = 0.2f + 0.5f * next();
        }
    }
    const Prefiltered alone = prefilter(normal, rough, {.rule = "overlap", .quick = true});
    for (const bool mirrored : {false, true}) {
        Image wide(2 * kSize, 2 * kSize, 3, ColorSpace::Data);
        Image wide_rough(2 * kSize, 2 * kSize, 1, ColorSpace::Data);
        for (int y = 0; y < 2 * kSize; ++y) {
            for (int x = 0; x < 2 * kSize; ++x) {
                const bool u = mirrored && x >= kSize, v = mirrored && y >= kSize;
                const int fx = u ? 2 * kSize - 1 - x : x % kSize;
                const int fy = v ? 2 * kSize - 1 - y : y % kSize;
                wide.at(x, y, 0) = u ? 1.0f - normal.at(fx, fy, 0) : normal.at(fx, fy, 0);
                wide.at(x, y, 1) = v ? 1.0f - normal.at(fx, fy, 1) : normal.at(fx, fy, 1);
                wide.at(x, y, 2) = normal.at(fx, fy, 2);
                wide_rough.at(x, y, 0) = rough.at(fx, fy, 0);
            }
        }
        const Prefiltered both = prefilter(wide, wide_rough, {.rule = "overlap", .quick = true});
        for (std::size_t k = 1; k < alone.roughness.size(); ++k) {
            const Image& part = alone.roughness[k];
            for (int y = 0; y < part.height; ++y) {
                for (int x = 0; x < part.width; ++x) {
                    ASSERT_EQ(both.roughness[k].at(x, y, 0), part.at(x, y, 0)) << k;
                    for (int c = 0; c < 3; ++c)
                        ASSERT_EQ(both.normal[k].at(x, y, c), alone.normal[k].at(x, y, c)) << k;
                }
            }
        }
    }
}

}  // namespace
}  // namespace petrichor::texproc
