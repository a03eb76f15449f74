#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_STATE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_STATE_H

// What a PictureBench holds, for the files that render with it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::texproc {

namespace detail {

/// Of a row of pixels: squares of the errors, and deviations in time.
struct RowSums {
    double squares = 0.0, deviation = 0.0;
};

/// Throws Error unless an image is as large as the level.
void check_level(const Image& given, const Level& plain, std::size_t k);

}  // namespace detail

struct PictureBench::State {
    PictureOptions options;
    PrefilterOptions input;
    std::shared_ptr<const detail::Levels> maps;  // plain mips; level 0 is that of the material
    std::vector<detail::FloorLight> lights;         // of the cases
    std::vector<float> exposure;            // of the cases
    std::vector<std::vector<float>> truth;  // of the cases: frame by frame, row by row

    const detail::Levels& plain() const { return *maps; }
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
    void light_and_render();  // what is rendered against: lights of the cases, then the truth
    void render_truth();
    std::vector<detail::Level> levels_of(const Prefiltered& chain) const;
    // One of them; empty where the chain has nothing of its own.
    detail::Level level_of(const Prefiltered& chain, std::size_t k) const;
    std::vector<const detail::Level*> merged(const std::vector<detail::Level>& own) const;
    // Adds up one row of pixels: shade(frame, to) gives the radiance of every case.
    template <class Shade>
    void sum_row(std::size_t view, int y, const std::vector<std::size_t>& cases, const Shade& shade,
                 std::vector<detail::RowSums>& to) const;
    // The scores of cases that share a view, from the sums of its rows in their order.
    void add_up(std::size_t view, const std::vector<std::size_t>& cases,
                const std::vector<std::vector<detail::RowSums>>& rows,
                std::vector<PictureScore>& scores) const;
    // Radiance of a pixel in some cases, from its taps; to[case][x].
    void shade_pixel(const std::vector<const detail::Level*>& levels, const detail::Taps& taps,
                     const glm::vec3& to_eye, const std::vector<std::size_t>& cases, std::size_t x,
                     std::vector<std::vector<float>>& to) const;
    // Of cases that share a view, one row of one frame; to[case][pixel].
    void shade_row(const std::vector<const detail::Level*>& levels, const detail::FloorPlan& plan, int frame, int y,
                   const std::vector<std::size_t>& cases,
                   std::vector<std::vector<float>>& to) const;
};

template <class Shade>
void PictureBench::State::sum_row(std::size_t view, int y, const std::vector<std::size_t>& cases,
                                  const Shade& shade, std::vector<detail::RowSums>& to) const
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
                    static_cast<double>(detail::shown(line[i][x], exposure[cases[i]]) - known[at]);
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

}  // namespace petrichor::texproc

#endif
