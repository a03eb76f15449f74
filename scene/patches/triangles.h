#ifndef PETRICHOR_SCENE_PATCHES_TRIANGLES_H
#define PETRICHOR_SCENE_PATCHES_TRIANGLES_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Alpha of a texture as rays test it, 0..255, row 0 at the top (v = 0). Empty: opaque everywhere.
struct AlphaImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> alpha;  ///< width * height
};

/// What a ray sees of a triangle.
enum TriangleFlags : std::uint8_t {
    kTriangleDoubleSided = 1,  ///< its back is a surface too
    kTriangleMasked = 2,       ///< has holes by alpha
    kTriangleSheltered = 4,    ///< of a sheltered material
    kTriangleBackdrop = 8,     ///< of a backdrop near the scene
};

/// Of a backdrop what lies within so many halves of the scene's diagonal is there: what is farther
/// away sees the open sky.
inline constexpr float kBackdropReach = 4.1f;

/// Barycentric coordinates of the second and third corner.
struct Barycentric {
    float b1 = 0.0f;
    float b2 = 0.0f;
};

/// All triangles of a scene in the world that stop light: instance by instance, primitive by
/// primitive, in the order of their indices. Left out: blended and transmissive materials, corners
/// that are not finite, areas of zero; what was left out is counted. Front faces are those that are
/// seen: a mirrored instance or a material with cull_front turns a triangle round.
class Triangles {
public:
    /// alpha: one entry a texture of the scene, by index; may be shorter or empty (no holes then).
    /// The scene must outlive this object.
    Triangles(const Scene& scene, std::span<const AlphaImage> alpha);

    std::uint32_t size() const { return static_cast<std::uint32_t>(flags_.size()); }
    /// Corner 0, and the ways from it to corners 1 and 2.
    const glm::vec3& corner(std::uint32_t t) const { return corners_[t]; }
    const glm::vec3& edge1(std::uint32_t t) const { return edges1_[t]; }
    const glm::vec3& edge2(std::uint32_t t) const { return edges2_[t]; }
    std::uint8_t flags(std::uint32_t t) const { return flags_[t]; }
    bool double_sided(std::uint32_t t) const { return (flags_[t] & kTriangleDoubleSided) != 0; }
    /// Unit, of the front.
    glm::vec3 normal(std::uint32_t t) const;
    float area_m2(std::uint32_t t) const;
    glm::vec3 point(std::uint32_t t, Barycentric at) const
    {
        return corners_[t] + edges1_[t] * at.b1 + edges2_[t] * at.b2;
    }
    std::uint32_t material(std::uint32_t t) const;
    /// Texture coordinates as the material's use of a texture reads them.
    glm::vec2 uv(std::uint32_t t, Barycentric at, const TextureUse& use) const;
    /// COLOR_0, white without.
    glm::vec4 color(std::uint32_t t, Barycentric at) const;
    /// _WEATHER, 1 everywhere without.
    glm::vec4 weather(std::uint32_t t, Barycentric at) const;
    /// Shading normal of the mesh, unit, in the world; the face's where the mesh has none.
    glm::vec3 shading_normal(std::uint32_t t, Barycentric at) const;
    /// A masked triangle is a hole there.
    bool is_hole(std::uint32_t t, Barycentric at) const;

    const Scene& scene() const { return *scene_; }
    glm::vec3 low() const { return low_; }    ///< of all triangles but backdrops, metres
    glm::vec3 high() const { return high_; }
    /// The largest coordinate of all, and whether backdrops are among them.
    float farthest_m() const { return farthest_m_; }
    bool backdrop() const { return backdrop_; }
    double total_area_m2() const { return area_; }  ///< fronts only, without backdrops
    std::uint64_t left_out_blended() const { return blended_; }
    std::uint64_t left_out_degenerate() const { return degenerate_; }
    /// Fingerprint of everything that rays can see: positions, sides, holes.
    const std::string& fingerprint() const { return fingerprint_; }

private:
    // Triangles of one primitive of one instance are neighbours.
    struct Run {
        std::uint32_t first = 0;  // index of its first triangle here
        const Primitive* primitive = nullptr;
        const glm::mat4* to_world = nullptr;
        bool turned = false;  // corners 1 and 2 were exchanged
    };
    const Run& run_of(std::uint32_t t) const;

    const Scene* scene_ = nullptr;
    std::vector<AlphaImage> alpha_;
    std::vector<Run> runs_;
    std::vector<glm::vec3> corners_, edges1_, edges2_;
    std::vector<std::uint32_t> source_;  // number of the triangle in its primitive
    std::vector<std::uint32_t> run_;
    std::vector<std::uint8_t> flags_;
    glm::vec3 low_{0.0f}, high_{0.0f};
    float farthest_m_ = 0.0f;
    bool backdrop_ = false;
    double area_ = 0.0;
    std::uint64_t blended_ = 0, degenerate_ = 0;
    std::string fingerprint_;
};

}  // namespace petrichor::scene

#endif
