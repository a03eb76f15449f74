#include "texproc/prefilter/detail/fit_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "texproc/prefilter/detail/fit_lights.h"

namespace petrichor::texproc::detail {

namespace {

constexpr FitLayout kOneView{1, 256, 120}, kManyViews{16, 32, 3200, 17.0f, 6.0f};
// Degrees down, where a picture looks: its middle, and any part of it.
constexpr float kLeastDown = 9.0f, kMostDown = 60.0f, kLowest = 7.0f;
constexpr int kSamples = 5;  // of the truth, along each side of a pixel

// Of one eye: how its pixels lie in texels of level 0.
struct Footprint {
    glm::vec2 across, along;  // the shorter and the longer axis
};

// Two lobes on anything but metal look down as guard_pictures() do, by little more often than by much: most
// of a floor is seen so, and pixels are long there, which a texel has to be told.
float down_of(const PrefilterOptions& options, FitDice& dice)
{
    if (options.lobes != 2 || options.surface == SurfaceClass::Metal) return dice(kLeastDown, kMostDown);
    const float lifted = dice(0.0f, 1.0f);
    return kLeastDown + (kMostDown - kLeastDown) * lifted * lifted;
}

// Truth of the pixels of a view.
void show(const Levels& plain, const PrefilterOptions& options, int places, const Footprint& footprint, FitView& view,
          FitPixel* pixels, FitDice& dice, float* light)
{
    const Level& base = plain.front();
    const glm::vec2 size(base.width, base.height);
    const glm::vec2 tap = footprint.along / (size * static_cast<float>(view.taps));
    view.step_u = tap.x, view.step_v = tap.y;
    constexpr int kCount = kSamples * kSamples;
    // The texels of a large map come from afar: those of the next moment are asked for before this one is lit.
    std::array<std::array<std::size_t, kCount>, 2> texels;
    std::array<float, kCount> nx, ny, nz, p;
    const auto lit = [&](std::size_t i) {
        for (std::size_t k = 0; k < kCount; ++k) {
            const Texel t = base.at(texels[i % 2][k]);
            nx[k] = t.n.x, ny[k] = t.n.y, nz[k] = t.n.z;
            p[k] = perceptual(t.stored, options);
        }
        chain_fit_kernel().mean_light(view.lights, nx.data(), ny.data(), nz.data(), p.data(), kCount,
                                      light + i * kFitLights);
    };
    for (int place = 0; place < places; ++place) {
        glm::vec2 at(dice(0.0f, size.x), dice(0.0f, size.y));
        const float angle = dice(0.0f, kFitTurn), far = dice(0.3f, 1.0f);
        const glm::vec2 move =
            far * (footprint.across * portable_cos(angle) + footprint.along * portable_sin(angle));
        for (std::size_t f = 0; f < kFitFrames; ++f, at += move) {
            const std::size_t i = static_cast<std::size_t>(place) * kFitFrames + f;
            const glm::vec2 uv = at / size;
            pixels[i].u = uv.x - std::floor(uv.x), pixels[i].v = uv.y - std::floor(uv.y);
            for (int s = 0; s < kCount; ++s) {
                const float a =
                    (static_cast<float>(s % kSamples) + dice(0.0f, 1.0f)) / kSamples - 0.5f;
                const float b =
                    (static_cast<float>(s / kSamples) + dice(0.0f, 1.0f)) / kSamples - 0.5f;
                const glm::vec2 q = (at + a * footprint.across + b * footprint.along) / size;
                std::size_t& texel = texels[i % 2][static_cast<std::size_t>(s)];
                texel = base.nearest_index(static_cast<double>(q.x), static_cast<double>(q.y));
                base.will_read(texel);
            }
            if (i > 0) lit(i - 1);
        }
    }
    lit(static_cast<std::size_t>(places) * kFitFrames - 1);
}

// Exposures of a picture, and what it shows then.
void expose(FitPool& pool, const FitPicture& picture, std::size_t pixels, const std::vector<float>& light)
{
    std::vector<float> sorted(light.size() / kFitLights);
    for (std::size_t l = 0; l < kFitLights; ++l) {
        for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = light[i * kFitLights + l];
        const auto at = [&](std::size_t rank) { return sorted.begin() + static_cast<std::ptrdiff_t>(rank); };
        const std::size_t half = sorted.size() / 2, most = sorted.size() * 97 / 100;
        std::nth_element(sorted.begin(), at(most), sorted.end());
        if (half < most) std::nth_element(sorted.begin(), at(half), at(most));
        const float middle = std::max(sorted[half], 1e-6f), bright = std::max(sorted[most], 1e-6f);
        const float exposure = std::min(0.18f / middle, 0.9f / bright);
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            const std::size_t v = picture.views[i / pixels];
            pool.views[v].exposure[l] = exposure;
            const float shown = std::sqrt(std::min(light[i * kFitLights + l] * exposure, 1.0f));
            pool.pixels[v * pixels + i % pixels].shown[l] =
                static_cast<std::uint16_t>(shown * 65535.0f + 0.5f);
        }
    }
}

}  // namespace

FitLayout fit_layout(SurfaceClass surface)
{
    return surface == SurfaceClass::Metal ? kManyViews : kOneView;
}

FitPool draw_fit_pixels(const Levels& plain, const PrefilterOptions& options, std::size_t number,
                        std::size_t fine, std::size_t enough)
{
    const FitLayout layout = fit_layout(options.surface);
    const std::size_t pixels = layout.pixels();
    FitPool pool;
    pool.fine = fine;
    pool.pictures.resize(std::max(enough / pixels, layout.least_views) / layout.views);
    pool.views.resize(pool.pictures.size() * layout.views);
    pool.pixels.resize(pool.views.size() * pixels);
    parallel_for(pool.pictures.size(), options.threads, [&](std::size_t which) {
        FitPicture& picture = pool.pictures[which];
        FitDice dice((static_cast<std::uint64_t>(number) << 32) + which);
        const float middle = dice(0.0f, kFitTurn), middle_down = down_of(options, dice);
        const FitDice of_lights = dice;  // the same for all its views
        FitLights past{};
        draw_fit_lights(dice, options.surface, middle, {}, past);
        constexpr float kOneTap = 0.15f;
        const bool one_tap = dice(0.0f, 1.0f) < kOneTap;
        std::vector<float> light(layout.views * pixels * kFitLights);
        for (std::size_t i = 0; i < layout.views; ++i) {
            // Far apart: a step of the fit takes views that follow each other.
            const std::size_t v = which + i * pool.pictures.size();
            picture.views.push_back(v);
            FitView& view = pool.views[v];
            float azimuth = middle, down = middle_down;
            if (layout.views > 1) {
                azimuth += kFitDegree * dice(-layout.wide, layout.wide);
                down = std::max(down + dice(-layout.tall, layout.tall), kLowest);
            }
            down *= kFitDegree;
            const glm::vec2 ahead(portable_cos(azimuth), portable_sin(azimuth));
            const glm::vec3 eye(-ahead * portable_cos(down), portable_sin(down));
            FitDice lights = of_lights;
            draw_fit_lights(lights, options.surface, middle, eye, view.lights);
            const float longer = 1.0f / portable_sin(down);  // than across
            view.taps = one_tap ? 1 : static_cast<int>(std::ceil(longer));
            view.share = dice(0.0f, 1.0f);
            const float across =
                std::ldexp(portable_exp(view.share * 0.693147181f), static_cast<int>(pool.fine)) *
                static_cast<float>(view.taps) / longer;
            show(plain, options, layout.places, {glm::vec2(-ahead.y, ahead.x) * across, ahead * (across * longer)}, view,
                 &pool.pixels[v * pixels], dice, &light[i * pixels * kFitLights]);
        }
        expose(pool, picture, pixels, light);
    });
    return pool;
}

}  // namespace petrichor::texproc::detail
