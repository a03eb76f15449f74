#ifndef PETRICHOR_SCENE_PATCHES_SURFACES_H
#define PETRICHOR_SCENE_PATCHES_SURFACES_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/patches/near_light.h"
#include "scene/patches/patches.h"

namespace petrichor::scene {

/// What patches are made of, without their geometry: colours of a texture, linear, row 0 at the top.
struct ColorImage {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  ///< width * height * 3; empty: white
};

/// A dry patch: means over its samples, textures and vertex colours included.
struct PatchSurface {
    glm::vec3 base_color{1.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;
    glm::vec3 emission{0.0f};  ///< radiance, as emissive factor x strength x texture
};

/// One entry a leaf.
///
///   images  by texture index; colours for base colour and emission, plain numbers for metallic and
///           roughness (green, blue); may be shorter (white). A few texels a metre are enough.
std::vector<PatchSurface> patch_surfaces(const Patches& patches, const Triangles& triangles,
                                         std::span<const ColorImage> images);

/// One source of NearLinks each.
std::vector<PatchSurface> near_surfaces(const NearLinks& near, const Triangles& triangles,
                                        std::span<const ColorImage> images);

/// Base colour at a point of a triangle, 0..1, textures and vertex colours included.
glm::vec3 surface_color(const Triangles& triangles, std::uint32_t triangle, Barycentric at,
                        std::span<const ColorImage> images);

/// Radiance that a point of a triangle sends out by itself: emissive factor x strength x texture.
glm::vec3 surface_emission(const Triangles& triangles, std::uint32_t triangle, Barycentric at,
                           std::span<const ColorImage> images);

/// Leaves that glow, brightest power (area x luminance) first, at most `most`; then ascending. Only
/// those whose radiance is above the mean of all surfaces.
std::vector<std::uint32_t> glowing_patches(const Patches& patches,
                                           std::span<const PatchSurface> surfaces,
                                           std::size_t most = 4096);

}  // namespace petrichor::scene

#endif
