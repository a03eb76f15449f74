#include "texproc/prefilter/detail/two_lobe_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "texproc/prefilter/detail/lobe_split.h"

namespace petrichor::texproc::detail {

namespace {

// A pixel covers one to two texels of its finer level each way, and the filter half a texel more.
constexpr double kSeen = 2.0;
constexpr int kMostSamples = 8;  // a side
// Two lobes that are likelier by less than this, in log likelihood of a texel of level 0, are one.
constexpr float kLeastGain = 0.1f;
// How far the roughness of two lobes then lies from that of one, a share of what it can.
constexpr float kApart = 0.25f;

float square(float v)
{
    return v * v;
}

int samples_of(int base, int level)
{
    return std::clamp(static_cast<int>(kSeen * ((base + level - 1) / level)), 1, int{kMostSamples});
}

LobeSplit split_of(const Level& base, const Level& level, int x, int y, const PrefilterOptions& options)
{
    const int across = samples_of(base.width, level.width), up = samples_of(base.height, level.height);
    std::array<SplitSample, static_cast<std::size_t>(kMostSamples * kMostSamples)> samples;
    std::size_t count = 0;
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < across; ++i) {
            const double u = x + 0.5 + kSeen * ((i + 0.5) / across - 0.5), v = y + 0.5 + kSeen * ((j + 0.5) / up - 0.5);
            const Texel t = base.nearest(u / level.width, v / level.height);
            samples[count++] = {t.n.x, t.n.y, perceptual(t.stored, options)};
        }
    }
    return split_lobes({samples.data(), count});
}

void swap_lobes(LobeSplit& split)
{
    std::swap(split.lobes[0], split.lobes[1]);
    split.second = 1.0f - split.second;
}

// The first is the narrower one, or where both are about as wide the one on that side of the axis along
// which most are apart.
void order(std::vector<LobeSplit>& splits)
{
    float xx = 0.0f, xy = 0.0f, yy = 0.0f;
    for (const LobeSplit& s : splits) {
        const float dx = s.lobes[1].x - s.lobes[0].x, dy = s.lobes[1].y - s.lobes[0].y;
        xx += dx * dx, xy += dx * dy, yy += dy * dy;
    }
    const float half = 0.5f * (xx - yy), along = half + std::sqrt(half * half + xy * xy);
    const glm::vec2 axis = along > 1e-9f ? glm::normalize(glm::vec2(along, xy)) : glm::vec2(0.0f, 1.0f);
    for (LobeSplit& s : splits) {
        const SplitLobe &a = s.lobes[0], &b = s.lobes[1];
        const float side = glm::dot(glm::vec2(b.x - a.x, b.y - a.y), axis);
        const float wide_a = width2(a), wide_b = width2(b);
        if (portable_log(wide_b / wide_a) + side / std::sqrt(std::max(wide_a, wide_b)) < 0.0f) swap_lobes(s);
    }
}

// A filter blends the first lobes of neighbours, and the second ones: each texel takes that one for its
// first which is more like the first ones about it.
void agree(std::vector<LobeSplit>& splits, int width, int height)
{
    constexpr int kSweeps = 4;
    constexpr float kFar = 4.0f;  // farther apart is all the same
    const auto at = [&](int x, int y) -> LobeSplit& {
        return splits[static_cast<std::size_t>((y + height) % height) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>((x + width) % width)];
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                LobeSplit& here = at(x, y);
                float as_is = 0.0f, swapped = 0.0f;
                for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
                    const LobeSplit& other = at(x + dx, y + dy);
                    const auto apart = [&](std::size_t a, std::size_t b) {
                        return std::min(lobe_distance(here.lobes[a], other.lobes[b]), kFar);
                    };
                    as_is += apart(0, 0) + apart(1, 1);
                    swapped += apart(0, 1) + apart(1, 0);
                }
                if (swapped < as_is) swap_lobes(here);
            }
        }
    }
}

// plain_p, one_p: roughness of the plain mip, and of the best lobe alone.
TwoLobeStart to_start(const LobeSplit& split, const glm::vec3& normal, float plain_p, float one_p)
{
    if (split.gain < kLeastGain)
        return {{normal, normal},
                {one_p - kApart * one_p, one_p + kApart * std::min(one_p, 1.0f - one_p)},
                0.5f};
    const SplitLobe &a = split.lobes[0], &b = split.lobes[1];
    const float w = split.second, apart = square(b.x - a.x) + square(b.y - a.y);
    const float spread = (1.0f - w) * a.spread + w * b.spread + w * (1.0f - w) * apart;
    const float more = square(one_p * one_p) - square(plain_p * plain_p);
    const float seen = spread > 1e-9f ? std::clamp(more / spread, 0.0f, 1.0f) : 0.0f;
    TwoLobeStart to{{}, {}, w};
    for (std::size_t i = 0; i < 2; ++i) {
        const SplitLobe& lobe = split.lobes[i];
        const float up2 = 1.0f - lobe.x * lobe.x - lobe.y * lobe.y;
        to.n[i] = glm::normalize(glm::vec3(lobe.x, lobe.y, std::sqrt(std::max(up2, 1e-4f))));
        to.p[i] = std::sqrt(std::sqrt(std::min(square(lobe.p * lobe.p) + seen * lobe.spread, 1.0f)));
    }
    return to;
}

}  // namespace

std::vector<TwoLobeStart> start_two_lobes(const Levels& plain, std::size_t k, const std::vector<Texel>& one,
                                          const PrefilterOptions& options)
{
    const Level &base = plain.front(), &level = plain[k];
    const std::size_t width = static_cast<std::size_t>(level.width);
    std::vector<LobeSplit> splits(one.size());
    parallel_for(static_cast<std::size_t>(level.height), options.threads, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x)
            splits[y * width + x] = split_of(base, level, static_cast<int>(x), static_cast<int>(y), options);
    });
    order(splits);
    agree(splits, level.width, level.height);
    std::vector<TwoLobeStart> starts;
    starts.reserve(one.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        starts.push_back(to_start(splits[i], one[i].n, perceptual(level.at(i).stored, options),
                                  perceptual(one[i].stored, options)));
    return starts;
}

}  // namespace petrichor::texproc::detail
