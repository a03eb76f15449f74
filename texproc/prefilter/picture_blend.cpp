// Mixtures of plain mips and a chain, and a chain that changes level by level: pictures.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "texproc/prefilter/detail/picture_state.h"

namespace petrichor::texproc {

using detail::bilinear;
using detail::FloorPixel;
using detail::FloorPlan;
using detail::Level;
using detail::perceptual;
using detail::RowSums;
using detail::shade;
using detail::Taps;
using detail::Texel;

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
    std::vector<std::vector<glm::vec2>> more(s.plain().size());
    for (std::size_t k = 1; k < more.size() && k < chain.roughness.size(); ++k) {
        const Image &rough = chain.roughness[k], &base = chain.base_share.at(k);
        const Level& level = s.plain()[k];
        for (const Image* of : {&rough, &base}) detail::check_level(*of, level, k);
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
                const Taps taps = detail::taps_of(s.plain(), at, view.taps);
                const Texel t = detail::filtered(plain, taps);
                State::Pixel& pixel = to.pixels[y * row + i];
                pixel.n = t.n, pixel.to_eye = at.to_eye, pixel.stored = t.stored;
                pixel.fine = static_cast<std::uint8_t>(taps.fine);
                pixel.coarse = static_cast<std::uint8_t>(taps.coarse);
                const auto add = [&](std::size_t level, float share, float& stored, float& dark) {
                    if (more[level].empty() || !(share > 0.0f)) return;
                    const Level& size = s.plain()[level];
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

}  // namespace petrichor::texproc
