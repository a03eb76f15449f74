#include "cli/simulate/relief.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "texproc/codecs/files/io.h"
#include "texproc/filter/bake.h"

namespace petrichor::cli {
namespace {

constexpr double kFlat_mm = 1e-3;  // a store that holds nothing to speak of

// Hollows know their area from the brim down; the curve of a store goes from the bottom up.
weather::Hypsometry hypsometry_of(const texproc::Hollows& hollows, double range_m)
{
    const double depth_mm = static_cast<double>(hollows.deepest) * range_m * 1000.0;
    if (!(depth_mm > kFlat_mm)) return weather::uniform_hypsometry(kFlat_mm);
    weather::Hypsometry relief = weather::uniform_hypsometry(depth_mm);
    relief.area_fraction.assign(hollows.covered.rbegin(), hollows.covered.rend());
    const double piece_mm = depth_mm / static_cast<double>(relief.area_fraction.size() - 1);
    relief.volume_mm.assign(relief.area_fraction.size(), 0.0);
    for (std::size_t i = 1; i < relief.volume_mm.size(); ++i) {
        relief.volume_mm[i] =
            relief.volume_mm[i - 1] +
            0.5 * piece_mm * (relief.area_fraction[i - 1] + relief.area_fraction[i]);
    }
    return relief;
}

std::string described(const char* name, const weather::Hypsometry& relief)
{
    char text[120];
    std::snprintf(text, sizeof text, "%s up to %.2f mm deep on %.1f %% of the area, %.3f kg/m2",
                  name, relief.depth_mm, 100.0 * weather::wet_area(relief, relief.depth_mm),
                  relief.capacity_kg_m2());
    return text;
}

}  // namespace

Relief read_relief(const std::filesystem::path& height_map, double range_m)
{
    if (!(range_m > 0.0 && range_m <= 10.0)) {
        throw Error(
            "--height-range-m must be above 0 and at most 10, got " + std::to_string(range_m),
            "Give the height difference between black and white in metres, for example 0.02.");
    }
    Image height = texproc::read_image(height_map);
    for (const float v : height.pixels) {
        if (!std::isfinite(v))
            throw Error("height map: " + height_map.string() + " has values that are not finite",
                        "Repair the map.");
    }
    Relief relief;
    const texproc::Hollows cracks = texproc::cracks(height);
    relief.cracks = hypsometry_of(cracks, range_m);
    // Puddles are what the hollows hold above full cracks.
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x)
            height.at(x, y, 0) += cracks.deepest * cracks.depth.at(x, y, 0);
    }
    relief.puddles = hypsometry_of(texproc::puddles(height), range_m);
    relief.note = "relief of " + height_map.filename().string() + ": " +
                  described("cracks", relief.cracks) + "; " + described("puddles", relief.puddles);
    return relief;
}

}  // namespace petrichor::cli
