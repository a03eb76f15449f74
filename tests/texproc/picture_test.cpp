// The picture yardstick measures what it says, and the rule picture wins on it.
#include "texproc/prefilter/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <utility>

#include "texproc/filter/pixel_length.h"
#include "texproc/material/base_share.h"
#include "texproc/prefilter/detail/picture_lobe.h"
#include "texproc/study/fresh_maps.h"
#include "texproc/study/score.h"
#include "texproc/study/scored_maps.h"

namespace petrichor::texproc {
namespace {

// Few pixels, enough for what is tested.
PictureOptions small(int samples)
{
    PictureOptions o = reference_pictures();
    o.views[0].width = 60;
    o.views[0].rows = 40;
    o.frames = 3;
    o.samples = samples;
    return o;
}

ScoredMaps material(const std::string& word, std::uint32_t seed)
{
    for (ScoredMaps& maps : fresh_maps(192, seed))
        if (maps.name.starts_with(word)) return std::move(maps);
    ADD_FAILURE() << "there is no " << word;
    return {};
}

RawImage constant(int size, const std::vector<float>& texel)
{
    Image image(size, size, static_cast<int>(texel.size()), ColorSpace::Data);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = texel[i % texel.size()];
    return to_raw(image, PixelType::U16);
}

TEST(PictureYardstick, AFlatSurfaceHasNoError)
{
    const PictureBench bench(constant(64, {0.5f, 0.5f, 1.0f}), constant(64, {0.4f}), {}, small(6));
    for (const PictureScore& score : bench.score({})) {
        EXPECT_LT(score.rmse, 0.004) << score.name;  // the eye moves within a pixel
        EXPECT_LT(score.flicker, 0.002) << score.name;
    }
}

// Nobody can have chosen a rule with them: each seed has its own, and the same again.
TEST(PictureYardstick, DrawnPicturesAreNoneOfTheOthers)
{
    const PictureOptions a = drawn_pictures(1), again = drawn_pictures(1), b = drawn_pictures(2);
    ASSERT_EQ(a.cases.size(), 12u);
    int metal = 0;
    for (const PictureCase& c : a.cases) metal += c.metal;
    EXPECT_EQ(metal, 4);
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_EQ(a.lights[i].to_light, again.lights[i].to_light);
        EXPECT_NE(a.lights[i].to_light, b.lights[i].to_light);
        EXPECT_GT(a.lights[i].to_light[2], 0.2f) << "above the horizon";
        for (const PictureOptions& known : {all_pictures(), design_pictures(), design_pictures(true)})
            for (const PictureLight& light : known.lights) EXPECT_NE(a.lights[i].to_light, light.to_light);
    }
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        EXPECT_EQ(a.views[i].pitch_deg, again.views[i].pitch_deg);
        EXPECT_NE(a.views[i].pitch_deg, b.views[i].pitch_deg);
    }
}

TEST(PictureYardstick, MoreSamplesChangeLittle)
{
    const ScoredMaps maps = material("mica", 3);
    const PictureBench few(maps.normal, maps.roughness, {}, small(10));
    const PictureBench many(maps.normal, maps.roughness, {}, small(20));
    const auto a = few.score({}), b = many.score({});
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i].rmse, b[i].rmse, 0.1 * b[i].rmse + 0.001) << a[i].name;
}

TEST(PictureYardstick, ThePlainChainIsThePlainMips)
{
    const ScoredMaps maps = material("facets", 3);
    const PictureBench bench(maps.normal, maps.roughness, {}, small(4));
    const auto given = bench.score(prefilter_raw(maps.normal, maps.roughness, {.rule = "none"}));
    const auto own = bench.score({});
    for (std::size_t i = 0; i < own.size(); ++i) {
        EXPECT_NEAR(given[i].rmse, own[i].rmse, 2e-4) << own[i].name;
        EXPECT_NEAR(given[i].flicker, own[i].flicker, 2e-4) << own[i].name;
    }
}

TEST(PictureYardstick, SameNumbersForAnyThreads)
{
    const ScoredMaps maps = material("cloth", 3);
    PictureOptions one = small(4), three = small(4);
    one.threads = 1;
    three.threads = 3;
    const auto a = PictureBench(maps.normal, maps.roughness, {}, one).score({});
    const auto b = PictureBench(maps.normal, maps.roughness, {}, three).score({});
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].rmse, b[i].rmse);
        EXPECT_EQ(a[i].flicker, b[i].flicker);
    }
}

// No code of 8 bits is straight up: rounded, still water mirrors another place; dithered, several texels
// together lie level.
TEST(PictureYardstick, DitheredNormalsOfEightBitsCostLess)
{
    Image normal(128, 128, 3, ColorSpace::Data), rough(128, 128, 1, ColorSpace::Data);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            const float s = 0.03f * std::sin(0.4f * static_cast<float>(x) + 0.1f * static_cast<float>(y));
            normal.at(x, y, 0) = 0.5f + 0.5f * s;
            normal.at(x, y, 1) = 0.5f;
            normal.at(x, y, 2) = 0.5f + 0.5f * std::sqrt(1.0f - s * s);
            rough.at(x, y, 0) = 0.12f;
        }
    }
    const RawImage n = to_raw(normal, PixelType::U16), r = to_raw(rough, PixelType::U16);
    const PictureBench bench(n, r, {}, small(8));
    const Prefiltered floats = prefilter_raw(n, r, {.rule = "none"});
    Prefiltered rounded = floats, dithered = floats;
    for (Image& image : rounded.normal)
        if (!image.empty()) image = to_image(to_raw(image, PixelType::U8), ColorSpace::Data);
    quantize(dithered, 8);
    const auto cost = [&](const Prefiltered& chain) {
        PictureScore sum;
        for (const PictureScore& one : bench.score(chain))
            sum.rmse += one.rmse, sum.flicker += one.flicker;
        return sum;
    };
    const PictureScore best = cost(floats), plain = cost(rounded), better = cost(dithered);
    EXPECT_LT(better.rmse - best.rmse, 0.5 * (plain.rmse - best.rmse));
    EXPECT_LT(better.flicker, 1.02 * plain.flicker);  // what it does not cost in turn
}

// The mixture that is filtered once shows what the mixed chain shows.
TEST(PictureYardstick, AMixtureOfLevelsIsTheMixedChain)
{
    const ScoredMaps maps = material("facets", 5);
    const PictureBench bench(maps.normal, maps.roughness, {}, small(4));
    const Prefiltered whole = prefilter_raw(maps.normal, maps.roughness, {.rule = "picture"});
    Prefiltered rough = whole;  // another chain than the plain one on every level
    const std::vector<Image> plain = bench.plain_roughness();
    for (std::size_t k = 1; k < rough.roughness.size(); ++k)
        for (std::size_t i = 0; i < plain[k].pixels.size(); ++i) {
            rough.roughness[k].pixels[i] = std::min(1.0f, plain[k].pixels[i] + 0.3f);
            rough.base_share[k].pixels[i] = 0.8f;
        }
    PictureBench::Blend blend(bench, rough);
    PictureBench::Blend::Shares shares{std::vector<float>(plain.size(), 0.0f),
                                       std::vector<float>(plain.size(), 0.0f)};
    const auto same = [&](const Prefiltered& chain) {
        const auto a = bench.score(chain), b = blend.score(shares);
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_NEAR(a[i].rmse, b[i].rmse, 1e-5) << a[i].name;
            EXPECT_NEAR(a[i].flicker, b[i].flicker, 1e-5) << a[i].name;
        }
    };
    same({});
    shares.roughness[2] = 0.5f;  // one level is another: the rest is remembered
    shares.base[3] = 1.0f;
    Prefiltered mixed;
    mixed.roughness = plain;
    mixed.base_share = rough.base_share;
    for (std::size_t k = 1; k < plain.size(); ++k)
        for (std::size_t i = 0; i < plain[k].pixels.size(); ++i) {
            if (k == 2)
                mixed.roughness[k].pixels[i] +=
                    0.5f * (rough.roughness[k].pixels[i] - plain[k].pixels[i]);
            if (k != 3) mixed.base_share[k].pixels[i] = 1.0f;
        }
    same(mixed);
}

// Rows that see no level which has changed are remembered.
TEST(PictureYardstick, ARetakenChainScoresAsItDoesAtOnce)
{
    const ScoredMaps maps = material("facets", 5);
    const PictureBench first(maps.normal, maps.roughness, {}, small(4));
    PictureOptions other = small(3);
    other.views[0].height_m = 2.5;
    const PictureBench bench(first, other), alone(maps.normal, maps.roughness, {}, other);
    Prefiltered chain = prefilter_raw(maps.normal, maps.roughness, {.rule = "picture", .quick = true});
    PictureBench::Retake retake(bench);
    const auto same = [&](std::uint32_t changed) {
        const auto a = alone.score(chain), b = retake.score(chain, changed);
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].rmse, b[i].rmse) << a[i].name;
            EXPECT_EQ(a[i].flicker, b[i].flicker) << a[i].name;
        }
        return b[0].rmse;
    };
    const double before = same(0);
    for (float& p : chain.roughness[2].pixels) p *= 0.5f;
    EXPECT_NE(same(1u << 2), before);
    for (float& share : chain.base_share[3].pixels) share = 0.5f;
    same(1u << 3);
}

TEST(PictureYardstick, AMapThatGlossesOverItsSlopesIsWorseThanPlain)
{
    const ScoredMaps maps = material("mica", 3);
    const PictureBench bench(maps.normal, maps.roughness, {}, small(6));
    Prefiltered gloss;
    gloss.roughness = bench.plain_roughness();
    for (Image& level : gloss.roughness)
        for (float& p : level.pixels) p *= 0.5f;
    const auto plain = bench.score({}), wrong = bench.score(gloss);
    EXPECT_GT(wrong[0].rmse, 1.1 * plain[0].rmse);
}

// On materials that it was not chosen on. The bounds are loose: floors of 60 x 40 pixels.
TEST(PictureRule, BeatsPlainMipsAndIsSeldomWorse)
{
    double ours = 0.0, unreal = 0.0;
    int cases = 0, worse = 0;
    for (const char* word : {"cloth", "mica", "ramp", "facets", "gravel", "mosaic"}) {
        const ScoredMaps maps = material(word, 21);
        const PictureBench bench(maps.normal, maps.roughness, {}, small(8));
        const auto plain = bench.score({});
        const auto score = [&](const char* rule) {
            return bench.score(
                prefilter_raw(maps.normal, maps.roughness, {.rule = rule, .quick = true}));
        };
        const auto a = score("picture"), b = score("unreal");
        for (std::size_t i = 0; i < plain.size(); ++i) {
            ours += a[i].rmse / plain[i].rmse - 1.0;
            unreal += b[i].rmse / plain[i].rmse - 1.0;
            worse += a[i].rmse > 1.05 * plain[i].rmse + 0.001;
            ++cases;
        }
    }
    EXPECT_LT(ours / cases, -0.10);
    EXPECT_LT(ours, unreal);
    EXPECT_LE(worse, cases / 10);
}

// Built for plain processors and for AVX2: no bit may differ.
TEST(PictureRule, PairsInMoreLanesHaveTheSameBits)
{
    detail::LitPairs pairs;
    std::mt19937 dice(5);
    const auto between = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(dice() >> 8) / 16777216.0f;
    };
    const auto direction = [&] {
        return detail::normalized({between(-1.0f, 1.0f), between(-1.0f, 1.0f), between(0.05f, 1.0f)});
    };
    for (std::size_t j = 0; j < detail::LitPairs::kMost; ++j) {
        const auto v = direction(), l = direction();
        const auto h = detail::normalized({v.x + l.x, v.y + l.y, v.z + l.z});
        pairs.vx[j] = v.x, pairs.vy[j] = v.y, pairs.vz[j] = v.z;
        pairs.lx[j] = l.x, pairs.ly[j] = l.y, pairs.lz[j] = l.z;
        pairs.hx[j] = h.x, pairs.hy[j] = h.y, pairs.hz[j] = h.z;
        pairs.fresnel[j] = between(0.04f, 1.0f), pairs.diffuse[j] = between(0.0f, 0.1f);
        pairs.light2[j] = j % 3 ? 0.0f : 0.01f, pairs.exposure[j] = between(0.1f, 9.0f);
    }
    for (const int count : {detail::LitPairs::kMost, detail::LitPairs::kMost / 2}) {
        pairs.count = count;
        for (int i = 0; i < 500; ++i) {
            const auto n = direction();
            const float alpha2 = std::pow(10.0f, between(-5.4f, 0.0f)), share = between(0.5f, 1.0f);
            detail::LitPairs::Row plain{}, here{};
            detail::plain_pair_kernel().radiance(pairs, n, alpha2, share, plain);
            detail::pair_kernel().radiance(pairs, n, alpha2, share, here);
            ASSERT_EQ(std::memcmp(plain.data(), here.data(), sizeof plain), 0);
            const auto shown = direction();
            detail::LitPairs::Row other{};
            for (std::size_t j = 0; j < other.size(); ++j) other[j] = j % 2 ? shown.z : 0.3f;
            const float distance = detail::plain_pair_kernel().distance(pairs, n, alpha2, share, other);
            ASSERT_EQ(detail::pair_kernel().distance(pairs, n, alpha2, share, other), distance);
            EXPECT_GT(distance, 0.0f);
            EXPECT_GT(*std::max_element(plain.begin(), plain.begin() + count), 0.0f);
        }
    }
}

TEST(PictureRule, SameBytesForAnyThreads)
{
    const ScoredMaps maps = material("strokes", 4);
    const Prefiltered one = prefilter_raw(maps.normal, maps.roughness,
                                          {.rule = "picture", .threads = 1, .quick = true});
    const Prefiltered three = prefilter_raw(maps.normal, maps.roughness,
                                            {.rule = "picture", .threads = 3, .quick = true});
    for (std::size_t k = 1; k < one.roughness.size(); ++k) {
        EXPECT_EQ(one.roughness[k].pixels, three.roughness[k].pixels);
        EXPECT_EQ(one.base_share[k].pixels, three.base_share[k].pixels);
    }
}

TEST(BaseShare, IsTheLengthOfTheMeanNormal)
{
    const float lean = std::sqrt(0.5f);  // half of the texels lean left, half right, by 45 degrees
    Image normals(8, 8, 3, ColorSpace::Data, 0.5f);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            normals.at(x, y, 0) = 0.5f + (x % 2 ? 0.5f : -0.5f) * lean;
            normals.at(x, y, 2) = 0.5f + 0.5f * lean;
        }
    const std::vector<Image> shares = base_shares(normals);
    ASSERT_EQ(shares.size(), 4u);
    EXPECT_FLOAT_EQ(shares[0].pixels[0], 1.0f);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(shares[k].pixels[0], lean, 1e-6f);

    std::vector<Image> color;
    for (const Image& share : shares)
        color.emplace_back(share.width, share.height, 4, ColorSpace::Linear, 0.8f);
    std::vector<Image> metal;
    for (const Image& share : shares)
        metal.emplace_back(share.width, share.height, 1, ColorSpace::Data, 1.0f);
    std::vector<Image> painted = color;
    apply_base_shares(painted, shares, {});
    EXPECT_FLOAT_EQ(painted[0].pixels[0], 0.8f);
    EXPECT_NEAR(painted[2].pixels[0], 0.8f * lean, 1e-6f);
    EXPECT_FLOAT_EQ(painted[2].pixels[3], 0.8f) << "alpha is no colour";
    apply_base_shares(color, shares, metal);
    EXPECT_FLOAT_EQ(color[2].pixels[0], 0.8f) << "the colour of metal is that of its highlight";
    std::vector<Image> of_metal = shares;
    for (Image& level : of_metal) std::fill(level.pixels.begin(), level.pixels.end(), 0.5f);
    metal[2].pixels[0] = 0.25f;
    apply_base_shares(color, shares, metal, of_metal);
    EXPECT_FLOAT_EQ(color[1].pixels[0], 0.4f) << "but for a share of its own";
    EXPECT_NEAR(color[2].pixels[0], 0.8f * (0.75f * lean + 0.25f * 0.5f), 1e-6f);
}

// Columns of a level that lean left and right in turn, by 45 degrees.
Image leaning_columns(int width, int height, int columns)
{
    const float lean = std::sqrt(0.5f);
    Image normals(width, height, 3, ColorSpace::Data, 0.5f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            normals.at(x, y, 0) = 0.5f + (x / columns % 2 ? 0.5f : -0.5f) * lean;
            normals.at(x, y, 2) = 0.5f + 0.5f * lean;
        }
    return normals;
}

TEST(PixelLength, IsLostBetweenTexelsAtEdgesToo)
{
    const Image lengths = pixel_lengths(leaning_columns(8, 3, 1));
    for (const float length : lengths.pixels) EXPECT_NEAR(length, std::sqrt(0.5f), 1e-6f);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 5}, {2, 1}})
        for (const float length : pixel_lengths(leaning_columns(width, height, 8)).pixels)
            EXPECT_NEAR(length, 1.0f, 1e-6f) << width << " x " << height;
}

// Of level 1, whose texels are all of one slope, bilinear reading makes a surface too bright from above:
// the normals between two slopes stand up. What pixels lose takes more than half of that away.
TEST(BaseShare, OfPixelsIsNearerToTheLightOfTheSlopes)
{
    const Image normals = leaning_columns(16, 16, 2);
    const float truth = std::sqrt(0.5f);
    float read = 0.0f;
    constexpr int kPlaces = 1000;
    for (int i = 0; i < kPlaces; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / kPlaces, x = (1.0f - 2.0f * t) * truth;
        read += truth / std::sqrt(x * x + truth * truth) / kPlaces;
    }
    const float texels = base_shares(normals)[1].at(3, 3, 0), pixels = pixel_base_shares(normals)[1].at(3, 3, 0);
    EXPECT_NEAR(texels, 1.0f, 1e-6f);
    EXPECT_LT(std::abs(pixels * read - truth), 0.5f * std::abs(texels * read - truth));
    EXPECT_LT(pixels, texels);
}

TEST(PictureRule, HasNoDesignLight)
{
    const ScoredMaps maps = material("cloth", 3);
    EXPECT_ANY_THROW(
        prefilter_raw(maps.normal, maps.roughness, {.rule = "picture", .design_light = 0.1f}));
}

}  // namespace
}  // namespace petrichor::texproc
