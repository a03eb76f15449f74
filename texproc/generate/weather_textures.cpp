// The small textures that the weather passes sample: drops, snow mask, snow and water bumps.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "formulas/weather/weather_maps.h"
#include "texproc/filter/bake.h"
#include "texproc/generate/noise.h"

namespace petrichor::texproc {

namespace {

glm::vec2 place(int x, int y, int size)
{
    return (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
}

void check_size(int size)
{
    if (size < 16 || size > 8192) {
        throw Error("bake: the size must be in 16..8192, got " + std::to_string(size), "Use 256.");
    }
}

// A formula of the place on the tile, texel by texel.
std::vector<float> drawn(int size, std::uint32_t seed, float (*formula)(glm::vec2, std::uint32_t))
{
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) values.push_back(formula(place(x, y, size), seed));
    }
    return values;
}

// x and y of the normals of a height, stored in channels `cx` and `cy`, +y up.
void store_normals(const std::vector<float>& height, int size, float strength, Image& out, int cx,
                   int cy)
{
    const auto at = [&](int x, int y) {
        return height[static_cast<std::size_t>(wrap_index(y, size)) *
                          static_cast<std::size_t>(size) +
                      static_cast<std::size_t>(wrap_index(x, size))];
    };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float nx = -strength * (at(x + 1, y) - at(x - 1, y));
            const float ny = strength * (at(x, y + 1) - at(x, y - 1));
            const float s = 0.5f / std::sqrt(1.0f + nx * nx + ny * ny);
            out.at(x, y, cx) = 0.5f + nx * s;
            out.at(x, y, cy) = 0.5f + ny * s;
        }
    }
}

// Of store_normals, for the slopes that the renderer draws.
float steepness(int size)
{
    return 0.5f * shared::kSnowSteepness * static_cast<float>(size);
}

// Gives values the distribution whose quantiles are these (rank, value) knots: ranks decide, so
// that mean and quantiles are met whatever the noise was.
void match_quantiles(std::vector<float>& values, const std::array<std::array<float, 2>, 5>& knots)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    for (std::size_t r = 0; r < order.size(); ++r) {
        const float rank = (static_cast<float>(r) + 0.5f) / static_cast<float>(order.size());
        std::size_t k = 1;
        while (k + 1 < knots.size() && rank > knots[k][0]) ++k;
        const float t = (rank - knots[k - 1][0]) / (knots[k][0] - knots[k - 1][0]);
        values[order[r]] = knots[k - 1][1] + t * (knots[k][1] - knots[k - 1][1]);
    }
}

}  // namespace

Image ripple_drops(int size, std::uint32_t seed)
{
    check_size(size);
    Image out(size, size, 4, ColorSpace::Data);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec4 drop = shared::rain_drops(place(x, y, size), seed);
            for (int c = 0; c < 4; ++c) out.at(x, y, c) = drop[c];
        }
    }
    return out;
}

Image snow_mask(int size, std::uint32_t seed)
{
    check_size(size);
    Image out(size, size, 4, ColorSpace::Data);
    std::vector<float> mask = drawn(size, seed, shared::snow_preference);
    // The middle knot makes the mean 0.715.
    match_quantiles(
        mask, {{{0.0f, 0.35f}, {0.05f, 0.51f}, {0.5f, 0.7611f}, {0.95f, 0.85f}, {1.0f, 0.95f}}});
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            out.at(x, y, 2) = mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                                   static_cast<std::size_t>(x)];
        }
    }
    store_normals(drawn(size, seed, shared::snow_relief), size, steepness(size), out, 3, 1);
    return out;
}

Image snow_water_bump(int size, std::uint32_t seed)
{
    check_size(size);
    Image out(size, size, 4, ColorSpace::Data);
    // Another piece of the same relief: the two lie over each other.
    store_normals(drawn(size, seed + 100, shared::snow_relief), size, steepness(size), out, 3, 1);
    std::vector<float> gloss = drawn(size, seed, shared::snow_gloss);
    match_quantiles(gloss,
                    {{{0.0f, 0.1f}, {0.25f, 0.25f}, {0.5f, 0.35f}, {0.9f, 0.5f}, {1.0f, 0.9f}}});
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            out.at(x, y, 2) = gloss[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                                    static_cast<std::size_t>(x)];
        }
    }
    return out;
}

}  // namespace petrichor::texproc
