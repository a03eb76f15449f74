// Texels that are fitted to pixels: the light in lanes is that of the floor, its slopes are slopes,
// and pictures that the fit has not seen get nearer to the truth and hold stiller.
#include "texproc/prefilter/detail/chain_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "texproc/prefilter/detail/chain_fit_kernel.h"
#include "texproc/prefilter/detail/fit_pixels.h"
#include "texproc/prefilter/picture.h"
#include "texproc/study/fresh_maps.h"

namespace petrichor::texproc {
namespace {

using namespace detail;

constexpr std::size_t kLights = kFitLights;

// Eight lights about an eye, the last but one a window, the last and the first on metal; a sky beside some
// of them, and alone.
FitLights lights(std::vector<FloorLight>& as_floor)
{
    FitLights to{};
    const glm::vec3 eye = glm::normalize(glm::vec3(-0.5f, 0.3f, 0.6f));
    for (int c = 0; c < 3; ++c) to.eye[c] = eye[c];
    for (std::size_t i = 0; i < kLights; ++i) {
        const float turn = 0.8f * static_cast<float>(i);
        const glm::vec3 l = glm::normalize(
            glm::vec3(std::cos(turn), std::sin(turn), 0.3f + 0.1f * static_cast<float>(i)));
        const glm::vec3 h = glm::normalize(l + eye);
        const bool window = i == 6, metal = i == 7 || i == 0;
        const float sun = i == 3 ? 0.0f : 1.0f, sky = i == 3 ? 1.0f : i % 2 == 0 ? 0.0f : 0.15f;
        to.lx[i] = l.x, to.ly[i] = l.y, to.lz[i] = l.z;
        to.hx[i] = h.x, to.hy[i] = h.y, to.hz[i] = h.z;
        const float f0 = metal ? kMetalF0 : kPaintF0, m = 1.0f - glm::dot(l, h);
        const float rim = m * m * m * m * m, fresnel = f0 + (1.0f - f0) * rim;
        to.fresnel[i] = sun * (metal ? rim : fresnel);
        to.fresnel_metal[i] = metal ? sun * f0 * (1.0f - rim) : 0.0f;
        to.albedo[i] = metal ? 0.0f : sun * (1.0f - fresnel) * kPaintAlbedo / shared::kPi;
        to.alpha2[i] = window ? 0.01f : 0.0f;
        to.sky[i] = sky;
        to.f0[i] = metal ? 0.0f : f0;
        to.f0_metal[i] = metal ? f0 : 0.0f;
        to.sky_albedo[i] = metal ? 0.0f : kPaintAlbedo * (1.0f - f0);
        as_floor.push_back({l, to.alpha2[i], sun, sky, metal});
    }
    return to;
}

TEST(ChainFitKernel, ShadesAsTheFloorDoes)
{
    std::vector<FloorLight> floor;
    const FitLights q = lights(floor);
    const glm::vec3 eye(q.eye[0], q.eye[1], q.eye[2]);
    for (const auto& [slope, p] : {std::pair(0.0f, 0.9f), {0.3f, 0.5f}, {-0.6f, 0.35f}}) {
        const glm::vec3 n = glm::normalize(glm::vec3(slope, 0.5f * slope, 1.0f));
        float light[kLights];
        chain_fit_kernel().mean_light(q, &n.x, &n.y, &n.z, &p, 1, light);
        for (std::size_t i = 0; i < kLights; ++i) {
            const float known = shade(n, p, 1.0f, eye, floor[i]);
            EXPECT_NEAR(light[i], known, 1e-4f * known + 1e-6f) << "light " << i << ", " << p;
        }
    }
}

// The shares of the base colour, of paint and of metal.
TEST(ChainFitKernel, SharesDarkenAsTheyDoOnTheFloor)
{
    std::vector<FloorLight> floor;
    FitView view{};
    view.lights = lights(floor);
    view.taps = 1;
    for (float& exposure : view.exposure) exposure = 1.0f;
    const glm::vec3 eye(view.lights.eye[0], view.lights.eye[1], view.lights.eye[2]);
    const Texel t{glm::normalize(glm::vec3(0.2f, -0.1f, 1.0f)), 0.5f, 0.7f, 0.6f};
    const std::vector<FitTexel> level(4, {{t.n.x, t.n.y, t.n.z}, t.stored, t.diffuse, t.metal, 0.5f, 0.0f});
    const FitLevel map{2, 2, level.data(), nullptr};
    const FitPixel pixel{0.3f, 0.6f, {}};
    float light[kLights];
    chain_fit_kernel().seen(view, {}, map, map, &pixel, 1, light);
    for (std::size_t i = 0; i < kLights; ++i) {
        const float known = shade(t, t.stored, eye, floor[i]);
        EXPECT_NEAR(light[i], known, 1e-4f * known + 1e-6f) << i;
        const float full = shade(t.n, t.stored, 1.0f, eye, floor[i]);
        EXPECT_LT(known, full) << i;
    }
}

// Two lobes of a texel, and what is diffuse by the normal between them.
TEST(ChainFitKernel, TwoLobesShadeAsTheyDoOnTheFloor)
{
    std::vector<FloorLight> floor;
    FitView view{};
    view.lights = lights(floor);
    view.taps = 1;
    for (float& exposure : view.exposure) exposure = 1.0f;
    const glm::vec3 eye(view.lights.eye[0], view.lights.eye[1], view.lights.eye[2]);
    const Texel t{glm::normalize(glm::vec3(0.2f, -0.1f, 1.0f)), 0.5f, 0.7f, 0.6f};
    const SecondTexel second{glm::normalize(glm::vec3(-0.3f, 0.2f, 1.0f)), 0.3f, 0.35f};
    const std::vector<FitTexel> level(4, {{t.n.x, t.n.y, t.n.z}, t.stored, t.diffuse, t.metal, second.share, 0.0f});
    const std::vector<FitLobe> lobes(4, {{second.n.x, second.n.y, second.n.z}, second.stored});
    const FitLevel map{2, 2, level.data(), nullptr, lobes.data(), nullptr}, one{2, 2, level.data(), nullptr};
    const FitPixel pixel{0.3f, 0.6f, {}};
    float light[kLights], of_one[kLights];
    chain_fit_kernel().seen(view, {}, map, map, &pixel, 1, light);
    chain_fit_kernel().seen(view, {}, one, one, &pixel, 1, of_one);
    for (std::size_t i = 0; i < kLights; ++i) {
        const float known = shade(t, t.stored, second, second.stored, eye, floor[i]);
        EXPECT_NEAR(light[i], known, 1e-4f * known + 1e-6f) << i;
        EXPECT_GT(std::abs(light[i] - of_one[i]), 1e-3f * known) << i << ": or this shows nothing";
        // Two lobes that are the same are one.
        const float same = shade(t, t.stored, {t.n, t.stored, second.share}, t.stored, eye, floor[i]);
        EXPECT_NEAR(same, shade(t, t.stored, eye, floor[i]), 1e-5f * same + 1e-7f) << i;
    }
}

// The first step of Adam goes by the rate, whatever the slope, but for slopes as small as what it is kept from 0 by. Both
// instruction sets take it alike, to the bit, and so the next ones.
TEST(ChainFitKernel, MovesAsAdamDoes)
{
    constexpr float kRate = 0.01f, kScale = 0.5f, kLeast = 0.02f, kFull = 1.0f - 0.9f, kFullSquare = 1.0f - 0.99f;
    constexpr std::size_t kCount = 5;
    struct Maps {
        std::vector<FitTexel> texels{kCount, {{0.6f, 0.0f, 0.8f}, 0.5f, 0.7f, 0.4f, 0.3f, 9.0f}};
        std::vector<FitSlope> mean{kCount, FitSlope{}}, square = mean;
        std::vector<FitLobe> second{kCount, {{0.0f, 0.6f, 0.8f}, 0.25f}}, second_mean{kCount, FitLobe{}}, second_square = second_mean;
        std::vector<FitSlope> slopes[kFitSlots];
        std::vector<FitLobe> second_slopes[kFitSlots];
        void step(const ChainFitKernel& kernel, const FitMove& how)
        {
            FitMoved level{texels.data(), mean.data(), square.data(), second.data(), second_mean.data(), second_square.data(), {}, {}};
            for (std::size_t k = 0; k < kFitSlots; ++k) {
                const float v = static_cast<float>(k) + 0.25f;
                slopes[k].assign(kCount, {{v, -v, 0.5f * v}, -2.0f * v, v, 0.001f * v, -v, 0.0f});
                second_slopes[k].assign(kCount, {{v, v, -v}, v});
                level.slopes[k] = slopes[k].data();
                level.second_slopes[k] = second_slopes[k].data();
            }
            kernel.move(how, level, static_cast<int>(kCount));
        }
    };
    FitMove how{kRate, kScale, 0.9f, 0.99f, kFull, kFullSquare, kLeast, true, true, true, true};
    Maps maps;
    maps.step(kChainFitKernelBase, how);
    const auto moved = [&](float at, float slope) {
        const float g = kScale * 7.0f * slope;  // the four slots hold 7 together
        return at - kRate * g / (std::abs(g) + 1e-3f);
    };
    const auto unit = [](float x, float y, float z) { return glm::normalize(glm::vec3(x, y, z)); };
    const FitTexel& t = maps.texels.back();
    const glm::vec3 n = unit(moved(0.6f, 1.0f), moved(0.0f, -1.0f), moved(0.8f, 0.5f));
    const FitLobe& lobe = maps.second.back();
    const glm::vec3 m = unit(moved(0.0f, 1.0f), moved(0.6f, 1.0f), moved(0.8f, -1.0f));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(t.n[c], n[c], 1e-6f);
        EXPECT_NEAR(lobe.n[c], m[c], 1e-6f);
    }
    EXPECT_NEAR(t.stored, moved(0.5f, -2.0f), 1e-6f);
    EXPECT_NEAR(t.metal, moved(0.4f, 1.0f), 1e-6f);
    EXPECT_NEAR(t.of_second, moved(0.3f, 0.001f), 1e-6f);
    EXPECT_NEAR(t.share, moved(0.7f, -1.0f), 1e-6f);
    EXPECT_NEAR(lobe.stored, moved(0.25f, 1.0f), 1e-6f);
    EXPECT_EQ(t.none, 9.0f);
    for (const auto& slot : maps.slopes) EXPECT_EQ(slot.back().stored, 0.0f) << "taken";
    for (const auto& slot : maps.second_slopes) EXPECT_EQ(slot.back().n[1], 0.0f) << "taken";
    // What does not move stays.
    Maps still;
    how.joint = how.metal = how.second = how.paint = false;
    still.step(kChainFitKernelBase, how);
    EXPECT_EQ(still.texels.back().stored, t.stored);
    EXPECT_EQ(still.texels.back().n[0], 0.6f);
    EXPECT_EQ(still.texels.back().metal, 0.4f);
    EXPECT_EQ(still.second.back().stored, 0.25f);
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) return;
    how.joint = how.metal = how.second = how.paint = true;
    Maps base, wide;
    for (int step = 0; step < 5; ++step) {
        base.step(kChainFitKernelBase, how);
        wide.step(kChainFitKernelAvx2, how);
    }
    EXPECT_EQ(std::memcmp(base.texels.data(), wide.texels.data(), kCount * sizeof(FitTexel)), 0);
    EXPECT_EQ(std::memcmp(base.second.data(), wide.second.data(), kCount * sizeof(FitLobe)), 0);
#endif
}

// A view of two levels with noise on them.
struct Scene {
    FitView view{};
    std::vector<FitTexel> fine, coarse;
    std::vector<FitSlope> fine_slopes, coarse_slopes;
    std::vector<FitLobe> fine_second, coarse_second, fine_second_slopes, coarse_second_slopes;
    std::vector<FitPixel> pixels;

    explicit Scene(bool two = false) : fine(16 * 16), coarse(8 * 8), fine_slopes(fine.size()), coarse_slopes(coarse.size())
    {
        std::vector<FloorLight> floor;
        view.lights = lights(floor);
        view.taps = 3;
        view.step_u = 0.03f, view.step_v = 0.05f;
        view.share = 0.4f;
        for (std::size_t i = 0; i < kLights; ++i)
            view.exposure[i] = 1.5f, view.weight[i] = 1.0f, view.flicker[i] = 0.7f;
        unsigned number = 1;
        const auto dice = [&number] {
            number = number * 1664525u + 1013904223u;
            return static_cast<float>(number >> 8) / 16777216.0f;
        };
        for (std::vector<FitTexel>* level : {&fine, &coarse}) {
            for (FitTexel& t : *level) {
                const glm::vec3 n = glm::normalize(glm::vec3(dice() - 0.5f, dice() - 0.5f, 1.0f));
                t = {{n.x, n.y, n.z}, 0.4f + 0.4f * dice(), 0.9f, 0.8f, 0.5f, 0.0f};
            }
        }
        for (int i = 0; i < 20 * kFitFrames; ++i) {
            FitPixel p{dice(), dice(), {}};
            for (std::uint16_t& shown : p.shown)
                shown = static_cast<std::uint16_t>(20000.0f * dice());
            pixels.push_back(p);
        }
        for (const auto& [level, lobes, slopes] :
             {std::tuple(&fine, &fine_second, &fine_second_slopes), {&coarse, &coarse_second, &coarse_second_slopes}}) {
            if (!two) break;
            for (std::size_t i = 0; i < level->size(); ++i) {
                const glm::vec3 n = glm::normalize(glm::vec3(dice() - 0.5f, dice() - 0.5f, 1.0f));
                lobes->push_back({{n.x, n.y, n.z}, 0.5f + 0.3f * dice()});
                (*level)[i].of_second = 0.2f + 0.6f * dice();
            }
            slopes->resize(lobes->size());
        }
    }
    FitLevel level(bool of_fine)
    {
        const bool two = !fine_second.empty();
        return of_fine ? FitLevel{16, 16, fine.data(), fine_slopes.data(), two ? fine_second.data() : nullptr,
                                  fine_second_slopes.data()}
                       : FitLevel{8, 8, coarse.data(), coarse_slopes.data(), two ? coarse_second.data() : nullptr,
                                  coarse_second_slopes.data()};
    }
    // Nothing is clipped, and lights that are nearly black somewhere do not count: the slope is
    // held back in both.
    void expose()
    {
        std::vector<float> out(pixels.size() * kLights);
        chain_fit_kernel().seen(view, {}, level(true), level(false), pixels.data(),
                                static_cast<int>(pixels.size()), out.data());
        int counted = 0;
        for (std::size_t l = 0; l < kLights; ++l) {
            float least = out[l], most = out[l];
            for (std::size_t i = l; i < out.size(); i += kLights)
                least = std::min(least, out[i]), most = std::max(most, out[i]);
            view.exposure[l] *= 0.8f / most;
            if (least > 0.02f * most)
                ++counted;
            else
                view.weight[l] = view.flicker[l] = 0.0f;
        }
        EXPECT_GE(counted, 4);
    }
    // Half of what add_slopes() takes the slope of.
    double cost()
    {
        const int count = static_cast<int>(pixels.size());
        std::vector<float> out(pixels.size() * kLights);
        chain_fit_kernel().seen(view, {}, level(true), level(false), pixels.data(), count,
                                out.data());
        double sum = 0.0;
        for (std::size_t i = 0; i < pixels.size(); i += kFitFrames) {
            for (std::size_t l = 0; l < kLights; ++l) {
                double e[kFitFrames], mean = 0.0;
                for (std::size_t f = 0; f < kFitFrames; ++f) {
                    const double light = static_cast<double>(out[(i + f) * kLights + l]);
                    e[f] = std::sqrt(light) - pixels[i + f].shown[l] / 65535.0;
                    mean += e[f] / kFitFrames;
                }
                for (const double error : e)
                    sum += 0.5 *
                           (static_cast<double>(view.weight[l]) * error * error +
                            static_cast<double>(view.flicker[l]) * (error - mean) * (error - mean));
            }
        }
        return sum;
    }
};

// Of one light at a time: slopes of several cancel, and what is left says little.
class ChainFitLobes : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Lobes, ChainFitLobes, testing::Bool(),
                         [](const auto& which) { return which.param ? "Two" : "One"; });

TEST_P(ChainFitLobes, SlopesAreThoseOfTheError)
{
    const bool two = GetParam();
    double largest = 0.0, largest_of_metal = 0.0, largest_of_second = 0.0, largest_of_paint = 0.0;
    for (std::size_t light = 0; light < kLights; ++light) {
        Scene s(two);
        s.expose();
        for (std::size_t l = 0; l < kLights; ++l)
            if (l != light) s.view.weight[l] = s.view.flicker[l] = 0.0f;
        chain_fit_kernel().add_slopes(s.view, {}, s.level(true), s.level(false), s.pixels.data(),
                                      static_cast<int>(s.pixels.size()));
        for (const bool of_fine : {true, false}) {
            std::vector<FitTexel>& texels = of_fine ? s.fine : s.coarse;
            const std::vector<FitSlope>& slopes = of_fine ? s.fine_slopes : s.coarse_slopes;
            for (const std::size_t i : {std::size_t{0}, texels.size() / 2, texels.size() - 3}) {
                FitTexel& t = texels[i];
                const FitSlope& slope = slopes[i];
                std::vector<float*> values = {&t.n[0], &t.n[1], &t.n[2], &t.stored, &t.metal};
                std::vector<float> found = {slope.n[0], slope.n[1], slope.n[2], slope.stored, slope.metal};
                if (two) {
                    FitLobe& lobe = (of_fine ? s.fine_second : s.coarse_second)[i];
                    const FitLobe& by = (of_fine ? s.fine_second_slopes : s.coarse_second_slopes)[i];
                    values.insert(values.end(), {&t.of_second, &t.share, &lobe.n[0], &lobe.n[1], &lobe.n[2], &lobe.stored});
                    found.insert(found.end(), {slope.of_second, slope.share, by.n[0], by.n[1], by.n[2], by.stored});
                }
                for (std::size_t c = 0; c < values.size(); ++c) {
                    float& value = *values[c];
                    const float was = value, step = 0.01f;
                    value = was + step;
                    const double above = s.cost();
                    value = was - step;
                    const double below = s.cost();
                    value = was;
                    const double known = (above - below) / (2.0 * static_cast<double>(step));
                    EXPECT_NEAR(static_cast<double>(found[c]), known,
                                0.05 * std::abs(known) + 1e-4)
                        << light << " " << of_fine << " " << i << " " << c;
                    largest = std::max(largest, std::abs(known));
                    if (c == 4) largest_of_metal = std::max(largest_of_metal, std::abs(known));
                    if (c == 5) largest_of_second = std::max(largest_of_second, std::abs(known));
                    if (c == 6) largest_of_paint = std::max(largest_of_paint, std::abs(known));
                }
            }
        }
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_GT(largest_of_metal, 0.001);
    if (two) {
        EXPECT_GT(largest_of_second, 0.001);
        EXPECT_GT(largest_of_paint, 0.001);
    }
}

TEST_P(ChainFitLobes, BothInstructionSetsGiveTheSameBits)
{
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
#endif
    Scene a(GetParam()), b(GetParam());
    const int count = static_cast<int>(a.pixels.size());
    kChainFitKernelBase.add_slopes(a.view, {}, a.level(true), a.level(false), a.pixels.data(),
                                   count);
    kChainFitKernelAvx2.add_slopes(b.view, {}, b.level(true), b.level(false), b.pixels.data(),
                                   count);
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), [](const auto& p, const auto& q) {
                   return std::memcmp(&p, &q, sizeof p) == 0;
               });
    };
    EXPECT_EQ(a.fine_second_slopes.size(), GetParam() ? a.fine.size() : 0u);
    EXPECT_TRUE(same(a.fine_second_slopes, b.fine_second_slopes));
    EXPECT_TRUE(same(a.coarse_second_slopes, b.coarse_second_slopes));
    EXPECT_TRUE(same(a.fine_slopes, b.fine_slopes));
    EXPECT_TRUE(same(a.coarse_slopes, b.coarse_slopes));
}

PictureOptions few_pixels()
{
    PictureOptions o = reference_pictures();
    o.views[0].width = 60;
    o.views[0].rows = 40;
    o.frames = 3;
    o.samples = 8;
    return o;
}

ScoredMaps cloth(int size)
{
    for (ScoredMaps& maps : fresh_maps(size, 21))
        if (maps.name.starts_with("cloth")) return std::move(maps);
    ADD_FAILURE() << "there is no cloth";
    return {};
}

// Of smoothness and green down too: the fit reads and writes what the maps mean.
class ChainFit : public testing::TestWithParam<bool> {};

TEST_P(ChainFit, PicturesThatItHasNotSeenAreNearerAndHoldStiller)
{
    ScoredMaps maps = cloth(96);
    PrefilterOptions options{.rule = "picture", .quick = true, .surface = SurfaceClass::Paint};
    if (GetParam()) {
        options.smoothness = options.green_down = true;
        Image n = to_image(maps.normal, ColorSpace::Data),
              r = to_image(maps.roughness, ColorSpace::Data);
        for (std::size_t i = 1; i < n.pixels.size(); i += 3) n.pixels[i] = 1.0f - n.pixels[i];
        for (float& p : r.pixels) p = 1.0f - p;
        maps.normal = to_raw(n, PixelType::U16), maps.roughness = to_raw(r, PixelType::U16);
    }
    PictureOptions paint = few_pixels();
    paint.cases.pop_back();  // metal
    const PictureBench bench(maps.normal, maps.roughness, options, paint);
    const Prefiltered start = prefilter_raw(maps.normal, maps.roughness, options);
    Prefiltered fitted = start;
    fit_chain(bench.levels(), options, fitted);
    const auto before = bench.score(start), after = bench.score(fitted);
    double rmse = 0.0, flicker = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        rmse += after[i].rmse / before[i].rmse / static_cast<double>(after.size());
        flicker += after[i].flicker / before[i].flicker / static_cast<double>(after.size());
    }
    EXPECT_LT(rmse, 0.95);
    EXPECT_LT(flicker, 0.95);
    for (std::size_t k = 1; k < fitted.normal.size(); ++k) {
        for (std::size_t i = 0; i < fitted.normal[k].pixels.size(); i += 3) {
            const float* n = &fitted.normal[k].pixels[i];
            const glm::vec3 decoded(2.0f * n[0] - 1.0f, 2.0f * n[1] - 1.0f, 2.0f * n[2] - 1.0f);
            ASSERT_NEAR(glm::length(decoded), 1.0f, 1e-4f) << k;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Maps, ChainFit, testing::Bool(), [](const auto& which) {
    return which.param ? "SmoothnessGreenDown" : "RoughnessGreenUp";
});

class ChainFitOf : public testing::TestWithParam<SurfaceClass> {};

TEST_P(ChainFitOf, SameNumbersForAnyThreads)
{
    const ScoredMaps maps = cloth(48);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pixels());
    PrefilterOptions options{.rule = "picture", .quick = true, .surface = GetParam()};
    const Prefiltered start = prefilter_raw(maps.normal, maps.roughness, options);
    Prefiltered one = start, three = start;
    options.threads = 1;
    fit_chain(bench.levels(), options, one);
    options.threads = 3;
    fit_chain(bench.levels(), options, three);
    bool moved = false;
    for (std::size_t k = 1; k < one.roughness.size(); ++k) {
        EXPECT_EQ(one.roughness[k].pixels, three.roughness[k].pixels);
        EXPECT_EQ(one.normal[k].pixels, three.normal[k].pixels);
        moved |= one.normal[k].pixels != start.normal[k].pixels;
    }
    EXPECT_TRUE(moved);
}
INSTANTIATE_TEST_SUITE_P(Surfaces, ChainFitOf,
                         testing::Values(SurfaceClass::Both, SurfaceClass::Metal),
                         [](const auto& which) {
                             return which.param == SurfaceClass::Metal ? "Metal" : "Both";
                         });

// Metal is fitted twice: first to the mean of all pictures, then with those counted more that are worse
// than with plain mips. What the second gives is nearer to plain mips in the worst of them.
TEST(ChainFitRule, MetalIsFittedToTheMeanAndThenToTheWorst)
{
    const ScoredMaps maps = cloth(96);
    PictureOptions o = few_pixels();
    for (PictureLight& light : o.lights) light.sky = light.alpha > 0.0f ? 0.0f : 0.1f;
    o.cases = {{0, 0, true}, {0, 1, true}, {0, 2, true}};
    const PictureBench bench(maps.normal, maps.roughness, {}, o);
    PrefilterOptions options{.rule = "picture", .quick = true, .surface = SurfaceClass::Metal};
    const Prefiltered start = prefilter_raw(maps.normal, maps.roughness, options);
    Prefiltered fitted = start, bold;
    ASSERT_TRUE(fit_chain(bench.levels(), options, fitted, [&] { bold = fitted; }));
    const auto plain = bench.score({});
    const auto worst = [&](const Prefiltered& chain) {
        const auto scores = bench.score(chain);
        double most = -1.0;
        for (std::size_t i = 0; i < scores.size(); ++i)
            most = std::max(most, scores[i].rmse / plain[i].rmse - 1.0);
        return most;
    };
    EXPECT_LT(worst(fitted), worst(bold) - 0.01);
    options.surface = SurfaceClass::Paint;
    Prefiltered paint = start;
    EXPECT_TRUE(fit_chain(bench.levels(), options, paint, [] { FAIL() << "paint is fitted once"; }));
}

// Most of a floor is seen from low above it. One lobe, and metal, are fitted to all heights alike.
TEST(FitPixels, TwoLobesOnPaintAreSeenFromLowMoreOften)
{
    const ScoredMaps maps = cloth(48);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pixels());
    const auto low = [&](SurfaceClass surface, int lobes) {
        const PrefilterOptions options{.rule = "picture", .surface = surface, .lobes = lobes};
        const std::size_t enough = 400 * fit_layout(surface).pixels();
        const FitPool pool = draw_fit_pixels(bench.levels(), options, 1, 1, enough);
        EXPECT_EQ(pool.pixels.size(), pool.views.size() * fit_layout(surface).pixels());
        double count = 0.0;
        for (const FitView& view : pool.views) count += view.lights.eye[2] < std::sin(25.0f * 0.0174533f);
        return count / static_cast<double>(pool.views.size());
    };
    EXPECT_NEAR(low(SurfaceClass::Paint, 2), std::sqrt(16.0 / 51.0), 0.07);
    EXPECT_NEAR(low(SurfaceClass::Paint, 1), 16.0 / 51.0, 0.07);
    EXPECT_NEAR(low(SurfaceClass::Metal, 2), 16.0 / 51.0, 0.07);
}

// Tiles of two glosses, which no single lobe of a texel looks like.
TEST(ChainFitRule, TwoLobesShowTwoGlosses)
{
    std::vector<ScoredMaps> all = fresh_maps(96, 21);
    const auto maps = std::find_if(all.begin(), all.end(), [](const ScoredMaps& m) { return m.name.starts_with("glosses"); });
    ASSERT_NE(maps, all.end());
    PictureOptions paint = few_pixels();
    paint.cases.pop_back();  // metal
    const PictureBench bench(maps->normal, maps->roughness, {}, paint);
    PrefilterOptions options{.rule = "picture", .surface = SurfaceClass::Paint};
    const auto plain = bench.score({});
    const auto share = [&](const Prefiltered& chain) {
        double sum = 0.0;
        const auto scores = bench.score(chain);
        for (std::size_t i = 0; i < scores.size(); ++i)
            sum += scores[i].rmse / plain[i].rmse / static_cast<double>(scores.size());
        return sum;
    };
    const Prefiltered one = prefilter_raw(maps->normal, maps->roughness, options);
    options.lobes = 2;
    const Prefiltered two = prefilter_raw(maps->normal, maps->roughness, options);
    EXPECT_TRUE(one.second.share.empty());
    EXPECT_LT(share(two), share(one) - 0.2);
    for (std::size_t k = 1; k < two.second.share.size(); ++k) {
        EXPECT_EQ(two.second.share[k].pixels.size(), one.roughness[k].pixels.size());
        for (const float s : two.second.share[k].pixels) ASSERT_TRUE(s >= 0.0f && s <= 1.0f) << k;
    }
    options.threads = 3;
    const Prefiltered again = prefilter_raw(maps->normal, maps->roughness, options);
    for (std::size_t k = 1; k < two.second.share.size(); ++k) {
        EXPECT_EQ(again.second.normal[k].pixels, two.second.normal[k].pixels) << k;
        EXPECT_EQ(again.second.share[k].pixels, two.second.share[k].pixels) << k;
    }
    options.quick = true;
    EXPECT_THROW(prefilter_raw(maps->normal, maps->roughness, options), Error);
}

TEST(ChainFitRule, FullQualityHoldsStillerThanQuick)
{
    const ScoredMaps maps = cloth(96);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pixels());
    const auto flicker = [&](bool quick) {
        double sum = 0.0;
        for (const PictureScore& s : bench.score(
                 prefilter_raw(maps.normal, maps.roughness, {.rule = "picture", .quick = quick})))
            sum += s.flicker;
        return sum;
    };
    EXPECT_LT(flicker(false), 0.97 * flicker(true));
}

// What one lobe cannot do, wide ahead and narrow behind, the colour of metal helps with: no picture of
// metal gets worse, with the sun behind and a sky as little as ahead.
TEST(ChainFitRule, MetalIsNotWorseWithTheSunBehind)
{
    const ScoredMaps maps = cloth(96);
    PictureOptions o = few_pixels();
    for (PictureLight& light : o.lights) light.sky = light.alpha > 0.0f ? 0.0f : 0.1f;
    o.cases = {{0, 0, true}, {0, 1, true}, {0, 2, true}};
    const PictureBench bench(maps.normal, maps.roughness, {}, o);
    const auto plain = bench.score({});
    const auto worst = [&](bool quick) {
        PrefilterOptions options{.rule = "picture", .quick = quick, .surface = SurfaceClass::Metal};
        const Prefiltered chain = prefilter_raw(maps.normal, maps.roughness, options);
        EXPECT_EQ(chain.metal_share.empty(), quick);
        const auto scores = bench.score(chain);
        double most = -1.0;
        for (std::size_t i = 0; i < scores.size(); ++i)
            most = std::max(most, scores[i].rmse / plain[i].rmse - 1.0);
        return most;
    };
    EXPECT_LT(worst(false), 0.02);
    EXPECT_GT(worst(true), 0.02) << "or this shows nothing";
}

// Maps of paint have no share of metal; of both they do.
TEST(ChainFitRule, OnlyMetalHasAShareOfItsColour)
{
    const ScoredMaps maps = cloth(48);
    for (const SurfaceClass surface : {SurfaceClass::Paint, SurfaceClass::Both}) {
        const Prefiltered chain = prefilter_raw(maps.normal, maps.roughness,
                                                {.rule = "picture", .surface = surface});
        EXPECT_EQ(chain.metal_share.empty(), surface == SurfaceClass::Paint);
        for (const Image& level : chain.metal_share)
            for (const float share : level.pixels) EXPECT_TRUE(share >= 0.0f && share <= 1.0f);
    }
}

// Where normals are not written with it.
TEST(ChainFitRule, RoughnessAloneKeepsTheNormals)
{
    const ScoredMaps maps = cloth(48);
    const PictureBench bench(maps.normal, maps.roughness, {}, few_pixels());
    PrefilterOptions options{.rule = "picture", .joint = false, .quick = true};
    const Prefiltered start = prefilter_raw(maps.normal, maps.roughness, options);
    Prefiltered fitted = start;
    fit_chain(bench.levels(), options, fitted);
    bool moved = false;
    for (std::size_t k = 1; k < start.normal.size(); ++k) {
        EXPECT_EQ(fitted.normal[k].pixels, start.normal[k].pixels) << k;
        moved |= fitted.roughness[k].pixels != start.roughness[k].pixels;
    }
    EXPECT_TRUE(moved);
}

}  // namespace
}  // namespace petrichor::texproc
