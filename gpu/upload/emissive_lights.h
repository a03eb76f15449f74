#ifndef PETRICHOR_GPU_UPLOAD_EMISSIVE_LIGHTS_H
#define PETRICHOR_GPU_UPLOAD_EMISSIVE_LIGHTS_H

#include <cstddef>
#include <memory>
#include <vector>

#include "gpu/upload/texture.h"

namespace petrichor::gpu {

/// What glows in a scene, as lights: connected triangles of glowing materials become one rectangle
/// where they are flat (its middle, direction, area and mean radiance are theirs), a point of the
/// same mean intensity where they are closed around. Panes beside each other in one plane are one.
///
///   radiance   of a triangle: that of the material, times its texture at the triangle's middle;
///              below 2 % of the brightest it is left out. Of blocks their plain level is read
///              (Texture::plain); without one they are seen, and light nothing
///   left out   what encloses a point or spot light of the scene, which stands for it already; what
///              bends; what sends less than a thousandth of the whole; all but the brightest 256.
///
/// Deterministic: in the order of instances and triangles.
std::vector<Light> emissive_lights(const Scene& scene, const std::vector<Texture>& textures);

/// The same in two steps, for emission that changes from frame to frame: where surfaces can glow
/// (those whose material glows as it was loaded), and how they do with these materials.
struct GlowSource {
    Light light;            ///< of radiance 1
    glm::vec3 share{1.0f};  ///< of the material's emission, by its texture
    float area_m2 = 0.0f;
    std::size_t material = 0;
    std::shared_ptr<const Instance> carrier = {};  ///< that moves it; null: nothing does
};
std::vector<GlowSource> glow_sources(const Scene& scene, const std::vector<Texture>& textures);
std::vector<Light> glowing(const std::vector<GlowSource>& sources,
                           const std::vector<Material>& materials);

}  // namespace petrichor::gpu

#endif
