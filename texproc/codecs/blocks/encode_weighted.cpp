#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

namespace petrichor::texproc {

namespace {

constexpr int kReach = 2;  // endpoints tried beyond the outermost values and within them

// One channel of a block: numbers to reach, in codes, and what being off by one costs.
struct Texels {
    std::array<float, 16> aim{}, weight{};
};

Texels texels_of(const Image& image, const Image& weights, int channel, int bx, int by)
{
    Texels texels;
    for (int t = 0; t < 16; ++t) {
        // Past an edge: the same again, at no cost.
        const int x = std::min(4 * bx + t % 4, image.width - 1);
        const int y = std::min(4 * by + t / 4, image.height - 1);
        const bool inside = x == 4 * bx + t % 4 && y == 4 * by + t / 4;
        texels.aim[static_cast<std::size_t>(t)] =
            255.0f * std::clamp(image.at(x, y, channel), 0.0f, 1.0f);
        texels.weight[static_cast<std::size_t>(t)] = inside ? weights.at(x, y, 0) : 0.0f;
    }
    return texels;
}

// How far the nearest of eight values is from every texel, weighted and summed.
float total_cost(const Texels& texels, const std::array<float, 8>& palette)
{
    std::array<float, 16> least;
    least.fill(256.0f);
    for (const float value : palette) {
        for (std::size_t t = 0; t < 16; ++t) {
            const float off = std::abs(texels.aim[t] - value);
            least[t] = off < least[t] ? off : least[t];
        }
    }
    float lanes[4] = {};
    for (std::size_t t = 0; t < 16; t += 4) {
        for (std::size_t l = 0; l < 4; ++l) lanes[l] += texels.weight[t + l] * least[t + l];
    }
    return (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
}

void encode_channel(const Texels& texels, std::byte* to)
{
    const auto [low, high] = std::minmax_element(texels.aim.begin(), texels.aim.end());
    const int first = static_cast<int>(std::floor(*low)), last = static_cast<int>(std::ceil(*high));
    const int in = kReach + (last - first) / 16;
    int r0 = last, r1 = first;
    float least = total_cost(texels, detail::exact_bc4_palette(r0, r1));
    for (int a = std::max(0, first - kReach); a <= std::min(255, first + in); ++a) {
        for (int b = std::max(0, last - in); b <= std::min(255, last + kReach); ++b) {
            for (const auto& [p, q] : {std::pair(b, a), std::pair(a, b)}) {
                const float cost = total_cost(texels, detail::exact_bc4_palette(p, q));
                if (cost < least) {
                    least = cost;
                    r0 = p;
                    r1 = q;
                }
            }
        }
    }
    const auto palette = detail::exact_bc4_palette(r0, r1);
    std::uint64_t bits = static_cast<std::uint64_t>(r0) | static_cast<std::uint64_t>(r1) << 8;
    for (std::size_t t = 0; t < 16; ++t) {
        std::uint64_t index = 0;
        for (std::uint64_t k = 1; k < 8; ++k) {
            if (std::abs(texels.aim[t] - palette[k]) < std::abs(texels.aim[t] - palette[index]))
                index = k;
        }
        bits |= index << (16 + 3 * t);
    }
    for (int i = 0; i < 8; ++i) to[i] = static_cast<std::byte>(bits >> (8 * i));
}

}  // namespace

std::vector<std::byte> encode_blocks_weighted(const Image& image, const Image& weights, Block block,
                                              int threads)
{
    const int channels = block == Block::Bc5 ? 2 : 1;
    if ((block != Block::Bc4 && block != Block::Bc5) || image.channels < channels ||
        weights.channels != 1 || image.width != weights.width || image.height != weights.height ||
        image.empty()) {
        throw Error("block texture: weights are for BC4 and BC5, one number a texel",
                    "Pass an image with one or two channels and weights of its size.");
    }
    std::vector<std::byte> bytes(blocks_size(block, image.width, image.height));
    const int across = (image.width + 3) / 4;
    parallel_for(static_cast<std::size_t>((image.height + 3) / 4), threads, [&](std::size_t by) {
        std::byte* to = bytes.data() + by * static_cast<std::size_t>(across) * block_bytes(block);
        for (int bx = 0; bx < across; ++bx) {
            for (int c = 0; c < channels; ++c, to += 8) {
                encode_channel(texels_of(image, weights, c, bx, static_cast<int>(by)), to);
            }
        }
    });
    return bytes;
}

}  // namespace petrichor::texproc
