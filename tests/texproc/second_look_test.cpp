// Two lobes weighed once more, by pictures that each material draws for itself.
#include "texproc/prefilter/detail/second_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "texproc/prefilter/detail/fit_parts.h"
#include "texproc/prefilter/detail/look_price.h"
#include "texproc/prefilter/detail/worst_lights.h"
#include "texproc/study/fresh_maps.h"

namespace petrichor::texproc {
namespace {

using detail::cheapest_steps;
using detail::look_price;

ScoredMaps material(const std::string& word, int size = 96)
{
    for (ScoredMaps& maps : fresh_maps(size, 21))
        if (maps.name.starts_with(word)) return std::move(maps);
    ADD_FAILURE() << "there is no " << word;
    return {};
}

PictureOptions few_pictures()
{
    PictureOptions o = reference_pictures();
    o.views[0].width = 60;
    o.views[0].rows = 40;
    o.frames = 2;
    o.samples = 8;
    o.cases.pop_back();  // metal
    return o;
}

const PrefilterOptions kTwoLobes{.rule = "picture", .surface = SurfaceClass::Paint, .lobes = 2};

// Two equal lobes.
Prefiltered two_lobes(const ScoredMaps& maps, const PrefilterOptions& options = {})
{
    PrefilterOptions quick = options;
    quick.rule = "picture";
    quick.quick = true;
    quick.lobes = 1;
    Prefiltered chain = prefilter_raw(maps.normal, maps.roughness, quick);
    chain.second = {chain.normal, chain.roughness, std::vector<Image>(chain.roughness.size())};
    for (std::size_t k = 1; k < chain.roughness.size(); ++k)
        chain.second.share[k] =
            Image(chain.roughness[k].width, chain.roughness[k].height, 1, ColorSpace::Data, 0.5f);
    return chain;
}

double worst(const PictureBench& bench, const Prefiltered& chain)
{
    const auto plain = bench.score({}), scores = bench.score(chain);
    double most = -1.0;
    for (std::size_t i = 0; i < scores.size(); ++i) most = std::max(most, scores[i].rmse / plain[i].rmse - 1.0);
    return most;
}

double mean(const PictureBench& bench, const Prefiltered& chain)
{
    const auto plain = bench.score({}), scores = bench.score(chain);
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) sum += scores[i].rmse / plain[i].rmse - 1.0;
    return sum / static_cast<double>(scores.size());
}

// Highlights much too wide, so that what is diffuse is too bright nearly everywhere: other pictures are the judges.
TEST(SecondLook, MendsWhatIsWorseInPicturesItHasNotSeen)
{
    const ScoredMaps maps = material("rivets");
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    Prefiltered chain = two_lobes(maps);
    for (std::size_t k = 1; k < chain.roughness.size(); ++k)
        for (std::vector<Image>* levels : {&chain.roughness, &chain.second.roughness})
            for (float& p : (*levels)[k].pixels) p = std::min(1.7f * p, 1.0f);
    const Prefiltered wide = chain;
    EXPECT_TRUE(detail::look_again(bench, kTwoLobes, chain));
    EXPECT_GT(worst(bench, wide), 0.2) << "or this shows nothing";
    EXPECT_LT(worst(bench, chain), 0.25 * worst(bench, wide));
    EXPECT_LT(mean(bench, chain), mean(bench, wide) - 0.05);
}

// The meaning of the map is nothing to it: smoothness, and normals that point down, get the same light.
TEST(SecondLook, ReadsTheMapsAsTheyAreNamed)
{
    const ScoredMaps maps = material("rivets", 64);
    PrefilterOptions turned = kTwoLobes;
    turned.smoothness = turned.green_down = true;
    ScoredMaps other = maps;
    Image normal = to_image(maps.normal, ColorSpace::Data), rough = to_image(maps.roughness, ColorSpace::Data);
    for (std::size_t i = 1; i < normal.pixels.size(); i += 3) normal.pixels[i] = 1.0f - normal.pixels[i];
    for (float& p : rough.pixels) p = 1.0f - p;
    other.normal = to_raw(normal, PixelType::U16);
    other.roughness = to_raw(rough, PixelType::U16);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    const PictureBench of_other(other.normal, other.roughness, turned, few_pictures());
    Prefiltered chain = two_lobes(maps), turned_chain = two_lobes(other, turned);
    for (std::size_t k = 1; k < chain.roughness.size(); ++k) {
        for (std::vector<Image>* levels : {&chain.roughness, &chain.second.roughness})
            for (float& p : (*levels)[k].pixels) p = std::min(1.7f * p, 1.0f);
        for (std::vector<Image>* levels : {&turned_chain.roughness, &turned_chain.second.roughness})
            for (float& smooth : (*levels)[k].pixels) smooth = std::max(1.0f - 1.7f * (1.0f - smooth), 0.0f);
    }
    const double wide = mean(bench, chain);
    EXPECT_NEAR(wide, mean(of_other, turned_chain), 0.01);
    detail::look_again(bench, kTwoLobes, chain);
    detail::look_again(of_other, turned, turned_chain);
    EXPECT_NEAR(mean(bench, chain), mean(of_other, turned_chain), 0.03);
    EXPECT_LT(mean(bench, chain), wide - 0.05) << "or this shows nothing";
}

TEST(SecondLook, ABaseColourThatIsNotWrittenStaysAsItIs)
{
    const ScoredMaps maps = material("rivets", 64);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    PrefilterOptions options = kTwoLobes;
    Prefiltered written = two_lobes(maps), chain = written;
    for (Prefiltered* of : {&written, &chain})
        for (std::size_t k = 1; k < of->base_share.size(); ++k)
            for (float& share : of->base_share[k].pixels) share *= 0.8f;  // too dark
    const std::vector<Image> before = chain.base_share;
    detail::look_again(bench, options, written);
    options.base_colors = false;
    detail::look_again(bench, options, chain);
    for (std::size_t k = 1; k < before.size(); ++k) EXPECT_EQ(chain.base_share[k].pixels, before[k].pixels) << k;
    EXPECT_NE(written.base_share[1].pixels, before[1].pixels) << "or this shows nothing";
}

TEST(SecondLook, SameNumbersForAnyThreads)
{
    const ScoredMaps maps = material("rivets");
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    Prefiltered one = two_lobes(maps);
    for (std::size_t k = 1; k < one.roughness.size(); ++k)
        for (float& p : one.roughness[k].pixels) p = std::min(1.7f * p, 1.0f);
    Prefiltered three = one;
    PrefilterOptions options = kTwoLobes;
    options.threads = 1;
    EXPECT_TRUE(detail::look_again(bench, options, one));
    options.threads = 3;
    detail::look_again(bench, options, three);
    for (std::size_t k = 1; k < one.roughness.size(); ++k) {
        EXPECT_EQ(one.roughness[k].pixels, three.roughness[k].pixels) << k;
        EXPECT_EQ(one.second.normal[k].pixels, three.second.normal[k].pixels) << k;
    }
}

// What a form says of a small step is what pictures say when it is taken.
TEST(PictureForms, FollowSmallSteps)
{
    const ScoredMaps maps = material("rivets", 64);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    Prefiltered chain = two_lobes(maps);
    const Prefiltered before = chain;
    PictureBench::Retake retake(bench);
    const std::vector<PictureScore> scores = retake.score(chain, ~0u);
    // Rougher second lobes on level 2, more of them on level 3.
    const auto step = [&](std::size_t i, float times) {
        const std::size_t k = i == 0 ? 2 : 3;
        auto part = i == 0 ? &SecondLobe::roughness : &SecondLobe::share;
        (chain.second.*part)[k] = (before.second.*part)[k];
        for (float& number : (chain.second.*part)[k].pixels) number += 0.02f * times;
        return k;
    };
    const PictureForms forms = retake.forms(chain, 2, [&](std::size_t i) {
        chain = before;
        return i < 2 ? step(i, 1.0f) : std::size_t{0};
    });
    ASSERT_EQ(forms.cases.size(), scores.size());
    for (const std::size_t none : {0u, 1u}) {
        EXPECT_NE(forms.cases[0].all.slope[none], 0.0f) << "or this shows nothing";
        EXPECT_NE(forms.cases[0].moving.slope[none], 0.0f) << "or this shows nothing";
    }
    const float x[] = {0.5f, -0.7f};
    step(0, x[0]), step(1, x[1]);
    const std::vector<PictureScore> after = bench.score(chain);
    for (std::size_t c = 0; c < scores.size(); ++c) {
        const auto said = [&](const PictureForms::Form& form) {
            double sum = form.error;
            for (std::size_t i = 0; i < 2; ++i) {
                sum += 2.0 * static_cast<double>(x[i] * form.slope[i]);
                for (std::size_t j = 0; j < 2; ++j) sum += static_cast<double>(x[i] * x[j] * form.square[2 * i + j]);
            }
            return sum;
        };
        const PictureForms::Form &all = forms.cases[c].all, &moving = forms.cases[c].moving;
        EXPECT_NEAR(all.error, scores[c].rmse * scores[c].rmse, 1e-3 * all.error) << scores[c].name;
        const double change = after[c].rmse * after[c].rmse - all.error;
        EXPECT_NEAR(said(all) - all.error, change, 0.1 * std::abs(change) + 2e-4 * all.error) << scores[c].name;
        // Of the deviation in time it is a bound, which is higher where hardly anything moves.
        EXPECT_GE(moving.error, scores[c].flicker) << scores[c].name;
        EXPECT_LE(moving.error, scores[c].flicker + 1e-3) << scores[c].name;
        EXPECT_GE(said(moving), after[c].flicker * (1.0 - 1e-3)) << scores[c].name;
        EXPECT_NEAR(said(moving) - moving.error, after[c].flicker - scores[c].flicker,
                    0.2 * std::abs(after[c].flicker - scores[c].flicker) + 5e-4 * moving.error)
            << scores[c].name;
    }
}

// One light, better by x up to where its errors are least; another that this makes worse than plain mips.
TEST(LookPrice, ALightThatGetsWorseHoldsBackWhatAnotherGains)
{
    const auto light = [](double error, float slope) {
        return std::vector<PictureForms::Case>(kHeldOutViews, {{error, {slope}, {0.01f}}, {1.0, {0.0f}, {0.0f}}});
    };
    PictureForms forms{1, light(1.0, -0.1f)};
    const std::vector<PictureScore> plain(2 * kHeldOutViews, {"", 1.0, 1.0});
    const float low[] = {-20.0f}, high[] = {20.0f};
    EXPECT_NEAR(cheapest_steps(forms, plain, low, high, 1).front(), 10.0f, 0.5f);
    const float near[] = {3.0f};
    EXPECT_NEAR(cheapest_steps(forms, plain, low, near, 1).front(), 3.0f, 0.01f) << "no farther than it may";
    for (const PictureForms::Case& c : light(0.9, 0.02f)) forms.cases.push_back(c);  // as plain where x is 1.9
    const float held = cheapest_steps(forms, plain, low, high, 1).front();
    EXPECT_GT(held, 0.5f);
    EXPECT_LT(held, 3.0f);
}

// Nothing is nearer to the truth for it, but less of it moves.
TEST(LookPrice, WhatFlickersLessIsCheaper)
{
    const PictureForms forms{1, std::vector<PictureForms::Case>(kHeldOutViews, {{1.0, {0.0f}, {1e-6f}}, {1.0, {-0.1f}, {0.05f}}})};
    const std::vector<PictureScore> plain(kHeldOutViews, {"", 1.0, 1.0});
    const float low[] = {-20.0f}, high[] = {20.0f};
    EXPECT_NEAR(cheapest_steps(forms, plain, low, high, 1).front(), 2.0f, 0.1f);
}

TEST(LookPrice, ItsSlopeIsThatOfThePrice)
{
    std::vector<double> changes(3 * kHeldOutViews), slope(changes.size()), unused = slope;
    for (std::size_t i = 0; i < changes.size(); ++i) changes[i] = 0.03 * std::sin(static_cast<double>(7 * i + 1));
    look_price(changes, slope);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        constexpr double kStep = 1e-5;
        std::vector<double> more = changes, less = changes;
        more[i] += kStep, less[i] -= kStep;
        EXPECT_NEAR((look_price(more, unused) - look_price(less, unused)) / (2.0 * kStep), slope[i], 1e-3) << i;
    }
}

// And the worse a picture is, the more each per cent costs.
TEST(WorstPrice, ItsSlopeIsThatOfThePriceAndGrows)
{
    std::vector<double> changes(3 * kHeldOutViews), slope(changes.size()), unused = slope;
    for (std::size_t i = 0; i < changes.size(); ++i)
        changes[i] = 0.03 * static_cast<double>(i / kHeldOutViews) + 0.02 * std::sin(static_cast<double>(7 * i + 1));
    detail::worst_price(changes, slope);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        constexpr double kStep = 1e-5;
        std::vector<double> more = changes, less = changes;
        more[i] += kStep, less[i] -= kStep;
        EXPECT_NEAR((detail::worst_price(more, unused) - detail::worst_price(less, unused)) / (2.0 * kStep), slope[i], 1e-4);
        if (i >= kHeldOutViews) {
            EXPECT_GT(slope[i], slope[i - kHeldOutViews]) << i;
        }
    }
}

// The mean gains for ever; what was sought loses as much, and holds it where it is hardly worse.
TEST(WorstPrice, WhatWasSoughtHoldsBackTheMean)
{
    const std::vector<PictureForms::Case> gains(8 * kHeldOutViews, {{1.0, {-0.0005f}, {1e-6f}}, {1.0, {0.0f}, {0.0f}}});
    const std::vector<PictureForms::Case> loses(kHeldOutViews, {{1.0, {0.05f}, {1e-4f}}, {1.0, {-0.1f}, {0.05f}}});
    PictureForms forms{1, gains};
    std::vector<PictureScore> plain(gains.size(), {"", 1.0, 1.0});
    const float low[] = {-20.0f}, high[] = {20.0f};
    EXPECT_GT(cheapest_steps(forms, plain, low, high, 1).front(), 8.0f);
    forms.cases.insert(forms.cases.end(), loses.begin(), loses.end());
    plain.resize(forms.cases.size(), {"", 1.0, 1.0});
    const float held = cheapest_steps(forms, plain, low, high, 1, kHeldOutViews).front();
    EXPECT_GT(held, 0.2f);
    EXPECT_LT(held, 4.0f);
}

// Highlights that are too wide lose where plain mips have the sun ahead: lights that lose most, as other pictures say.
TEST(WorstLights, AreThoseUnderWhichTheChainLosesMost)
{
    const ScoredMaps maps = material("rivets", 64);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pictures());
    Prefiltered chain = two_lobes(maps);
    for (std::size_t k = 1; k < chain.roughness.size(); ++k)
        for (std::vector<Image>* levels : {&chain.roughness, &chain.second.roughness})
            for (float& p : (*levels)[k].pixels) p = std::min(1.3f * p, 1.0f);
    PictureOptions floors = held_out_pictures(SurfaceClass::Paint, 5);
    PictureOptions found = detail::worst_lights(bench, floors, kTwoLobes, chain, 11);
    ASSERT_FALSE(found.lights.empty());
    ASSERT_EQ(found.cases.size(), found.lights.size() * kHeldOutViews);
    for (std::size_t i = 0; i < found.cases.size(); ++i) {
        EXPECT_EQ(found.cases[i].light, static_cast<int>(i / kHeldOutViews));
        EXPECT_FALSE(found.cases[i].metal);
        EXPECT_LT(found.views[static_cast<std::size_t>(found.cases[i].view)].covers, 0.2) << "none of large pixels";
    }
    for (std::size_t i = 0; i < found.lights.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if ((found.lights[i].alpha > 0.0f) != (found.lights[j].alpha > 0.0f)) continue;
            double cosine = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                cosine += static_cast<double>(found.lights[i].to_light[c] * found.lights[j].to_light[c]);
            EXPECT_LT(cosine, std::cos(4.9 * 3.14159265 / 180.0)) << i << ", " << j;
        }
    }
    // In pictures of its own, against as many that were not sought.
    const auto change = [&](PictureOptions pictures) {
        pictures.seed = 99;
        const PictureBench of(bench, pictures);
        const auto plain = of.score({}), scores = of.score(chain);
        double sum = 0.0, seen = 0.0;
        for (std::size_t i = 0; i < scores.size(); ++i) {
            if (pictures.views[static_cast<std::size_t>(pictures.cases[i].view)].covers > 0.2) continue;
            sum += scores[i].rmse / plain[i].rmse - 1.0;
            ++seen;
        }
        return sum / seen;
    };
    EXPECT_GT(change(found), change(floors) + 0.03) << change(floors);
    // The same seed, the same lights; another one, others.
    const PictureOptions again = detail::worst_lights(bench, floors, kTwoLobes, chain, 11);
    ASSERT_EQ(again.lights.size(), found.lights.size());
    for (std::size_t i = 0; i < found.lights.size(); ++i) EXPECT_EQ(again.lights[i].to_light, found.lights[i].to_light);
    EXPECT_NE(detail::worst_lights(bench, floors, kTwoLobes, chain, 12).lights[0].to_light, found.lights[0].to_light);
}

TEST(HeldOutPictures, AreEachMaterialsOwnAndNoneOfTheScored)
{
    const ScoredMaps one = material("rivets", 64), other = material("mica", 64);
    const PictureBench a(one.normal, one.roughness, {}, few_pictures());
    const PictureBench b(other.normal, other.roughness, {}, few_pictures());
    EXPECT_NE(detail::floors_seed(a.levels()), detail::floors_seed(b.levels()));
    const PictureOptions o = held_out_pictures(SurfaceClass::Paint, detail::floors_seed(a.levels()));
    const PictureOptions scored = all_pictures();
    ASSERT_EQ(o.cases.size() % kHeldOutViews, 0u);
    for (std::size_t i = 0; i < o.cases.size(); ++i) {
        EXPECT_FALSE(o.cases[i].metal);
        EXPECT_EQ(o.cases[i].light, o.cases[i - i % kHeldOutViews].light);
        EXPECT_LT(o.cases[i].view, static_cast<int>(o.views.size()));
        for (std::size_t j = i + 1; j < i - i % kHeldOutViews + kHeldOutViews; ++j)
            EXPECT_NE(o.cases[i].view, o.cases[j].view) << "a light is seen from different places";
    }
    for (const PictureLight& light : o.lights)
        for (const PictureLight& of_score : scored.lights) EXPECT_NE(light.to_light, of_score.to_light);
    for (const PictureCase& c : held_out_pictures(SurfaceClass::Metal, 3).cases) EXPECT_TRUE(c.metal);
}

// Few pixels of a picture say what all of them do: they are as small as there.
TEST(PictureView, ASampleOfAPictureIsAsFarFromTheTruth)
{
    const ScoredMaps maps = material("rivets");
    PictureOptions all = reference_pictures();
    all.frames = 2;
    all.samples = 8;
    PictureOptions some = all;
    some.views[0].width /= 5;
    some.views[0].rows /= 5;
    PictureOptions large = some;
    some.views[0].covers = 0.2;
    const auto of_all = PictureBench(maps.normal, maps.roughness, {}, all).score({});
    const auto of_some = PictureBench(maps.normal, maps.roughness, {}, some).score({});
    const auto of_large = PictureBench(maps.normal, maps.roughness, {}, large).score({});
    double apart = 0.0, large_apart = 0.0;
    for (std::size_t i = 0; i < of_all.size(); ++i) {
        apart += std::abs(std::log(of_some[i].rmse / of_all[i].rmse));
        large_apart += std::abs(std::log(of_large[i].rmse / of_all[i].rmse));
    }
    EXPECT_LT(apart, 0.5 * large_apart);
    EXPECT_LT(apart, 0.2 * static_cast<double>(of_all.size()));
}

}  // namespace
}  // namespace petrichor::texproc
