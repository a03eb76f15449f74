// What of a fit is kept: pictures decide, and none of them pays for another.
#include "texproc/prefilter/detail/fit_settle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/study/fresh_maps.h"

namespace petrichor::texproc {
namespace {

ScoredMaps material(const std::string& word, int size = 128)
{
    for (ScoredMaps& maps : fresh_maps(size, 21))
        if (maps.name.starts_with(word)) return std::move(maps);
    ADD_FAILURE() << "there is no " << word;
    return {};
}

PictureOptions few_pixels()
{
    PictureOptions o = reference_pictures();
    o.views[0].width = 60;
    o.views[0].rows = 40;
    o.frames = 2;
    o.samples = 6;
    o.cases.pop_back();  // metal
    return o;
}

// The parts of the levels that a fit changes.
detail::FitLevels parts(const Prefiltered& chain)
{
    detail::FitLevels all(chain.roughness.size());
    for (std::size_t k = 1; k < all.size(); ++k) {
        if (!detail::is_fitted(chain.roughness[k].width, chain.roughness[k].height)) continue;
        all[k][0] = chain.roughness[k];
        all[k][1] = chain.normal[k];
        all[k][6] = chain.base_share[k];
        if (k >= chain.second.share.size()) continue;
        all[k][3] = chain.second.normal[k];
        all[k][4] = chain.second.roughness[k];
        all[k][5] = chain.second.share[k];
    }
    return all;
}

Prefiltered start(const ScoredMaps& maps, bool two)
{
    Prefiltered chain = prefilter_raw(maps.normal, maps.roughness, {.rule = "picture", .quick = true});
    if (!two) return chain;
    chain.second = {chain.normal, chain.roughness, std::vector<Image>(chain.roughness.size())};
    for (std::size_t k = 1; k < chain.roughness.size(); ++k)
        chain.second.share[k] =
            Image(chain.roughness[k].width, chain.roughness[k].height, 1, ColorSpace::Data, 0.5f);
    return chain;
}

double change(const PictureScore& score, const PictureScore& plain)
{
    return (score.rmse + 3e-4) / (plain.rmse + 3e-4) - 1.0;
}

double worst(const PictureBench& bench, const Prefiltered& chain)
{
    const auto plain = bench.score({}), scores = bench.score(chain);
    double most = -1.0;
    for (std::size_t i = 0; i < scores.size(); ++i) most = std::max(most, change(scores[i], plain[i]));
    return most;
}

double mean(const PictureBench& bench, const Prefiltered& chain)
{
    const auto plain = bench.score({}), scores = bench.score(chain);
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) sum += change(scores[i], plain[i]);
    return sum / static_cast<double>(scores.size());
}

TEST(FitSettle, AFitThatOnlyCostsLeavesNothing)
{
    const ScoredMaps maps = material("mica");
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pixels());
    Prefiltered chain = start(maps, false);
    const Prefiltered before = chain;
    detail::Fits fits{parts(chain), {parts(chain)}};
    for (detail::FitParts& level : fits.after[0])
        for (float& p : level[0].pixels) p *= 0.3f;
    detail::keep_of_fits(bench, fits, {.rule = "picture", .surface = SurfaceClass::Paint}, chain);
    for (std::size_t k = 1; k < before.roughness.size(); ++k) {
        EXPECT_EQ(chain.roughness[k].pixels, before.roughness[k].pixels) << k;
        EXPECT_EQ(chain.base_share[k].pixels, before.base_share[k].pixels) << k;
    }
}

// Two lobes as they are fitted, and what is kept of them.
struct TwoLobes {
    explicit TwoLobes(const std::string& word)
        : maps(material(word)),
          bench(maps.normal, maps.roughness, {}, design_pictures(false, SurfaceClass::Paint)),
          kept(start(maps, true)),
          fitted(kept)
    {
        const PrefilterOptions options{.rule = "picture", .surface = SurfaceClass::Paint, .lobes = 2};
        detail::Fits fits{parts(kept), {}};
        EXPECT_TRUE(detail::fit_chain(bench.levels(), options, fitted));
        fits.after.push_back(parts(fitted));
        detail::keep_of_fits(bench, fits, options, kept);
    }
    ScoredMaps maps;
    PictureBench bench;
    Prefiltered kept, fitted;
};

// A fit gains in one light what it loses in another.
TEST(FitSettle, PicturesDoNotPayForOthers)
{
    const TwoLobes sheet("corrugated");
    const PictureBench guard(sheet.bench, guard_pictures(SurfaceClass::Paint));
    EXPECT_GT(worst(guard, sheet.fitted), 0.4) << "or this shows nothing";
    EXPECT_LT(worst(guard, sheet.kept), 0.5 * worst(guard, sheet.fitted));
    EXPECT_LT(mean(sheet.bench, sheet.kept), 0.8 * mean(sheet.bench, sheet.fitted));
}

// Lobes that are much too narrow, which a sun behind does not tell: pictures of the guard, with suns all around, do.
TEST(FitSettle, WhatItsOwnPicturesDoNotSeeTheGuardSees)
{
    const ScoredMaps maps = material("corrugated", 64);
    PictureOptions behind = few_pixels();
    behind.cases = {{0, 2, false}};
    const PictureBench bench(maps.normal, maps.roughness, {}, behind);
    const PictureBench guard(bench, guard_pictures(SurfaceClass::Paint));
    const PrefilterOptions options{.rule = "picture", .surface = SurfaceClass::Paint, .lobes = 2};
    Prefiltered kept = start(maps, true), narrow = kept;
    detail::Fits fits{parts(kept), {}};
    ASSERT_TRUE(detail::fit_chain(bench.levels(), options, narrow));
    for (std::vector<Image>* levels : {&narrow.roughness, &narrow.second.roughness})
        for (Image& level : *levels)
            for (float& p : level.pixels) p *= 0.3f;
    fits.after.push_back(parts(narrow));
    detail::keep_of_fits(bench, fits, options, kept);
    EXPECT_GT(worst(guard, narrow), 0.8) << "or this shows nothing";
    EXPECT_LT(worst(guard, kept), 0.85 * worst(guard, narrow));
    EXPECT_LT(mean(bench, kept), 0.8 * mean(bench, narrow));
}

// A wide second lobe shines where what is diffuse already does, so the base colour is fitted with it.
TEST(FitSettle, TheBaseColourThatIsFittedWithTwoLobesIsKept)
{
    const TwoLobes facets("facets");
    Prefiltered before = facets.kept;
    before.base_share = start(facets.maps, true).base_share;
    double apart = 0.0, count = 0.0;
    for (std::size_t k = 1; k < before.base_share.size(); ++k)
        for (std::size_t i = 0; i < before.base_share[k].pixels.size(); ++i, ++count)
            apart += std::abs(
                static_cast<double>(before.base_share[k].pixels[i] - facets.kept.base_share[k].pixels[i]));
    EXPECT_GT(apart / count, 0.003);
    EXPECT_LT(mean(facets.bench, facets.kept), mean(facets.bench, before) - 0.005);
}

// The base colour of a scene is made without the roughness, and its lobes are fitted with it as it is.
TEST(FitSettle, ABaseColourThatIsNotWrittenStaysAsItIs)
{
    const ScoredMaps maps = fresh_maps(48, 21).front();
    PrefilterOptions options{.rule = "picture", .surface = SurfaceClass::Paint, .lobes = 2};
    options.base_colors = false;
    const Prefiltered two = prefilter_raw(maps.normal, maps.roughness, options);
    options.lobes = 1;
    const Prefiltered one = prefilter_raw(maps.normal, maps.roughness, options);
    ASSERT_FALSE(two.second.share.empty());
    for (std::size_t k = 1; k < one.base_share.size(); ++k)
        EXPECT_EQ(two.base_share[k].pixels, one.base_share[k].pixels) << k;
    EXPECT_NE(two.roughness[1].pixels, one.roughness[1].pixels) << "or this shows nothing";
}

TEST(GuardPictures, LookAtEverySideAndAreNoneOfTheScored)
{
    const PictureOptions paint = guard_pictures(SurfaceClass::Paint), drawn = drawn_pictures(1);
    std::map<int, std::vector<double>> around;
    for (const PictureCase& c : paint.cases) {
        EXPECT_FALSE(c.metal);
        const PictureLight& light = paint.lights[static_cast<std::size_t>(c.light)];
        if (light.alpha == 0.0f)
            around[c.view].push_back(
                std::atan2(static_cast<double>(light.to_light[0]), static_cast<double>(light.to_light[1])));
        for (const PictureLight& other : drawn.lights) EXPECT_NE(light.to_light, other.to_light);
    }
    EXPECT_EQ(around.size(), paint.views.size());
    for (auto& [view, suns] : around) {
        std::sort(suns.begin(), suns.end());
        suns.push_back(suns.front() + 2.0 * std::numbers::pi);
        for (std::size_t i = 1; i < suns.size(); ++i)
            EXPECT_LT(suns[i] - suns[i - 1], 2.0 * 2.0 * std::numbers::pi / 7.0 + 1e-6) << view;
    }
    for (const PictureCase& c : guard_pictures(SurfaceClass::Metal).cases) {
        EXPECT_TRUE(c.metal);
        EXPECT_LT(c.view, static_cast<int>(paint.views.size()));
    }
}

}  // namespace
}  // namespace petrichor::texproc
