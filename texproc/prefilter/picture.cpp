#include "texproc/prefilter/picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/detail/map_surface.h"
#include "texproc/prefilter/detail/picture_state.h"

namespace petrichor::texproc {

using detail::check_level;
using detail::FloorPixel;
using detail::FloorPlan;
using detail::Level;
using detail::perceptual;
using detail::RowSums;
using detail::shade;
using detail::shown;
using detail::Taps;
using detail::Texel;

void detail::check_level(const Image& given, const Level& plain, std::size_t k)
{
    if (given.width == plain.width && given.height == plain.height) return;
    throw Error("score: level " + std::to_string(k) + " is " + std::to_string(given.width) + " x " +
                    std::to_string(given.height) + ", expected " + std::to_string(plain.width) +
                    " x " + std::to_string(plain.height),
                "Give the chain of the same maps.");
}

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
                        const auto [px, py] = plan.inside(x, y, ((s % n) + jx) / n, ((s / n) + jy) / n);
                        const auto at = plan.ray(frame, px, py);
                        const Texel t = plain().front().nearest(at.u, at.v);
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

Level PictureBench::State::level_of(const Prefiltered& chain, std::size_t k) const
{
    const bool normals = k < chain.normal.size() && !chain.normal[k].empty();
    const bool rough = k < chain.roughness.size() && !chain.roughness[k].empty();
    if (!normals && !rough) return {};
    const Level& size = plain()[k];
    Level own = size;
    if (normals) {
        check_level(chain.normal[k], size, k);
        for (std::size_t i = 0; i < own.texels.size(); ++i) {
            const float* n = &chain.normal[k].pixels[3 * i];
            const float y = 2.0f * n[1] - 1.0f;
            own.texels[i].n = {2.0f * n[0] - 1.0f, input.green_down ? -y : y, 2.0f * n[2] - 1.0f};
        }
    }
    const auto of_texels = [&](const std::vector<Image>& levels, float Texel::*number) {
        if (k >= levels.size() || levels[k].empty()) return;
        check_level(levels[k], size, k);
        for (std::size_t i = 0; i < own.texels.size(); ++i)
            own.texels[i].*number = levels[k].pixels[i];
    };
    of_texels(chain.base_share, &Texel::diffuse);
    of_texels(chain.metal_share, &Texel::metal);
    of_texels(chain.roughness, &Texel::stored);
    if (k < chain.second.share.size() && !chain.second.share[k].empty()) {
        for (const Image* of : {&chain.second.normal.at(k), &chain.second.roughness.at(k), &chain.second.share[k]})
            check_level(*of, size, k);
        own.second.resize(own.texels.size());
        for (std::size_t i = 0; i < own.second.size(); ++i) {
            const float* n = &chain.second.normal[k].pixels[3 * i];
            const float y = 2.0f * n[1] - 1.0f;
            own.second[i] = {{2.0f * n[0] - 1.0f, input.green_down ? -y : y, 2.0f * n[2] - 1.0f},
                             chain.second.roughness[k].pixels[i], chain.second.share[k].pixels[i]};
        }
    }
    return own;
}

std::vector<Level> PictureBench::State::levels_of(const Prefiltered& chain) const
{
    std::vector<Level> own(plain().size());
    for (std::size_t k = 1; k < own.size(); ++k) own[k] = level_of(chain, k);
    return own;
}

std::vector<const Level*> PictureBench::State::merged(const std::vector<Level>& own) const
{
    std::vector<const Level*> all;
    for (std::size_t k = 0; k < plain().size(); ++k)
        all.push_back(k < own.size() && !own[k].texels.empty() ? &own[k] : &plain()[k]);
    return all;
}

void PictureBench::State::shade_pixel(const std::vector<const Level*>& levels, const Taps& taps,
                                      const glm::vec3& to_eye, const std::vector<std::size_t>& cases,
                                      std::size_t x, std::vector<std::vector<float>>& to) const
{
    const Texel t = detail::filtered(levels, taps);
    const float p = perceptual(t.stored, input);
    const bool two = !levels[taps.fine]->second.empty() || !levels[taps.coarse]->second.empty();
    if (!two) {
        for (std::size_t i = 0; i < cases.size(); ++i) to[i][x] = shade(t, p, to_eye, lights[cases[i]]);
        return;
    }
    const detail::SecondTexel second = detail::second_filtered(levels, taps);
    const float p2 = perceptual(second.stored, input);
    for (std::size_t i = 0; i < cases.size(); ++i)
        to[i][x] = shade(t, p, second, p2, to_eye, lights[cases[i]]);
}

void PictureBench::State::shade_row(const std::vector<const Level*>& levels, const FloorPlan& plan,
                                    int frame, int y, const std::vector<std::size_t>& cases,
                                    std::vector<std::vector<float>>& to) const
{
    const PictureView& view = view_of(cases.front());
    for (int x = 0; x < view.width; ++x) {
        const FloorPixel pixel = plan.pixel(frame, x, y);
        shade_pixel(levels, detail::taps_of(plain(), pixel, view.taps), pixel.to_eye, cases,
                    static_cast<std::size_t>(x), to);
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
    s.maps = std::make_shared<const detail::Levels>(detail::plain_levels(std::move(base)));
    s.light_and_render();
}

PictureBench::PictureBench(const PictureBench& of_maps, PictureOptions options)
    : state_(std::make_unique<State>())
{
    state_->options = std::move(options);
    state_->input = of_maps.state_->input;
    state_->maps = of_maps.state_->maps;
    state_->light_and_render();
}

void PictureBench::State::light_and_render()
{
    for (const PictureCase& c : options.cases) {
        const PictureLight& light = options.lights[static_cast<std::size_t>(c.light)];
        const auto& d = light.to_light;
        lights.push_back({glm::normalize(glm::vec3(d[0], d[1], d[2])), light.alpha * light.alpha,
                          light.sun, light.sky, c.metal});
    }
    render_truth();
}

PictureBench::~PictureBench() = default;
PictureBench::PictureBench(PictureBench&&) noexcept = default;
PictureBench& PictureBench::operator=(PictureBench&&) noexcept = default;

std::vector<Image> PictureBench::plain_roughness() const
{
    std::vector<Image> levels(1);
    for (std::size_t k = 1; k < state_->plain().size(); ++k) {
        const Level& level = state_->plain()[k];
        levels.emplace_back(level.width, level.height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < level.texels.size(); ++i)
            levels.back().pixels[i] = level.texels[i].stored;
    }
    return levels;
}

const std::vector<Level>& PictureBench::levels() const
{
    return state_->plain();
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
