#include "texproc/prefilter/stored.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "texproc/filter/area.h"
#include "texproc/prefilter/detail/codes.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/prefilter/detail/lobe_cost.h"
#include "texproc/prefilter/detail/walk.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

StoredAs floats(const PrefilterOptions& o)
{
    return {0, o.smoothness, o.alpha, o.green_down, false};
}

// Numbers tried about the stored one, in 1 / 255.
constexpr std::array<float, 9> kSteps{-24.0f, -12.0f, -6.0f, -3.0f, 0.0f, 3.0f, 6.0f, 12.0f, 24.0f};
constexpr std::size_t kStay = 4;

// The lowest point of the parabola through three of them, as far as it lies between the outer two.
float lowest(float x0, float x1, float x2, float y0, float y1, float y2)
{
    const float d0 = (y1 - y0) / (x1 - x0), d1 = (y2 - y1) / (x2 - x1);
    const float bend = (d1 - d0) / (x2 - x0);
    if (!(bend > 0.0f)) return x1;
    return std::clamp(0.5f * (x0 + x1) - 0.5f * d0 / bend, x0, x2);
}

// The cheapest number about the stored one.
float cheapest_number(const LobeCost& cost, const Direction& normal, float number, float light2,
                      const StoredAs& as)
{
    constexpr float kClear = 3e-3f;  // what samples may say by chance
    std::array<float, kSteps.size()> numbers, alpha2s, costs;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
        numbers[k] = std::clamp(number + kSteps[k] / 255.0f, 0.0f, 1.0f);
        alpha2s[k] = std::clamp(read_alpha2({{}, numbers[k]}, as) + light2, kMinAlpha2, 1.0f);
    }
    cost(normal, alpha2s.data(), static_cast<int>(kSteps.size()), costs.data());
    const auto best =
        static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    if (costs[best] > costs[kStay] - kClear) return number;
    const bool inner = best > 0 && best + 1 < kSteps.size() && numbers[best - 1] < numbers[best] &&
                       numbers[best] < numbers[best + 1];
    return inner ? lowest(numbers[best - 1], numbers[best], numbers[best + 1], costs[best - 1],
                          costs[best], costs[best + 1])
                 : numbers[best];
}

int samples_at(int level)
{
    return level <= 2 ? 160 : level <= 4 ? 240 : level <= 5 ? 320 : level <= 7 ? 1280 : 2560;
}

std::vector<Image> empty_levels(const std::vector<Image>& like)
{
    std::vector<Image> levels(like.size());
    for (std::size_t k = 1; k < like.size(); ++k) {
        levels[k] = Image(like[k].width, like[k].height, 1, ColorSpace::Data);
    }
    return levels;
}

}  // namespace

std::vector<Image> through_blocks(const std::vector<Image>& levels,
                                  const std::vector<Image>& weights, const LossyFormat& format)
{
    std::vector<Image> read(levels.size());
    for (std::size_t k = 1; k < levels.size(); ++k) {
        const Image& level = levels[k];
        const bool weighted = k < weights.size() && !weights[k].empty();
        const std::vector<std::byte> bytes =
            weighted ? encode_blocks_weighted(level, weights[k], format.block, format.threads)
                     : encode_blocks(to_raw(level, PixelType::U8), format.block,
                                     {.quality = format.quality, .threads = format.threads});
        read[k] = to_image(decode_blocks(bytes, format.block, level.width, level.height,
                                         BlockSign::Exact, format.threads),
                           ColorSpace::Data);
    }
    return read;
}

LobeWeights lobe_weights(const Prefiltered& chain, const PrefilterOptions& options)
{
    const StoredAs as = floats(options);
    LobeWeights weights{empty_levels(chain.roughness), empty_levels(chain.roughness)};
    for (std::size_t k = 1; k < chain.roughness.size(); ++k) {
        const std::vector<float>& numbers = chain.roughness[k].pixels;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const float alpha = std::sqrt(read_alpha2({{}, numbers[i]}, as));
            // Narrower than a code, no lobe is aimed at, and no number of it is told from the next.
            weights.normal[k].pixels[i] = 1.0f / (alpha + 0.004f);
            weights.roughness[k].pixels[i] = 1.0f / (std::sqrt(alpha) + 0.03f);
        }
    }
    return weights;
}

std::vector<Image> aim_roughness(const RawImage& normal, const RawImage& roughness,
                                 const Prefiltered& stored, const PrefilterOptions& options)
{
    const MapSurface surface = make_surface(ref(normal), ref(roughness), options);
    std::vector<Image> aim = stored.roughness;
    const StoredAs as = floats(options);
    const float light2 = options.design_light * options.design_light;
    WalkOptions walking;
    walking.cells = true;
    walking.apart = kApart;
    walking.threads = options.threads;
    walking.progress = options.progress;
    // The finest levels hold most texels, and quick is quick.
    if (options.quick) walking.wanted = [](int level, int, int) { return level > 2; };
    walk(surface, walking, [&](const MipTexel& t) {
        thread_local Cells lit;
        thread_local Samples storage, fresh;
        const std::size_t k = static_cast<std::size_t>(t.level);
        lit = *t.cells;
        merge(lit, t.level < 5 ? 128 : 1024, lit.count());
        for (float& a2 : lit.alpha2) a2 = std::clamp(a2 + light2, kMinAlpha2, 1.0f);
        const float* c = &stored.normal[k].pixels[stored.normal[k].index(t.x, t.y, 0)];
        const Direction n = read_normal({{c[0], c[1], c[2]}, 0.0f}, as);
        const std::uint32_t seed = static_cast<std::uint32_t>(t.level * 7919 + t.y * 104729 + t.x);
        const Whole whole = whole_of(lit.view(), t.means);
        const int samples = samples_at(t.level);
        float& number = aim[k].at(t.x, t.y, 0);
        const float found = cheapest_number(LobeCost(lit.view(), whole, samples, 2 * seed, storage),
                                            n, number, light2, as);
        if (found == number) return;
        // The best of nine on few samples is partly luck: others must agree.
        const LobeCost judge(lit.view(), whole, 2 * samples, 2 * seed + 1, fresh);
        const auto cost_of = [&](float v) {
            return judge(n, std::clamp(read_alpha2({{}, v}, as) + light2, kMinAlpha2, 1.0f));
        };
        if (cost_of(found) < cost_of(number)) number = found;
    });
    return aim;
}

}  // namespace petrichor::texproc
