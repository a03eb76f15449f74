#include "texproc/prefilter/detail/chain_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "texproc/prefilter/detail/chain_fit_kernel.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kMostTexels = 256 * 256;
constexpr int kLeastSide = 8;
// Of a level: pixels drawn for each texel, views at least, passes over them, steps of a pass.
constexpr std::size_t kPixelsPerTexel = 30, kLeastViews = 120, kPasses = 2, kSteps = 250;
constexpr int kPlaces = 256;       // of a view, each seen kFitFrames times
constexpr int kSamples = 5;        // of the truth, along each side of a pixel
constexpr std::size_t kSlots = 4;  // slopes are summed apart: the sums do not depend on threads
constexpr float kFirstRate = 0.003f, kLastRate = 0.00003f;
constexpr float kFlicker =
    0.5f;  // what changes between two moments counts so much beside all of the error
constexpr float kKeep = 0.9f, kKeepSquare = 0.99f;  // of Adam (Kingma & Ba 2015)
constexpr float kNothing2 = 3e-6f;                  // a mean square of errors that nobody sees
constexpr float kWorseMetal = 2.0f;
constexpr float kDegree = 0.0174532925f, kTurn = 6.28318531f;

class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    std::uint32_t whole()  // SplitMix64
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
    }
    float operator()(float low, float high)
    {
        return low + (high - low) * static_cast<float>(whole() >> 8) * (1.0f / 16777216.0f);
    }
    float gaussian()
    {
        const float radius = std::sqrt(-2.0f * portable_log((*this)(1e-7f, 1.0f)));
        return radius * portable_cos((*this)(0.0f, kTurn));
    }

private:
    std::uint64_t state_;
};

glm::vec3 direction(float azimuth, float height)
{
    const float flat = portable_cos(height);
    return {portable_cos(azimuth) * flat, portable_sin(azimuth) * flat, portable_sin(height)};
}

// What a light of a view is drawn from (docs/textures.md, 7): the stated distribution of lights.
enum class Around { Ahead, High, Beside, Behind, Anywhere, Window, Sky };
void draw_light(Dice& dice, Around around, bool metal, float azimuth, const glm::vec3& eye,
                std::size_t i, FitLights& to)
{
    float low = 20.0f, high = 65.0f, turned = 0.0f;
    constexpr float kAhead = 0.45f;  // radians, of a Gaussian: highlights are ahead, so most are
    if (around == Around::Beside) {
        const float side = dice(-1.0f, 1.0f) < 0.0f ? -1.0f : 1.0f;
        turned = side * dice(0.6f, 1.8f);
    } else if (around == Around::Behind) {
        turned = 0.5f * kTurn + dice(-1.0f, 1.0f);
    } else if (around == Around::Anywhere) {
        turned = dice(0.0f, kTurn);
    } else {
        turned = kAhead * dice.gaussian();
        low = around == Around::High ? 30.0f : 12.0f;
        high = around == Around::High ? 70.0f : 45.0f;
    }
    const glm::vec3 l = direction(azimuth + turned, kDegree * dice(low, high));
    const glm::vec3 h = glm::normalize(l + eye);
    to.lx[i] = l.x, to.ly[i] = l.y, to.lz[i] = l.z;
    to.hx[i] = h.x, to.hy[i] = h.y, to.hz[i] = h.z;
    const float m = 1.0f - std::clamp(glm::dot(l, h), 0.0f, 1.0f), m2 = m * m, rim = m2 * m2 * m;
    const float sun = around == Around::Sky ? 0.0f : 1.0f;
    const float paint = kPaintF0 + (1.0f - kPaintF0) * rim;
    to.fresnel[i] = sun * (metal ? rim : paint);
    to.fresnel_metal[i] = metal ? sun * kMetalF0 * (1.0f - rim) : 0.0f;
    to.albedo[i] = metal ? 0.0f : sun * (1.0f - paint) * kPaintAlbedo * (1.0f / shared::kPi);
    const float window = dice(0.08f, 0.14f);
    to.alpha2[i] = around == Around::Window ? window * window : 0.0f;
    // Beside half of the suns the sky gives a tenth to a third of the light; beside all that metal is
    // not ahead of, since it would be black without.
    const bool needs_sky =
        metal && (around == Around::Beside || around == Around::Behind || around == Around::Anywhere);
    const bool has_sky = needs_sky || dice(0.0f, 1.0f) < 0.5f;
    const float beside = has_sky ? dice(0.05f, 0.2f) : 0.0f;
    to.sky[i] = around == Around::Sky ? 1.0f : around == Around::Window ? 0.0f : beside;
    to.f0[i] = metal ? 0.0f : kPaintF0;
    to.f0_metal[i] = metal ? kMetalF0 : 0.0f;
    to.sky_albedo[i] = metal ? 0.0f : kPaintAlbedo * (1.0f - kPaintF0);
}

// The eight of a view; of both classes, five on paint and three on metal.
void draw_lights(Dice& dice, SurfaceClass surface, float azimuth, const glm::vec3& eye, FitLights& to)
{
    using enum Around;
    for (int c = 0; c < 3; ++c) to.eye[c] = eye[c];
    std::size_t number = 0;
    const auto add = [&](bool metal, std::initializer_list<Around> one_of) {
        const Around around = *(one_of.begin() + dice.whole() % one_of.size());
        draw_light(dice, around, metal, azimuth, eye, number++, to);
    };
    if (surface == SurfaceClass::Both) {
        add(false, {Ahead});
        add(false, {Ahead, High});
        add(false, {Beside});
        add(false, {Behind});
        add(false, {Window, Window, Sky, Anywhere});
        add(true, {Ahead});
        add(true, {Ahead, High, Beside, Sky});
        add(true, {Beside, Behind, Behind, Anywhere});
        return;
    }
    const bool metal = surface == SurfaceClass::Metal;
    for (const Around around : {Ahead, Ahead, High, Beside, Behind, Window}) add(metal, {around});
    add(metal, {Anywhere, Ahead});
    add(metal, {Sky, Behind});
}

// Of one eye: how its pixels lie in texels of level 0.
struct Footprint {
    glm::vec2 across, along;  // the shorter and the longer axis
};

// Pixels whose finer level is the same.
struct Pool {
    std::size_t fine = 0;
    std::vector<FitView> views;
    std::vector<FitPixel> pixels;  // kPlaces times kFitFrames a view
};
constexpr std::size_t kPixels = static_cast<std::size_t>(kPlaces) * kFitFrames;

class ChainFit {
public:
    ChainFit(const Levels& plain, const PrefilterOptions& options, const Prefiltered& chain);
    bool worth() const { return last_ >= first_ && seen_; }
    void fit();
    void store(Prefiltered& chain) const;

private:
    FitLevel level(std::size_t k, FitSlope* slopes) const
    {
        return {plain_[k].width, plain_[k].height, texels_[k].data(),
                k < first_ || k > last_ ? nullptr : slopes};
    }
    void draw(Pool& pool, std::size_t number);
    bool show(const Footprint& footprint, std::size_t fine, FitView& view, FitPixel* pixels,
              Dice& dice) const;
    void step(const Pool& pool, const std::vector<std::size_t>& views, float rate);
    void move(std::size_t k, std::size_t slot_offset, std::size_t pixels, float rate);

    const Levels& plain_;
    const PrefilterOptions& options_;
    FitMeaning meaning_;
    std::vector<std::vector<FitTexel>> texels_, plain_texels_;
    std::size_t first_ = 1, last_ = 0;  // levels that are fitted
    std::vector<Pool> pools_;
    bool seen_ = false;  // plain mips are off somewhere
    const bool colors_metal_;
    // Of Adam: means of slopes and of their squares, and steps, of a level.
    std::vector<std::vector<FitSlope>> mean_;
    std::vector<std::vector<FitSlope>> square_;
    std::vector<int> steps_;
    std::array<std::vector<FitSlope>, kSlots> slopes_;
};

ChainFit::ChainFit(const Levels& plain, const PrefilterOptions& options, const Prefiltered& chain)
    : plain_(plain),
      options_(options),
      meaning_{options.smoothness, options.alpha},
      texels_(plain.size()),
      plain_texels_(plain.size()),
      colors_metal_(!chain.metal_share.empty()),
      mean_(plain.size()),
      square_(plain.size()),
      steps_(plain.size(), 0)
{
    const auto count = [&](std::size_t k) {
        return static_cast<std::size_t>(plain[k].width) * static_cast<std::size_t>(plain[k].height);
    };
    while (first_ < plain.size() && count(first_) > kMostTexels) ++first_;
    for (std::size_t k = first_; k < plain.size(); ++k)
        if (std::min(plain[k].width, plain[k].height) >= kLeastSide) last_ = k;
    if (last_ < first_) return;
    // The level above the finest of them is blended with it, and one below the coarsest.
    for (std::size_t k = first_ - 1; k <= std::min(last_ + 1, plain.size() - 1); ++k) {
        texels_[k].resize(count(k));
        plain_texels_[k].resize(count(k));
        for (std::size_t i = 0; i < texels_[k].size(); ++i) {
            const Texel t = plain[k].at(i);
            FitTexel& to = texels_[k][i];
            to = {{t.n.x, t.n.y, t.n.z}, t.stored, 1.0f, 1.0f, {}};
            plain_texels_[k][i] = to;
            if (k == 0) continue;
            to.stored = chain.roughness[k].pixels[i];
            if (k < chain.base_share.size()) to.share = chain.base_share[k].pixels[i];
            if (k < chain.metal_share.size()) to.metal = chain.metal_share[k].pixels[i];
        }
        mean_[k].resize(k ? count(k) : 0);
        square_[k].resize(k ? count(k) : 0);
    }
    pools_.resize(last_ - first_ + 2);
    for (std::size_t i = 0; i < pools_.size(); ++i) draw(pools_[i], i);
}

void ChainFit::draw(Pool& pool, std::size_t number)
{
    pool.fine = first_ - 1 + number;
    // As many as the finest fitted level of the two has texels.
    const Level& size = plain_[std::max(pool.fine, first_)];
    const std::size_t texels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    const std::size_t share = pool.fine < first_ ? 2 : 1;
    const std::size_t views =
        std::max<std::size_t>(texels * kPixelsPerTexel / (share * kPixels), kLeastViews);
    pool.views.resize(views);
    pool.pixels.resize(views * kPixels);
    std::vector<char> off(views, 0);
    parallel_for(views, options_.threads, [&](std::size_t v) {
        Dice dice((static_cast<std::uint64_t>(number) << 32) + v);
        FitView& view = pool.views[v];
        const float azimuth = dice(0.0f, kTurn), down = kDegree * dice(9.0f, 60.0f);
        const glm::vec2 ahead(portable_cos(azimuth), portable_sin(azimuth));
        const glm::vec3 eye(-ahead * portable_cos(down), portable_sin(down));
        draw_lights(dice, options_.surface, azimuth, eye, view.lights);
        const float longer = 1.0f / portable_sin(down);  // than across
        constexpr float kOneTap = 0.15f;
        view.taps = dice(0.0f, 1.0f) < kOneTap ? 1 : static_cast<int>(std::ceil(longer));
        view.share = dice(0.0f, 1.0f);
        const float across =
            std::ldexp(portable_exp(view.share * 0.693147181f), static_cast<int>(pool.fine)) *
            static_cast<float>(view.taps) / longer;
        const Footprint footprint{glm::vec2(-ahead.y, ahead.x) * across, ahead * (across * longer)};
        FitPixel* pixels = &pool.pixels[v * kPixels];
        off[v] = show(footprint, pool.fine, view, pixels, dice);
    });
    seen_ |= std::find(off.begin(), off.end(), 1) != off.end();
}

// Truth of the pixels of a view, its exposures and weights; whether plain mips are off.
bool ChainFit::show(const Footprint& footprint, std::size_t fine, FitView& view, FitPixel* pixels,
                    Dice& dice) const
{
    const ChainFitKernel& kernel = chain_fit_kernel();
    const Level& base = plain_.front();
    const glm::vec2 size(base.width, base.height);
    const glm::vec2 tap = footprint.along / (size * static_cast<float>(view.taps));
    view.step_u = tap.x, view.step_v = tap.y;
    constexpr int kCount = kSamples * kSamples;
    std::array<float, kCount> nx, ny, nz, p;
    std::vector<float> light(kPixels * kFitLights);
    for (int place = 0; place < kPlaces; ++place) {
        glm::vec2 at(dice(0.0f, size.x), dice(0.0f, size.y));
        const float angle = dice(0.0f, kTurn), far = dice(0.3f, 1.0f);
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
                const Texel t = base.nearest(static_cast<double>(q.x), static_cast<double>(q.y));
                const std::size_t k = static_cast<std::size_t>(s);
                nx[k] = t.n.x, ny[k] = t.n.y, nz[k] = t.n.z;
                p[k] = perceptual(t.stored, options_);
            }
            kernel.mean_light(view.lights, nx.data(), ny.data(), nz.data(), p.data(), kCount,
                              &light[i * kFitLights]);
        }
    }
    std::vector<float> sorted(kPixels);
    for (std::size_t l = 0; l < kFitLights; ++l) {
        for (std::size_t i = 0; i < kPixels; ++i) sorted[i] = light[i * kFitLights + l];
        std::sort(sorted.begin(), sorted.end());
        const float middle = std::max(sorted[kPixels / 2], 1e-6f);
        const float bright = std::max(sorted[kPixels * 97 / 100], 1e-6f);
        view.exposure[l] = std::min(0.18f / middle, 0.9f / bright);
        for (std::size_t i = 0; i < kPixels; ++i) {
            const float shown =
                std::sqrt(std::min(light[i * kFitLights + l] * view.exposure[l], 1.0f));
            pixels[i].shown[l] = static_cast<std::uint16_t>(shown * 65535.0f + 0.5f);
        }
    }
    // Errors count relative to those of plain mips: the slope of their ratio, not of its square, so
    // that a light in which little is left to gain is not given up for one in which much is lost.
    struct Sums {
        float squares = 0.0f, changes = 0.0f;
    };
    const auto sums_of = [&](const std::vector<std::vector<FitTexel>>& of) {
        const auto at = [&](std::size_t k) {
            return FitLevel{plain_[k].width, plain_[k].height, of[k].data(), nullptr};
        };
        kernel.seen(view, meaning_, at(fine), at(std::min(fine + 1, plain_.size() - 1)), pixels,
                    static_cast<int>(kPixels), light.data());
        std::array<Sums, kFitLights> sums{};
        for (std::size_t i = 0; i < kPixels; i += kFitFrames) {
            for (std::size_t l = 0; l < kFitLights; ++l) {
                float sum = 0.0f, squares = 0.0f;
                for (std::size_t f = i; f < i + kFitFrames; ++f) {
                    const float error = std::sqrt(std::min(light[f * kFitLights + l], 1.0f)) -
                                        static_cast<float>(pixels[f].shown[l]) * (1.0f / 65535.0f);
                    sum += error;
                    squares += error * error;
                }
                sums[l].squares += squares;
                sums[l].changes += std::max(squares - sum * sum * (1.0f / kFitFrames), 0.0f);
            }
        }
        for (Sums& sum : sums) {
            sum.squares = sum.squares / static_cast<float>(kPixels) + kNothing2;
            sum.changes = sum.changes / static_cast<float>(kPixels) + kNothing2;
        }
        return sums;
    };
    const std::array<Sums, kFitLights> plain = sums_of(plain_texels_), now = sums_of(texels_);
    bool off = false;
    for (std::size_t l = 0; l < kFitLights; ++l) {
        view.weight[l] = 1.0f / std::sqrt(plain[l].squares * now[l].squares);
        // One lobe cannot be wide enough ahead and narrow enough behind: what step 2 made worse on metal
        // comes first.
        if (view.lights.f0_metal[l] > 0.0f && now[l].squares > plain[l].squares)
            view.weight[l] *= kWorseMetal;
        view.flicker[l] = kFlicker / std::sqrt(plain[l].changes * now[l].changes);
        off |= plain[l].squares > 2.0f * kNothing2;
    }
    return off;
}

void ChainFit::move(std::size_t k, std::size_t slot_offset, std::size_t pixels, float rate)
{
    if (k < first_ || k > last_) return;
    ++steps_[k];
    const float n = static_cast<float>(steps_[k]);
    const float full = 1.0f - portable_pow(kKeep, n),
                full_square = 1.0f - portable_pow(kKeepSquare, n);
    const float scale = static_cast<float>(texels_[k].size()) / static_cast<float>(pixels);
    constexpr std::size_t kBlock = 4096;
    parallel_for(
        (texels_[k].size() + kBlock - 1) / kBlock, options_.threads, [&](std::size_t block) {
            const std::size_t end = std::min((block + 1) * kBlock, texels_[k].size());
            for (std::size_t i = block * kBlock; i < end; ++i) {
                float slope[5] = {};
                for (std::vector<FitSlope>& slot : slopes_) {
                    FitSlope& s = slot[slot_offset + i];
                    for (int c = 0; c < 3; ++c) slope[c] += s.n[c];
                    slope[3] += s.stored, slope[4] += s.metal;
                    s = {};
                }
                FitSlope &mean = mean_[k][i], &square = square_[k][i];
                FitTexel& t = texels_[k][i];
                const auto moved = [&](float at, float g, float& m, float& s) {
                    g *= scale;
                    m = kKeep * m + (1.0f - kKeep) * g;
                    s = kKeepSquare * s + (1.0f - kKeepSquare) * g * g;
                    return at - rate * (m / full) / (std::sqrt(s / full_square) + 1e-3f);
                };
                t.stored =
                    std::clamp(moved(t.stored, slope[3], mean.stored, square.stored), 0.0f, 1.0f);
                if (!options_.joint) continue;
                if (colors_metal_)
                    t.metal = std::clamp(
                        moved(t.metal, slope[4], mean.metal, square.metal), 0.0f, 1.0f);
                float square_length = 0.0f;
                for (int c = 0; c < 3; ++c) {
                    t.n[c] = moved(t.n[c], slope[c], mean.n[c], square.n[c]);
                    square_length += t.n[c] * t.n[c];
                }
                const float length = std::sqrt(std::max(square_length, 1e-12f));
                for (float& n_c : t.n) n_c /= length;
            }
        });
}

void ChainFit::step(const Pool& pool, const std::vector<std::size_t>& views, float rate)
{
    const std::size_t coarse = std::min(pool.fine + 1, plain_.size() - 1);
    const std::size_t offset = pool.fine < first_ ? 0 : texels_[pool.fine].size();
    parallel_for(std::min(kSlots, views.size()), options_.threads, [&](std::size_t slot) {
        FitSlope* const to = slopes_[slot].data();
        for (std::size_t i = slot; i < views.size(); i += kSlots)
            chain_fit_kernel().add_slopes(
                pool.views[views[i]], meaning_, level(pool.fine, to), level(coarse, to + offset),
                &pool.pixels[views[i] * kPixels], static_cast<int>(kPixels));
    });
    move(pool.fine, 0, views.size() * kPixels, rate);
    if (coarse != pool.fine) move(coarse, offset, views.size() * kPixels, rate);
}

void ChainFit::fit()
{
    std::size_t most = 0;
    for (std::size_t k = first_; k <= last_; ++k)
        most = std::max(most, texels_[k].size() + (k < last_ ? texels_[k + 1].size() : 0));
    for (std::vector<FitSlope>& slot : slopes_) slot.assign(most, {});
    // All steps of a pass in one order: levels by turns.
    struct Step {
        std::size_t pool, first, count;
    };
    std::vector<Step> steps;
    for (std::size_t i = 0; i < pools_.size(); ++i) {
        const std::size_t views = pools_[i].views.size(),
                          batch = std::max<std::size_t>(views / kSteps, 1);
        for (std::size_t v = 0; v < views; v += batch)
            steps.push_back({i, v, std::min(batch, views - v)});
    }
    Dice dice(7);
    const auto shuffle = [&](auto& all) {
        for (std::size_t i = all.size(); i-- > 1;) std::swap(all[i], all[dice.whole() % (i + 1)]);
    };
    std::vector<std::size_t> views;
    const std::size_t total = steps.size() * kPasses;
    for (std::size_t pass = 0, done = 0; pass < kPasses; ++pass) {
        shuffle(steps);
        for (const Step& s : steps) {
            views.resize(s.count);
            for (std::size_t i = 0; i < s.count; ++i) views[i] = s.first + i;
            const float share = static_cast<float>(done++) / static_cast<float>(total);
            step(pools_[s.pool], views, kFirstRate + (kLastRate - kFirstRate) * share);
        }
    }
}

void ChainFit::store(Prefiltered& chain) const
{
    for (std::size_t k = first_; k <= last_; ++k) {
        for (std::size_t i = 0; i < texels_[k].size(); ++i) {
            const FitTexel& t = texels_[k][i];
            chain.roughness[k].pixels[i] = t.stored;
            if (!options_.joint) continue;
            if (colors_metal_) chain.metal_share[k].pixels[i] = t.metal;
            float* n = &chain.normal[k].pixels[3 * i];
            n[0] = 0.5f + 0.5f * t.n[0];
            n[1] = 0.5f + 0.5f * (options_.green_down ? -t.n[1] : t.n[1]);
            n[2] = 0.5f + 0.5f * t.n[2];
        }
    }
}

}  // namespace

bool is_fitted(int width, int height)
{
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) <= kMostTexels &&
           std::min(width, height) >= kLeastSide;
}

void fit_chain(const Levels& plain, const PrefilterOptions& options, Prefiltered& chain)
{
    ChainFit fit(plain, options, chain);
    if (!fit.worth()) return;
    fit.fit();
    fit.store(chain);
}

}  // namespace petrichor::texproc::detail
