#include "texproc/study/detail/elliptic_oracle.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "texproc/prefilter/detail/elliptic_fit.h"
#include "texproc/prefilter/detail/lobe_cost.h"
#include "texproc/prefilter/detail/simplex.h"

namespace petrichor::texproc::detail {

namespace {

constexpr int kNormals = 16;  // of the footprint, beside the mean
constexpr int kAngles = 8;    // of half a turn
constexpr int kWidths = 8;    // alphas, geometric
constexpr std::size_t kStarts = 12;
constexpr int kSteps = 500;  // of a simplex

using Numbers = std::array<float, 5>;  // of elliptic_lobe()

struct Try {
    float error;
    std::size_t normal;
    Numbers numbers;
};

// The mean and normals at equal steps of the cumulated weight, sorted by how far they lean and to
// which side, so that the steps cross the footprint.
std::vector<Direction> normals_to_try(const Cells& cells, const Direction& mean)
{
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < cells.nx.size(); ++i) {
        const double w = static_cast<double>(cells.weight[i]);
        const double x = static_cast<double>(cells.nx[i] - mean.x);
        const double y = static_cast<double>(cells.ny[i] - mean.y);
        xx += w * x * x;
        xy += w * x * y;
        yy += w * y * y;
    }
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const float ax = static_cast<float>(std::cos(angle)), ay = static_cast<float>(std::sin(angle));
    std::vector<std::size_t> order(cells.nx.size());
    float whole = 0.0f;
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
        whole += cells.weight[i];
    }
    const auto along = [&](std::size_t i) { return ax * cells.nx[i] + ay * cells.ny[i]; };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return along(a) != along(b) ? along(a) < along(b) : a < b;
    });
    std::vector<Direction> normals{mean};
    float sum = 0.0f;
    for (const std::size_t i : order) {
        sum += cells.weight[i];
        const auto passed = static_cast<int>(kNormals * sum / whole - 0.5f) + 1;
        if (passed >= static_cast<int>(normals.size()) &&
            normals.size() <= static_cast<std::size_t>(kNormals)) {
            normals.push_back({cells.nx[i], cells.ny[i], cells.nz[i]});
        }
    }
    return normals;
}

bool same_basin(const Try& a, const Try& b)
{
    if (a.normal != b.normal) return false;
    const auto near = [&](std::size_t i, float by) {
        return std::abs(a.numbers[i] - b.numbers[i]) <= by;
    };
    return near(2, 1.5f) && near(3, 1.5f) && near(4, 0.5f);
}

}  // namespace

EllipticLobe best_elliptic(Samples& samples, const std::array<double, kViews>& mass,
                           const Cells& cells, const Direction& mean, double narrowest)
{
    std::vector<Frame> frames;
    for (const Direction& n : normals_to_try(cells, mean)) frames.push_back(frame_about(n));
    const auto error = [&](std::size_t normal, const Numbers& x) {
        const EllipticLobe lobe = elliptic_lobe(frames[normal], {1.0f, 0.0f}, x);
        return lobe.nz < 0.02f ? 2.0f : static_cast<float>(measure(samples, mass, lobe).error);
    };
    const auto low = static_cast<float>(2.0 * std::log(std::max(1e-3, 0.7 * narrowest)));
    std::vector<Try> tries;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        for (int i = 0; i < kWidths; ++i) {
            for (int j = 0; j <= i; ++j) {
                const auto at = [&](int k) {
                    return low * static_cast<float>(kWidths - 1 - k) / (kWidths - 1);
                };
                for (int k = 0; k < (i == j ? 1 : kAngles); ++k) {
                    const float angle = 3.14159265f * static_cast<float>(k) / kAngles;
                    const Numbers x{0.0f, 0.0f, at(i), at(j), angle};
                    tries.push_back({error(n, x), n, x});
                }
            }
        }
    }
    std::stable_sort(tries.begin(), tries.end(),
                     [](const Try& a, const Try& b) { return a.error < b.error; });
    std::vector<Try> starts;
    for (const Try& t : tries) {
        if (starts.size() == kStarts) break;
        if (std::none_of(starts.begin(), starts.end(),
                         [&](const Try& s) { return same_basin(s, t); })) {
            starts.push_back(t);
        }
    }
    Try best = tries.front();
    const auto refine = [&](const Try& from, float step) {
        const float lean = step * std::sqrt(std::exp(std::min(from.numbers[2], from.numbers[3])));
        const auto [x, value] =
            simplex<5>(from.numbers, from.error, {lean, lean, 2.0f * step, -2.0f * step, step},
                       kSteps, 1e-6f, [&](const Numbers& y) { return error(from.normal, y); });
        const Try found{value, from.normal, x};
        if (found.error < best.error) best = found;
    };
    for (const Try& start : starts) refine(start, 0.4f);
    // A simplex may collapse on its way: twice more from where the best one ended.
    for (int again = 0; again < 2; ++again) refine(Try(best), 0.2f);
    return elliptic_lobe(frames[best.normal], {1.0f, 0.0f}, best.numbers);
}

}  // namespace petrichor::texproc::detail
