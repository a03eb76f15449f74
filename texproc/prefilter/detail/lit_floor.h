#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LIT_FLOOR_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LIT_FLOOR_H

// How a renderer lights a floor from mips: texels, what a pixel filters of them, and its light.
// docs/textures.md, 7.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formulas/light/brdf.h"
#include "texproc/prefilter/detail/floor_plan.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

inline constexpr float kPaintAlbedo = 0.3f, kPaintF0 = 0.04f, kMetalF0 = 0.9f;
inline constexpr float kNarrowestAlpha = 0.002f;

struct Texel {
    glm::vec3 n{0.0f, 0.0f, 1.0f};
    float stored = 0.0f;   // roughness as the map holds it
    float diffuse = 1.0f;  // share of the base colour, of paint
    float metal = 1.0f;    // and of metal
};

// Of a texel that has two lobes.
struct SecondTexel {
    glm::vec3 n{0.0f, 0.0f, 1.0f};
    float stored = 0.0f, share = 0.5f;
};

// A texel of level 0, of which there are many.
struct SmallTexel {
    std::int16_t n[3];
    std::uint16_t stored;
};
inline SmallTexel to_small(const glm::vec3& n, float stored)
{
    const auto code = [](float v, float most) {
        return std::floor(std::clamp(v, -1.0f, 1.0f) * most + 0.5f);
    };
    SmallTexel to{};
    for (int c = 0; c < 3; ++c) to.n[c] = static_cast<std::int16_t>(code(n[c], 32767.0f));
    to.stored = static_cast<std::uint16_t>(code(std::max(stored, 0.0f), 65535.0f));
    return to;
}

// The four texels about a point of a map that repeats, with their weights.
template <class Take>
void bilinear(int width, int height, double u, double v, float weight, const Take& take)
{
    const double x = (u - std::floor(u)) * width - 0.5, y = (v - std::floor(v)) * height - 0.5;
    const double fx = std::floor(x), fy = std::floor(y);
    const float tx = static_cast<float>(x - fx), ty = static_cast<float>(y - fy);
    const auto wrapped = [](double at, int n) {
        const int i = static_cast<int>(at);
        return static_cast<std::size_t>(i < 0 ? i + n : i >= n ? i - n : i);
    };
    const std::size_t x0 = wrapped(fx, width), x1 = wrapped(fx + 1.0, width);
    const std::size_t y0 = wrapped(fy, height) * static_cast<std::size_t>(width);
    const std::size_t y1 = wrapped(fy + 1.0, height) * static_cast<std::size_t>(width);
    take(y0 + x0, weight * (1.0f - tx) * (1.0f - ty));
    take(y0 + x1, weight * tx * (1.0f - ty));
    take(y1 + x0, weight * (1.0f - tx) * ty);
    take(y1 + x1, weight * tx * ty);
}

struct Level {
    int width = 0, height = 0;
    std::vector<Texel> texels;
    std::vector<SmallTexel> small{};  // instead of texels
    std::vector<SecondTexel> second{};  // none: both lobes are those of the texels

    Texel at(std::size_t i) const
    {
        if (small.empty()) return texels[i];
        const SmallTexel& t = small[i];
        constexpr float kUnit = 1.0f / 32767.0f;
        return {glm::vec3(t.n[0], t.n[1], t.n[2]) * kUnit,
                static_cast<float>(t.stored) * (1.0f / 65535.0f), 1.0f};
    }
    SecondTexel second_at(std::size_t i) const
    {
        if (!second.empty()) return second[i];
        const Texel t = at(i);
        return {t.n, t.stored, 0.5f};
    }
    std::size_t nearest_index(double u, double v) const
    {
        const auto place = [](double x, int n) {
            const int i = static_cast<int>((x - std::floor(x)) * n);
            return std::min(i, n - 1);
        };
        return static_cast<std::size_t>(place(v, height)) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(place(u, width));
    }
    Texel nearest(double u, double v) const { return at(nearest_index(u, v)); }
    // A hint that this texel will be read soon.
    void will_read(std::size_t i) const
    {
        __builtin_prefetch(small.empty() ? static_cast<const void*>(&texels[i]) : static_cast<const void*>(&small[i]));
    }
    // Bilinear, wrapped; added with a weight.
    void add_to(Texel& sum, double u, double v, float weight) const
    {
        bilinear(width, height, u, v, weight, [&](std::size_t i, float w) {
            const Texel t = at(i);
            sum.n += t.n * w;
            sum.stored += t.stored * w;
            sum.diffuse += t.diffuse * w;
            sum.metal += t.metal * w;
        });
    }
    void add_to(SecondTexel& sum, double u, double v, float weight) const
    {
        bilinear(width, height, u, v, weight, [&](std::size_t i, float w) {
            const SecondTexel t = second_at(i);
            sum.n += t.n * w;
            sum.stored += t.stored * w;
            sum.share += t.share * w;
        });
    }
};
using Levels = std::vector<Level>;

// Of a case of the pictures.
struct FloorLight {
    glm::vec3 to_light;
    float alpha2, sun, sky;
    bool metal;
};

inline float shown(float radiance, float exposure)
{
    return std::pow(std::clamp(radiance * exposure, 0.0f, 1.0f), 1.0f / 2.2f);
}

// A gradient sky over dark ground, blurred by the width of what looks at it.
inline float sky_radiance(float up, float width)
{
    const float w = 0.05f + width;
    const float t = std::clamp((up + w) / (2.0f * w), 0.0f, 1.0f);
    return 0.12f + t * t * (3.0f - 2.0f * t) * (0.88f - 0.5f * std::max(up, 0.0f));
}

// What of the light is seen.
enum class Seen { All, Gloss, Diffuse };

// Between a light and the eye: the half-vector, and how Schlick's rise to the rim goes with it.
struct Between {
    glm::vec3 h;
    float rise;
};
inline Between between(const glm::vec3& to_eye, const FloorLight& light)
{
    const glm::vec3 h = glm::normalize(light.to_light + to_eye);
    const float lh = std::clamp(glm::dot(light.to_light, h), 0.0f, 1.0f);
    const float m = 1.0f - lh, m2 = m * m;
    return {h, m2 * m2 * m};
}

// Radiance towards the eye. Paint: Lambert below the highlight; metal: the highlight alone. The
// share is of the base colour: what is diffuse of paint, what metal mirrors. known: between(), or null.
template <Seen kSeen = Seen::All>
float shade(const glm::vec3& n, float p, float share, const glm::vec3& to_eye, const FloorLight& light,
            const Between* known = nullptr)
{
    const float own = std::max(p * p, kNarrowestAlpha);
    const float f0 = light.metal ? kMetalF0 * share : kPaintF0;
    const float albedo = light.metal || kSeen == Seen::Gloss ? 0.0f : kPaintAlbedo * share;
    float seen = 0.0f;
    if (light.sky > 0.0f) {
        float radiance = albedo * (1.0f - f0) * (0.12f + 0.5f * (1.0f + n.z) * 0.45f);
        if constexpr (kSeen != Seen::Diffuse) {
            const float nv = std::clamp(std::abs(glm::dot(n, to_eye)), 1e-4f, 1.0f);
            const glm::vec3 mirror = 2.0f * glm::dot(n, to_eye) * n - to_eye;
            // Schlick with the rim taken back by roughness, as image-based lighting does.
            const float rim = std::pow(1.0f - nv, 5.0f);
            const float fresnel = f0 + (std::max(1.0f - p, f0) - f0) * rim;
            radiance = fresnel * sky_radiance(mirror.z, own) + radiance;
        }
        seen = light.sky * radiance;
    }
    const float nl = glm::dot(n, light.to_light);
    if (nl <= 0.0f || light.sun <= 0.0f) return seen;
    const Between at = known ? *known : between(to_eye, light);
    const float fresnel = f0 + (1.0f - f0) * at.rise;
    float reflected = (1.0f - fresnel) * albedo * (1.0f / shared::kPi);
    if constexpr (kSeen != Seen::Diffuse) {
        const float alpha = std::sqrt(own * own + light.alpha2);
        const float nv = std::clamp(std::abs(glm::dot(n, to_eye)), 1e-4f, 1.0f);
        const float nh = std::clamp(glm::dot(n, at.h), 0.0f, 1.0f);
        reflected = fresnel * shared::ggx_distribution(nh, alpha) * shared::ggx_visibility(nl, nv, alpha) + reflected;
    }
    return seen + light.sun * nl * reflected;
}

inline float shade(const Texel& t, float p, const glm::vec3& to_eye, const FloorLight& light)
{
    return shade(t.n, p, light.metal ? t.metal : t.diffuse, to_eye, light);
}

// Of two lobes; p, p2: their perceptual roughness.
inline float shade(const Texel& t, float p, const SecondTexel& second, float p2, const glm::vec3& to_eye,
                   const FloorLight& light)
{
    const float share = light.metal ? t.metal : t.diffuse;
    const Between at = between(to_eye, light);
    const float gloss = (1.0f - second.share) * shade<Seen::Gloss>(t.n, p, share, to_eye, light, &at) +
                        second.share * shade<Seen::Gloss>(second.n, p2, share, to_eye, light, &at);
    if (light.metal) return gloss;
    const glm::vec3 mean = glm::normalize(t.n + second.share * (second.n - t.n));
    return gloss + shade<Seen::Diffuse>(mean, p, share, to_eye, light, &at);
}

inline float perceptual(float stored, const PrefilterOptions& input)
{
    float p = input.smoothness ? 1.0f - stored : stored;
    if (input.alpha) p = std::sqrt(std::max(p, 0.0f));
    return std::clamp(p, 0.0f, 1.0f);
}

inline float stored_value(float p, const PrefilterOptions& input)
{
    const float v = input.alpha ? p * p : p;
    return input.smoothness ? 1.0f - v : v;
}

// The plain mips of a level 0: mean normals of unit length, mean of the roughness as stored.
Levels plain_levels(Level base);

// The trilinear samples along the longer axis of a pixel's footprint.
struct Taps {
    int count = 1;
    double u = 0.0, v = 0.0, step_u = 0.0, step_v = 0.0;  // the first, and from one to the next
    std::size_t fine = 0, coarse = 0;
    float share = 0.0f;  // of the coarse level

    // Of one of the two levels, with its share.
    template <class Sum>
    void add_to(Sum& sum, const Level& level, float of_level) const
    {
        for (int i = 0; i < count; ++i)
            level.add_to(sum, u + i * step_u, v + i * step_v, of_level / static_cast<float>(count));
    }
};
// Of a pixel, with at most so many samples; sizes by those of level 0.
Taps taps_of(const Levels& levels, const FloorPixel& pixel, int most_taps);

// What one shading of a pixel sees.
inline Texel filtered(const std::vector<const Level*>& levels, const Taps& taps)
{
    Texel sum{glm::vec3(0.0f), 0.0f, 0.0f, 0.0f};
    taps.add_to(sum, *levels[taps.fine], 1.0f - taps.share);
    if (taps.share > 0.0f) taps.add_to(sum, *levels[taps.coarse], taps.share);
    const float length = glm::length(sum.n);
    sum.n = length > 0.0f ? sum.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return sum;
}

inline SecondTexel second_filtered(const std::vector<const Level*>& levels, const Taps& taps)
{
    SecondTexel sum{glm::vec3(0.0f), 0.0f, 0.0f};
    taps.add_to(sum, *levels[taps.fine], 1.0f - taps.share);
    if (taps.share > 0.0f) taps.add_to(sum, *levels[taps.coarse], taps.share);
    const float length = glm::length(sum.n);
    sum.n = length > 0.0f ? sum.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return sum;
}

}  // namespace petrichor::texproc::detail

#endif
