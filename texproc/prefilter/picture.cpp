#include "texproc/prefilter/picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/detail/map_surface.h"

namespace petrichor::texproc {

namespace {

using detail::bilinear;
using detail::FloorLight;
using detail::FloorPixel;
using detail::FloorPlan;
using detail::Level;
using detail::Levels;
using detail::perceptual;
using detail::shade;
using detail::shown;
using detail::Taps;
using detail::Texel;

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
    std::vector<FloorLight> lights;         // of the cases
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
                                shade(t, p, at.to_eye, lights[cases[i]]));
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
        if (k < chain.metal_share.size() && !chain.metal_share[k].empty()) {
            check_level(chain.metal_share[k], plain[k], k);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i)
                own[k].texels[i].metal = chain.metal_share[k].pixels[i];
        }
        if (rough) {
            check_level(chain.roughness[k], plain[k], k);
            for (std::size_t i = 0; i < own[k].texels.size(); ++i)
                own[k].texels[i].stored = chain.roughness[k].pixels[i];
        }
        if (k < chain.second.share.size() && !chain.second.share[k].empty()) {
            for (const Image* of : {&chain.second.normal.at(k), &chain.second.roughness.at(k), &chain.second.share[k]})
                check_level(*of, plain[k], k);
            own[k].second.resize(own[k].texels.size());
            for (std::size_t i = 0; i < own[k].second.size(); ++i) {
                const float* n = &chain.second.normal[k].pixels[3 * i];
                const float y = 2.0f * n[1] - 1.0f;
                own[k].second[i] = {{2.0f * n[0] - 1.0f, input.green_down ? -y : y, 2.0f * n[2] - 1.0f},
                                    chain.second.roughness[k].pixels[i], chain.second.share[k].pixels[i]};
            }
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
        const Taps taps = detail::taps_of(plain, pixel, view.taps);
        const Texel t = detail::filtered(levels, taps);
        const float p = perceptual(t.stored, input);
        const bool two = !levels[taps.fine]->second.empty() || !levels[taps.coarse]->second.empty();
        if (!two) {
            for (std::size_t i = 0; i < cases.size(); ++i)
                to[i][static_cast<std::size_t>(x)] = shade(t, p, pixel.to_eye, lights[cases[i]]);
            continue;
        }
        const detail::SecondTexel second = detail::second_filtered(levels, taps);
        const float p2 = perceptual(second.stored, input);
        for (std::size_t i = 0; i < cases.size(); ++i)
            to[i][static_cast<std::size_t>(x)] =
                shade(t, p, second, p2, pixel.to_eye, lights[cases[i]]);
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
                detail::to_small({row.nx[x], row.ny[x], row.nz[x]}, detail::stored_value(row.p[x], input)));
    }
    s.plain = detail::plain_levels(std::move(base));
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

const std::vector<Level>& PictureBench::levels() const
{
    return state_->plain;
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
                const Taps taps = detail::taps_of(s.plain, at, view.taps);
                const Texel t = detail::filtered(plain, taps);
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
                        line[i][x] =
                            shade({t.n, stored, base, 1.0f}, p, t.to_eye, s.lights[view.cases[i]]);
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

}  // namespace petrichor::texproc
