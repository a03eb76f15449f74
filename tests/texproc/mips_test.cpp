#include "texproc/filter/mips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "texproc/filter/area.h"

namespace petrichor::texproc {
namespace {

Image noise(int width, int height, int channels)
{
    Image image(width, height, channels, ColorSpace::Data);
    std::uint32_t seed = 12345;
    for (float& v : image.pixels) {
        seed = seed * 1664525u + 1013904223u;
        v = static_cast<float>(seed >> 8) / 16777216.0f;
    }
    return image;
}

double mean(const Image& image, int channel)
{
    double sum = 0.0;
    const auto step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = static_cast<std::size_t>(channel); i < image.pixels.size(); i += step) {
        sum += static_cast<double>(image.pixels[i]);
    }
    return sum * image.channels / static_cast<double>(image.pixels.size());
}

struct Size {
    int width, height;
};
void PrintTo(const Size& s, std::ostream* out)
{
    *out << s.width << "x" << s.height;
}

class Chain : public testing::TestWithParam<Size> {};

// Exact area: nothing is lost, at any size, on any level.
TEST_P(Chain, EveryLevelKeepsTheMean)
{
    const Image image = noise(GetParam().width, GetParam().height, 3);
    for (const Image& level : mip_chain(image)) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean(level, c), mean(image, c), 1e-5);
    }
}

// Each texel against a sum over level 0, taken in another way.
TEST_P(Chain, EveryTexelIsTheMeanOverItsAreaOfLevelZero)
{
    const Image image = noise(GetParam().width, GetParam().height, 1);
    const auto chain = mip_chain(image);
    for (const Image& level : chain) {
        const double sx = static_cast<double>(image.width) / level.width;
        const double sy = static_cast<double>(image.height) / level.height;
        for (int y = 0; y < level.height; ++y) {
            for (int x = 0; x < level.width; ++x) {
                double sum = 0.0, area = 0.0;
                for (int v = 0; v < image.height; ++v) {
                    const double h = std::min(v + 1.0, (y + 1) * sy) - std::max<double>(v, y * sy);
                    if (h <= 0.0) continue;
                    for (int u = 0; u < image.width; ++u) {
                        const double w =
                            std::min(u + 1.0, (x + 1) * sx) - std::max<double>(u, x * sx);
                        if (w <= 0.0) continue;
                        sum += w * h * static_cast<double>(image.at(u, v, 0));
                        area += w * h;
                    }
                }
                ASSERT_NEAR(static_cast<double>(level.at(x, y, 0)), sum / area, 1e-5);
            }
        }
    }
    EXPECT_EQ(chain.back().width, 1);
    EXPECT_EQ(chain.back().height, 1);
}
INSTANTIATE_TEST_SUITE_P(Sizes, Chain,
                         testing::Values(Size{1, 1}, Size{16, 16}, Size{32, 4}, Size{5, 5},
                                         Size{7, 13}, Size{1, 9}, Size{12, 10}, Size{24, 36}));

TEST(Mips, RollingByATexelOfALevelRollsThatLevel)
{
    const Image image = noise(32, 32, 1);
    Image rolled = image;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) rolled.at(x, y, 0) = image.at((x + 8) % 32, y, 0);
    }
    const auto a = mip_chain(image), b = mip_chain(rolled);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) EXPECT_EQ(b[3].at(x, y, 0), a[3].at((x + 1) % 4, y, 0));
    }
}

struct FilterCase {
    const char* name;
    MipFilter filter;
};
void PrintTo(const FilterCase& c, std::ostream* out)
{
    *out << c.name;
}

class Filters : public testing::TestWithParam<FilterCase> {};
TEST_P(Filters, KeepAConstantAndRollWithTheInput)
{
    for (const Image& level :
         mip_chain(Image(24, 20, 2, ColorSpace::Data, 0.7f), {.filter = GetParam().filter})) {
        for (const float v : level.pixels) EXPECT_NEAR(v, 0.7f, 1e-6f);
    }
    const Image image = noise(32, 64, 1);
    Image rolled = image;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 32; ++x) rolled.at((x + 8) % 32, (y + 16) % 64, 0) = image.at(x, y, 0);
    }
    const MipOptions options{.filter = GetParam().filter};
    const auto a = mip_chain(image, options), b = mip_chain(rolled, options);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 4; ++x) {
            EXPECT_EQ(b[3].at((x + 1) % 4, (y + 2) % 8, 0), a[3].at(x, y, 0));
        }
    }
    // Clamped, the edges differ from wrapped ones.
    if (GetParam().filter != MipFilter::Box) {
        const auto c = mip_chain(image, {.wrap_u = false, .filter = GetParam().filter});
        EXPECT_NE(c[1].at(0, 0, 0), a[1].at(0, 0, 0));
        EXPECT_EQ(c[1].at(8, 0, 0), a[1].at(8, 0, 0));
    }
}

// A low frequency passes nearly whole, one above the new limit nearly not.
TEST_P(Filters, PassLowAndStopHigh)
{
    const auto energy = [&](int waves) {
        Image wave(64, 64, 1, ColorSpace::Data);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                wave.at(x, y, 0) =
                    std::cos(6.2831853f * static_cast<float>(waves * x) / 64.0f + 0.3f);
            }
        }
        double sum = 0.0;
        const auto chain = mip_chain(wave, {.filter = GetParam().filter});
        for (const float v : chain[1].pixels) sum += 2.0 * static_cast<double>(v * v) / 1024.0;
        return sum;
    };
    EXPECT_GT(energy(3), GetParam().filter == MipFilter::Mitchell ? 0.8 : 0.95);
    EXPECT_LT(energy(28), GetParam().filter == MipFilter::Box ? 0.06 : 0.01);
}
INSTANTIATE_TEST_SUITE_P(All, Filters,
                         testing::Values(FilterCase{"box", MipFilter::Box},
                                         FilterCase{"kaiser", MipFilter::Kaiser},
                                         FilterCase{"lanczos3", MipFilter::Lanczos3},
                                         FilterCase{"mitchell", MipFilter::Mitchell}),
                         [](const auto& test) { return test.param.name; });

TEST(Mips, WithoutTheFirstLevelTheOthersAreTheSame)
{
    for (const bool normals : {false, true}) {
        const Image image = noise(24, 18, 3);
        const auto all = mip_chain(image, {.normals = normals});
        const auto rest = mip_chain(image, {.normals = normals, .drop_first = true});
        ASSERT_EQ(rest.size(), all.size());
        EXPECT_TRUE(rest[0].empty());
        EXPECT_EQ(all[0].pixels, image.pixels);
        for (std::size_t k = 1; k < all.size(); ++k) EXPECT_EQ(rest[k].pixels, all[k].pixels);
    }
}

TEST(Mips, NormalsComeOutWithUnitLength)
{
    for (const Image& level : mip_chain(noise(9, 6, 3), {.normals = true})) {
        if (level.width == 9) continue;
        for (std::size_t i = 0; i < level.pixels.size(); i += 3) {
            double length = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double n = 2.0 * static_cast<double>(level.pixels[i + k]) - 1.0;
                length += n * n;
            }
            EXPECT_NEAR(length, 1.0, 1e-5);
        }
    }
    EXPECT_THROW(mip_chain(noise(4, 4, 2), {.normals = true}), Error);
}

TEST(Mips, AlphaCoverageIsKept)
{
    Image image = noise(64, 64, 4);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] *= image.pixels[i];
    const auto share = [](const Image& level) {
        int over = 0;
        for (std::size_t i = 3; i < level.pixels.size(); i += 4) over += level.pixels[i] > 0.5f;
        return 4.0 * over / static_cast<double>(level.pixels.size());
    };
    const auto kept = mip_chain(image, {.alpha_cutoff = 0.5f});
    const auto plain = mip_chain(image);
    for (std::size_t k = 1; k < 5; ++k) {
        EXPECT_NEAR(share(kept[k]), share(image),
                    0.51 * 4.0 / static_cast<double>(kept[k].pixels.size()))
            << "level " << k;
    }
    EXPECT_LT(share(plain[3]), 0.1) << "the test would not notice a chain that does nothing";
}

// A leaf: a disc of one colour, black under the holes as paint programs leave it.
Image leaf(int size)
{
    Image image(size, size, 4, ColorSpace::Linear, 0.0f);
    const float middle = 0.5f * static_cast<float>(size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float dx = static_cast<float>(x) - middle, dy = static_cast<float>(y) - middle;
            if (dx * dx + dy * dy > 0.1f * middle * middle) continue;
            const float color[4] = {0.2f, 0.6f, 0.1f, 1.0f};
            std::copy(color, color + 4, &image.at(x, y, 0));
        }
    }
    return image;
}

constexpr MipFilter kAllFilters[] = {MipFilter::Box, MipFilter::Kaiser, MipFilter::Lanczos3,
                                     MipFilter::Mitchell};

TEST(AlphaWeighted, OpaqueColourAndDataKeepTheirBits)
{
    Image opaque = noise(48, 37, 4);
    opaque.space = ColorSpace::Linear;
    for (std::size_t i = 3; i < opaque.pixels.size(); i += 4) opaque.pixels[i] = 1.0f;
    const Image data = noise(48, 37, 4);
    for (const MipFilter filter : kAllFilters) {
        for (const Image& image : {opaque, data}) {
            const auto plain = mip_chain(image, {.filter = filter});
            const auto weighted = mip_chain(image, {.filter = filter, .alpha_weighted = true});
            for (std::size_t k = 0; k < plain.size(); ++k) {
                EXPECT_EQ(plain[k].pixels, weighted[k].pixels) << k;
            }
        }
    }
}

TEST(AlphaWeighted, LeavesHaveNoDarkFringe)
{
    const Image image = leaf(64);
    for (const MipFilter filter : kAllFilters) {
        const auto chain = mip_chain(image, {.filter = filter, .alpha_weighted = true});
        for (std::size_t k = 1; k < chain.size(); ++k) {
            int covered = 0;
            for (std::size_t i = 0; i < chain[k].pixels.size(); i += 4) {
                const float* texel = &chain[k].pixels[i];
                if (!(texel[3] > 1.0f / 4096.0f)) continue;
                ++covered;
                EXPECT_NEAR(texel[0], 0.2f, 1e-4f) << k;
                EXPECT_NEAR(texel[1], 0.6f, 1e-4f) << k;
            }
            EXPECT_GT(covered, 0) << k;
        }
    }
    // Without weights the edge of a level is darker than any texel of the leaf.
    float darkest = 1.0f;
    for (const Image& level : {mip_chain(image)[2]}) {
        for (std::size_t i = 0; i < level.pixels.size(); i += 4) {
            if (level.pixels[i + 3] > 0.01f) darkest = std::min(darkest, level.pixels[i + 1]);
        }
    }
    EXPECT_LT(darkest, 0.3f);
}

// A bilinear tap between the leaf and a hole beside it must not fetch black.
TEST(AlphaWeighted, HolesTakeTheColourOfTheirNeighbours)
{
    const Image level = mip_chain(leaf(64), {.alpha_weighted = true})[2];
    int beside = 0;
    for (int y = 1; y + 1 < level.height; ++y) {
        for (int x = 1; x + 1 < level.width; ++x) {
            if (level.at(x, y, 3) > 0.0f) continue;
            const bool touches = level.at(x - 1, y, 3) > 0.01f || level.at(x + 1, y, 3) > 0.01f ||
                                 level.at(x, y - 1, 3) > 0.01f || level.at(x, y + 1, 3) > 0.01f;
            if (!touches) continue;
            ++beside;
            EXPECT_NEAR(level.at(x, y, 1), 0.6f, 1e-4f);
        }
    }
    EXPECT_GT(beside, 4);
}

// What a level shows over black is what level 0 shows, and rolling rolls it.
TEST(AlphaWeighted, CoverageTimesColourIsKeptAndRollsAlong)
{
    Image image = noise(32, 32, 4);
    image.space = ColorSpace::Linear;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
        image.pixels[i] = std::max(0.0f, 2.0f * image.pixels[i] - 1.0f);
    }
    const auto shown = [](const Image& level) {
        double sum = 0.0;
        for (std::size_t i = 0; i < level.pixels.size(); i += 4) {
            sum += static_cast<double>(level.pixels[i] * level.pixels[i + 3]);
        }
        return 4.0 * sum / static_cast<double>(level.pixels.size());
    };
    Image rolled = image;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            std::copy_n(&image.at((x + 4) % 32, (y + 8) % 32, 0), 4, &rolled.at(x, y, 0));
        }
    }
    const auto chain = mip_chain(image, {.alpha_weighted = true});
    for (const Image& level : chain) EXPECT_NEAR(shown(level), shown(image), 1e-6);
    const Image moved = mip_chain(rolled, {.alpha_weighted = true})[2];
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            for (int c = 0; c < 4; ++c) {
                EXPECT_EQ(moved.at(x, y, c), chain[2].at((x + 1) % 8, (y + 2) % 8, c));
            }
        }
    }
}

}  // namespace
}  // namespace petrichor::texproc
