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

    // Infinite where it is above `most`. `aim` in the order of decoded texels.
    float error_of(const std::byte* bytes, const BlockBytes& aim, float most) const
    {
        BlockBytes read;
        format_.decode(bytes, BlockSign::Unsigned, read);
        const std::size_t channels = static_cast<std::size_t>(format_.channels);
        int sums[4] = {};
        if (channels == 4) {
            sum_squares<4>(read, aim, sums);
        } else if (channels == 2) {
            sum_squares<2>(read, aim, sums);
        } else {
            sum_squares<1>(read, aim, sums);
        }
        float total = 0.0f;
        for (std::size_t c = 0; c < channels; ++c) total += weight_[c] * static_cast<float>(sums[c]);
        return total > most ? kNever : total;
    }

    template <std::size_t channels>
    static void sum_squares(const BlockBytes& read, const BlockBytes& aim, int (&sums)[4])
    {
        for (std::size_t t = 0; t < 16; ++t) {
            for (std::size_t c = 0; c < channels; ++c) {
                const int off = std::to_integer<int>(read[t * channels + c]) - std::to_integer<int>(aim[t * channels + c]);
                sums[c] += off * off;
            }
        }
    }

    float match_bits(int distance, int first) const
    {
        if (distance == distance_) return first == 0 && ends_ ? 0.0f : kAgainBits;
        return kMatchBits +
               std::log2(static_cast<float>(distance) * static_cast<float>(format_.bytes));
    }

    // An earlier block worth a look.
    struct Candidate {
        int block, mode;
        float bits;  // of a match that does not begin the block
        std::array<std::uint64_t, 2> content;
    };

    // Earlier blocks worth a look, nearest first, each content once.
    void gather(int i)
    {
        candidates_.clear();
        const auto offer = [&](int j) {
            if (j < 0 || j >= i) return;
            Candidate found{j, 0, 0.0f, {}};
            std::memcpy(found.content.data(), at(j), format_.bytes);
            for (const Candidate& other : candidates_)
                if (other.content == found.content) return;
            found.mode = mode_of(format_.block, at(j));
            found.bits = match_bits(i - j, 1);
            candidates_.push_back(found);
        };
        if (distance_ > 0) offer(i - distance_);
        for (int back = 1; back <= kBack; ++back) offer(i - back);
        for (int side = -kAbove; side <= kAbove; ++side)
            if (across_ + side > kBack) offer(i - across_ - side);
    }

    void place(int i)
    {
        const std::size_t channels = static_cast<std::size_t>(format_.channels);
        const BlockTexels texels = texels_(i % across_, first_row_ + i / across_);
        BlockBytes aim;
        for (std::size_t t = 0; t < 16; ++t)
            for (std::size_t c = 0; c < channels; ++c) aim[t * channels + c] = std::byte{texels.plane[c][t]};
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
        float best_error = least_error;
        float cost = least_error + price_ * kByteBits * static_cast<float>(bytes);
        const auto attempt = [&](const Bytes& base, float base_error, float spent, Run run, const Candidate& c) {
            const float match = run.first == 0 && ends_ && i - c.block == distance_ ? 0.0f : c.bits;
            const float bits = spent - kByteBits * static_cast<float>(run.count) + match;
            // No other bytes are nearer to the texels than the encoder's, nearly.
            if (0.98f * least_error + price_ * bits >= cost) return;
            Bytes trial = base;
            std::memcpy(trial.data() + run.first, at(c.block) + run.first,
                        static_cast<std::size_t>(run.count));
            const float error = trial == base ? base_error : error_of(trial.data(), aim, std::min(cost - price_ * bits, most_));
            if (!(error + price_ * bits < cost)) return;
            cost = error + price_ * bits;
            best = trial;
            best_error = error;
            taken = run;
            from = c.block;
        };
        Bytes base = best;
        const int mode = mode_of(format_.block, own);
        for (const Run& run : runs_of(format_.block))
            for (const Candidate& c : candidates_)
                if (run.count == bytes || c.mode == mode)
                    attempt(base, least_error, kByteBits * static_cast<float>(bytes), run, c);
        if (taken.count > 0 && taken.count < bytes) {  // a second run beside the first
            base = best;
            const float base_error = best_error;
            const Run one = taken;
            const float spent =
                kByteBits * static_cast<float>(bytes - one.count) + match_bits(i - from, one.first);
            const int first_from = from;
            const int base_mode = mode_of(format_.block, base.data());
            for (const Run& run : runs_of(format_.block)) {
                if (run.first < one.first + one.count && one.first < run.first + run.count)
                    continue;
                for (const Candidate& c : candidates_)
                    if (c.mode == base_mode) attempt(base, base_error, spent, run, c);
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
    std::vector<Candidate> candidates_;
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
