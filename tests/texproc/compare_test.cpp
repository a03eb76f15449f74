#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "texproc/filter/mips.h"
#include "texproc/filter/normal.h"
#include "texproc/generate/generate.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/study/compare/inspect.h"
#include "texproc/study/compare/metrics.h"
#include "texproc/study/compare/shading.h"

namespace petrichor::texproc {
namespace {

Image flat(int size, float r, float g, float b)
{
    Image image(size, size, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        image.pixels[i] = r;
        image.pixels[i + 1] = g;
        image.pixels[i + 2] = b;
    }
    return image;
}

Image chequers(int size, int edge, float low, float high)
{
    Image image(size, size, 3, ColorSpace::Data);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = (x / edge + y / edge) % 2 ? high : low;
        }
    }
    return image;
}

TEST(Psnr, IsTheMeanSquaredDifferenceInDecibels)
{
    const Image a = flat(4, 0.5f, 0.5f, 0.5f), b = flat(4, 0.6f, 0.5f, 0.5f);
    const std::vector<double> db = psnr(a, b);
    ASSERT_EQ(db.size(), 4u);
    EXPECT_NEAR(db[0], 20.0, 1e-4);
    EXPECT_TRUE(std::isinf(db[1]));
    EXPECT_NEAR(db[3], 20.0 + 10.0 * std::log10(3.0), 1e-4);
    EXPECT_NEAR(largest_difference(a, b), 0.1, 1e-6);
    EXPECT_THROW(psnr(a, flat(5, 0, 0, 0)), Error);
}

TEST(Ssim, FollowsItsFormula)
{
    const Image a = chequers(32, 3, 0.2f, 0.8f);
    EXPECT_NEAR(ssim(a, a), 1.0, 1e-6);
    // Constant pictures have no structure: what is left is the luminance term.
    const double x = 0.3, y = 0.6;
    EXPECT_NEAR(ssim(flat(16, 0.3f, 0.3f, 0.3f), flat(16, 0.6f, 0.6f, 0.6f)),
                (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-4);
    Image inverse = a;
    for (float& v : inverse.pixels) v = 1.0f - v;
    EXPECT_LT(ssim(a, inverse), 0.0);
    EXPECT_EQ(ssim(a, inverse, 1), ssim(a, inverse, 7));
}

TEST(AngularError, MeasuresKnownAngles)
{
    const float s = 0.5f * std::sin(0.1f), c = 0.5f * std::cos(0.1f);
    const AngularError e =
        angular_error(flat(4, 0.5f, 0.5f, 1.0f), flat(4, 0.5f + s, 0.5f, 0.5f + c));
    const double degrees = 0.1 * 57.29577951308232;
    EXPECT_NEAR(e.mean_degrees, degrees, 1e-4);
    EXPECT_NEAR(e.p95_degrees, degrees, 1e-4);
    EXPECT_NEAR(e.max_degrees, degrees, 1e-4);
    // Length does not count, and tiny angles are not lost.
    EXPECT_NEAR(angular_error(flat(2, 0.5f, 0.5f, 1.0f), flat(2, 0.5f, 0.5f, 0.7f)).max_degrees,
                0.0, 1e-9);
}

TEST(Flip, EqualPicturesDoNotDifferAndOppositeOnesDo)
{
    const Image black = flat(24, 0, 0, 0), white = flat(24, 1, 1, 1);
    EXPECT_EQ(flip(white, white).mean, 0.0);
    // Flat pictures have no features, so the value is the paper's colour formula alone: HyAB 100 to
    // the power 0.7 against the largest distance, green to blue.
    const double largest = std::pow(
        std::abs(87.7347 - 32.2970) + std::hypot(0.877347 * -86.1827 - 0.322970 * 79.1875,
                                                 0.877347 * 83.1793 - 0.322970 * -107.8602),
        0.7);
    const double knee = 0.4 * largest, power = std::pow(100.0, 0.7);
    EXPECT_NEAR(flip(black, white).mean, 0.95 + 0.05 * (power - knee) / (largest - knee), 1e-4);
    EXPECT_NEAR(flip(black, white).mean, flip(white, black).mean, 1e-6);
    EXPECT_LE(flip(flat(8, 0, 1, 0), flat(8, 0, 0, 1)).max, 1.0 + 1e-6);
}

TEST(Flip, FineDetailFadesWithDistance)
{
    const Image a = chequers(64, 1, 0.3f, 0.7f);
    Image b = a;
    for (float& v : b.pixels) v = 1.0f - v;  // the same pattern shifted by a pixel
    const double near = flip(a, b, 20.0).mean, far = flip(a, b, 120.0).mean;
    EXPECT_GT(near, 2.0 * far);
    EXPECT_EQ(flip(a, b, 67.0, 1).error.pixels, flip(a, b, 67.0, 5).error.pixels);
    EXPECT_THROW(flip(a, b, 0.0), Error);
}

TEST(Inspect, KnowsMapsOfAGeneratedMaterial)
{
    const MaterialMaps maps = generate_material(MaterialKind::Brick, 256, 3);
    const ImageFacts normal = inspect(to_raw(maps.normal, PixelType::U8));
    EXPECT_EQ(normal.meaning, Meaning::Normal);
    ASSERT_TRUE(normal.green.has_value());
    EXPECT_FALSE(normal.green->down);
    EXPECT_TRUE(normal.tiles_u && normal.tiles_v);
    Image turned = maps.normal;
    flip_green(turned);
    EXPECT_TRUE(inspect(to_raw(turned, PixelType::U8)).green->down);
    EXPECT_EQ(inspect(to_raw(maps.albedo, PixelType::U8)).meaning, Meaning::Color);
    EXPECT_EQ(inspect(to_raw(maps.height, PixelType::U16)).meaning, Meaning::Grey);
    EXPECT_EQ(inspect(to_raw(maps.metallic, PixelType::U8)).meaning, Meaning::Constant);
    EXPECT_EQ(inspect(to_raw(to_layout(maps.normal, NormalLayout::Ag), PixelType::U8)).meaning,
              Meaning::NormalTwoChannel);
}

TEST(Inspect, SeesSeamsAndNumbersThatAreNone)
{
    Image ramp(64, 64, 1, ColorSpace::Data);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) ramp.at(x, y, 0) = static_cast<float>(x) / 63.0f;
    }
    const ImageFacts facts = inspect(to_raw(ramp, PixelType::F32));
    EXPECT_FALSE(facts.tiles_u);
    EXPECT_TRUE(facts.tiles_v);
    EXPECT_NEAR(facts.channels[0].mean, 0.5, 1e-4);
    EXPECT_NEAR(facts.channels[0].histogram[3], 4.0 / 64.0, 1e-6);
    ramp.pixels[5] = std::nanf("");
    EXPECT_EQ(inspect(to_raw(ramp, PixelType::F32)).channels[0].not_finite, 1u);
    EXPECT_THROW(inspect(RawImage{}), Error);
}

// What the sheets are for: with less of the light misplaced, the prefiltered floor is nearer the
// truth.
TEST(Shading, PrefilteredMipsAreNearerTheTruth)
{
    const MaterialMaps maps = generate_material(MaterialKind::Cobble, 256, 1);
    Image gloss = maps.roughness;
    for (float& v : gloss.pixels) v *= 0.35f;  // wet
    const Prefiltered chains = prefilter(maps.normal, gloss, {.rule = "median"});
    ShadedMaps plain{{}, mip_chain(maps.normal, {.normals = true}), mip_chain(gloss), {}};
    ShadedMaps filtered{{}, chains.normal, chains.roughness, {}};
    filtered.normal[0] = plain.normal[0];
    filtered.roughness[0] = plain.roughness[0];
    const ShadingOptions options{.samples = 64};
    const Image truth = shaded_floor(plain, 160, 48, true, options);
    EXPECT_LT(light_error(shaded_floor(filtered, 160, 48, false, options), truth),
              0.8 * light_error(shaded_floor(plain, 160, 48, false, options), truth));
    const Image ball = shaded_ball(plain, 4, 64, true, options);
    EXPECT_LT(light_error(shaded_ball(filtered, 4, 64, false, options), ball),
              light_error(shaded_ball(plain, 4, 64, false, options), ball));
    EXPECT_THROW(shaded_ball({{}, plain.normal, {}, {}}, 0, 8, false, options), Error);
}

}  // namespace
}  // namespace petrichor::texproc
