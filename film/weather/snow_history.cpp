#include "film/weather/snow_history.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "base/portable_math.h"

namespace petrichor::film {
namespace {

constexpr double kNone_m = 1e-6;

}  // namespace

struct SnowHistory::Grid {
    std::function<double(double)> depth_m;
    double film_s = 0.0;
    int steps = 1;
    std::once_flag made;
    // At the points: the depth, the share that is left of what lay when snow last began, and how often it began.
    std::vector<double> depths_m, kept;
    std::vector<int> begun;

    void make()
    {
        for (int i = 0; i <= steps; ++i) {
            const double depth = std::max(depth_m(film_s * i / steps), 0.0);
            if (i == 0) {
                depths_m.push_back(depth);
                kept.push_back(1.0);
                begun.push_back(0);
                continue;
            }
            const double before = depths_m.back();
            const bool gone = depth < kNone_m && before >= kNone_m;
            kept.push_back(gone ? 1.0 : before >= kNone_m ? kept.back() * std::min(depth / before, 1.0) : kept.back());
            begun.push_back(begun.back() + (gone ? 1 : 0));
            depths_m.push_back(depth);
        }
    }

    struct Moment {
        double depth_m = 0.0, kept = 1.0;
        int begun = 0;
    };
    Moment at(double s) const
    {
        const double along = film_s > 0.0 ? std::clamp(s / film_s, 0.0, 1.0) * steps : 0.0;
        const auto i = static_cast<std::size_t>(std::min(along, static_cast<double>(steps) - 1.0));
        const double u = along - static_cast<double>(i);
        Moment m{depths_m[i] + (depths_m[i + 1] - depths_m[i]) * u, kept[i], begun[i]};
        if (u >= 1.0) return {depths_m[i + 1], kept[i + 1], begun[i + 1]};
        if (depths_m[i] >= kNone_m) m.kept *= std::min(m.depth_m / depths_m[i], 1.0);
        return m;
    }
};

SnowHistory::SnowHistory(std::function<double(double film_s)> depth_m, double film_s, int steps)
    : grid_(std::make_shared<Grid>())
{
    grid_->depth_m = std::move(depth_m);
    grid_->film_s = film_s;
    grid_->steps = std::max(steps, 1);
}

double SnowHistory::left(double made_s, double now_s) const
{
    if (!grid_) return 1.0;
    Grid& g = *grid_;
    std::call_once(g.made, [&g] { g.make(); });
    const Grid::Moment then = g.at(made_s), now = g.at(now_s);
    if (now.depth_m < kNone_m) return 1.0;  // nothing lies that could show it
    if (then.begun != now.begun || then.depth_m < kNone_m || !(then.kept > 0.0)) return 0.0;
    const double old_m = std::min(then.depth_m * now.kept / then.kept, now.depth_m);
    const double fresh_m = now.depth_m - old_m;
    return old_m < kNone_m ? 0.0 : old_m / now.depth_m * portable_exp(-fresh_m / old_m);
}

}  // namespace petrichor::film
