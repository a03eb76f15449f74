#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "texproc/prefilter/detail/picture_state.h"

namespace petrichor::texproc {

using detail::FloorPixel;
using detail::FloorPlan;
using detail::Level;
using detail::RowSums;
using detail::shown;
using detail::Taps;

struct PictureBench::Retake::State {
    const PictureBench::State& bench;
    std::vector<Level> own;
    struct Pixel {
        Taps taps;
        glm::vec3 to_eye;
    };
    struct View {
        std::vector<std::size_t> cases;
        std::vector<Pixel> pixels;        // row by row, in it frame by frame
        std::vector<std::uint32_t> sees;  // of a row: a bit a level
        std::vector<std::vector<RowSums>> rows;
    };
    std::vector<View> views;
    bool first = true;

    explicit State(const PictureBench::State& of) : bench(of), own(of.plain().size()) {}
};

PictureBench::Retake::Retake(const PictureBench& bench)
    : state_(std::make_unique<State>(*bench.state_))
{
    const PictureBench::State& s = *bench.state_;
    state_->views.resize(s.options.views.size());
    for (std::size_t v = 0; v < s.options.views.size(); ++v) {
        State::View& to = state_->views[v];
        to.cases = s.cases_of(v);
        if (to.cases.empty()) continue;
        const PictureView& view = s.options.views[v];
        const FloorPlan plan(view);
        const std::size_t width = static_cast<std::size_t>(view.width);
        const std::size_t row = width * static_cast<std::size_t>(s.options.frames);
        const std::size_t rows = static_cast<std::size_t>(view.rows);
        to.pixels.resize(row * rows);
        to.sees.assign(rows, 0);
        to.rows.assign(rows, std::vector<RowSums>(to.cases.size()));
        parallel_for(rows, s.options.threads, [&](std::size_t y) {
            for (std::size_t i = 0; i < row; ++i) {
                const FloorPixel at = plan.pixel(static_cast<int>(i / width),
                                                 static_cast<int>(i % width), static_cast<int>(y));
                const Taps taps = detail::taps_of(s.plain(), at, view.taps);
                to.pixels[y * row + i] = {taps, at.to_eye};
                to.sees[y] |= 1u << taps.fine;
                if (taps.share > 0.0f) to.sees[y] |= 1u << taps.coarse;
            }
        });
    }
}

PictureBench::Retake::~Retake() = default;
PictureBench::Retake::Retake(Retake&&) noexcept = default;

std::vector<PictureScore> PictureBench::Retake::score(const Prefiltered& chain,
                                                      std::uint32_t changed)
{
    const PictureBench::State& s = state_->bench;
    if (state_->first) changed = ~0u;
    state_->first = false;
    for (std::size_t k = 1; k < state_->own.size(); ++k)
        if (changed & (1u << k)) state_->own[k] = s.level_of(chain, k);
    const std::vector<const Level*> levels = s.merged(state_->own);
    std::vector<PictureScore> scores(s.options.cases.size());
    for (std::size_t v = 0; v < state_->views.size(); ++v) {
        State::View& view = state_->views[v];
        if (view.cases.empty()) continue;
        const std::size_t width = static_cast<std::size_t>(s.options.views[v].width);
        parallel_for(view.rows.size(), s.options.threads, [&](std::size_t y) {
            if (!(view.sees[y] & changed)) return;
            const State::Pixel* row =
                &view.pixels[y * width * static_cast<std::size_t>(s.options.frames)];
            const auto shade_all = [&](int frame, std::vector<std::vector<float>>& line) {
                for (std::size_t x = 0; x < width; ++x) {
                    const State::Pixel& pixel = row[static_cast<std::size_t>(frame) * width + x];
                    s.shade_pixel(levels, pixel.taps, pixel.to_eye, view.cases, x, line);
                }
            };
            s.sum_row(v, static_cast<int>(y), view.cases, shade_all, view.rows[y]);
        });
        s.add_up(v, view.cases, view.rows, scores);
    }
    return scores;
}

namespace {

// A deviation in time below half a code of 255 is taken for that, and has hardly a slope: nobody sees it.
constexpr float kStill = 0.002f;

// Adds up squares of errors that change with numbers: those of `seen`, by `change` each.
void add_square(PictureForms::Form& to, float weight, float error, const std::vector<std::size_t>& seen,
                const std::vector<float>& change)
{
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const float scaled = weight * change[i];
        to.slope[seen[i]] += error * scaled;
        float* const row = &to.square[seen[i] * to.slope.size()];
        for (std::size_t j = 0; j < seen.size(); ++j) row[seen[j]] += scaled * change[j];
    }
}

}  // namespace

PictureForms PictureBench::Retake::forms(const Prefiltered& chain, std::size_t count,
                                         const std::function<std::size_t(std::size_t)>& vary) const
{
    const PictureBench::State& s = state_->bench;
    std::vector<Level> varied;
    std::vector<std::size_t> level_of;
    for (std::size_t i = 0; i < count; ++i) {
        level_of.push_back(vary(i));
        varied.push_back(s.level_of(chain, level_of.back()));
    }
    vary(count);
    const std::vector<const Level*> levels = s.merged(state_->own);
    PictureForms forms{count, std::vector<PictureForms::Case>(s.options.cases.size())};
    for (PictureForms::Case& c : forms.cases) {
        for (PictureForms::Form* form : {&c.all, &c.moving}) {
            form->slope.resize(count);
            form->square.resize(count * count);
        }
    }
    // View by view: each adds up its rows in their order.
    parallel_for(state_->views.size(), s.options.threads, [&](std::size_t v) {
        const State::View& view = state_->views[v];
        if (view.cases.empty()) return;
        const std::size_t width = static_cast<std::size_t>(s.options.views[v].width);
        const std::size_t rows = view.rows.size(), frames = static_cast<std::size_t>(s.options.frames);
        const float each = 1.0f / static_cast<float>(width * rows), each_frame = each / static_cast<float>(frames);
        std::vector<const Level*> other = levels;
        for (std::size_t y = 0; y < rows; ++y) {
            std::vector<std::size_t> seen;
            for (std::size_t i = 0; i < count; ++i)
                if (view.sees[y] & (1u << level_of[i])) seen.push_back(i);
            // As it is, then with each number a step on; of each all frames.
            using Line = std::vector<std::vector<float>>;
            std::vector<std::vector<Line>> lines(
                1 + seen.size(), std::vector<Line>(frames, Line(view.cases.size(), std::vector<float>(width))));
            for (std::size_t f = 0; f < frames; ++f) {
                const auto shade_all = [&](Line& to) {
                    for (std::size_t x = 0; x < width; ++x) {
                        const State::Pixel& pixel = view.pixels[(y * frames + f) * width + x];
                        s.shade_pixel(other, pixel.taps, pixel.to_eye, view.cases, x, to);
                    }
                };
                shade_all(lines[0][f]);
                for (std::size_t i = 0; i < seen.size(); ++i) {
                    const std::size_t level = level_of[seen[i]];
                    other[level] = &varied[seen[i]];
                    shade_all(lines[1 + i][f]);
                    other[level] = levels[level];
                }
            }
            std::vector<float> error(frames), mean(seen.size());
            std::vector<std::vector<float>> change(frames, mean);
            for (std::size_t c = 0; c < view.cases.size(); ++c) {
                const std::size_t which = view.cases[c];
                PictureForms::Case& to = forms.cases[which];
                for (std::size_t x = 0; x < width; ++x) {
                    float middle = 0.0f, squares = 0.0f;
                    std::fill(mean.begin(), mean.end(), 0.0f);
                    for (std::size_t f = 0; f < frames; ++f) {
                        const float now = shown(lines[0][f][c][x], s.exposure[which]);
                        error[f] = now - s.truth[which][(f * rows + y) * width + x];
                        to.all.error += static_cast<double>(each_frame * error[f] * error[f]);
                        middle += error[f] / static_cast<float>(frames);
                        for (std::size_t i = 0; i < seen.size(); ++i) {
                            change[f][i] = shown(lines[1 + i][f][c][x], s.exposure[which]) - now;
                            mean[i] += change[f][i] / static_cast<float>(frames);
                        }
                        add_square(to.all, each_frame, error[f], seen, change[f]);
                    }
                    for (std::size_t f = 0; f < frames; ++f) {
                        error[f] -= middle;
                        squares += error[f] * error[f];
                        for (std::size_t i = 0; i < seen.size(); ++i) change[f][i] -= mean[i];
                    }
                    // sqrt(v) <= (v / d + d) / 2 for any d, and the same where d^2 = v.
                    const float variance = squares / static_cast<float>(frames), deviation = std::sqrt(variance);
                    const float about = std::max(deviation, kStill);
                    to.moving.error += static_cast<double>(each * 0.5f * (variance / about + about));
                    for (std::size_t f = 0; f < frames; ++f)
                        add_square(to.moving, 0.5f * each_frame / about, error[f], seen, change[f]);
                }
            }
        }
    });
    return forms;
}

}  // namespace petrichor::texproc
