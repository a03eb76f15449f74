#include "texproc/prefilter/picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "formulas/light/brdf.h"
#include "texproc/filter/area.h"
#include "texproc/prefilter/detail/floor_plan.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/prefilter/detail/map_surface.h"

namespace petrichor::texproc {

namespace {

using detail::FloorPixel;
using detail::FloorPlan;
using shared::ggx_distribution;
using shared::ggx_visibility;
using shared::kPi;

constexpr float kPaintAlbedo = 0.3f, kPaintF0 = 0.04f, kMetalF0 = 0.9f;
constexpr float kNarrowestAlpha = 0.002f;

struct Texel {
    glm::vec3 n{0.0f, 0.0f, 1.0f};
    float stored = 0.0f;   // roughness as the map holds it
    float diffuse = 1.0f;  // share of the base colour
};

// A texel of level 0, of which there are many.
struct SmallTexel {
    std::int16_t n[3];
    std::uint16_t stored;
};
SmallTexel to_small(const glm::vec3& n, float stored)
{
    const auto code = [](float v, float most) {
        return std::floor(std::clamp(v, -1.0f, 1.0f) * most + 0.5f);
    };
    SmallTexel to{};
    for (int c = 0; c < 3; ++c) to.n[c] = static_cast<std::int16_t>(code(n[c], 32767.0f));
    to.stored = static_cast<std::uint16_t>(code(std::max(stored, 0.0f), 65535.0f));
    return to;
}

// The four texels about a point of a map that repeats, with their weights.
template <class Take>
void bilinear(int width, int height, double u, double v, float weight, const Take& take)
{
    const double x = (u - std::floor(u)) * width - 0.5, y = (v - std::floor(v)) * height - 0.5;
    const double fx = std::floor(x), fy = std::floor(y);
    const float tx = static_cast<float>(x - fx), ty = static_cast<float>(y - fy);
    const auto wrapped = [](double at, int n) {
        const int i = static_cast<int>(at);
        return static_cast<std::size_t>(i < 0 ? i + n : i >= n ? i - n : i);
    };
    const std::size_t x0 = wrapped(fx, width), x1 = wrapped(fx + 1.0, width);
    const std::size_t y0 = wrapped(fy, height) * static_cast<std::size_t>(width);
    const std::size_t y1 = wrapped(fy + 1.0, height) * static_cast<std::size_t>(width);
    take(y0 + x0, weight * (1.0f - tx) * (1.0f - ty));
    take(y0 + x1, weight * tx * (1.0f - ty));
    take(y1 + x0, weight * (1.0f - tx) * ty);
    take(y1 + x1, weight * tx * ty);
}

struct Level {
    int width = 0, height = 0;
    std::vector<Texel> texels;
    std::vector<SmallTexel> small{};  // instead of texels

    Texel at(std::size_t i) const
    {
        if (small.empty()) return texels[i];
        const SmallTexel& t = small[i];
        constexpr float kUnit = 1.0f / 32767.0f;
        return {glm::vec3(t.n[0], t.n[1], t.n[2]) * kUnit,
                static_cast<float>(t.stored) * (1.0f / 65535.0f), 1.0f};
    }
    Texel nearest(double u, double v) const
    {
        const auto place = [](double x, int n) {
            const int i = static_cast<int>((x - std::floor(x)) * n);
            return std::min(i, n - 1);
        };
        return at(static_cast<std::size_t>(place(v, height)) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(place(u, width)));
    }
    // Bilinear, wrapped; added with a weight.
    void add_to(Texel& sum, double u, double v, float weight) const
    {
        bilinear(width, height, u, v, weight, [&](std::size_t i, float w) {
            const Texel t = at(i);
            sum.n += t.n * w;
            sum.stored += t.stored * w;
            sum.diffuse += t.diffuse * w;
        });
    }
};
using Levels = std::vector<Level>;

struct Light {
    glm::vec3 to_light;
    float alpha2, sun, sky;
    bool metal;
};

float shown(float radiance, float exposure)
{
    return std::pow(std::clamp(radiance * exposure, 0.0f, 1.0f), 1.0f / 2.2f);
}

// A gradient sky over dark ground, blurred by the width of what looks at it.
float sky_radiance(float up, float width)
{
    const float w = 0.05f + width;
    const float t = std::clamp((up + w) / (2.0f * w), 0.0f, 1.0f);
    return 0.12f + t * t * (3.0f - 2.0f * t) * (0.88f - 0.5f * std::max(up, 0.0f));
}

// Radiance towards the eye. Paint: Lambert below the highlight; metal: the highlight alone.
float shade(const glm::vec3& n, float p, float share, const glm::vec3& to_eye, const Light& light)
{
    const float own = std::max(p * p, kNarrowestAlpha);
    const float f0 = light.metal ? kMetalF0 : kPaintF0;
    const float albedo = light.metal ? 0.0f : kPaintAlbedo * share;
    float seen = 0.0f;
    if (light.sky > 0.0f) {
        const float nv = std::clamp(std::abs(glm::dot(n, to_eye)), 1e-4f, 1.0f);
        const glm::vec3 mirror = 2.0f * glm::dot(n, to_eye) * n - to_eye;
        // Schlick with the rim taken back by roughness, as image-based lighting does.
        const float rim = std::pow(1.0f - nv, 5.0f);
        const float fresnel = f0 + (std::max(1.0f - p, f0) - f0) * rim;
        const float diffuse = 0.12f + 0.5f * (1.0f + n.z) * 0.45f;
        seen = light.sky * (fresnel * sky_radiance(mirror.z, own) + albedo * (1.0f - f0) * diffuse);
    }
    const float alpha = std::sqrt(own * own + light.alpha2);
    const float nl = glm::dot(n, light.to_light);
    if (nl <= 0.0f || light.sun <= 0.0f) return seen;
    const float nv = std::clamp(std::abs(glm::dot(n, to_eye)), 1e-4f, 1.0f);
    const glm::vec3 h = glm::normalize(light.to_light + to_eye);
    const float nh = std::clamp(glm::dot(n, h), 0.0f, 1.0f);
    const float lh = std::clamp(glm::dot(light.to_light, h), 0.0f, 1.0f);
    const float m = 1.0f - lh, m2 = m * m;
    const float fresnel = f0 + (1.0f - f0) * (m2 * m2 * m);
    return seen + light.sun * nl *
                      (fresnel * ggx_distribution(nh, alpha) * ggx_visibility(nl, nv, alpha) +
                       (1.0f - fresnel) * albedo * (1.0f / kPi));
}

float perceptual(float stored, const PrefilterOptions& input)
{
    float p = input.smoothness ? 1.0f - stored : stored;
    if (input.alpha) p = std::sqrt(std::max(p, 0.0f));
    return std::clamp(p, 0.0f, 1.0f);
}

float stored_value(float p, const PrefilterOptions& input)
{
    const float v = input.alpha ? p * p : p;
    return input.smoothness ? 1.0f - v : v;
}

// The plain mips: mean normals of unit length, mean of the roughness as stored.
Levels plain_levels(Level base)
{
    Levels levels;
    levels.push_back(std::move(base));
    const Level& first = levels.front();
    const std::vector<LevelSize> sizes = level_sizes(first.width, first.height);
    for (std::size_t k = 1; k < sizes.size(); ++k)
        levels.push_back({sizes[k].width, sizes[k].height,
                          std::vector<Texel>(static_cast<std::size_t>(sizes[k].width) *
                                             static_cast<std::size_t>(sizes[k].height))});
    for (int c = 0; c < 4; ++c) {  // one at a time: a large map is large
        Image plane(levels[0].width, levels[0].height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < plane.pixels.size(); ++i) {
            const Texel t = levels[0].at(i);
            plane.pixels[i] = c < 3 ? t.n[c] : t.stored;
        }
        const std::vector<Image> smaller = area_levels(plane);
        for (std::size_t k = 1; k < levels.size(); ++k)
            for (std::size_t i = 0; i < levels[k].texels.size(); ++i) {
                Texel& t = levels[k].texels[i];
                (c < 3 ? t.n[c] : t.stored) = smaller[k - 1].pixels[i];
            }
    }
    for (std::size_t k = 1; k < levels.size(); ++k) {
        for (Texel& t : levels[k].texels) {
            const float length = glm::length(t.n);
            t.n = length > 0.0f ? t.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
        }
    }
    return levels;
}

// The trilinear samples along the longer axis of a pixel's footprint.
struct Taps {
    int count = 1;
    double u = 0.0, v = 0.0, step_u = 0.0, step_v = 0.0;  // the first, and from one to the next
    std::size_t fine = 0, coarse = 0;
    float share = 0.0f;  // of the coarse level

    // Of one of the two levels, with its share.
    void add_to(Texel& sum, const Level& level, float of_level) const
    {
        for (int i = 0; i < count; ++i)
            level.add_to(sum, u + i * step_u, v + i * step_v, of_level / static_cast<float>(count));
    }
};
Taps taps_of(const Levels& levels, const FloorPixel& pixel, int most_taps)
{
    const Level& base = levels.front();
    const double ax = pixel.across_u * base.width, ay = pixel.across_v * base.height;
    const double bx = pixel.along_u * base.width, by = pixel.along_v * base.height;
    double longer = std::hypot(ax, ay), shorter = std::hypot(bx, by);
    double du = pixel.across_u, dv = pixel.across_v;
    if (shorter > longer) {
        std::swap(longer, shorter);
        du = pixel.along_u, dv = pixel.along_v;
    }
    const int taps =
        std::clamp(static_cast<int>(std::ceil(longer / std::max(shorter, 1e-9))), 1, most_taps);
    const double top = static_cast<double>(levels.size() - 1);
    const double lod = std::clamp(std::log2(std::max(longer / taps, 1e-9)), 0.0, top);
    Taps to;
    to.count = taps;
    to.step_u = du / taps, to.step_v = dv / taps;
    to.u = pixel.u + (0.5 / taps - 0.5) * du, to.v = pixel.v + (0.5 / taps - 0.5) * dv;
    to.fine = std::min(static_cast<std::size_t>(lod), levels.size() - 1);
    to.coarse = std::min(to.fine + 1, levels.size() - 1);
    to.share = static_cast<float>(lod - static_cast<double>(to.fine));
    return to;
}

// What one shading of a pixel sees.
Texel filtered(const std::vector<const Level*>& levels, const Taps& taps)
{
    Texel sum{glm::vec3(0.0f), 0.0f, 0.0f};
    taps.add_to(sum, *levels[taps.fine], 1.0f - taps.share);
    if (taps.share > 0.0f) taps.add_to(sum, *levels[taps.coarse], taps.share);
    const float length = glm::length(sum.n);
    sum.n = length > 0.0f ? sum.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return sum;
}

void check_level(const Image& given, const Level& plain, std::size_t k)
{
    if (given.width == plain.width && given.height == plain.height) return;
    throw Error("score: level " + std::to_string(k) + " is " + std::to_string(given.width) + " x " +
                    std::to_string(given.height) + ", expected " + std::to_string(plain.width) +
                    " x " + std::to_string(plain.height),
                "Give the chain of the same maps.");
}

// Of a row of pixels: squares of the errors, and deviations in time.
struct RowSums {
    double squares = 0.0, deviation = 0.0;
};

}  // namespace

struct PictureBench::State {
    PictureOptions options;
    PrefilterOptions input;
    Levels plain;                           // level 0 is that of the material
    std::vector<Light> lights;              // of the cases
    std::vector<float> exposure;            // of the cases
    std::vector<std::vector<float>> truth;  // of the cases: frame by frame, row by row

    std::size_t pixels(std::size_t which) const
    {
        const PictureView& view = view_of(which);
        return static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.rows);
    }
    const PictureView& view_of(std::size_t which) const
    {
        return options.views[static_cast<std::size_t>(options.cases[which].view)];
    }
    std::vector<std::size_t> cases_of(std::size_t view) const
    {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < options.cases.size(); ++c)
            if (options.cases[c].view == static_cast<int>(view)) found.push_back(c);
        return found;
    }
    void render_truth();
    std::vector<Level> levels_of(const Prefiltered& chain) const;
    std::vector<const Level*> merged(const std::vector<Level>& own) const;
    // Adds up one row of pixels: shade(frame, to) gives the radiance of every case.
    template <class Shade>
    void sum_row(std::size_t view, int y, const std::vector<std::size_t>& cases, const Shade& shade,
                 std::vector<RowSums>& to) const;
    // The scores of cases that share a view, from the sums of its rows in their order.
    void add_up(std::size_t view, const std::vector<std::size_t>& cases,
                const std::vector<std::vector<RowSums>>& rows,
                std::vector<PictureScore>& scores) const;
    // Radiance of cases that share a view, one row of one frame; to[case][pixel].
    void shade_row(const std::vector<const Level*>& levels, const FloorPlan& plan, int frame, int y,
                   const std::vector<std::size_t>& cases,
                   std::vector<std::vector<float>>& to) const;
};

void PictureBench::State::render_truth()
{
    truth.resize(options.cases.size());
    exposure.resize(options.cases.size(), 1.0f);
    for (std::size_t v = 0; v < options.views.size(); ++v) {
        const std::vector<std::size_t> cases = cases_of(v);
        if (cases.empty()) continue;
        const PictureView& view = options.views[v];
        const FloorPlan plan(view);
        for (const std::size_t c : cases)
            truth[c].resize(pixels(c) * static_cast<std::size_t>(options.frames));
        const std::size_t rows = static_cast<std::size_t>(view.rows);
        parallel_for(
            rows * static_cast<std::size_t>(options.frames), options.threads, [&](std::size_t job) {
                const int frame = static_cast<int>(job / rows), y = static_cast<int>(job % rows);
                const int n = options.samples;
                std::vector<double> sum(cases.size());
                for (int x = 0; x < view.width; ++x) {
                    std::fill(sum.begin(), sum.end(), 0.0);
                    for (int s = 0; s < n * n; ++s) {
                        const auto [jx, jy] = detail::jitter(options.seed, frame, x, y, s);
                        const auto at =
                            plan.ray(frame, x + ((s % n) + jx) / n, y + ((s / n) + jy) / n);
                        const Texel t = plain.front().nearest(at.u, at.v);
                        const float p = perceptual(t.stored, input);
                        for (std::size_t i = 0; i < cases.size(); ++i)
                            sum[i] += static_cast<double>(
                                shade(t.n, p, t.diffuse, at.to_eye, lights[cases[i]]));
                    }
                    const std::size_t pixel =
                        job * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(x);
                    for (std::size_t i = 0; i < cases.size(); ++i)
                        truth[cases[i]][pixel] = static_cast<float>(sum[i] / (n * n));
                }
            });
        for (const std::size_t c : cases) {
            std::vector<float> sorted = truth[c];
            std::sort(sorted.begin(), sorted.end());
            const float median = sorted[sorted.size() / 2];
            const float bright = sorted[sorted.size() * 97 / 100];
            exposure[c] = std::min(0.18f / std::max(median, 1e-6f), 0.9f / std::max(bright, 1e-6f));
            for (float& value : truth[c]) value = shown(value, exposure[c]);
        }
    }
}

std::vector<Level> PictureBench::State::levels_of(const Prefiltered& chain) const
{
    std::vector<Level> own(plain.size());
    for (std::size_t k = 1; k < plain.size(); ++k) {
        const bool normals = k < chain.normal.size() && !chain.normal[k].empty();
        const bool rough = k < chain.roughness.size() && !chain.roughness[k].empty();
        if (!normals && !rough) continue;
        own[k] = plain[k];
        if (normals) {
            check_level(chain.normal[k], plain[k], k);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i) {
                const float* n = &chain.normal[k].pixels[3 * i];
                const float y = 2.0f * n[1] - 1.0f;
                own[k].texels[i].n = {2.0f * n[0] - 1.0f, input.green_down ? -y : y,
                                      2.0f * n[2] - 1.0f};
            }
        }
        if (k < chain.base_share.size() && !chain.base_share[k].empty()) {
            check_level(chain.base_share[k], plain[k], k);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i)
                own[k].texels[i].diffuse = chain.base_share[k].pixels[i];
        }
        if (rough) {
            check_level(chain.roughness[k], plain[k], k);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i)
                own[k].texels[i].stored = chain.roughness[k].pixels[i];
        }
    }
    return own;
}

std::vector<const Level*> PictureBench::State::merged(const std::vector<Level>& own) const
{
    std::vector<const Level*> all;
    for (std::size_t k = 0; k < plain.size(); ++k)
        all.push_back(k < own.size() && !own[k].texels.empty() ? &own[k] : &plain[k]);
    return all;
}

void PictureBench::State::shade_row(const std::vector<const Level*>& levels, const FloorPlan& plan,
                                    int frame, int y, const std::vector<std::size_t>& cases,
                                    std::vector<std::vector<float>>& to) const
{
    const PictureView& view = view_of(cases.front());
    for (int x = 0; x < view.width; ++x) {
        const FloorPixel pixel = plan.pixel(frame, x, y);
        const Texel t = filtered(levels, taps_of(plain, pixel, view.taps));
        const float p = perceptual(t.stored, input);
        for (std::size_t i = 0; i < cases.size(); ++i)
            to[i][static_cast<std::size_t>(x)] =
                shade(t.n, p, t.diffuse, pixel.to_eye, lights[cases[i]]);
    }
}

template <class Shade>
void PictureBench::State::sum_row(std::size_t view, int y, const std::vector<std::size_t>& cases,
                                  const Shade& shade, std::vector<RowSums>& to) const
{
    const std::size_t width = static_cast<std::size_t>(options.views[view].width);
    const std::size_t rows = static_cast<std::size_t>(options.views[view].rows);
    std::vector<std::vector<float>> line(cases.size(), std::vector<float>(width));
    std::vector<std::vector<double>> first(cases.size(), std::vector<double>(width)),
        second = first;
    for (int f = 0; f < options.frames; ++f) {
        shade(f, line);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const std::vector<float>& known = truth[cases[i]];
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t at =
                    (static_cast<std::size_t>(f) * rows + static_cast<std::size_t>(y)) * width + x;
                const double error =
                    static_cast<double>(shown(line[i][x], exposure[cases[i]]) - known[at]);
                first[i][x] += error;
                second[i][x] += error * error;
            }
        }
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
        to[i] = {};
        for (std::size_t x = 0; x < width; ++x) {
            to[i].squares += second[i][x];
            const double mean = first[i][x] / options.frames;
            to[i].deviation +=
                std::sqrt(std::max(second[i][x] / options.frames - mean * mean, 0.0));
        }
    }
}

void PictureBench::State::add_up(std::size_t v, const std::vector<std::size_t>& cases,
                                 const std::vector<std::vector<RowSums>>& rows,
                                 std::vector<PictureScore>& scores) const
{
    const PictureView& view = options.views[v];
    for (std::size_t i = 0; i < cases.size(); ++i) {
        double squares = 0.0, deviation = 0.0;
        for (const auto& row : rows) squares += row[i].squares, deviation += row[i].deviation;
        const double count = static_cast<double>(view.width) * static_cast<double>(rows.size());
        const PictureCase& c = options.cases[cases[i]];
        scores[cases[i]] = {view.name + ", " +
                                options.lights[static_cast<std::size_t>(c.light)].name +
                                (c.metal ? ", metal" : ""),
                            std::sqrt(squares / (count * options.frames)), deviation / count};
    }
}

PictureBench::PictureBench(const RawImage& normal, const RawImage& roughness,
                           const PrefilterOptions& input, PictureOptions options)
    : PictureBench(detail::make_surface(detail::ref(normal), detail::ref(roughness), input), input,
                   std::move(options))
{
}

PictureBench::PictureBench(const detail::MapSurface& surface, const PrefilterOptions& input,
                           PictureOptions options)
    : state_(std::make_unique<State>())
{
    State& s = *state_;
    s.options = std::move(options);
    s.input = input;
    Level base{surface.width, surface.height, {}};
    base.small.reserve(static_cast<std::size_t>(base.width) *
                       static_cast<std::size_t>(base.height));
    detail::SurfaceRow row;
    for (int y = 0; y < surface.height; ++y) {
        detail::fetch(surface, y, row);
        for (std::size_t x = 0; x < row.nx.size(); ++x)
            base.small.push_back(
                to_small({row.nx[x], row.ny[x], row.nz[x]}, stored_value(row.p[x], input)));
    }
    s.plain = plain_levels(std::move(base));
    for (const PictureCase& c : s.options.cases) {
        const PictureLight& light = s.options.lights[static_cast<std::size_t>(c.light)];
        const auto& d = light.to_light;
        s.lights.push_back({glm::normalize(glm::vec3(d[0], d[1], d[2])), light.alpha * light.alpha,
                            light.sun, light.sky, c.metal});
    }
    s.render_truth();
}

PictureBench::~PictureBench() = default;
PictureBench::PictureBench(PictureBench&&) noexcept = default;
PictureBench& PictureBench::operator=(PictureBench&&) noexcept = default;

std::vector<Image> PictureBench::plain_roughness() const
{
    std::vector<Image> levels(1);
    for (std::size_t k = 1; k < state_->plain.size(); ++k) {
        const Level& level = state_->plain[k];
        levels.emplace_back(level.width, level.height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < level.texels.size(); ++i)
            levels.back().pixels[i] = level.texels[i].stored;
    }
    return levels;
}

const PictureOptions& PictureBench::options() const
{
    return state_->options;
}

std::vector<PictureScore> PictureBench::score(const Prefiltered& chain) const
{
    const State& s = *state_;
    const std::vector<Level> own = s.levels_of(chain);
    const std::vector<const Level*> levels = s.merged(own);
    std::vector<PictureScore> scores(s.options.cases.size());
    for (std::size_t v = 0; v < s.options.views.size(); ++v) {
        const std::vector<std::size_t> cases = s.cases_of(v);
        if (cases.empty()) continue;
        const PictureView& view = s.options.views[v];
        const FloorPlan plan(view);
        std::vector<std::vector<RowSums>> rows(static_cast<std::size_t>(view.rows),
                                               std::vector<RowSums>(cases.size()));
        parallel_for(rows.size(), s.options.threads, [&](std::size_t y) {
            s.sum_row(
                v, static_cast<int>(y), cases,
                [&](int frame, std::vector<std::vector<float>>& line) {
                    s.shade_row(levels, plan, frame, static_cast<int>(y), cases, line);
                },
                rows[y]);
        });
        s.add_up(v, cases, rows, scores);
    }
    return scores;
}

struct PictureBench::Blend::State {
    const PictureBench::State& bench;
    // A pixel: what plain mips give, and what the chain adds to it on either level.
    struct Pixel {
        glm::vec3 n, to_eye;
        float stored = 0.0f, add_fine = 0.0f, add_coarse = 0.0f;
        float darken_fine = 0.0f, darken_coarse = 0.0f;
        std::uint8_t fine = 0, coarse = 0;
    };
    struct View {
        std::vector<std::size_t> cases;
        std::vector<Pixel> pixels;        // row by row, in it frame by frame
        std::vector<std::uint32_t> sees;  // of a row: a bit a level
        std::vector<std::vector<RowSums>> rows;
    };
    std::vector<View> views;
    Shares last;  // of which `rows` are

    explicit State(const PictureBench::State& of) : bench(of) {}
};

PictureBench::Blend::Blend(const PictureBench& bench, const Prefiltered& chain)
    : state_(std::make_unique<State>(*bench.state_))
{
    const PictureBench::State& s = *bench.state_;
    // The chain less the plain mips: roughness as stored, and what it takes from the base colour.
    std::vector<std::vector<glm::vec2>> more(s.plain.size());
    for (std::size_t k = 1; k < more.size() && k < chain.roughness.size(); ++k) {
        const Image &rough = chain.roughness[k], &base = chain.base_share.at(k);
        const Level& level = s.plain[k];
        for (const Image* of : {&rough, &base}) check_level(*of, level, k);
        more[k].reserve(level.texels.size());
        for (std::size_t i = 0; i < level.texels.size(); ++i)
            more[k].emplace_back(rough.pixels[i] - level.texels[i].stored, base.pixels[i] - 1.0f);
    }
    const std::vector<const Level*> plain = s.merged({});
    state_->views.resize(s.options.views.size());
    for (std::size_t v = 0; v < s.options.views.size(); ++v) {
        State::View& to = state_->views[v];
        to.cases = s.cases_of(v);
        if (to.cases.empty()) continue;
        const PictureView& view = s.options.views[v];
        const FloorPlan plan(view);
        const std::size_t width = static_cast<std::size_t>(view.width);
        const std::size_t row = width * static_cast<std::size_t>(s.options.frames);
        to.pixels.resize(row * static_cast<std::size_t>(view.rows));
        to.sees.assign(static_cast<std::size_t>(view.rows), 0);
        to.rows.assign(static_cast<std::size_t>(view.rows), std::vector<RowSums>(to.cases.size()));
        parallel_for(to.rows.size(), s.options.threads, [&](std::size_t y) {
            for (std::size_t i = 0; i < row; ++i) {
                const FloorPixel at = plan.pixel(static_cast<int>(i / width),
                                                 static_cast<int>(i % width), static_cast<int>(y));
                const Taps taps = taps_of(s.plain, at, view.taps);
                const Texel t = filtered(plain, taps);
                State::Pixel& pixel = to.pixels[y * row + i];
                pixel.n = t.n, pixel.to_eye = at.to_eye, pixel.stored = t.stored;
                pixel.fine = static_cast<std::uint8_t>(taps.fine);
                pixel.coarse = static_cast<std::uint8_t>(taps.coarse);
                const auto add = [&](std::size_t level, float share, float& stored, float& dark) {
                    if (more[level].empty() || !(share > 0.0f)) return;
                    const Level& size = s.plain[level];
                    for (int tap = 0; tap < taps.count; ++tap)
                        bilinear(size.width, size.height, taps.u + tap * taps.step_u,
                                 taps.v + tap * taps.step_v, share / static_cast<float>(taps.count),
                                 [&](std::size_t at_texel, float w) {
                                     stored += more[level][at_texel].x * w;
                                     dark += more[level][at_texel].y * w;
                                 });
                    to.sees[y] |= 1u << level;
                };
                add(taps.fine, 1.0f - taps.share, pixel.add_fine, pixel.darken_fine);
                add(taps.coarse, taps.share, pixel.add_coarse, pixel.darken_coarse);
            }
        });
    }
}

PictureBench::Blend::~Blend() = default;

std::vector<PictureScore> PictureBench::Blend::score(const Shares& shares)
{
    const PictureBench::State& s = state_->bench;
    const bool all = state_->last.roughness.empty();
    std::uint32_t changed = 0;
    for (std::size_t k = 0; k < shares.roughness.size() && !all; ++k)
        if (shares.roughness[k] != state_->last.roughness[k] ||
            shares.base[k] != state_->last.base[k])
            changed |= 1u << k;
    state_->last = shares;
    std::vector<PictureScore> scores(s.options.cases.size());
    for (std::size_t v = 0; v < state_->views.size(); ++v) {
        State::View& view = state_->views[v];
        if (view.cases.empty()) continue;
        const std::size_t width = static_cast<std::size_t>(s.options.views[v].width);
        parallel_for(view.rows.size(), s.options.threads, [&](std::size_t y) {
            if (!all && !(view.sees[y] & changed)) return;
            const State::Pixel* row =
                &view.pixels[y * width * static_cast<std::size_t>(s.options.frames)];
            const auto shade_all = [&](int frame, std::vector<std::vector<float>>& line) {
                for (std::size_t x = 0; x < width; ++x) {
                    const State::Pixel& t = row[static_cast<std::size_t>(frame) * width + x];
                    const float stored = t.stored + shares.roughness[t.fine] * t.add_fine +
                                         shares.roughness[t.coarse] * t.add_coarse;
                    const float base = 1.0f + shares.base[t.fine] * t.darken_fine +
                                       shares.base[t.coarse] * t.darken_coarse;
                    const float p = perceptual(std::clamp(stored, 0.0f, 1.0f), s.input);
                    for (std::size_t i = 0; i < view.cases.size(); ++i)
                        line[i][x] = shade(t.n, p, base, t.to_eye, s.lights[view.cases[i]]);
                }
            };
            s.sum_row(v, static_cast<int>(y), view.cases, shade_all, view.rows[y]);
        });
        s.add_up(v, view.cases, view.rows, scores);
    }
    return scores;
}

Image PictureBench::picture(std::size_t which, int frame, const Prefiltered* chain) const
{
    const State& s = *state_;
    const PictureView& view = s.view_of(which);
    Image out(view.width, view.rows, 1, ColorSpace::Data);
    const std::size_t first = static_cast<std::size_t>(frame) * s.pixels(which);
    if (!chain) {
        std::copy_n(s.truth[which].begin() + static_cast<std::ptrdiff_t>(first), s.pixels(which),
                    out.pixels.begin());
        return out;
    }
    const std::vector<Level> own = s.levels_of(*chain);
    const std::vector<const Level*> levels = s.merged(own);
    const FloorPlan plan(view);
    std::vector<std::vector<float>> line(1,
                                         std::vector<float>(static_cast<std::size_t>(view.width)));
    for (int y = 0; y < view.rows; ++y) {
        s.shade_row(levels, plan, frame, y, {which}, line);
        for (int x = 0; x < view.width; ++x)
            out.at(x, y, 0) = shown(line[0][static_cast<std::size_t>(x)], s.exposure[which]);
    }
    return out;
}

PictureOptions reference_pictures()
{
    PictureOptions o;
    o.views = {{.name = "floor"}};
    o.lights = {{.name = "sun ahead", .to_light = {0.15f, 1.0f, 0.42f}},
                {.name = "sun from the left", .to_light = {-0.6f, 0.8f, 1.0f}},
                {.name = "sun behind", .to_light = {0.6f, -0.8f, 0.7f}},
                {.name = "window ahead", .to_light = {0.15f, 1.0f, 0.42f}, .alpha = 0.1f}};
    o.cases = {{0, 0, false}, {0, 1, false}, {0, 2, false}, {0, 3, false}, {0, 0, true}};
    return o;
}

PictureOptions design_pictures(bool quick)
{
    PictureOptions o;
    o.frames = 2;
    o.samples = quick ? 5 : 8;
    o.seed = 77;
    o.views = {{.name = "near",
                .height_m = 1.2,
                .pitch_deg = 20.0,
                .width = 110,
                .rows = 56,
                .step_right_m = 0.006,
                .step_ahead_m = 0.017},
               {.name = "far",
                .height_m = 2.6,
                .pitch_deg = 13.0,
                .field_of_view_deg = 40.0,
                .width = 110,
                .rows = 48,
                .step_right_m = 0.011,
                .step_ahead_m = 0.031},
               {.name = "down",
                .height_m = 4.0,
                .pitch_deg = 70.0,
                .field_of_view_deg = 50.0,
                .width = 80,
                .rows = 48,
                .step_right_m = 0.007,
                .step_ahead_m = 0.013}};
    if (quick) {
        o.lights = {{.name = "ahead, low", .to_light = {-0.25f, 1.0f, 0.30f}},
                    {.name = "ahead, high", .to_light = {0.3f, 1.0f, 0.8f}},
                    {.name = "from the right", .to_light = {1.0f, 0.1f, 0.6f}},
                    {.name = "behind", .to_light = {-0.5f, -0.9f, 0.9f}}};
    } else {
        // As fine as a large picture, but less of it.
        o.views.push_back({.name = "part",
                           .height_m = 1.7,
                           .pitch_deg = 15.0,
                           .field_of_view_deg = 12.0,
                           .width = 100,
                           .rows = 64,
                           .step_right_m = 0.005,
                           .step_ahead_m = 0.019});
        // A ring of suns, low and high in turn, another ahead.
        constexpr float kRing[][3] = {
            {0.26f, 0.97f, 0.45f},  {0.83f, 0.56f, 1.1f},    {0.97f, -0.26f, 0.45f},
            {0.56f, -0.83f, 1.1f},  {-0.26f, 0.97f, 1.1f},   {-0.83f, 0.56f, 0.45f},
            {-0.97f, -0.26f, 1.1f}, {-0.56f, -0.83f, 0.45f}, {-0.1f, 1.0f, 0.3f}};
        for (const auto& sun : kRing)
            o.lights.push_back({.name = "sun " + std::to_string(o.lights.size()),
                                .to_light = {sun[0], sun[1], sun[2]}});
    }
    o.lights.push_back({.name = "window", .to_light = {-0.1f, 1.0f, 0.5f}, .alpha = 0.12f});
    for (int view = 0; view < static_cast<int>(o.views.size()); ++view)
        for (int light = 0; light < static_cast<int>(o.lights.size()); ++light)
            o.cases.push_back({view, light, false});
    return o;
}

PictureOptions all_pictures()
{
    PictureOptions o = reference_pictures();
    o.views.push_back({.name = "floor, one tap", .taps = 1});
    o.views.push_back({.name = "from above",
                       .height_m = 6.0,
                       .pitch_deg = 55.0,
                       .width = 200,
                       .rows = 100,
                       .step_right_m = 0.009,
                       .step_ahead_m = 0.013});
    // A sun beside which the sky gives a fifth of the light, and a sky alone.
    constexpr float kBesideSun = 0.1f;
    for (int i = 0; i < 3; ++i) {
        PictureLight day = o.lights[static_cast<std::size_t>(i)];
        day.name += " and sky";
        day.sky = kBesideSun;
        o.lights.push_back(day);
    }
    o.lights.push_back({.name = "sky", .sun = 0.0f, .sky = 1.0f});
    constexpr int kAhead = 4, kLeft = 5, kBehind = 6, kSky = 7;
    for (const PictureCase& c : {PictureCase{0, kLeft, true},
                                 {0, kBehind, true},
                                 {0, kAhead, false},
                                 {0, kSky, false},
                                 {0, kSky, true},
                                 {1, kAhead, false},
                                 {1, kLeft, false},
                                 {1, kBehind, false},
                                 {1, kAhead, true},
                                 {2, kAhead, false},
                                 {2, kLeft, false},
                                 {2, kBehind, false},
                                 {2, kAhead, true}})
        o.cases.push_back(c);
    return o;
}

}  // namespace petrichor::texproc
