// A small renderer for contact sheets: GGX with height-correlated Smith and Schlick's Fresnel,
// Lambert below it, one directional light and a little sky.
#include "texproc/study/compare/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "formulas/light/brdf.h"

namespace petrichor::texproc {

namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPi = 3.14159265f;

struct Texel {
    vec3 albedo, normal;  // normal: tangent space
    float roughness, metallic;
};

struct Frame {
    vec3 tangent, bitangent, normal;  // bitangent: up the image
};

int wrapped(int i, int size)
{
    return (i % size + size) % size;
}

Texel fetch(const ShadedMaps& maps, int level, int x, int y)
{
    const std::size_t k = static_cast<std::size_t>(level);
    const Image& n = maps.normal[k];
    const int i = wrapped(x, n.width), j = wrapped(y, n.height);
    Texel t;
    t.normal = 2.0f * vec3(n.at(i, j, 0), n.at(i, j, 1), n.at(i, j, 2)) - 1.0f;
    t.roughness = maps.roughness[k].at(i, j, 0);
    t.albedo = maps.albedo.empty() ? vec3(0.05f)
                                   : vec3(maps.albedo[k].at(i, j, 0), maps.albedo[k].at(i, j, 1),
                                          maps.albedo[k].at(i, j, 2));
    t.metallic = maps.metallic.empty() ? 0.0f : maps.metallic[k].at(i, j, 0);
    return t;
}

Texel mixed(const Texel& a, const Texel& b, float t)
{
    return {glm::mix(a.albedo, b.albedo, t), glm::mix(a.normal, b.normal, t),
            a.roughness + (b.roughness - a.roughness) * t,
            a.metallic + (b.metallic - a.metallic) * t};
}

Texel bilinear(const ShadedMaps& maps, int level, const vec2& uv)
{
    const Image& n = maps.normal[static_cast<std::size_t>(level)];
    const float x = uv.x * static_cast<float>(n.width) - 0.5f,
                y = uv.y * static_cast<float>(n.height) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return mixed(mixed(fetch(maps, level, i, j), fetch(maps, level, i + 1, j), fx),
                 mixed(fetch(maps, level, i, j + 1), fetch(maps, level, i + 1, j + 1), fx), fy);
}

vec3 shade(const Texel& texel, const Frame& frame, const vec3& view, const vec3& light,
           const ShadingOptions& o)
{
    const vec3 n =
        glm::normalize(texel.normal.x * frame.tangent + texel.normal.y * frame.bitangent +
                       std::max(texel.normal.z, 0.01f) * frame.normal);
    const float nl = glm::dot(n, light), nv = std::max(glm::dot(n, view), 1e-3f);
    const vec3 sky =
        texel.albedo * (0.06f + 0.06f * n.y);  // metals mirror it, which comes to the same
    if (nl <= 0.0f || glm::dot(frame.normal, light) <= 0.0f) return o.exposure * sky;
    const vec3 h = glm::normalize(view + light);
    const float nh = std::max(glm::dot(n, h), 0.0f), vh = std::max(glm::dot(view, h), 0.0f);
    const float p = std::clamp(texel.roughness, 0.02f, 1.0f);
    const float alpha = std::sqrt(p * p * p * p + o.light * o.light);
    const float lobe = shared::ggx_distribution(nh, alpha) * shared::ggx_visibility(nl, nv, alpha);
    const vec3 f0 = glm::mix(vec3(0.04f), texel.albedo, texel.metallic);
    const vec3 fresnel = shared::schlick_fresnel(f0, vh);
    const vec3 diffuse = texel.albedo * (1.0f - texel.metallic) / kPi;
    const vec3 out = diffuse * (1.0f - fresnel) + fresnel * lobe;
    return o.exposure * (sky + kPi * nl * out);
}

// A point of a rank-1 lattice in the unit square.
vec2 lattice(int i, std::uint32_t shift)
{
    const float s = static_cast<float>(shift & 0xffffu) / 65536.0f,
                t = static_cast<float>(shift >> 16) / 65536.0f;
    const float u = 0.7548777f * static_cast<float>(i) + s,
                v = 0.5698403f * static_cast<float>(i) + t;
    return {u - std::floor(u), v - std::floor(v)};
}

std::uint32_t hashed(std::uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

void check(const ShadedMaps& maps)
{
    if (maps.normal.empty() || maps.roughness.size() != maps.normal.size() ||
        (!maps.albedo.empty() && maps.albedo.size() != maps.normal.size())) {
        throw Error("shading: the maps have different numbers of levels",
                    "Give whole chains of one size.");
    }
}

void put(Image& image, int x, int y, const vec3& color)
{
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = color[c];
}

}  // namespace

Image shaded_ball(const ShadedMaps& maps, int level, int size, bool reference,
                  const ShadingOptions& options)
{
    check(maps);
    Image out(size, size, 3, ColorSpace::Linear);
    const vec3 light = glm::normalize(vec3(-0.45f, 0.6f, 0.75f)), view(0.0f, 0.0f, 1.0f);
    const int texels = 1 << level;
    parallel_for(static_cast<std::size_t>(size), options.threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < size; ++x) {
            const vec2 at = (vec2(x, y) + 0.5f) * (2.0f / static_cast<float>(size)) - 1.0f;
            const float r2 = glm::dot(at, at);
            if (r2 > 0.98f) continue;
            Frame frame;
            frame.normal = vec3(at.x, -at.y, std::sqrt(1.0f - r2));
            frame.tangent = glm::normalize(vec3(1, 0, 0) - frame.normal * frame.normal.x);
            frame.bitangent = glm::cross(frame.normal, frame.tangent);
            if (!reference) {
                put(out, x, y, shade(fetch(maps, level, x, y), frame, view, light, options));
                continue;
            }
            vec3 sum(0.0f);
            const int count = std::min(options.samples, texels * texels);
            const bool all = count == texels * texels;
            const std::uint32_t shift = hashed(static_cast<std::uint32_t>(y * size + x));
            for (int i = 0; i < count; ++i) {
                const vec2 s = lattice(i, shift);
                const int dx =
                    all ? i % texels : static_cast<int>(s.x * static_cast<float>(texels));
                const int dy =
                    all ? i / texels : static_cast<int>(s.y * static_cast<float>(texels));
                sum += shade(fetch(maps, 0, x * texels + dx, y * texels + dy), frame, view, light,
                             options);
            }
            put(out, x, y, sum / static_cast<float>(count));
        }
    });
    return out;
}

Image shaded_floor(const ShadedMaps& maps, int width, int height, bool reference,
                   const ShadingOptions& options)
{
    check(maps);
    Image out(width, height, 3, ColorSpace::Linear);
    const vec3 light = glm::normalize(vec3(0.1f, 0.42f, -1.0f));
    const Frame frame{vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, 1, 0)};
    const Image& base = maps.normal.front();
    constexpr float kEye = 1.0f, kTile = 1.6f;  // heights of the eye and edges of a tile
    // The floor fills the picture: the horizon lies just above it.
    const float focal = 1.1f * static_cast<float>(width) / 2.0f;
    const float drop = 0.045f, fall = 0.62f;
    const auto hit = [&](const vec2& pixel) {
        const float down = drop + fall * pixel.y / static_cast<float>(height);
        const vec3 ray((pixel.x - 0.5f * static_cast<float>(width)) / focal, -down, -1.0f);
        const float t = kEye / down;
        return std::pair(vec2(ray.x * t, -ray.z * t), glm::normalize(-ray));
    };
    const vec2 size(static_cast<float>(base.width), static_cast<float>(base.height));
    const auto uv_of = [&](const vec2& at) { return vec2(at.x, -at.y * size.x / size.y) / kTile; };
    const int last = static_cast<int>(maps.normal.size()) - 1;
    parallel_for(static_cast<std::size_t>(height), options.threads, [&](std::size_t row) {
        for (int x = 0; x < width; ++x) {
            const vec2 corner(static_cast<float>(x), static_cast<float>(row));
            const auto [at, view] = hit(corner + 0.5f);
            if (reference) {
                vec3 sum(0.0f);
                const std::uint32_t shift =
                    hashed(static_cast<std::uint32_t>(static_cast<int>(row) * width + x));
                for (int i = 0; i < options.samples; ++i) {
                    const auto [p, from] = hit(corner + lattice(i, shift));
                    sum += shade(bilinear(maps, 0, uv_of(p)), frame, from, light, options);
                }
                put(out, x, static_cast<int>(row), sum / static_cast<float>(options.samples));
                continue;
            }
            // Between the longer and the shorter axis of the footprint, as anisotropic sampling
            // would.
            const vec2 du = uv_of(hit(corner + vec2(1.5f, 0.5f)).first) - uv_of(at);
            const vec2 dv = uv_of(hit(corner + vec2(0.5f, 1.5f)).first) - uv_of(at);
            const float u = glm::length(du * size), v = glm::length(dv * size);  // texels
            const float longer = std::max(u, v), shorter = std::min(u, v);
            const int taps =
                std::clamp(static_cast<int>(std::lround(longer / std::max(shorter, 1e-9f))), 1, 16);
            const float lod =
                std::clamp(std::log2(std::max(longer / static_cast<float>(taps), 1.0f)), 0.0f,
                           static_cast<float>(last));
            const int k = std::min(static_cast<int>(lod), std::max(0, last - 1));
            const vec2 axis = u > v ? du : dv;
            Texel sum{vec3(0.0f), vec3(0.0f), 0.0f, 0.0f};
            for (int i = 0; i < taps; ++i) {
                const vec2 uv =
                    uv_of(at) +
                    axis * ((static_cast<float>(i) + 0.5f) / static_cast<float>(taps) - 0.5f);
                const Texel t =
                    mixed(bilinear(maps, k, uv), bilinear(maps, std::min(k + 1, last), uv),
                          lod - static_cast<float>(k));
                sum.albedo += t.albedo / static_cast<float>(taps);
                sum.normal += t.normal / static_cast<float>(taps);
                sum.roughness += t.roughness / static_cast<float>(taps);
                sum.metallic += t.metallic / static_cast<float>(taps);
            }
            put(out, x, static_cast<int>(row), shade(sum, frame, view, light, options));
        }
    });
    return out;
}

double light_error(const Image& picture, const Image& reference)
{
    double difference = 0.0, light = 0.0;
    for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
        const auto luminance = [&](const Image& image) {
            return 0.2126 * static_cast<double>(image.pixels[i]) +
                   0.7152 * static_cast<double>(image.pixels[i + 1]) +
                   0.0722 * static_cast<double>(image.pixels[i + 2]);
        };
        difference += std::abs(luminance(picture) - luminance(reference));
        light += luminance(reference);
    }
    return light > 0.0 ? difference / light : 0.0;
}

}  // namespace petrichor::texproc
