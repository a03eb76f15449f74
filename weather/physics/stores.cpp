#include "weather/physics/stores.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/physics/detail/uniform_relief.h"

namespace petrichor::weather {

namespace {

double piece_mm(const Hypsometry& relief)
{
    return relief.depth_mm / static_cast<double>(relief.area_fraction.size() - 1);
}

}  // namespace

double Hypsometry::capacity_kg_m2() const
{
    return area_fraction.empty() ? 0.5 * depth_mm : volume_mm.back();
}

Hypsometry uniform_hypsometry(double depth_mm)
{
    if (!(depth_mm > 0.0) || !std::isfinite(depth_mm)) {
        throw Error(
            "stores: the depth of a relief must be above 0 mm, got " + std::to_string(depth_mm),
            "Give the height difference between low and high points in mm.");
    }
    Hypsometry relief;
    relief.depth_mm = depth_mm;
    return relief;
}

Hypsometry make_hypsometry(std::span<const float> heights, double depth_mm, int steps)
{
    Hypsometry relief = uniform_hypsometry(depth_mm);
    if (heights.empty()) {
        throw Error("stores: the height map has no texels",
                    "Give a height map with at least one texel.");
    }
    if (steps < 2 || steps > 256) {
        throw Error("stores: steps must be 2..256, got " + std::to_string(steps),
                    "Use 32 steps unless you have a reason.");
    }
    const auto n = static_cast<std::size_t>(steps);
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    if (!std::isfinite(*low) || !std::isfinite(*high)) {
        throw Error("stores: the height map has values that are not finite",
                    "Repair the height map: every texel must be a number.");
    }
    const double floor = static_cast<double>(*low);
    const double range = static_cast<double>(*high) - floor;
    if (!(range > 0.0)) return relief;  // flat: any curve with the same capacity will do
    // Counts per bin, then the running sum: F at the upper edge of each bin.
    std::vector<std::size_t> bins(n, 0);
    for (const float h : heights) {
        const double z = (static_cast<double>(h) - floor) / range * static_cast<double>(n);
        if (!std::isfinite(z)) {
            throw Error("stores: the height map has values that are not finite",
                        "Repair the height map: every texel must be a number.");
        }
        ++bins[std::min(n - 1, static_cast<std::size_t>(z))];
    }
    relief.area_fraction.assign(n + 1, 0.0);
    relief.volume_mm.assign(n + 1, 0.0);
    const double piece = depth_mm / static_cast<double>(n);
    std::size_t below = 0;
    for (std::size_t i = 0; i < n; ++i) {
        below += bins[i];
        relief.area_fraction[i + 1] =
            static_cast<double>(below) / static_cast<double>(heights.size());
        relief.volume_mm[i + 1] =
            relief.volume_mm[i] +
            0.5 * piece * (relief.area_fraction[i] + relief.area_fraction[i + 1]);
    }
    return relief;
}

double stored_kg_m2(const Hypsometry& relief, double level_mm)
{
    const double h = std::clamp(level_mm, 0.0, relief.depth_mm);
    if (relief.area_fraction.empty()) return detail::uniform_volume_at(h, relief.depth_mm);
    const double piece = piece_mm(relief);
    const auto i = std::min(static_cast<std::size_t>(h / piece), relief.area_fraction.size() - 2);
    const double x = h - static_cast<double>(i) * piece;
    const double slope = (relief.area_fraction[i + 1] - relief.area_fraction[i]) / piece;
    return relief.volume_mm[i] + x * (relief.area_fraction[i] + 0.5 * slope * x);
}

double water_level_mm(const Hypsometry& relief, double stored)
{
    if (!(stored > 0.0)) return 0.0;
    if (stored >= relief.capacity_kg_m2()) return relief.depth_mm;
    if (relief.area_fraction.empty()) return detail::uniform_level_of(stored, relief.depth_mm);
    const auto& volume = relief.volume_mm;
    const auto upper = std::upper_bound(volume.begin(), volume.end(), stored);
    const auto i =
        std::min(static_cast<std::size_t>(upper - volume.begin()) - 1, volume.size() - 2);
    // Within a piece V is a + b x + c x^2; the root in the form that stays exact for c -> 0.
    const double piece = piece_mm(relief);
    const double b = relief.area_fraction[i];
    const double slope = (relief.area_fraction[i + 1] - relief.area_fraction[i]) / piece;
    const double v = stored - volume[i];
    const double root = std::sqrt(b * b + 2.0 * slope * v);
    const double x = b + root > 0.0 ? 2.0 * v / (b + root) : 0.0;
    return std::min(static_cast<double>(i) * piece + std::min(x, piece), relief.depth_mm);
}

double wet_area(const Hypsometry& relief, double level_mm)
{
    const double h = std::clamp(level_mm, 0.0, relief.depth_mm);
    if (relief.area_fraction.empty()) return detail::uniform_area_at(h, relief.depth_mm);
    const double piece = piece_mm(relief);
    const auto i = std::min(static_cast<std::size_t>(h / piece), relief.area_fraction.size() - 2);
    const double x = (h - static_cast<double>(i) * piece) / piece;
    return relief.area_fraction[i] + x * (relief.area_fraction[i + 1] - relief.area_fraction[i]);
}

}  // namespace petrichor::weather
