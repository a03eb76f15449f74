#include "texproc/filter/normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "base/error.h"
#include "texproc/filter/detail/fft.h"
#include "texproc/filter/normal_codes.h"
#include "texproc/generate/noise.h"

namespace petrichor::texproc {
namespace {

Image hills(int width, int height)
{
    Image h(width, height, 1, ColorSpace::Data);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            h.at(x, y, 0) =
                0.5f +
                0.2f * gradient_noise(5.0f * static_cast<float>(x) / static_cast<float>(width),
                                      4.0f * static_cast<float>(y) / static_cast<float>(height), 5,
                                      4, 9);
        }
    }
    return h;
}

// Small slopes about straight up, whose code is `flat`.
RawImage nearly_flat(double flat)
{
    Image n(64, 64, 3, ColorSpace::Data, 1.0f);
    for (int i = 0; i < 64 * 64; ++i) {
        for (int c = 0; c < 2; ++c) {
            const double off = 4.0 * (static_cast<double>((i * 2654435761u + static_cast<unsigned>(c) * 40503u) % 1009u) / 1008.0) - 2.0;
            n.pixels[static_cast<std::size_t>(3 * i + c)] = static_cast<float>((flat + off) / 255.0);
        }
    }
    return to_raw(n, PixelType::U16);
}

double mean_code(const RawImage& image, int channel)
{
    double sum = 0.0;
    const Image n = to_image(image, ColorSpace::Data);
    for (std::size_t i = static_cast<std::size_t>(channel); i < n.pixels.size(); i += 3) sum += 255.0 * static_cast<double>(n.pixels[i]);
    return sum / static_cast<double>(n.width * n.height);
}

// The mean of many normals is a code, whichever way flat was written: to either side of it no level could hold it.
TEST(Normal, EightBitsLeanAlikeSoThatTheirMeanIsACode)
{
    for (const double flat : {127.5, 128.0}) {
        const RawImage maps = nearly_flat(flat), codes = normals_in_8_bits(maps);
        for (int c = 0; c < 2; ++c) {
            EXPECT_NEAR(mean_code(maps, c), flat, 0.02);
            EXPECT_NEAR(mean_code(codes, c), 128.0, 0.05) << flat;
        }
        EXPECT_EQ(codes.bytes[2], std::byte{255});
        EXPECT_EQ(normals_in_8_bits(codes).bytes, codes.bytes);
    }
}

TEST(Normal, EightBitsKeepCodesThatMoreBitsHold)
{
    Image n(256, 1, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < n.pixels.size(); ++i) n.pixels[i] = static_cast<float>((i * 7) % 256) / 255.0f;
    for (const PixelType type : {PixelType::U16, PixelType::F32})
        EXPECT_EQ(normals_in_8_bits(to_raw(n, type)).bytes, to_raw(n, PixelType::U8).bytes);
}

// x may lie in alpha; what lies in its place is no direction and becomes the nearest code.
TEST(Normal, EightBitsLeanInTheChannelsThatHoldTheSlopes)
{
    const RawImage flat = to_raw(Image(4, 4, 4, ColorSpace::Data, 127.6f / 255.0f), PixelType::U16);
    const RawImage low = to_raw(Image(4, 4, 4, ColorSpace::Data, 127.4f / 255.0f), PixelType::U16);
    const auto texel = [](const RawImage& image) {
        return std::vector<std::byte>(image.bytes.begin(), image.bytes.begin() + 4);
    };
    const auto of = [](int r, int g, int b, int a) {
        return std::vector<std::byte>{static_cast<std::byte>(r), static_cast<std::byte>(g), static_cast<std::byte>(b),
                                      static_cast<std::byte>(a)};
    };
    EXPECT_EQ(texel(normals_in_8_bits(flat, 3, 1)), of(128, 128, 128, 128));
    EXPECT_EQ(texel(normals_in_8_bits(low, 3, 1)), of(127, 128, 127, 128));
}

TEST(Normal, SlopesPointDownhill)
{
    Image h(4, 4, 1, ColorSpace::Data);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) h.at(x, y, 0) = 0.25f * static_cast<float>(x);
    }
    const Image n = normal_from_height(h, {.depth = 1.0f, .edge_u = Edge::Clamp});
    EXPECT_NEAR(n.at(1, 1, 0), 0.5f - 0.5f / std::sqrt(2.0f), 1e-6f);  // slope 1 up to the right
    EXPECT_NEAR(n.at(1, 1, 1), 0.5f, 1e-6f);
}

TEST(Normal, HeightComesBackFromItsNormals)
{
    for (const auto& [width, height] : {std::pair{64, 64}, std::pair{60, 36}}) {
        const Image h = hills(width, height);
        const Image n = normal_from_height(h, {.depth = 0.3f});
        const IntegratedHeight back = height_from_normal(n);
        const Image again = normal_from_height(back.height, {.depth = back.depth});
        for (std::size_t i = 0; i < n.pixels.size(); ++i) {
            ASSERT_NEAR(again.pixels[i], n.pixels[i], 2e-3f) << width << " x " << height;
        }
    }
}

// A slope with a bump does not tile: only a height that goes on mirrored gives its slopes back.
TEST(Normal, HeightsThatDoNotTileComeBackMirrored)
{
    Image h(48, 32, 1, ColorSpace::Data);
    for (int y = 0; y < h.height; ++y) {
        for (int x = 0; x < h.width; ++x) {
            const float u = static_cast<float>(x) - 24.0f, v = static_cast<float>(y) - 16.0f;
            h.at(x, y, 0) =
                0.012f * static_cast<float>(x) + 0.3f * std::exp(-(u * u + v * v) / 60.0f);
        }
    }
    for (const Edge edge : {Edge::Mirror, Edge::Clamp}) {
        const Image n = normal_from_height(h, {.depth = 0.2f, .edge_u = edge, .edge_v = edge});
        const auto worst = [&](Edge how) {
            const IntegratedHeight back = height_from_normal(n, how, how);
            const Image again = normal_from_height(
                back.height, {.depth = back.depth, .edge_u = edge, .edge_v = edge});
            float most = 0.0f;
            for (std::size_t i = 0; i < n.pixels.size(); ++i)
                most = std::max(most, std::abs(again.pixels[i] - n.pixels[i]));
            return most;
        };
        EXPECT_LT(worst(edge), 5e-3f);
        EXPECT_GT(worst(Edge::Wrap), 0.03f);
    }
}

TEST(Normal, GreenIsDetected)
{
    const Image h = hills(64, 64);
    Image n = normal_from_height(h, {.depth = 0.3f});
    EXPECT_FALSE(detect_green(n, h).down);
    EXPECT_FALSE(detect_green(n).down);
    EXPECT_GT(detect_green(n, h).confidence, 0.9);
    EXPECT_GT(detect_green(n).confidence, 0.9);
    flip_green(n);
    EXPECT_TRUE(detect_green(n, h).down);
    EXPECT_TRUE(detect_green(n).down);
    const Image flat(8, 8, 3, ColorSpace::Data, 0.5f);
    EXPECT_EQ(detect_green(flat).confidence, 0.0);
}

TEST(Normal, LayoutsAreLosslessForUnitNormals)
{
    const Image n = normal_from_height(hills(16, 16), {.depth = 0.3f});
    for (const NormalLayout layout : {NormalLayout::Rgb, NormalLayout::Rg, NormalLayout::Ag,
                                      NormalLayout::Rxgb, NormalLayout::RgSigned}) {
        const Image back = from_layout(to_layout(n, layout), layout);
        for (std::size_t i = 0; i < n.pixels.size(); ++i) {
            EXPECT_NEAR(back.pixels[i], n.pixels[i], 1e-4f);
        }
    }
    EXPECT_THROW(from_layout(n, NormalLayout::Ag), Error);
    EXPECT_NEAR(to_layout(n, NormalLayout::RgSigned).pixels[1], 2.0f * n.pixels[1] - 1.0f, 1e-6f);
    EXPECT_THROW(normal_layout("xyz"), Error);
}

TEST(Normal, AZeroOfEightBitsPointsUp)
{
    for (const int code : {127, 128}) {
        Image zero(2, 2, 3, ColorSpace::Data, static_cast<float>(code) / 255.0f);
        renormalize(zero);
        EXPECT_EQ(zero.pixels[0], 0.5f);
        EXPECT_EQ(zero.pixels[2], 1.0f);
    }
}

TEST(Normal, BlendingWithFlatChangesNothing)
{
    const Image n = normal_from_height(hills(16, 16), {.depth = 0.3f});
    Image flat(16, 16, 3, ColorSpace::Data, 0.5f);
    for (std::size_t i = 2; i < flat.pixels.size(); i += 3) flat.pixels[i] = 1.0f;
    for (const Image& out : {blend_normals(n, flat), blend_normals(flat, n)}) {
        for (std::size_t i = 0; i < n.pixels.size(); ++i) {
            EXPECT_NEAR(out.pixels[i], n.pixels[i], 1e-5f);
        }
    }
    EXPECT_THROW(blend_normals(n, Image(8, 8, 3, ColorSpace::Data)), Error);
}

TEST(Fft, AgreesWithTheSumAndInverts)
{
    for (const std::size_t n : {1u, 8u, 15u, 31u}) {
        std::vector<std::complex<double>> a(n);
        for (std::size_t i = 0; i < n; ++i) {
            a[i] = {static_cast<double>(hash_unit(hash_u32(static_cast<std::uint32_t>(i)))),
                    0.25 * static_cast<double>(i)};
        }
        auto f = a;
        detail::fft(f, false);
        for (std::size_t k = 0; k < n; ++k) {
            std::complex<double> sum = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                sum += a[i] * std::polar(1.0, -6.283185307179586 * static_cast<double>(i * k) /
                                                  static_cast<double>(n));
            }
            EXPECT_NEAR(std::abs(f[k] - sum), 0.0, 1e-9);
        }
        detail::fft(f, true);
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(std::abs(f[i] - a[i]), 0.0, 1e-12);
    }
}

}  // namespace
}  // namespace petrichor::texproc
