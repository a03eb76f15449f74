#include "cli/simulate/depth_lines.h"

#include <cmath>

namespace petrichor::cli {
namespace {

constexpr double kTold_m = 0.3;  // thinner snow is told by its colour
constexpr std::size_t kMost = 6;

}  // namespace

std::vector<double> depth_levels_m(double deepest_m)
{
    if (!(deepest_m > kTold_m && deepest_m < 1e4)) return {};
    for (double power = 0.01;; power *= 10.0) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double step_m = digit * power;
            std::vector<double> levels;
            for (int i = 1; static_cast<double>(i) * step_m < deepest_m; ++i) {
                if (static_cast<double>(i) * step_m > kTold_m)
                    levels.push_back(static_cast<double>(i) * step_m);
                if (levels.size() > kMost) break;
            }
            if (levels.size() <= kMost) return levels;
        }
    }
}

std::array<double, 3> depth_line_color(std::size_t i, std::size_t count)
{
    const double x =
        count < 2 ? 1.0 : static_cast<double>(i) / static_cast<double>(count - 1);
    return {0.36 - 0.26 * x, 0.62 - 0.54 * x, 0.86 - 0.44 * x};
}

void draw_depth_lines(std::span<const double> depth_m, std::size_t width,
                      std::span<const double> levels_m, std::span<std::uint8_t> rgb)
{
    for (std::size_t p = 0; p < depth_m.size(); ++p) {
        const auto crosses = [&](std::size_t other, double level_m) {
            return (depth_m[p] < level_m && depth_m[other] >= level_m) ||
                   (depth_m[p] >= level_m && depth_m[other] < level_m);
        };
        for (std::size_t i = 0; i < levels_m.size(); ++i) {
            const bool right = (p + 1) % width != 0 && crosses(p + 1, levels_m[i]);
            const bool below = p + width < depth_m.size() && crosses(p + width, levels_m[i]);
            if (!right && !below) continue;
            const auto color = depth_line_color(i, levels_m.size());
            for (std::size_t k = 0; k < 3; ++k)
                rgb[3 * p + k] = static_cast<std::uint8_t>(std::lround(255.0 * color[k]));
        }
    }
}

}  // namespace petrichor::cli
