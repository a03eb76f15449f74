#include "texproc/prefilter/detail/walk.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "texproc/filter/area.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kDirectLevels = 5;  // these gather level 0 themselves
constexpr int kMeans = 8;
constexpr int kTileWidth = 512;  // texels of level 0

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
                length[i] = lobe_length(row.alpha2[i]);
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
                s[4] += w * static_cast<double>(row.alpha2[at]);
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
          int limit, int apart, Cells& cells)
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
    merge(cells, limit, apart * limit);
}

// Grids over level 0.
struct Level {
    std::vector<Footprint> columns, rows;
};

class Walk {
public:
    Walk(const MapSurface& surface, const WalkOptions& options,
         const std::function<void(const MipTexel&)>& visit)
        : surface_(surface),
          options_(options),
          visit_(visit),
          sizes_(level_sizes(surface.width, surface.height)),
          levels_(sizes_.size()),
          means_(sizes_.size())
    {
        for (std::size_t k = 1; k < sizes_.size(); ++k) {
            levels_[k] = {footprints(surface.width, sizes_[k].width),
                          footprints(surface.height, sizes_[k].height)};
        }
    }

    void run()
    {
        const std::size_t direct =
            options_.cells ? std::min(kDirectLevels, sizes_.size() - 1) : std::size_t{0};
        if (direct > 0) gather_levels(direct);
        for (std::size_t k = direct + 1; k < sizes_.size(); ++k) {
            make_means(k);
            if (options_.cells) {
                join_level(k);
            } else {
                visit_means(k);
            }
            means_[k - 1] = Image();
        }
    }

private:
    std::size_t width(std::size_t k) const { return static_cast<std::size_t>(sizes_[k].width); }
    std::size_t height(std::size_t k) const { return static_cast<std::size_t>(sizes_[k].height); }

    bool skipped(std::size_t k, int x, int y) const
    {
        return options_.wanted && !options_.wanted(static_cast<int>(k), x, y);
    }

    void row_done(std::size_t k)
    {
        if (!options_.progress) return;
        const std::size_t rows = done_ += std::size_t{1} << std::min<std::size_t>(k, 20);
        options_.progress(std::min(1.0, static_cast<double>(rows) / (8.0 * surface_.height)));
    }

    void start_lists(std::size_t k, std::vector<Cells>& lists) const
    {
        lists.clear();
        if (k + 1 < sizes_.size()) lists.resize(width(k) * height(k));
    }

    // Levels 1 to `last` together, strip after strip, so that every row of level 0 is decoded once
    // for all of them, but for those that reach over the end of a strip.
    void gather_levels(std::size_t last)
    {
        if (last + 1 < sizes_.size()) {
            means_[last] = Image(sizes_[last].width, sizes_[last].height, kMeans, ColorSpace::Data);
        }
        start_lists(last, lists_);
        // As high as a texel of the last level, less where there are few strips for the threads.
        const int strip = std::clamp(surface_.height / 64, 2, 1 << kDirectLevels);
        const int strips = (surface_.height + strip - 1) / strip;
        parallel_for(static_cast<std::size_t>(strips), options_.threads, [&](std::size_t s) {
            const int first = static_cast<int>(s) * strip;
            gather_strip(last, first, std::min(surface_.height, first + strip));
        });
    }

    // Every row of the levels whose area starts in rows [first, end) of level 0; tile after tile,
    // so that what all levels look at stays near.
    void gather_strip(std::size_t last, int first, int end)
    {
        struct Rows {
            int begin, end;
        };
        std::vector<Rows> wanted(last + 1);
        int below = end;
        for (std::size_t k = 1; k <= last; ++k) {
            const std::vector<Footprint>& rows = levels_[k].rows;
            const auto start_of = [&](int y) {
                const auto at =
                    std::lower_bound(rows.begin(), rows.end(), y,
                                     [](const Footprint& f, int line) { return f.first < line; });
                return static_cast<int>(at - rows.begin());
            };
            wanted[k] = {start_of(first), start_of(end)};
            if (wanted[k].begin == wanted[k].end) continue;
            const Footprint& lowest = rows[static_cast<std::size_t>(wanted[k].end - 1)];
            below = std::max(below, lowest.first + static_cast<int>(lowest.weights.size()));
        }
        thread_local std::vector<SurfaceRow> fetched;  // the next strip needs as much
        fetched.resize(std::max(fetched.size(), static_cast<std::size_t>(below - first)));
        for (int y = first; y < below; ++y) {
            fetch(surface_, y, fetched[static_cast<std::size_t>(y - first)]);
        }
        const int tiles = std::max(1, surface_.width / kTileWidth);
        for (int tile = 0; tile < tiles; ++tile) {
            for (std::size_t k = 1; k <= last; ++k) {
                const auto column = [&](int t) {
                    return static_cast<int>(std::int64_t{sizes_[k].width} * t / tiles);
                };
                for (int y = wanted[k].begin; y < wanted[k].end; ++y) {
                    gather_texels(k, y, column(tile), column(tile + 1), k == last, fetched, first);
                    if (tile + 1 == tiles) row_done(k);
                }
            }
        }
    }

    // Texels [begin, end) of a row.
    void gather_texels(std::size_t k, int y, int begin, int end, bool keep,
                       const std::vector<SurfaceRow>& fetched, int first)
    {
        thread_local Cells cells;
        keep = keep && !lists_.empty();
        for (int x = begin; x < end; ++x) {
            const bool skip = skipped(k, x, y);
            if (skip && !keep) continue;
            Means m;
            gather(fetched, static_cast<std::size_t>(first),
                   levels_[k].columns[static_cast<std::size_t>(x)],
                   levels_[k].rows[static_cast<std::size_t>(y)], cells, m);
            if (options_.own_lobes) add_own_lobes(cells, m);
            merge(cells, cells_kept(k), options_.apart * cells_kept(k));
            if (keep) {
                store_means(means_[k], x, y, m);
                lists_[static_cast<std::size_t>(y) * width(k) + static_cast<std::size_t>(x)] =
                    cells;
            }
            if (!skip) visit_({static_cast<int>(k), x, y, m, &cells});
        }
    }

    // The means of a level whose texels join whole texels of the one below come from there.
    void make_means(std::size_t k)
    {
        const LevelSize size = sizes_[k], below = sizes_[k - 1];
        const bool nested = k > 1 && 2 * size.width == below.width &&
                            2 * size.height == below.height && surface_.width % below.width == 0 &&
                            surface_.height % below.height == 0;
        if (nested) {
            means_[k] = area_reduced(means_[k - 1], size.width, size.height, options_.threads);
            return;
        }
        means_[k] = Image(size.width, size.height, kMeans, ColorSpace::Data);
        parallel_for(height(k), options_.threads, [&](std::size_t y) {
            means_row(surface_, levels_[k].rows[y], levels_[k].columns, options_.own_lobes,
                      static_cast<int>(y), means_[k]);
        });
    }

    void visit_means(std::size_t k)
    {
        parallel_for(height(k), options_.threads, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < sizes_[k].width; ++x) {
                if (skipped(k, x, y)) continue;
                visit_({static_cast<int>(k), x, y, load_means(means_[k], x, y), nullptr});
            }
            row_done(k);
        });
    }

    void join_level(std::size_t k)
    {
        const LevelSize below = sizes_[k - 1];
        const std::vector<Footprint> columns = footprints(below.width, sizes_[k].width);
        const std::vector<Footprint> rows = footprints(below.height, sizes_[k].height);
        std::vector<Cells> next;
        start_lists(k, next);
        parallel_for(height(k), options_.threads, [&](std::size_t row) {
            thread_local Cells cells;
            const int y = static_cast<int>(row);
            for (int x = 0; x < sizes_[k].width; ++x) {
                const bool skip = skipped(k, x, y);
                if (skip && next.empty()) continue;
                const std::size_t at = static_cast<std::size_t>(x);
                join(lists_, below.width, columns[at], rows[row], cells_kept(k), options_.apart,
                     cells);
                if (!next.empty()) next[row * width(k) + at] = cells;
                if (!skip) visit_({static_cast<int>(k), x, y, load_means(means_[k], x, y), &cells});
            }
            row_done(k);
        });
        lists_ = std::move(next);
    }

    const MapSurface& surface_;
    const WalkOptions& options_;
    const std::function<void(const MipTexel&)>& visit_;
    std::vector<LevelSize> sizes_;
    std::vector<Level> levels_;
    std::vector<Image> means_;
    std::vector<Cells> lists_;
    std::atomic<std::size_t> done_{0};
};

}  // namespace

void walk(const MapSurface& surface, const WalkOptions& options,
          const std::function<void(const MipTexel&)>& visit)
{
    Walk(surface, options, visit).run();
}

}  // namespace petrichor::texproc::detail
