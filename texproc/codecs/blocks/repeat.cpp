#include "texproc/codecs/blocks/detail/repeat.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "base/parallel.h"

namespace petrichor::texproc::detail {

namespace {

// How far back bytes are taken from: along the row, and beside the block above.
constexpr int kBack = 48, kAbove = 8;
constexpr int kChunkBlocks = 4096;  // at least so many blocks know of each other

// What a compressor spends (zstd, roughly): a byte as it is; a match at a new distance, with the
// logarithm of the distance; at the distance of the match before; one that goes on.
constexpr float kByteBits = 8.0f, kMatchBits = 12.0f, kAgainBits = 9.0f;

constexpr float kNever = std::numeric_limits<float>::infinity();

struct Run {
    int first, count;
};
// Which bytes may be taken over together, longest first. BC7 and UASTC begin with the mode and the
// ends and close with the indices; the others are halves of two ends and six bytes of indices.
constexpr Run kLong[] = {{0, 16}, {2, 14}, {0, 12}, {4, 12}, {0, 11}, {0, 10}, {6, 10},
                         {0, 9},  {7, 9},  {0, 8},  {8, 8},  {9, 7},  {0, 7},  {10, 6},
                         {0, 6},  {11, 5}, {0, 5},  {12, 4}, {0, 4}};
constexpr Run kHalves[] = {{0, 16}, {0, 8}, {8, 8}, {2, 6}, {10, 6}};
constexpr Run kColor[] = {{0, 8}, {0, 4}, {4, 4}};
constexpr Run kOne[] = {{0, 8}, {2, 6}};

std::span<const Run> runs_of(Block block)
{
    switch (block) {
        case Block::Bc7:
        case Block::Uastc:
            return kLong;
        case Block::Bc1:
            return kColor;
        case Block::Bc4:
            return kOne;
        default:
            return kHalves;
    }
}

using Bytes = std::array<std::byte, 16>;

// What must be equal for a part of a block to mean the same in another: the mode of BC7, and what
// the bits that tell it in UASTC hold.
int mode_of(Block block, const std::byte* bytes)
{
    const unsigned first = std::to_integer<unsigned>(bytes[0]);
    if (block == Block::Bc7) return std::countr_zero(first | 256u);
    return block == Block::Uastc ? static_cast<int>(first & 127u) : 0;
}

class Chunk {
public:
    Chunk(std::span<std::byte> blocks, int across, int first_row, const BlockRow& format,
          const std::function<BlockTexels(int, int)>& texels, const std::array<float, 4>& weights,
          float price, float most)
        : blocks_(blocks),
          across_(across),
          first_row_(first_row),
          format_(format),
          texels_(texels),
          price_(price),
          most_(16.0f * most * most)
    {
        float sum = 0.0f;
        const int channels = std::min(format.channels, 4);
        for (int c = 0; c < channels; ++c) sum += weights[static_cast<std::size_t>(c)];
        for (int c = 0; c < channels; ++c)
            weight_[static_cast<std::size_t>(c)] =
                sum > 0.0f ? weights[static_cast<std::size_t>(c)] / sum : 0.0f;
    }

    void run()
    {
        const int count = static_cast<int>(blocks_.size() / format_.bytes);
        for (int i = 0; i < count; ++i) place(i);
    }

private:
    std::byte* at(int block)
    {
        return blocks_.data() + static_cast<std::size_t>(block) * format_.bytes;
    }

    // Infinite where it is above `most`.
    float error_of(const std::byte* bytes, const BlockTexels& aim, float most) const
    {
        BlockBytes read;
        format_.decode(bytes, BlockSign::Unsigned, read);
        const std::size_t channels = static_cast<std::size_t>(format_.channels);
        float total = 0.0f;
        for (std::size_t c = 0; c < channels; ++c) {
            int sum = 0;
            for (std::size_t t = 0; t < 16; ++t) {
                const int off = std::to_integer<int>(read[t * channels + c]) - aim.plane[c][t];
                sum += off * off;
            }
            total += weight_[c] * static_cast<float>(sum);
            if (total > most) return kNever;
        }
        return total;
    }

    float match_bits(int distance, int first) const
    {
        if (distance == distance_) return first == 0 && ends_ ? 0.0f : kAgainBits;
        return kMatchBits +
               std::log2(static_cast<float>(distance) * static_cast<float>(format_.bytes));
    }

    // Earlier blocks worth a look, nearest first, each content once.
    void gather(int i)
    {
        candidates_.clear();
        const auto offer = [&](int j) {
            if (j < 0 || j >= i) return;
            for (const int other : candidates_)
                if (std::memcmp(at(other), at(j), format_.bytes) == 0) return;
            candidates_.push_back(j);
        };
        if (distance_ > 0) offer(i - distance_);
        for (int back = 1; back <= kBack; ++back) offer(i - back);
        for (int side = -kAbove; side <= kAbove; ++side)
            if (across_ + side > kBack) offer(i - across_ - side);
    }

    void place(int i)
    {
        const BlockTexels aim = texels_(i % across_, first_row_ + i / across_);
        std::byte* own = at(i);
        const float least_error = error_of(own, aim, kNever);
        if (least_error >= most_) {
            ends_ = false;
            return;
        }
        gather(i);
        Bytes best{};
        std::memcpy(best.data(), own, format_.bytes);
        Run taken{0, 0};
        int from = 0;
        const int bytes = static_cast<int>(format_.bytes);
        float cost = least_error + price_ * kByteBits * static_cast<float>(bytes);
        const auto attempt = [&](const Bytes& base, float spent, Run run, int j) {
            const float bits =
                spent - kByteBits * static_cast<float>(run.count) + match_bits(i - j, run.first);
            // No other bytes are nearer to the texels than the encoder's, nearly.
            if (0.98f * least_error + price_ * bits >= cost) return;
            Bytes trial = base;
            std::memcpy(trial.data() + run.first, at(j) + run.first,
                        static_cast<std::size_t>(run.count));
            const float error = error_of(trial.data(), aim, std::min(cost - price_ * bits, most_));
            if (!(error + price_ * bits < cost)) return;
            cost = error + price_ * bits;
            best = trial;
            taken = run;
            from = j;
        };
        Bytes base = best;
        const int mode = mode_of(format_.block, own);
        for (const Run& run : runs_of(format_.block))
            for (const int j : candidates_)
                if (run.count == bytes || mode_of(format_.block, at(j)) == mode)
                    attempt(base, kByteBits * static_cast<float>(bytes), run, j);
        if (taken.count > 0 && taken.count < bytes) {  // a second run beside the first
            base = best;
            const Run one = taken;
            const float spent =
                kByteBits * static_cast<float>(bytes - one.count) + match_bits(i - from, one.first);
            const int first_from = from;
            for (const Run& run : runs_of(format_.block)) {
                if (run.first < one.first + one.count && one.first < run.first + run.count)
                    continue;
                for (const int j : candidates_)
                    if (mode_of(format_.block, at(j)) == mode_of(format_.block, base.data()))
                        attempt(base, spent, run, j);
            }
            // The later of the two is what the next block goes on from.
            if (taken.first < one.first) taken = one, from = first_from;
        }
        std::memcpy(own, best.data(), format_.bytes);
        if (taken.count > 0) distance_ = i - from;
        ends_ = taken.count > 0 && taken.first + taken.count == bytes;
    }

    std::span<std::byte> blocks_;
    int across_, first_row_;
    const BlockRow& format_;
    const std::function<BlockTexels(int, int)>& texels_;
    float price_, most_;  // squared error a block: of a bit, and at most
    std::array<float, 4> weight_{};
    std::vector<int> candidates_;
    int distance_ = 0;   // of the match before
    bool ends_ = false;  // it reached the end of its block
};

}  // namespace

void repeat_blocks(std::span<std::byte> blocks, int across, const BlockRow& format,
                   const std::function<BlockTexels(int, int)>& texels,
                   const std::array<float, 4>& weights, float price, float most,
                   int threads)
{
    const int rows = static_cast<int>(blocks.size() / format.bytes) / across;
    const int rows_a_chunk = std::max(1, (kChunkBlocks + across - 1) / across);
    const int chunks = (rows + rows_a_chunk - 1) / rows_a_chunk;
    parallel_for(static_cast<std::size_t>(chunks), threads, [&](std::size_t chunk) {
        const int first = static_cast<int>(chunk) * rows_a_chunk;
        const int last = std::min(rows, first + rows_a_chunk);
        const std::size_t row = static_cast<std::size_t>(across) * format.bytes;
        Chunk(blocks.subspan(static_cast<std::size_t>(first) * row,
                             static_cast<std::size_t>(last - first) * row),
              across, first, format, texels, weights, price, most)
            .run();
    });
}

}  // namespace petrichor::texproc::detail
