// What every material is built from: rows in parallel, noise over a tile, blur, courses of stones.
#include <cassert>
#include <thread>

#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

void for_rows(int count, int threads, const std::function<void(int, int)>& rows)
{
    const int parts = std::clamp(threads, 1, std::max(1, count));
    if (parts == 1) {
        rows(0, count);
        return;
    }
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(parts));
    for (int part = 0; part < parts; ++part) {
        const int first = static_cast<int>(static_cast<long long>(count) * part / parts);
        const int last = static_cast<int>(static_cast<long long>(count) * (part + 1) / parts);
        workers.emplace_back([&rows, first, last] { rows(first, last); });
    }
}

namespace {

// Adds one octave to a row. The gradients of a cell are fetched once, when the row enters it. Each octave lies a part of
// a cell off the others: gradient noise is 0 on its lattice, and lattices that share points show as lines.
void add_octave(float* row, int size, float y, int cells_x, int cells_y, float amplitude,
                std::uint32_t seed)
{
    const float shift_x = hash_unit(seed, 1), shift_y = hash_unit(seed, 2);
    const float position_y = y * static_cast<float>(cells_y) / static_cast<float>(size) + shift_y;
    const int y0 = static_cast<int>(position_y);
    const float fy = position_y - static_cast<float>(y0);
    const int top = wrap_index(y0, cells_y);
    const int low = wrap_index(y0 + 1, cells_y);
    const float v = noise_fade(fy);
    const float scale = static_cast<float>(cells_x) / static_cast<float>(size);
    const float strength = amplitude * kNoiseScale;

    int cell = -1;
    // Along a row inside a cell the noise is a0 + b0 fx at the left, a1 + b1 (fx - 1) at the right.
    float a0 = 0.0f, b0 = 0.0f, a1 = 0.0f, b1 = 0.0f;
    for (int i = 0; i < size; ++i) {
        const float position_x = (static_cast<float>(i) + 0.5f) * scale + shift_x;
        const int x0 = static_cast<int>(position_x);
        if (x0 != cell) {
            cell = x0;
            const int left = wrap_index(x0, cells_x);
            const int right = wrap_index(x0 + 1, cells_x);
            const NoiseGradient g00 = noise_gradient(left, top, seed);
            const NoiseGradient g10 = noise_gradient(right, top, seed);
            const NoiseGradient g01 = noise_gradient(left, low, seed);
            const NoiseGradient g11 = noise_gradient(right, low, seed);
            b0 = g00.x + v * (g01.x - g00.x);
            b1 = g10.x + v * (g11.x - g10.x);
            a0 = g00.y * fy + v * (g01.y * (fy - 1.0f) - g00.y * fy);
            a1 = g10.y * fy + v * (g11.y * (fy - 1.0f) - g10.y * fy);
        }
        const float fx = position_x - static_cast<float>(x0);
        const float u = noise_fade(fx);
        const float left_value = a0 + b0 * fx;
        const float right_value = a1 + b1 * (fx - 1.0f);
        row[i] += strength * (left_value + u * (right_value - left_value));
    }
}

}  // namespace

std::vector<float> noise_layer(const MaterialSurface& surface, const NoiseLayer& layer)
{
    const int size = surface.size;
    std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                              0.0f);
    struct Octave {
        int cells_x, cells_y;
        float amplitude;
        std::uint32_t seed;
    };
    std::vector<Octave> octaves;
    float amplitude = 1.0f;
    float energy = 0.0f;
    int cells_x = surface.cells(layer.feature_x_m);
    int cells_y = surface.cells(layer.feature_y_m);
    for (int k = 0; k < layer.octaves; ++k) {
        energy += amplitude * amplitude;
        if (2 * cells_x <= size && 2 * cells_y <= size) {
            octaves.push_back({cells_x, cells_y, amplitude,
                               hash_u32(surface.seed * 0x9e3779b1u + layer.salt * 977u +
                                        static_cast<std::uint32_t>(k))});
        }
        amplitude *= layer.gain;
        cells_x *= 2;
        cells_y *= 2;
    }
    const float normalise = 1.0f / std::sqrt(energy);
    for_rows(size, surface.threads, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            float* row =
                values.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(size);
            for (const Octave& octave : octaves) {
                add_octave(row, size, static_cast<float>(j) + 0.5f, octave.cells_x, octave.cells_y,
                           octave.amplitude * normalise, octave.seed);
            }
        }
    });
    return values;
}

std::vector<float> box_blur(const std::vector<float>& values, int size, int radius, int threads)
{
    const auto n = static_cast<std::size_t>(size);
    std::vector<float> across(values.size());
    std::vector<float> result(values.size());
    const int r = std::clamp(radius, 0, (size - 1) / 2);
    const double weight = 1.0 / static_cast<double>(2 * r + 1);
    for_rows(size, threads, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            const float* in = values.data() + static_cast<std::size_t>(j) * n;
            float* out = across.data() + static_cast<std::size_t>(j) * n;
            double sum = 0.0;
            for (int i = -r; i <= r; ++i) sum += static_cast<double>(in[wrap_index(i, size)]);
            for (int i = 0; i < size; ++i) {
                out[i] = static_cast<float>(sum * weight);
                const int enters = i + r + 1 >= size ? i + r + 1 - size : i + r + 1;
                const int leaves = i - r < 0 ? i - r + size : i - r;
                sum += static_cast<double>(in[enters]) - static_cast<double>(in[leaves]);
            }
        }
    });
    // Columns: every part runs down its own columns, with one running sum a column.
    for_rows(size, threads, [&](int first, int last) {
        std::vector<double> sums(static_cast<std::size_t>(last - first), 0.0);
        for (int j = -r; j <= r; ++j) {
            const float* in = across.data() + static_cast<std::size_t>(wrap_index(j, size)) * n;
            for (int i = first; i < last; ++i) {
                sums[static_cast<std::size_t>(i - first)] += static_cast<double>(in[i]);
            }
        }
        for (int j = 0; j < size; ++j) {
            float* out = result.data() + static_cast<std::size_t>(j) * n;
            const float* enters =
                across.data() + static_cast<std::size_t>(wrap_index(j + r + 1, size)) * n;
            const float* leaves =
                across.data() + static_cast<std::size_t>(wrap_index(j - r, size)) * n;
            for (int i = first; i < last; ++i) {
                double& sum = sums[static_cast<std::size_t>(i - first)];
                out[i] = static_cast<float>(sum * weight);
                sum += static_cast<double>(enters[i]) - static_cast<double>(leaves[i]);
            }
        }
    });
    return result;
}

Courses::Courses(float tile_m, const CourseRule& rule, std::uint32_t seed)
    : tile_m_(tile_m), slant_(rule.slant), seed_(seed)
{
    assert(rule.rows >= 1 && rule.stone_length_m > 0.0f);
    const float row_m = tile_m / static_cast<float>(rule.rows);
    for (int j = 0; j <= rule.rows; ++j) {
        const float shift =
            j == 0 || j == rule.rows
                ? 0.0f
                : 0.5f * rule.row_jitter * hash_signed(seed, static_cast<std::uint32_t>(j));
        row_edges_.push_back((static_cast<float>(j) + shift) * row_m);
    }
    for (int j = 0; j < rule.rows; ++j) {
        const std::uint32_t h = hash_cell(j, 17, seed);
        int count = std::max(2, static_cast<int>(std::lround(tile_m / rule.stone_length_m)));
        if (rule.length_jitter > 0.0f && count > 4) count += static_cast<int>(h >> 7) % 3 - 1;
        const float length = tile_m / static_cast<float>(count);
        float start =
            rule.half_bond ? 0.5f * length * static_cast<float>(j & 1) : length * hash_unit(h, 1);
        // Rows of like count must not line up with the row above.
        if (!rule.half_bond) start += 0.5f * length * static_cast<float>(j & 1);
        start -= tile_m * std::floor(start / tile_m);
        Row row;
        for (int i = 0; i < count; ++i) {
            const float shift =
                0.5f * rule.length_jitter * hash_signed(h, 100u + static_cast<std::uint32_t>(i));
            row.edges.push_back(start + (static_cast<float>(i) + shift) * length);
        }
        row.edges.push_back(row.edges.front() + tile_m);
        rows_.push_back(std::move(row));
    }
}

CourseStone Courses::find(float x_m, float y_m) const
{
    float y = y_m - tile_m_ * std::floor(y_m / tile_m_);
    if (y >= tile_m_) y = 0.0f;
    const int row_count = static_cast<int>(rows_.size());
    int j = std::min(static_cast<int>(y / tile_m_ * static_cast<float>(row_count)), row_count - 1);
    while (j > 0 && y < row_edges_[static_cast<std::size_t>(j)]) --j;
    while (j + 1 < row_count && y >= row_edges_[static_cast<std::size_t>(j) + 1]) ++j;

    CourseStone stone{};
    stone.top_m = row_edges_[static_cast<std::size_t>(j)] + (y_m - y);
    stone.bottom_m = row_edges_[static_cast<std::size_t>(j) + 1] + (y_m - y);
    const float middle = 0.5f * (stone.top_m + stone.bottom_m);

    const std::vector<float>& edges = rows_[static_cast<std::size_t>(j)].edges;
    const int count = static_cast<int>(edges.size()) - 1;
    const float turn = std::floor((x_m - edges.front()) / tile_m_);
    const float x = x_m - turn * tile_m_;
    int i = std::clamp(static_cast<int>((x - edges.front()) / tile_m_ * static_cast<float>(count)),
                       0, count - 1);
    const auto slant_of = [&](int edge) {
        return slant_ * hash_signed(hash_cell(edge % count, j, seed_), 7);
    };
    const auto edge_at = [&](int edge) {
        return edges[static_cast<std::size_t>(edge)] + slant_of(edge) * (y_m - middle);
    };
    while (i > 0 && x < edge_at(i)) --i;
    while (i + 1 < count && x >= edge_at(i + 1)) ++i;
    // The slanted first line may leave a sliver that belongs to the stone across the seam.
    float seam = 0.0f;
    if (i == 0 && x < edge_at(0)) {
        i = count - 1;
        seam = -tile_m_;
    } else if (i == count - 1 && x >= edge_at(count)) {
        i = 0;
        seam = tile_m_;
    }
    stone.left_m = edges[static_cast<std::size_t>(i)] + seam + turn * tile_m_;
    stone.right_m = edges[static_cast<std::size_t>(i) + 1] + seam + turn * tile_m_;
    stone.slant_left = slant_of(i);
    stone.slant_right = slant_of(i + 1);
    stone.id = hash_cell(i, j, seed_ ^ 0x51ed270bu);
    return stone;
}

float rounded_inside(float to_side_x, float to_side_y, float radius)
{
    const float qx = std::max(radius - to_side_x, 0.0f);
    const float qy = std::max(radius - to_side_y, 0.0f);
    return radius - std::sqrt(qx * qx + qy * qy);
}

}  // namespace petrichor::texproc::detail
