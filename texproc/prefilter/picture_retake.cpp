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
    for (PictureForms::Case& c : forms.cases) c.slope.resize(count), c.square.resize(count * count);
    // View by view: each adds up its rows in their order.
    parallel_for(state_->views.size(), s.options.threads, [&](std::size_t v) {
        const State::View& view = state_->views[v];
        if (view.cases.empty()) return;
        const std::size_t width = static_cast<std::size_t>(s.options.views[v].width);
        const std::size_t rows = view.rows.size(), frames = static_cast<std::size_t>(s.options.frames);
        const float each = 1.0f / static_cast<float>(width * rows * frames);
        std::vector<const Level*> other = levels;
        for (std::size_t y = 0; y < rows; ++y) {
            std::vector<std::size_t> seen;
            for (std::size_t i = 0; i < count; ++i)
                if (view.sees[y] & (1u << level_of[i])) seen.push_back(i);
            std::vector<std::vector<float>> line(view.cases.size(), std::vector<float>(width));
            std::vector<std::vector<std::vector<float>>> lines(seen.size(), line);
            for (std::size_t f = 0; f < frames; ++f) {
                const auto shade_all = [&](std::vector<std::vector<float>>& to) {
                    for (std::size_t x = 0; x < width; ++x) {
                        const State::Pixel& pixel = view.pixels[(y * frames + f) * width + x];
                        s.shade_pixel(other, pixel.taps, pixel.to_eye, view.cases, x, to);
                    }
                };
                shade_all(line);
                for (std::size_t i = 0; i < seen.size(); ++i) {
                    const std::size_t level = level_of[seen[i]];
                    other[level] = &varied[seen[i]];
                    shade_all(lines[i]);
                    other[level] = levels[level];
                }
                std::vector<float> change(seen.size());
                for (std::size_t c = 0; c < view.cases.size(); ++c) {
                    const std::size_t which = view.cases[c];
                    PictureForms::Case& to = forms.cases[which];
                    for (std::size_t x = 0; x < width; ++x) {
                        const float now = shown(line[c][x], s.exposure[which]);
                        const float error = now - s.truth[which][(f * rows + y) * width + x];
                        to.error += static_cast<double>(each * error * error);
                        for (std::size_t i = 0; i < seen.size(); ++i) {
                            change[i] = shown(lines[i][c][x], s.exposure[which]) - now;
                            to.slope[seen[i]] += each * error * change[i];
                        }
                        for (std::size_t i = 0; i < seen.size(); ++i)
                            for (std::size_t j = 0; j < seen.size(); ++j)
                                to.square[seen[i] * count + seen[j]] += each * change[i] * change[j];
                    }
                }
            }
        }
    });
    return forms;
}

}  // namespace petrichor::texproc
