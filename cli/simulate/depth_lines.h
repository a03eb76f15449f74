#ifndef PETRICHOR_CLI_SIMULATE_DEPTH_LINES_H
#define PETRICHOR_CLI_SIMULATE_DEPTH_LINES_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::cli {

/// Depths at which a map of snow has lines, m: multiples of 1, 2 or 5 times a power of ten, two to
/// six of them where the snow is deep enough, none at or below 0.3 m, where its colour tells.
std::vector<double> depth_levels_m(double deepest_m);

/// The colour of line `i` of `count`: the deeper the darker.
std::array<double, 3> depth_line_color(std::size_t i, std::size_t count);

/// Draws the lines into a picture of 8-bit RGB. A pixel is on a line where the pixel to its right
/// or the one below lies on the other side of it; NaN is no snow map's.
///   depth_m  one a pixel
void draw_depth_lines(std::span<const double> depth_m, std::size_t width,
                      std::span<const double> levels_m, std::span<std::uint8_t> rgb);

}  // namespace petrichor::cli

#endif
