#include "texproc/prefilter/detail/walk.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "texproc/area.h"
#include "texproc/detail/parallel.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kDirectLevels = 5;  // these gather level 0 themselves
constexpr int kMeans = 8;

int cells_kept(std::size_t level)
{
    return level <= 5 ? 256 : level <= 7 ? 512 : 1024;
}

Means load_means(const Image& image, int x, int y)
{
    const float* m = &image.pixels[image.index(x, y, 0)];
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7]};
}

void store_means(Image& image, int x, int y, const Means& m)
{
    float* to = &image.pixels[image.index(x, y, 0)];
    const float all[kMeans] = {m.nx, m.ny, m.nz, m.p, m.alpha2, m.vx, m.vy, m.vz};
    std::copy(all, all + kMeans, to);
}

void add_own_lobes(const Cells& cells, Means& m)
{
    double x = 0, y = 0, z = 0;
    for (std::size_t i = 0; i < cells.nx.size(); ++i) {
        const double w = static_cast<double>(cells.weight[i] * lobe_length(cells.alpha2[i]));
        x += w * static_cast<double>(cells.nx[i]);
        y += w * static_cast<double>(cells.ny[i]);
        z += w * static_cast<double>(cells.nz[i]);
    }
    m.vx = static_cast<float>(x);
    m.vy = static_cast<float>(y);
    m.vz = static_cast<float>(z);
}

// Means of one row of texels of any level, straight from level 0, without cells.
void means_row(const MapSurface& surface, const Footprint& rows,
               const std::vector<Footprint>& columns, bool own_lobes, int y, Image& out)
{
    SurfaceRow row;
    const std::size_t width = static_cast<std::size_t>(surface.width);
    std::vector<double> sum(columns.size() * kMeans, 0.0);
    for (std::size_t j = 0; j < rows.weights.size(); ++j) {
        fetch(surface, rows.first + static_cast<int>(j), row);
        std::vector<float> length;
        if (own_lobes) {
            length.resize(width);
            for (std::size_t i = 0; i < width; ++i) {
                length[i] = lobe_length((row.p[i] * row.p[i]) * (row.p[i] * row.p[i]));
            }
        }
        for (std::size_t c = 0; c < columns.size(); ++c) {
            double* s = &sum[c * kMeans];
            for (std::size_t i = 0; i < columns[c].weights.size(); ++i) {
                const std::size_t at = static_cast<std::size_t>(columns[c].first) + i;
                const double w = static_cast<double>(columns[c].weights[i] * rows.weights[j]);
                const float p = row.p[at];
                const double nx = static_cast<double>(row.nx[at]);
                const double ny = static_cast<double>(row.ny[at]);
                const double nz = static_cast<double>(row.nz[at]);
                s[0] += w * nx;
                s[1] += w * ny;
                s[2] += w * nz;
                s[3] += w * static_cast<double>(p);
                s[4] += w * static_cast<double>(std::max((p * p) * (p * p), kMinAlpha2));
                if (!own_lobes) continue;
                const double lw = w * static_cast<double>(length[at]);
                s[5] += lw * nx;
                s[6] += lw * ny;
                s[7] += lw * nz;
            }
        }
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t k = 0; k < kMeans; ++k) {
            out.pixels[out.index(static_cast<int>(c), y, static_cast<int>(k))] =
                static_cast<float>(sum[c * kMeans + k]);
        }
    }
}

// The cells of a texel of level k from those of the level below: all that its area touches, each by
// the share of it that is covered.
void join(const std::vector<Cells>& below, int below_width, const Footprint& x, const Footprint& y,
          int limit, Cells& cells)
{
    cells.clear();
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
        for (std::size_t i = 0; i < x.weights.size(); ++i) {
            const Cells& child = below[static_cast<std::size_t>(y.first + static_cast<int>(j)) *
                                           static_cast<std::size_t>(below_width) +
                                       static_cast<std::size_t>(x.first) + i];
            const float w = x.weights[i] * y.weights[j];
            for (std::size_t c = 0; c < child.nx.size(); ++c) {
                cells.add(child.nx[c], child.ny[c], child.nz[c], child.alpha2[c],
                          w * child.weight[c]);
            }
        }
    }
    merge(cells, limit, 4 * limit);
}

}  // namespace

void walk(const MapSurface& surface, const WalkOptions& options,
          const std::function<void(const MipTexel&)>& visit)
{
    const std::vector<LevelSize> sizes = level_sizes(surface.width, surface.height);
    std::vector<Image> means(sizes.size());
    std::vector<Cells> lists, next;
    std::atomic<std::size_t> done{0};
    const double rows_in_all = 2.0 * surface.height;  // level k counts for 2^k rows of level 0
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        const auto [width, height] = sizes[k];
        const std::vector<Footprint> columns = footprints(surface.width, width);
        const std::vector<Footprint> rows = footprints(surface.height, height);
        Image& level = means[k];
        const bool direct = k <= kDirectLevels && options.cells;
        // Only the next level that does not gather looks at means.
        if (!direct || k == kDirectLevels) level = Image(width, height, kMeans, ColorSpace::Data);
        const bool keep_lists = options.cells && k >= kDirectLevels && k + 1 < sizes.size();
        if (keep_lists) {
            next.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
        }
        // Means of levels whose texels join whole texels of the one below come from there.
        const bool nested =
            k > 1 && 2 * width == sizes[k - 1].width && 2 * height == sizes[k - 1].height &&
            surface.width % sizes[k - 1].width == 0 && surface.height % sizes[k - 1].height == 0;
        if (!direct && nested) level = area_reduced(means[k - 1], width, height, options.threads);
        std::vector<Footprint> child_columns, child_rows;
        if (options.cells && !direct) {
            child_columns = footprints(sizes[k - 1].width, width);
            child_rows = footprints(sizes[k - 1].height, height);
        }
        parallel_for(static_cast<std::size_t>(height), options.threads, [&](std::size_t j) {
            const int y = static_cast<int>(j);
            thread_local Cells cells;
            std::vector<SurfaceRow> fetched;
            const auto skipped = [&](int x) {
                return options.wanted && !options.wanted(static_cast<int>(k), x, y);
            };
            if (direct) {
                fetched.resize(rows[j].weights.size());
                for (std::size_t r = 0; r < fetched.size(); ++r) {
                    fetch(surface, rows[j].first + static_cast<int>(r), fetched[r]);
                }
            } else if (!nested) {
                means_row(surface, rows[j], columns, options.own_lobes, y, level);
            }
            for (int x = 0; x < width; ++x) {
                const std::size_t i = static_cast<std::size_t>(x);
                Means m;
                if (skipped(x) && !keep_lists) continue;
                if (direct) {
                    gather(fetched, static_cast<std::size_t>(rows[j].first), columns[i], rows[j],
                           cells, m);
                    if (options.own_lobes) add_own_lobes(cells, m);
                    if (!level.empty()) store_means(level, x, y, m);
                    merge(cells, cells_kept(k), 4 * cells_kept(k));
                } else {
                    m = load_means(level, x, y);
                    if (options.cells) {
                        join(lists, sizes[k - 1].width, child_columns[i], child_rows[j],
                             cells_kept(k), cells);
                    }
                }
                if (keep_lists) next[j * static_cast<std::size_t>(width) + i] = cells;
                if (skipped(x)) continue;
                visit({static_cast<int>(k), x, y, m, options.cells ? &cells : nullptr});
            }
            if (options.progress) {
                const std::size_t so_far = done += std::size_t{1} << std::min<std::size_t>(k, 20);
                options.progress(std::min(1.0, static_cast<double>(so_far) / rows_in_all / 4.0));
            }
        });
        if (keep_lists) lists = std::move(next);
        if (k >= 2) means[k - 1] = Image();
    }
}

}  // namespace petrichor::texproc::detail
