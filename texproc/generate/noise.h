#ifndef PETRICHOR_TEXPROC_GENERATE_NOISE_H
#define PETRICHOR_TEXPROC_GENERATE_NOISE_H

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "formulas/noise/noise.h"

namespace petrichor::texproc {

// Noise that tiles. Every value is a function of (lattice cell, seed): no stream, no state, so the
// order of evaluation and the number of threads never show. Positions are in cells; a period is the
// number of cells after which the noise repeats, per axis, >= 1.

/// Mixes 32 bits so that neighbouring inputs have unrelated outputs.
inline std::uint32_t hash_u32(std::uint32_t x)
{
    return shared::hash_u(x);
}

/// Hash of a lattice cell.
inline std::uint32_t hash_cell(int x, int y, std::uint32_t seed)
{
    return hash_u32(static_cast<std::uint32_t>(x) * 0x9e3779b1u ^
                    hash_u32(static_cast<std::uint32_t>(y) + seed * 0x85ebca6bu));
}

/// The upper 24 bits as [0, 1).
inline float hash_unit(std::uint32_t h)
{
    return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

/// Member `index` of the family of numbers in [0, 1) that belongs to `h`.
inline float hash_unit(std::uint32_t h, std::uint32_t index)
{
    return hash_unit(hash_u32(h + index * 0x9e3779b9u));
}

/// The same in [-1, 1).
inline float hash_signed(std::uint32_t h, std::uint32_t index)
{
    return 2.0f * hash_unit(h, index) - 1.0f;
}

inline int wrap_index(int i, int period)
{
    const int r = i % period;
    return r < 0 ? r + period : r;
}

/// 0 below low, 1 above high, smooth between. low > high turns it round.
inline float smooth_step(float low, float high, float x)
{
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Gradient of a lattice point: both components in [-1, 1].
struct NoiseGradient {
    float x;
    float y;
};

inline NoiseGradient noise_gradient(int x, int y, std::uint32_t seed)
{
    const std::uint32_t h = hash_cell(x, y, seed);
    return {static_cast<float>(h & 0xffffu) * (1.0f / 32767.5f) - 1.0f,
            static_cast<float>(h >> 16) * (1.0f / 32767.5f) - 1.0f};
}

inline float noise_fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/// Scale that brings gradient noise to about [-1, 1] (standard deviation near 0.4).
inline constexpr float kNoiseScale = 1.9f;

/// Gradient noise, zero on lattice points, about [-1, 1].
inline float gradient_noise(float x, float y, int period_x, int period_y, std::uint32_t seed)
{
    const float floor_x = std::floor(x);
    const float floor_y = std::floor(y);
    const float fx = x - floor_x;
    const float fy = y - floor_y;
    const int x0 = wrap_index(static_cast<int>(floor_x), period_x);
    const int y0 = wrap_index(static_cast<int>(floor_y), period_y);
    const int x1 = x0 + 1 == period_x ? 0 : x0 + 1;
    const int y1 = y0 + 1 == period_y ? 0 : y0 + 1;
    const NoiseGradient g00 = noise_gradient(x0, y0, seed);
    const NoiseGradient g10 = noise_gradient(x1, y0, seed);
    const NoiseGradient g01 = noise_gradient(x0, y1, seed);
    const NoiseGradient g11 = noise_gradient(x1, y1, seed);
    const float u = noise_fade(fx);
    const float v = noise_fade(fy);
    const float top0 = g00.x * fx + g00.y * fy;
    const float top1 = g10.x * (fx - 1.0f) + g10.y * fy;
    const float low0 = g01.x * fx + g01.y * (fy - 1.0f);
    const float low1 = g11.x * (fx - 1.0f) + g11.y * (fy - 1.0f);
    const float top = top0 + u * (top1 - top0);
    const float low = low0 + u * (low1 - low0);
    return kNoiseScale * (top + v * (low - top));
}

/// The nearest and second nearest of one random point per cell.
struct CellPoint {
    float nearest = 8.0f;  ///< distance in cells
    float second = 8.0f;   ///< distance in cells
    float dx = 0.0f;       ///< from the nearest point to the position
    float dy = 0.0f;
    std::uint32_t id = 0;  ///< hash of the nearest point
};

/// Cellular (Worley) noise. jitter 0: a grid, 1: anywhere in the cell.
inline CellPoint cell_noise(float x, float y, int period_x, int period_y, std::uint32_t seed,
                            float jitter = 1.0f)
{
    CellPoint result;
    const int cell_x = static_cast<int>(std::floor(x));
    const int cell_y = static_cast<int>(std::floor(y));
    float nearest = 64.0f;
    float second = 64.0f;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const std::uint32_t h =
                hash_cell(wrap_index(cell_x + i, period_x), wrap_index(cell_y + j, period_y), seed);
            const float px = static_cast<float>(h & 0xffffu) * (1.0f / 65536.0f) - 0.5f;
            const float py = static_cast<float>(h >> 16) * (1.0f / 65536.0f) - 0.5f;
            const float dx = x - (static_cast<float>(cell_x + i) + 0.5f + jitter * px);
            const float dy = y - (static_cast<float>(cell_y + j) + 0.5f + jitter * py);
            const float d = dx * dx + dy * dy;
            if (d < nearest) {
                second = nearest;
                nearest = d;
                result.dx = dx;
                result.dy = dy;
                result.id = h;
            } else if (d < second) {
                second = d;
            }
        }
    }
    result.nearest = std::sqrt(nearest);
    result.second = std::sqrt(second);
    return result;
}

/// How far a position is from the border of its cell (Quilez 2012): everywhere as wide as it says, where the
/// difference of the two nearest distances is not.
struct CellBorder {
    float distance = 8.0f;  ///< in cells
    std::uint32_t id = 0;   ///< hash of the cell's point
    float middle_x = 0.0f, middle_y = 0.0f;  ///< of the points on both sides, in cells: one for each border
};

inline CellBorder cell_border(float x, float y, int period_x, int period_y, std::uint32_t seed,
                              float jitter = 1.0f)
{
    const int cell_x = static_cast<int>(std::floor(x));
    const int cell_y = static_cast<int>(std::floor(y));
    float to_x[25], to_y[25];
    std::uint32_t ids[25];
    int nearest = 0;
    for (int j = -2, k = 0; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i, ++k) {
            const std::uint32_t h =
                hash_cell(wrap_index(cell_x + i, period_x), wrap_index(cell_y + j, period_y), seed);
            ids[k] = h;
            to_x[k] = static_cast<float>(cell_x + i) + 0.5f +
                      jitter * (static_cast<float>(h & 0xffffu) * (1.0f / 65536.0f) - 0.5f) - x;
            to_y[k] = static_cast<float>(cell_y + j) + 0.5f +
                      jitter * (static_cast<float>(h >> 16) * (1.0f / 65536.0f) - 0.5f) - y;
            if (to_x[k] * to_x[k] + to_y[k] * to_y[k] <
                to_x[nearest] * to_x[nearest] + to_y[nearest] * to_y[nearest])
                nearest = k;
        }
    }
    CellBorder border;
    border.id = ids[nearest];
    for (int k = 0; k < 25; ++k) {
        const float dx = to_x[k] - to_x[nearest], dy = to_y[k] - to_y[nearest];
        const float apart = dx * dx + dy * dy;
        if (k == nearest || apart < 1e-8f) continue;
        const float along = 0.5f * ((to_x[k] + to_x[nearest]) * dx + (to_y[k] + to_y[nearest]) * dy);
        const float distance = along / std::sqrt(apart);
        if (distance >= border.distance) continue;
        border.distance = distance;
        border.middle_x = x + 0.5f * (to_x[k] + to_x[nearest]);
        border.middle_y = y + 0.5f * (to_y[k] + to_y[nearest]);
    }
    return border;
}

}  // namespace petrichor::texproc

#endif
