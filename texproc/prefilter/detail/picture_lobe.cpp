#include "texproc/prefilter/detail/picture_lobe.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formulas/light/brdf.h"

namespace petrichor::texproc::detail {

namespace {

constexpr float kAlbedo = 0.3f, kPaintF0 = 0.04f;  // paint, stone, soil
constexpr float kMetalF0 = 0.9f;
constexpr float kNarrowest2 = 4e-6f;
constexpr int kRefinements = 5;

// How far the eye looks down (rise over run), from the horizon to nearly straight.
constexpr float kEyeRise[] = {0.18f, 0.29f, 0.49f, 1.2f};
struct Light {
    float right, ahead, up, alpha;
};
// Low and high, ahead of the eye where highlights are, beside it and behind it; the last two are
// windows.
constexpr Light kLight[] = {
    {0.0f, 1.0f, 0.27f, 0.0f},   {0.14f, 1.0f, 0.47f, 0.0f},   {-0.27f, 1.0f, 0.87f, 0.0f},
    {-0.84f, 1.0f, 0.91f, 0.0f}, {1.73f, 1.0f, 2.0f, 0.0f},    {-1.0f, 0.0f, 0.58f, 0.0f},
    {1.73f, -1.0f, 2.38f, 0.0f}, {-0.84f, -1.0f, 0.91f, 0.0f}, {0.0f, -1.0f, 1.43f, 0.0f},
    {0.36f, 1.0f, 0.5f, 0.0f},   {0.36f, 1.0f, 0.5f, 0.1f},    {-0.2f, 1.0f, 0.8f, 0.12f}};

// Exposure of a picture from its pixels: the middle is shown as middle grey, few are white.
constexpr float kMiddle = 0.18f, kWhite = 0.9f;

// Inlined into either of the two below, so that its loop is of their lanes.
inline __attribute__((always_inline)) void radiance_in_lanes(const LitPairs& pairs, const Direction& n, float alpha2,
                                                             float base_share, LitPairs::Row& out)
{
    for (int i = 0; i < pairs.count; ++i) {
        const std::size_t j = static_cast<std::size_t>(i);
        const float nl = std::max(n.x * pairs.lx[j] + n.y * pairs.ly[j] + n.z * pairs.lz[j], 0.0f);
        const float nv = std::max(std::abs(n.x * pairs.vx[j] + n.y * pairs.vy[j] + n.z * pairs.vz[j]), 1e-4f);
        const float nh =
            std::min(std::max(n.x * pairs.hx[j] + n.y * pairs.hy[j] + n.z * pairs.hz[j], 0.0f), 1.0f);
        const float alpha = std::sqrt(alpha2 + pairs.light2[j]);
        const float lobe = shared::ggx_distribution(nh, alpha) * shared::ggx_visibility(nl, nv, alpha);
        out[j] = (pairs.fresnel[j] * lobe + pairs.diffuse[j] * base_share) * nl * pairs.exposure[j];
    }
}
inline __attribute__((always_inline)) float distance_in_lanes(const LitPairs& pairs, const Direction& n, float alpha2,
                                                              float base_share, const LitPairs::Row& shown)
{
    LitPairs::Row one;
    radiance_in_lanes(pairs, n, alpha2, base_share, one);
    for (int i = 0; i < pairs.count; ++i) {
        const std::size_t j = static_cast<std::size_t>(i);
        const float off = std::sqrt(std::min(one[j], 1.0f)) - shown[j];
        one[j] = off * off;
    }
    float sum = 0.0f;
    for (int i = 0; i < pairs.count; ++i) sum += one[static_cast<std::size_t>(i)];
    return sum;
}
void radiance_plain(const LitPairs& pairs, const Direction& n, float alpha2, float base_share, LitPairs::Row& out)
{
    radiance_in_lanes(pairs, n, alpha2, base_share, out);
}
float distance_plain(const LitPairs& pairs, const Direction& n, float alpha2, float base_share,
                     const LitPairs::Row& shown)
{
    return distance_in_lanes(pairs, n, alpha2, base_share, shown);
}
#if defined(__x86_64__)
__attribute__((target("avx2"))) float distance_avx2(const LitPairs& pairs, const Direction& n, float alpha2,
                                                    float base_share, const LitPairs::Row& shown)
{
    return distance_in_lanes(pairs, n, alpha2, base_share, shown);
}
__attribute__((target("avx2"))) void radiance_avx2(const LitPairs& pairs, const Direction& n, float alpha2,
                                                   float base_share, LitPairs::Row& out)
{
    radiance_in_lanes(pairs, n, alpha2, base_share, out);
}
#endif

}  // namespace

PairKernel plain_pair_kernel()
{
    return {radiance_plain, distance_plain};
}

PairKernel pair_kernel()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return {radiance_avx2, distance_avx2};
#endif
    return plain_pair_kernel();
}

PictureLobe::PictureLobe(const MapSurface& surface, bool quick, bool metal)
{
    pairs_.count = quick ? LitPairs::kMost / 2 : LitPairs::kMost;
    const float f0 = metal ? kMetalF0 : kPaintF0, albedo = metal ? 0.0f : kAlbedo;
    // Each pair is turned by the golden angle, so that no direction of the map is preferred.
    const double turn_cos = -0.7373688780783197, turn_sin = 0.6754902942615238;
    double c = 1.0, s = 0.0;
    const int eye_step = quick ? 2 : 1;
    std::size_t j = 0;
    for (int eye = 0; eye < kEyes; eye += eye_step) {
        for (const Light& light : kLight) {
            const auto turned = [&](double right, double ahead, double up) {
                return normalized({static_cast<float>(right * c - ahead * s),
                                   static_cast<float>(right * s + ahead * c),
                                   static_cast<float>(up)});
            };
            const Direction v = turned(0.0, -1.0, static_cast<double>(kEyeRise[eye]));
            const Direction l =
                turned(static_cast<double>(light.right), static_cast<double>(light.ahead),
                       static_cast<double>(light.up));
            const Direction h = normalized({v.x + l.x, v.y + l.y, v.z + l.z});
            pairs_.vx[j] = v.x, pairs_.vy[j] = v.y, pairs_.vz[j] = v.z;
            pairs_.lx[j] = l.x, pairs_.ly[j] = l.y, pairs_.lz[j] = l.z;
            pairs_.hx[j] = h.x, pairs_.hy[j] = h.y, pairs_.hz[j] = h.z;
            const float m = 1.0f - dot(l, h), m2 = m * m;
            pairs_.fresnel[j] = f0 + (1.0f - f0) * (m2 * m2 * m);
            pairs_.diffuse[j] = (1.0f - pairs_.fresnel[j]) * albedo * (1.0f / shared::kPi);
            pairs_.light2[j] = light.alpha * light.alpha;
            pairs_.exposure[j] = 1.0f;
            ++j;
            const double next = c * turn_cos - s * turn_sin;
            s = c * turn_sin + s * turn_cos;
            c = next;
        }
    }
    expose(surface);
}

void PictureLobe::radiance(const Direction& n, float alpha2, float base_share, Row& out) const
{
    kernel_.radiance(pairs_, n, alpha2, base_share, out);
}

// As a display shows it: clipped, in steps that look alike.
void PictureLobe::show(Row& radiance) const
{
    for (float& value : radiance) value = std::sqrt(std::min(value, 1.0f));
}

void PictureLobe::expose(const MapSurface& surface)
{
    // Blocks of 4 x 4 texels all over the map: about what pixels are made of.
    constexpr int kBands = 18, kAcross = 16, kBlock = 4;
    std::vector<Row> blocks;
    SurfaceRow row;
    for (int band = 0; band < kBands; ++band) {
        std::array<Row, kAcross> sums{};
        for (int line = 0; line < kBlock; ++line) {
            fetch(surface, (band * surface.height / kBands + line) % surface.height, row);
            for (int block = 0; block < kAcross; ++block) {
                for (int texel = 0; texel < kBlock; ++texel) {
                    const auto x = static_cast<std::size_t>(
                        (block * surface.width / kAcross + texel) % surface.width);
                    Row one{};
                    radiance({row.nx[x], row.ny[x], row.nz[x]}, row.alpha2[x], 1.0f, one);
                    Row& sum = sums[static_cast<std::size_t>(block)];
                    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += one[j];
                }
            }
        }
        blocks.insert(blocks.end(), sums.begin(), sums.end());
    }
    std::vector<float> values(blocks.size());
    for (std::size_t j = 0; j < static_cast<std::size_t>(pairs_.count); ++j) {
        std::transform(blocks.begin(), blocks.end(), values.begin(),
                       [&](const Row& sum) { return sum[j] * (1.0f / (kBlock * kBlock)); });
        std::sort(values.begin(), values.end());
        const float middle = std::max(values[values.size() / 2], 1e-6f);
        const float bright = std::max(values[values.size() * 97 / 100], 1e-6f);
        pairs_.exposure[j] = std::min(kMiddle / middle, kWhite / bright);
    }
}

FittedLobe PictureLobe::operator()(const Cells& cells, const Means& means) const
{
    const float length = std::sqrt(means.nx * means.nx + means.ny * means.ny + means.nz * means.nz);
    FittedLobe lobe{.normal = normalized({means.nx, means.ny, means.nz})};
    Row truth{}, one{};
    float narrow = 1.0f, wide = 0.0f;
    for (std::size_t i = 0; i < cells.nx.size(); ++i) {
        radiance({cells.nx[i], cells.ny[i], cells.nz[i]}, cells.alpha2[i], 1.0f, one);
        for (std::size_t j = 0; j < truth.size(); ++j) truth[j] += cells.weight[i] * one[j];
        narrow = std::min(narrow, cells.alpha2[i]);
        wide = std::max(wide, cells.alpha2[i]);
    }
    show(truth);
    const auto cost = [&](float alpha2) {
        return kernel_.distance(pairs_, lobe.normal, alpha2, length, truth);
    };
    // The plain mip, then a ladder of widths, then closer about the best.
    const float plain = std::max(means.p * means.p * (means.p * means.p), kNarrowest2);
    lobe.alpha2 = plain;
    float least = cost(plain);
    narrow = std::max(std::min(narrow, plain), kNarrowest2);
    wide = std::min(std::max(wide, plain) + 2.0f * std::max(1.0f - length * length, 0.0f), 1.0f);
    if (wide <= 1.02f * narrow) return lobe;
    float step = wide / narrow;  // the ladder's ratio by square roots alone: the same everywhere
    step = std::sqrt(std::sqrt(std::sqrt(step)));
    const auto attempt = [&](float alpha2) {
        const float value = cost(alpha2);
        if (!(value < least)) return false;
        least = value;
        lobe.alpha2 = alpha2;
        return true;
    };
    float rung = narrow;
    for (int i = 0; i <= 8; ++i, rung *= step) attempt(std::min(rung, wide));
    for (int i = 0; i < kRefinements; ++i) {
        step = std::sqrt(step);
        const float at = lobe.alpha2;
        if (!attempt(std::min(at * step, 1.0f))) attempt(std::max(at / step, kNarrowest2));
    }
    return lobe;
}

}  // namespace petrichor::texproc::detail
