#include "texproc/filter/detail/morphology.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/parallel.h"

namespace petrichor::texproc::detail {

namespace {

// out[i] = largest of line[i .. i + count - 1], round and round (van Herk 1992, Gil and Werman
// 1993): the largest from the start of a block of `count` and to the end of one meet in every
// window.
void sliding_largest(std::vector<float>& line, std::size_t count)
{
    const std::size_t length = line.size();
    if (count >= length) {
        std::fill(line.begin(), line.end(), *std::max_element(line.begin(), line.end()));
        return;
    }
    const std::size_t padded = length + count - 1;
    std::vector<float> forward(padded), backward(padded);
    for (std::size_t i = 0; i < padded; ++i) {
        const float value = line[i % length];
        forward[i] = i % count == 0 ? value : std::max(forward[i - 1], value);
    }
    for (std::size_t i = padded; i-- > 0;) {
        const float value = line[i % length];
        backward[i] =
            i + 1 == padded || (i + 1) % count == 0 ? value : std::max(backward[i + 1], value);
    }
    for (std::size_t i = 0; i < length; ++i)
        line[i] = std::max(backward[i], forward[i + count - 1]);
}

struct Step {
    int x, y;
};

// Slides a window of `count` texels along a direction over every closed line of the torus, and
// moves the result back by `shift` texels of that direction, so that a window of odd length is
// centred. Lines start on row 0; diagonals close after lcm(width, height) texels.
void slide(Image& map, Step step, std::size_t count, int shift, int threads)
{
    if (count <= 1 && shift == 0) return;
    const int w = map.width, h = map.height;
    const bool row = step.y == 0, column = step.x == 0;
    const std::size_t lines = static_cast<std::size_t>(row ? h : column ? w : std::gcd(w, h));
    const std::size_t length = static_cast<std::size_t>(row ? w : column ? h : std::lcm(w, h));
    parallel_for(lines, threads, [&](std::size_t number) {
        std::vector<float> line(length);
        const auto walk = [&](const auto& visit) {
            int x = row ? 0 : static_cast<int>(number), y = row ? static_cast<int>(number) : 0;
            for (std::size_t i = 0; i < length; ++i) {
                visit(map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                 static_cast<std::size_t>(x)],
                      i);
                x += step.x;
                y += step.y;
                x = x >= w ? x - w : x < 0 ? x + w : x;
                y = y >= h ? y - h : y < 0 ? y + h : y;
            }
        };
        walk([&](float& texel, std::size_t i) { line[i] = texel; });
        sliding_largest(line, count);
        const std::size_t back = length - static_cast<std::size_t>(shift) % length;
        walk([&](float& texel, std::size_t i) { texel = line[(i + back) % length]; });
    });
}

// The five texels of a unit diamond.
void small_diamond(Image& map, int threads)
{
    const Image from = map;
    parallel_for(static_cast<std::size_t>(map.height), threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const int up = y == 0 ? map.height - 1 : y - 1, down = y + 1 == map.height ? 0 : y + 1;
        for (int x = 0; x < map.width; ++x) {
            const int left = x == 0 ? map.width - 1 : x - 1, right = x + 1 == map.width ? 0 : x + 1;
            map.at(x, y, 0) = std::max({from.at(x, y, 0), from.at(left, y, 0), from.at(right, y, 0),
                                        from.at(x, up, 0), from.at(x, down, 0)});
        }
    });
}

}  // namespace

Image extreme_within(const Image& map, int radius, float sign, int threads)
{
    Image out = map;
    for (float& v : out.pixels) v *= sign;
    const int square = (radius + 1) / 2, diamond = radius / 2;
    const std::size_t side = 2 * static_cast<std::size_t>(square) + 1;
    slide(out, {1, 0}, side, square, threads);
    slide(out, {0, 1}, side, square, threads);
    if (diamond > 0) {
        // A diamond of radius b is two diagonal segments of b texels and a unit diamond. The
        // segments start at the texel and reach to (2 b - 2, 0): the row is moved back by b - 1.
        const std::size_t segment = static_cast<std::size_t>(diamond);
        slide(out, {1, 1}, segment, 0, threads);
        slide(out, {1, -1}, segment, 0, threads);
        slide(out, {1, 0}, 1, diamond - 1, threads);
        small_diamond(out, threads);
    }
    for (float& v : out.pixels) v *= sign;
    return out;
}

}  // namespace petrichor::texproc::detail
