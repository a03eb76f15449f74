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

struct Level {
    int width = 0, height = 0;
    std::vector<Texel> texels;

    const Texel& nearest(double u, double v) const
    {
        const auto at = [](double x, int n) {
            const int i = static_cast<int>((x - std::floor(x)) * n);
            return std::min(i, n - 1);
        };
        return texels[static_cast<std::size_t>(at(v, height)) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(at(u, width))];
    }
    // Bilinear, wrapped; added with a weight.
    void add_to(Texel& sum, double u, double v, float weight) const
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
        const auto take = [&](std::size_t i, float w) {
            sum.n += texels[i].n * w;
            sum.stored += texels[i].stored * w;
            sum.diffuse += texels[i].diffuse * w;
        };
        take(y0 + x0, weight * (1.0f - tx) * (1.0f - ty));
        take(y0 + x1, weight * tx * (1.0f - ty));
        take(y1 + x0, weight * (1.0f - tx) * ty);
        take(y1 + x1, weight * tx * ty);
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
    Image all(base.width, base.height, 4, ColorSpace::Data);
    for (std::size_t i = 0; i < base.texels.size(); ++i) {
        const Texel& t = base.texels[i];
        float* to = &all.pixels[4 * i];
        to[0] = t.n.x, to[1] = t.n.y, to[2] = t.n.z, to[3] = t.stored;
    }
    Levels levels;
    levels.push_back(std::move(base));
    for (const Image& mip : area_levels(all)) {
        if (mip.empty()) continue;
        Level level{mip.width, mip.height, {}};
        for (std::size_t i = 0; i < mip.pixels.size(); i += 4) {
            const float* m = &mip.pixels[i];
            const glm::vec3 n(m[0], m[1], m[2]);
            const float length = glm::length(n);
            level.texels.push_back(
                {length > 0.0f ? n / length : glm::vec3(0.0f, 0.0f, 1.0f), m[3], 1.0f});
        }
        levels.push_back(std::move(level));
    }
    return levels;
}

// What one shading of a pixel sees: trilinear samples along the longer axis of its footprint.
Texel filtered(const std::vector<const Level*>& levels, const FloorPixel& pixel, int most_taps)
{
    const Level& base = *levels.front();
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
    const std::size_t fine = std::min(static_cast<std::size_t>(lod), levels.size() - 1);
    const std::size_t coarse = std::min(fine + 1, levels.size() - 1);
    const float share = static_cast<float>(lod - static_cast<double>(fine));
    Texel sum{glm::vec3(0.0f), 0.0f, 0.0f};
    for (int i = 0; i < taps; ++i) {
        const double at = (i + 0.5) / taps - 0.5;
        const double u = pixel.u + at * du, v = pixel.v + at * dv;
        const float weight = 1.0f / static_cast<float>(taps);
        levels[fine]->add_to(sum, u, v, weight * (1.0f - share));
        if (share > 0.0f) levels[coarse]->add_to(sum, u, v, weight * share);
    }
    const float length = glm::length(sum.n);
    sum.n = length > 0.0f ? sum.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return sum;
}

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
                        const Texel& t = plain.front().nearest(at.u, at.v);
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
        const auto check = [&](const Image& level) {
            if (level.width == plain[k].width && level.height == plain[k].height) return;
            throw Error("score: level " + std::to_string(k) + " is " + std::to_string(level.width) +
                            " x " + std::to_string(level.height) + ", expected " +
                            std::to_string(plain[k].width) + " x " +
                            std::to_string(plain[k].height),
                        "Give the chain of the same maps.");
        };
        if (normals) {
            check(chain.normal[k]);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i) {
                const float* n = &chain.normal[k].pixels[3 * i];
                const float y = 2.0f * n[1] - 1.0f;
                own[k].texels[i].n = {2.0f * n[0] - 1.0f, input.green_down ? -y : y,
                                      2.0f * n[2] - 1.0f};
            }
        }
        if (k < chain.base_share.size() && !chain.base_share[k].empty()) {
            check(chain.base_share[k]);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i)
                own[k].texels[i].diffuse = chain.base_share[k].pixels[i];
        }
        if (rough) {
            check(chain.roughness[k]);
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
        const Texel t = filtered(levels, pixel, view.taps);
        const float p = perceptual(t.stored, input);
        for (std::size_t i = 0; i < cases.size(); ++i)
            to[i][static_cast<std::size_t>(x)] =
                shade(t.n, p, t.diffuse, pixel.to_eye, lights[cases[i]]);
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
    base.texels.reserve(static_cast<std::size_t>(base.width) *
                        static_cast<std::size_t>(base.height));
    detail::SurfaceRow row;
    for (int y = 0; y < surface.height; ++y) {
        detail::fetch(surface, y, row);
        for (std::size_t x = 0; x < row.nx.size(); ++x)
            base.texels.push_back(
                {{row.nx[x], row.ny[x], row.nz[x]}, stored_value(row.p[x], input), 1.0f});
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
        const std::size_t width = static_cast<std::size_t>(view.width);
        const int frames = s.options.frames;
        // Of every row, squares of the errors and deviations in time; added in the order of rows.
        struct RowSums {
            double squares = 0.0, deviation = 0.0;
        };
        std::vector<std::vector<RowSums>> rows(static_cast<std::size_t>(view.rows),
                                               std::vector<RowSums>(cases.size()));
        parallel_for(rows.size(), s.options.threads, [&](std::size_t y) {
            std::vector<std::vector<float>> line(cases.size(), std::vector<float>(width));
            std::vector<std::vector<double>> first(cases.size(), std::vector<double>(width)),
                second = first;
            for (int f = 0; f < frames; ++f) {
                s.shade_row(levels, plan, f, static_cast<int>(y), cases, line);
                for (std::size_t i = 0; i < cases.size(); ++i) {
                    const std::vector<float>& truth = s.truth[cases[i]];
                    for (std::size_t x = 0; x < width; ++x) {
                        const std::size_t at =
                            (static_cast<std::size_t>(f) * rows.size() + y) * width + x;
                        const double error = static_cast<double>(
                            shown(line[i][x], s.exposure[cases[i]]) - truth[at]);
                        first[i][x] += error;
                        second[i][x] += error * error;
                    }
                }
            }
            for (std::size_t i = 0; i < cases.size(); ++i)
                for (std::size_t x = 0; x < width; ++x) {
                    rows[y][i].squares += second[i][x];
                    const double mean = first[i][x] / frames;
                    rows[y][i].deviation +=
                        std::sqrt(std::max(second[i][x] / frames - mean * mean, 0.0));
                }
        });
        for (std::size_t i = 0; i < cases.size(); ++i) {
            double squares = 0.0, deviation = 0.0;
            for (const auto& row : rows) squares += row[i].squares, deviation += row[i].deviation;
            const double count = static_cast<double>(width * rows.size());
            const PictureCase& c = s.options.cases[cases[i]];
            scores[cases[i]] = {view.name + ", " +
                                    s.options.lights[static_cast<std::size_t>(c.light)].name +
                                    (c.metal ? ", metal" : ""),
                                std::sqrt(squares / (count * frames)), deviation / count};
        }
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

PictureOptions design_pictures()
{
    PictureOptions o;
    o.frames = 2;
    o.samples = 8;
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
    o.lights = {{.name = "ahead, low", .to_light = {-0.25f, 1.0f, 0.30f}},
                {.name = "ahead, high", .to_light = {0.3f, 1.0f, 0.8f}},
                {.name = "from the right", .to_light = {1.0f, 0.1f, 0.6f}},
                {.name = "behind", .to_light = {-0.5f, -0.9f, 0.9f}},
                {.name = "window", .to_light = {-0.1f, 1.0f, 0.5f}, .alpha = 0.12f}};
    for (int view = 0; view < 3; ++view)
        for (int light = 0; light < 5; ++light) o.cases.push_back({view, light, false});
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
