#ifndef PETRICHOR_DEMO_MESH_BUILDER_H
#define PETRICHOR_DEMO_MESH_BUILDER_H

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace petrichor::demo {

/// A box with bevelled edges, turned by `axes` (its columns are the box's x, y, z in the world).
struct BoxShape {
    glm::vec3 centre{0.0f};
    glm::vec3 half{0.5f};  ///< half edges, metres
    float bevel_m = 0.0f;  ///< width of the chamfer; shaded round
    glm::mat3 axes{1.0f};
    int grain = 1;  ///< axis 0..2 along which the texture's v runs
};

/// Collects the triangles of one material. Texture coordinates are metres over tile_m; u to the
/// right and v down as seen from outside, so a normal map's green points up.
class MeshBuilder {
public:
    explicit MeshBuilder(float tile_m) : tile_m_(tile_m) {}

    glm::vec4 color{1.0f};    ///< given to the vertices that follow
    glm::vec4 weather{1.0f};  ///< r mix, g puddle mask, b snow mask
    glm::vec2 uv_offset_m{0.0f};
    float uv_scale = 1.0f;  ///< > 1: the material appears smaller

    std::uint32_t add_vertex(const glm::vec3& position, const glm::vec3& normal,
                             const glm::vec2& uv_m);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    /// Four corners counter-clockwise as seen from outside; flat, uv from the plane.
    /// `up` is the direction in which the texture's v decreases.
    void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
              const glm::vec3& up = glm::vec3(0.0f, 1.0f, 0.0f));
    void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                  const glm::vec3& up = glm::vec3(0.0f, 1.0f, 0.0f));

    void box(const BoxShape& shape);
    /// A bevelled box from one point to another, width and height across; v runs along it.
    void beam(const glm::vec3& from, const glm::vec3& to, float width_m, float height_m,
              float bevel_m, const glm::vec3& side = glm::vec3(0.0f, 1.0f, 0.0f));

    /// A (columns + 1) x (rows + 1) grid: `point(i, j)` gives position, normal and uv in metres.
    struct Point {
        glm::vec3 position;
        glm::vec3 normal;
        glm::vec2 uv_m;
        glm::vec4 color{1.0f};
        glm::vec4 weather{1.0f};
    };
    void grid(int columns, int rows, const std::function<Point(int, int)>& point);

    /// A surface of revolution: (radius, height) pairs from bottom to top, around +y through
    /// `foot`.
    void lathe(const glm::vec3& foot, const std::vector<glm::vec2>& profile, int sides,
               const glm::mat3& axes = glm::mat3(1.0f));
    /// A round pipe along a path, with closed ends; radius may differ by point.
    void tube(const std::vector<glm::vec3>& path, const std::vector<float>& radius_m, int sides);
    void tube(const std::vector<glm::vec3>& path, float radius_m, int sides);

    std::size_t triangle_count() const { return primitive_.indices.size() / 3; }
    /// The finished primitive. Masks and colours are kept only when they are not all one.
    scene::Primitive take(std::uint32_t material);

private:
    void face_uv_axes(const glm::vec3& normal, const glm::vec3& up, glm::vec3& u,
                      glm::vec3& v) const;

    float tile_m_;
    scene::Primitive primitive_;
};

}  // namespace petrichor::demo

#endif
