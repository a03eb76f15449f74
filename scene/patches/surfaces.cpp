#include "scene/patches/surfaces.h"

#include <algorithm>
#include <cmath>

namespace petrichor::scene {
namespace {

float wrapped(float x, Wrap wrap)
{
    if (!std::isfinite(x)) return 0.0f;
    if (wrap == Wrap::Clamp) return std::clamp(x, 0.0f, 1.0f);
    const float whole = std::floor(x);
    const float part = x - whole;
    if (wrap == Wrap::Repeat || static_cast<std::int64_t>(whole) % 2 == 0) return part;
    return 1.0f - part;
}

glm::vec3 texel(const Triangles& triangles, const PatchSample& sample, const TextureUse& use,
                std::span<const ColorImage> images)
{
    if (!use.present() || static_cast<std::size_t>(use.texture) >= images.size())
        return glm::vec3(1.0f);
    const ColorImage& image = images[static_cast<std::size_t>(use.texture)];
    if (image.rgb.empty()) return glm::vec3(1.0f);
    const EncodedImage& source =
        triangles.scene().textures[static_cast<std::size_t>(use.texture)];
    const glm::vec2 uv = triangles.uv(sample.triangle, sample.at, use);
    const auto place = [](float x, Wrap wrap, int size) {
        return std::clamp(static_cast<int>(wrapped(x, wrap) * static_cast<float>(size)), 0,
                          size - 1);
    };
    const int x = place(uv.x, source.wrap_u, image.width);
    const int y = place(uv.y, source.wrap_v, image.height);
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x));
    return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

float luminance(glm::vec3 v)
{
    return 0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z;
}

TextureUse tiled(TextureUse use, glm::vec2 tiling)
{
    use.scale *= tiling;
    use.offset *= tiling;
    return use;
}

// Colour of a ground of layers: as it is from afar, else by the weights of its control map.
glm::vec3 ground_color(const Triangles& triangles, const PatchSample& sample, const Material& m,
                       std::span<const ColorImage> images)
{
    const SecondSet& s = m.second;
    if (s.far_texture.present()) return texel(triangles, sample, s.far_texture, images);
    glm::vec3 weights(1.0f, 0.0f, 0.0f);
    if (s.mix_mask.present()) weights = texel(triangles, sample, tiled(s.mix_mask, s.mix_mask_tiling), images);
    const float fourth = std::max(1.0f - weights.x - weights.y - weights.z, 0.0f);
    const glm::vec3 sum =
        texel(triangles, sample, m.base_color_texture, images) * glm::vec3(m.base_color) * weights.x +
        texel(triangles, sample, tiled(s.base_color_texture, s.tiling), images) * s.color * weights.y +
        texel(triangles, sample, tiled(s.third.base_color_texture, s.third.tiling), images) * s.third.color * weights.z +
        texel(triangles, sample, tiled(s.fourth.base_color_texture, s.fourth.tiling), images) * s.fourth.color * fourth;
    return sum / std::max(weights.x + weights.y + weights.z + fourth, 1e-3f);
}

}  // namespace

glm::vec3 surface_color(const Triangles& triangles, std::uint32_t triangle, Barycentric at,
                        std::span<const ColorImage> images)
{
    const Material& m = triangles.scene().materials[triangles.material(triangle)];
    const PatchSample sample{triangle, at};
    const glm::vec3 own = m.second.use == SecondSetUse::Layers
                              ? ground_color(triangles, sample, m, images)
                              : texel(triangles, sample, m.base_color_texture, images) * glm::vec3(m.base_color);
    const glm::vec3 color = own * glm::vec3(triangles.color(triangle, at));
    return glm::clamp(color, 0.0f, 1.0f);
}

glm::vec3 surface_emission(const Triangles& triangles, std::uint32_t triangle, Barycentric at,
                           std::span<const ColorImage> images)
{
    const Material& m = triangles.scene().materials[triangles.material(triangle)];
    if (!(luminance(m.emissive) > 0.0f)) return glm::vec3(0.0f);
    return m.emissive * m.emissive_strength *
           texel(triangles, PatchSample{triangle, at}, m.emissive_texture, images);
}

namespace {

// Of every `each` samples one.
std::vector<PatchSurface> means_over(std::span<const PatchSample> samples, std::size_t each,
                                     const Triangles& triangles, std::span<const ColorImage> images)
{
    std::vector<PatchSurface> surfaces;
    surfaces.reserve(samples.size() / each);
    const float share = 1.0f / static_cast<float>(each);
    for (std::size_t first = 0; first + each <= samples.size(); first += each) {
        PatchSurface mean;
        mean.base_color = glm::vec3(0.0f);
        mean.roughness = 0.0f;
        for (const PatchSample& sample : samples.subspan(first, each)) {
            const Material& m =
                triangles.scene().materials[triangles.material(sample.triangle)];
            // Glossy, metallic: glTF's green and blue.
            const glm::vec3 gloss =
                texel(triangles, sample, m.metallic_roughness_texture, images);
            mean.base_color += surface_color(triangles, sample.triangle, sample.at, images) * share;
            mean.metallic += (m.specular_workflow ? 0.0f : m.metallic * gloss.z) * share;
            mean.roughness += m.roughness * gloss.y * share;
            mean.emission +=
                surface_emission(triangles, sample.triangle, sample.at, images) * share;
        }
        surfaces.push_back(mean);
    }
    return surfaces;
}

}  // namespace

std::vector<PatchSurface> patch_surfaces(const Patches& patches, const Triangles& triangles,
                                         std::span<const ColorImage> images)
{
    return means_over(patches.samples, kPatchSamples, triangles, images);
}

std::vector<PatchSurface> near_surfaces(const NearLinks& near, const Triangles& triangles,
                                        std::span<const ColorImage> images)
{
    return means_over(near.samples, NearLinks::kSamples, triangles, images);
}

std::vector<std::uint32_t> glowing_patches(const Patches& patches,
                                           std::span<const PatchSurface> surfaces,
                                           std::size_t most)
{
    double light = 0.0, area = 0.0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const auto a = static_cast<double>(patches.area_m2[i]);
        light += a * static_cast<double>(luminance(surfaces[i].emission));
        area += a;
    }
    const double mean = area > 0.0 ? light / area : 0.0;
    struct Glow {
        std::uint32_t patch;
        float power;
    };
    std::vector<Glow> glows;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const float radiance = luminance(surfaces[i].emission);
        if (radiance > 0.0f && static_cast<double>(radiance) > mean)
            glows.push_back({i, radiance * patches.area_m2[i]});
    }
    std::sort(glows.begin(), glows.end(), [](const Glow& a, const Glow& b) {
        return a.power != b.power ? a.power > b.power : a.patch < b.patch;
    });
    if (glows.size() > most) glows.resize(most);
    std::vector<std::uint32_t> found;
    for (const Glow& glow : glows) found.push_back(glow.patch);
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace petrichor::scene
