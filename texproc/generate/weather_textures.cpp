// The small textures that the weather passes sample: drops, snow mask, snow and water bumps.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "texproc/filter/bake.h"
#include "texproc/generate/noise.h"

namespace petrichor::texproc {

namespace {

void check_size(int size)
{
    if (size < 16 || size > 8192) {
        throw Error("bake: the size must be in 16..8192, got " + std::to_string(size), "Use 256.");
    }
}

// Octaves of tiling gradient noise, about [-1, 1].
std::vector<float> octaves(int size, int cells, int count, float gain, std::uint32_t seed)
{
    std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            float sum = 0.0f, weight = 1.0f;
            int period = cells;
            for (int o = 0; o < count; ++o) {
                const float scale = static_cast<float>(period) / static_cast<float>(size);
                sum += weight * gradient_noise((static_cast<float>(x) + 0.5f) * scale,
                                               (static_cast<float>(y) + 0.5f) * scale, period,
                                               period, seed + static_cast<std::uint32_t>(o));
                weight *= gain;
                period *= 2;
            }
            values[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                   static_cast<std::size_t>(x)] = sum;
        }
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
    constexpr int kCells = 12;
    Image out(size, size, 4, ColorSpace::Data);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) * kCells / static_cast<float>(size);
            const float v = (static_cast<float>(y) + 0.5f) * kCells / static_cast<float>(size);
            float* to = &out.at(x, y, 0);
            to[1] = to[2] = 0.5f;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int i = static_cast<int>(u) + dx, j = static_cast<int>(v) + dy;
                    const std::uint32_t h =
                        hash_cell(wrap_index(i, kCells), wrap_index(j, kCells), seed);
                    const float radius = 0.45f + 0.5f * hash_unit(h, 3);
                    const float du = u - (static_cast<float>(i) + hash_unit(h, 1));
                    const float dv = v - (static_cast<float>(j) + hash_unit(h, 2));
                    const float distance = std::sqrt(du * du + dv * dv);
                    const float envelope = 1.0f - distance / radius;
                    if (envelope <= to[0]) continue;  // the drop that is nearest its centre wins
                    to[0] = envelope;
                    const float scale = distance > 1e-6f ? 0.5f / distance : 0.0f;
                    to[1] = 0.5f + du * scale;
                    to[2] = 0.5f + dv * scale;
                    to[3] = hash_unit(h, 4);
                }
            }
        }
    }
    return out;
}

Image snow_mask(int size, std::uint32_t seed)
{
    check_size(size);
    Image out(size, size, 4, ColorSpace::Data);
    std::vector<float> mask = octaves(size, 4, 6, 0.6f, seed);
    // The middle knot makes the mean 0.715.
    match_quantiles(
        mask, {{{0.0f, 0.35f}, {0.05f, 0.51f}, {0.5f, 0.7611f}, {0.95f, 0.85f}, {1.0f, 0.95f}}});
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            out.at(x, y, 2) = mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                                   static_cast<std::size_t>(x)];
        }
    }
    store_normals(octaves(size, 16, 3, 0.7f, seed + 100), size, 0.004f * static_cast<float>(size),
                  out, 3, 1);
    return out;
}

Image snow_water_bump(int size, std::uint32_t seed)
{
    check_size(size);
    Image out(size, size, 4, ColorSpace::Data);
    store_normals(octaves(size, 6, 4, 0.5f, seed), size, 0.004f * static_cast<float>(size), out, 3,
                  1);
    std::vector<float> gloss = octaves(size, 8, 5, 0.7f, seed + 200);
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
