// BC6H: lines through the half floats of a block, as integers (so that errors are relative), refined
// by least squares and stored in the finest mode that holds them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "texproc/codecs/blocks/detail/bc6h_modes.h"
#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/encode_bc6h.h"

namespace petrichor::texproc::detail {

namespace {

using Color = std::array<float, 3>;
using Line = std::array<Color, 2>;

struct Input {
    float texel[3][16];  // half floats as integers with a sign
    Color weight;
    bool is_signed;
};

// Modes with the same bits of the first endpoint, finest first; -1 ends a row.
constexpr int kTwoLines[6][4] = {{2, 3, 4, -1}, {0, -1}, {5, -1}, {6, 7, 8, -1}, {1, -1}, {9, -1}};
constexpr int kOneLine[4][4] = {{13, -1}, {12, -1}, {11, -1}, {10, -1}};

struct Trial {
    int mode = -1, partition = 0;
    int endpoint[4][3] = {};
    int index[16] = {};
    float error = std::numeric_limits<float>::infinity();
};

// The stored number whose half float is nearest.
int quantized(float half, int bits, bool is_signed)
{
    const float most = is_signed ? 32767.0f : 65535.0f;
    const float size = std::abs(half) + 0.5f;
    const float wide = std::clamp(size * (is_signed ? 32.0f : 64.0f) / 31.0f, 0.0f, most);
    const bool negative = is_signed && half < 0.0f;
    const int top = (1 << (is_signed ? bits - 1 : bits)) - 1;
    const int near = static_cast<int>(wide) >> (16 - bits);
    int best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (int value = std::max(near - 1, 0); value <= std::min(near + 1, top); ++value) {
        const int read = bc6h_half(bc6h_unquantized(value, bits, is_signed), is_signed);
        const float off = std::abs(static_cast<float>(read) - std::abs(half));
        if (off < least) {
            least = off;
            best = value;
        }
    }
    return negative ? -best : best;
}

struct Texels {
    int at[16];
    int count = 0;
};
Texels texels_of(int regions, int partition, int region)
{
    Texels all;
    for (int t = 0; t < 16; ++t)
        if (bc7_subset(regions, partition, t) == region) all.at[all.count++] = t;
    return all;
}

// The line of least squared distances; what it leaves over goes to `rest`.
Line fitted_line(const Input& in, const Texels& texels, float& rest)
{
    Color mean{}, axis{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int i = 0; i < texels.count; ++i) mean[c] += in.texel[c][texels.at[i]];
        mean[c] /= static_cast<float>(texels.count);
    }
    float moment[3][3] = {};
    for (int i = 0; i < texels.count; ++i) {
        Color d;
        for (std::size_t c = 0; c < 3; ++c)
            d[c] = (in.texel[c][texels.at[i]] - mean[c]) * std::sqrt(in.weight[c]);
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) moment[a][b] += d[a] * d[b];
    }
    // Power iteration from the channel that varies most.
    std::size_t widest = 0;
    for (std::size_t c = 1; c < 3; ++c)
        if (moment[c][c] > moment[widest][widest]) widest = c;
    for (std::size_t c = 0; c < 3; ++c) axis[c] = moment[widest][c];
    float length = 0.0f;
    for (int turn = 0; turn < 5; ++turn) {
        length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        if (!(length > 0.0f)) break;
        Color next{};
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) next[a] += moment[a][b] * axis[b] / length;
        axis = next;
    }
    length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    rest = std::max(moment[0][0] + moment[1][1] + moment[2][2] - length, 0.0f);
    if (!(length > 0.0f)) return {mean, mean};
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (int i = 0; i < texels.count; ++i) {
        float along = 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            along += (in.texel[c][texels.at[i]] - mean[c]) * std::sqrt(in.weight[c]) * axis[c] /
                     length;
        low = std::min(low, along);
        high = std::max(high, along);
    }
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        const float step = axis[c] / length / std::max(std::sqrt(in.weight[c]), 1e-6f);
        line[0][c] = mean[c] + low * step;
        line[1][c] = mean[c] + high * step;
    }
    return line;
}

// The endpoints that are best for the chosen indices.
Line refined_line(const Input& in, const Texels& texels, const int (&index)[16],
                  const int* weights, const Line& before)
{
    float aa = 0.0f, ab = 0.0f, bb = 0.0f;
    Color at{}, bt{};
    for (int i = 0; i < texels.count; ++i) {
        const float b = static_cast<float>(weights[index[texels.at[i]]]) / 64.0f, a = 1.0f - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        for (std::size_t c = 0; c < 3; ++c) {
            at[c] += a * in.texel[c][texels.at[i]];
            bt[c] += b * in.texel[c][texels.at[i]];
        }
    }
    const float det = aa * bb - ab * ab;
    if (!(det > 1e-4f)) return before;
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        line[0][c] = (at[c] * bb - bt[c] * ab) / det;
        line[1][c] = (bt[c] * aa - at[c] * ab) / det;
    }
    return line;
}

// The first mode of a row that holds the endpoints, or -1.
int mode_that_holds(const int* modes, const int (&endpoint)[4][3])
{
    for (; *modes >= 0; ++modes) {
        const Bc6hMode& mode = kBc6hModes[*modes];
        bool holds = true;
        for (int e = 1; mode.transformed && e < 2 * mode.regions; ++e)
            for (int c = 0; c < 3; ++c) {
                const int most = 1 << (mode.delta[c] - 1);
                const int apart = endpoint[e][c] - endpoint[0][c];
                holds &= apart >= -most && apart < most;
            }
        if (holds) return *modes;
    }
    return -1;
}

// Nearest colours of the lines as they would be read; turns lines round where the format needs the
// first index to be small.
bool choose_indices(const Input& in, const int* modes, int partition, const Texels* texels,
                    Trial& trial)
{
    const Bc6hMode& first = kBc6hModes[modes[0]];
    const int index_bits = first.regions == 2 ? 3 : 4, count = 1 << index_bits;
    const int* weights = bc7_weights(index_bits);
    trial.error = 0.0f;
    trial.partition = partition;
    for (int r = 0; r < first.regions; ++r) {
        float palette[3][16];
        for (int c = 0; c < 3; ++c) {
            const int a = bc6h_unquantized(trial.endpoint[2 * r][c], first.bits, in.is_signed);
            const int b = bc6h_unquantized(trial.endpoint[2 * r + 1][c], first.bits, in.is_signed);
            for (int k = 0; k < count; ++k)
                palette[c][k] = static_cast<float>(
                    bc6h_half((a * (64 - weights[k]) + b * weights[k] + 32) >> 6, in.is_signed));
        }
        for (int i = 0; i < texels[r].count; ++i) {
            const int t = texels[r].at[i];
            float cost[16] = {};
            for (std::size_t c = 0; c < 3; ++c) {
                const float value = in.texel[c][t], weight = in.weight[c];
                for (int k = 0; k < count; ++k) {
                    const float off = palette[c][k] - value;
                    cost[k] += weight * off * off;
                }
            }
            int best = 0;
            for (int k = 1; k < count; ++k)
                if (cost[k] < cost[best]) best = k;
            trial.index[t] = best;
            trial.error += cost[best];
        }
        if (trial.index[bc7_anchor(first.regions, partition, r)] >= count / 2) {
            for (int c = 0; c < 3; ++c)
                std::swap(trial.endpoint[2 * r][c], trial.endpoint[2 * r + 1][c]);
            for (int i = 0; i < texels[r].count; ++i)
                trial.index[texels[r].at[i]] = count - 1 - trial.index[texels[r].at[i]];
        }
    }
    trial.mode = mode_that_holds(modes, trial.endpoint);
    return trial.mode >= 0;
}

// Could the endpoints be held one way round or the other?
bool may_hold(const int* modes, const int (&endpoint)[4][3])
{
    if (mode_that_holds(modes, endpoint) >= 0) return true;
    int turned[4][3];
    std::copy(&endpoint[0][0], &endpoint[0][0] + 12, &turned[0][0]);
    std::swap(turned[0], turned[1]);
    return mode_that_holds(modes, turned) >= 0;
}

// Lines in the finest modes that hold them.
void try_lines(const Input& in, int regions, int partition, const Texels* texels,
               const Line* fitted, int refinements, Trial& best)
{
    const int rows = regions == 2 ? 6 : 4;
    const int* weights = bc7_weights(regions == 2 ? 3 : 4);
    for (int row = 0; row < rows; ++row) {
        const int* modes = regions == 2 ? kTwoLines[row] : kOneLine[row];
        const int bits = kBc6hModes[modes[0]].bits;
        std::array<Line, 2> lines{fitted[0], fitted[regions - 1]};
        bool held = false;
        for (int turn = 0; turn <= refinements; ++turn) {
            Trial trial;
            for (int e = 0; e < 2 * regions; ++e)
                for (std::size_t c = 0; c < 3; ++c)
                    trial.endpoint[e][c] =
                        quantized(lines[static_cast<std::size_t>(e / 2)]
                                       [static_cast<std::size_t>(e % 2)][c],
                                  bits, in.is_signed);
            if (!may_hold(modes, trial.endpoint)) break;
            if (choose_indices(in, modes, partition, texels, trial)) {
                held = true;
                if (trial.error < best.error) best = trial;
            }
            if (trial.error == 0.0f) break;
            for (int r = 0; r < regions; ++r) {
                const auto at = static_cast<std::size_t>(r);
                lines[at] = refined_line(in, texels[r], trial.index, weights, lines[at]);
            }
        }
        if (held) return;  // coarser modes hold the same lines less well
    }
}

void store(const Trial& trial, std::byte* to)
{
    const Bc6hMode& mode = kBc6hModes[trial.mode];
    BitWriter bits;
    bits.put(kBc6hModeCodes[trial.mode], trial.mode < 2 ? 2 : 5);
    each_bc6h_bit(mode.fields, [&](int e, int c, int bit) {
        int value = trial.partition;
        if (e >= 0) {
            value = trial.endpoint[e][c];
            if (e > 0 && mode.transformed) value -= trial.endpoint[0][c];
        }
        bits.put((value >> bit) & 1, 1);
    });
    const int index_bits = mode.regions == 2 ? 3 : 4;
    for (int t = 0; t < 16; ++t) {
        const int region = bc7_subset(mode.regions, trial.partition, t);
        const bool anchor = t == bc7_anchor(mode.regions, trial.partition, region);
        bits.put(trial.index[t], index_bits - (anchor ? 1 : 0));
    }
    bits.store(to);
}

struct Effort {
    int partitions, refinements;
};
Effort effort_of(BlockQuality quality)
{
    switch (quality) {
        case BlockQuality::Fast:
            return {1, 1};
        case BlockQuality::Normal:
            return {4, 2};
        case BlockQuality::Best:
            return {32, 5};
    }
    return {};
}

}  // namespace

void encode_bc6h(const HalfTexels& texels, const BlockOptions& options, bool is_signed,
                 std::byte* to)
{
    constexpr int kMost = 0x7bff;  // the largest finite half float
    Input in;
    in.is_signed = is_signed;
    for (std::size_t c = 0; c < 3; ++c) {
        in.weight[c] = std::max(options.weights[c], 0.0f);
        for (std::size_t t = 0; t < 16; ++t) {
            const int bits = texels.plane[c][t];
            const int size = (bits & 0x7fff) > 0x7c00 ? 0 : std::min(bits & 0x7fff, kMost);
            const bool negative = (bits & 0x8000) != 0;
            in.texel[c][t] = static_cast<float>(!negative ? size : is_signed ? -size : 0);
        }
    }
    const Effort effort = effort_of(options.quality);
    Trial best;
    float rest = 0.0f;
    const Texels all = texels_of(1, 0, 0);
    const Line line = fitted_line(in, all, rest);
    try_lines(in, 1, 0, &all, &line, effort.refinements, best);

    // Two lines where one leaves more than the steps between its colours do.
    if (best.error > 0.0f && (rest > 0.0f || best.error > 16.0f)) {
        struct Split {
            int partition;
            float rest;
        };
        std::array<Split, 32> splits;
        for (int p = 0; p < 32; ++p) {
            float sum = 0.0f;
            for (int r = 0; r < 2; ++r) {
                fitted_line(in, texels_of(2, p, r), rest);
                sum += rest;
            }
            splits[static_cast<std::size_t>(p)] = {p, sum};
        }
        std::stable_sort(splits.begin(), splits.end(),
                         [](const Split& a, const Split& b) { return a.rest < b.rest; });
        for (int k = 0; k < effort.partitions; ++k) {
            const int p = splits[static_cast<std::size_t>(k)].partition;
            const Texels parts[2] = {texels_of(2, p, 0), texels_of(2, p, 1)};
            const Line lines[2] = {fitted_line(in, parts[0], rest), fitted_line(in, parts[1], rest)};
            try_lines(in, 2, p, parts, lines, effort.refinements, best);
        }
    }
    store(best, to);
}

}  // namespace petrichor::texproc::detail
