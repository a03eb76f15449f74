#include "scene/shapes.h"

#include <cmath>

#include "base/error.h"
#include "formulas/geometry/shapes.h"

namespace petrichor::scene {

const std::vector<ShapeKind>& shape_kinds()
{
    // Twelve levels of the tetrahedron are thousandths of a pixel; eight of the sponge likewise.
    static const std::vector<ShapeKind> kinds{
        {"mandelbulb", 8, 16, 2.0f}, {"sierpinski", 8, 16, 2.82842712f}, {"menger", 5, 10, 2.0f},
        {"sphere", 0, 0, 2.0f},      {"box", 0, 0, 2.0f},                {"torus", 0, 0, 2.0f}};
    return kinds;
}

glm::vec3 half_of(const MarchedShape& shape, const ShapeMoment& at)
{
    if (shape.kind == SHAPE_BOX || shape.kind == SHAPE_TORUS) return shape.half;
    return shared::shape_half(shape.kind, at.power);
}

Bounds shape_bounds(const MarchedShape& shape, const ShapeMoment& at)
{
    const glm::vec3 half = half_of(shape, at);
    const glm::mat3 linear(at.to_world);
    const glm::vec3 reach = glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y + glm::abs(linear[2]) * half.z;
    const glm::vec3 middle(at.to_world[3]);
    return {middle - reach, middle + reach};
}

void check_moment(const MarchedShape& shape, const ShapeMoment& at)
{
    const std::string who = "shapes: \"" + shape.name + "\" ";
    if (shape.kind == SHAPE_MANDELBULB && !(at.power >= 2.0f && at.power <= 12.0f)) {
        throw Error(who + "has the power " + std::to_string(at.power) + "; 2 to 12 are possible",
                    "Give a power of 2 to 12, such as 8.");
    }
    const glm::mat3 linear(at.to_world);
    const float scale = glm::length(linear[0]);
    bool fits = scale > 0.0f && std::isfinite(scale);
    for (int i = 0; i < 3; ++i) {
        fits = fits && std::abs(glm::length(linear[i]) - scale) <= 1e-4f * scale &&
               std::abs(glm::dot(linear[i], linear[(i + 1) % 3])) <= 1e-4f * scale * scale &&
               std::isfinite(at.to_world[3][i]);
    }
    fits = fits && glm::determinant(linear) > 0.0f;
    if (!fits) {
        throw Error(who + "is not placed by a turn, one scale above 0 and a shift: its distances would be none",
                    "Give it a size above 0 and a finite place.");
    }
}

void check_shape(const MarchedShape& shape, const Scene& scene)
{
    const std::string who = "shapes: \"" + shape.name + "\" ";
    const auto& kinds = shape_kinds();
    if (shape.kind < 0 || static_cast<std::size_t>(shape.kind) >= kinds.size())
        throw Error(who + "is of kind " + std::to_string(shape.kind) + ", which there is not", "Name one of its kinds.");
    const ShapeKind& kind = kinds[static_cast<std::size_t>(shape.kind)];
    if (shape.iterations < 0 || shape.iterations > kind.most || (kind.levels > 0 && shape.iterations < 1)) {
        throw Error(who + "has " + std::to_string(shape.iterations) + " iterations; a " + kind.name +
                        " has " + (kind.most > 0 ? "1 to " + std::to_string(kind.most) : std::string("none")),
                    kind.most > 0 ? "More are smaller than any pixel; give fewer." : "Leave them out.");
    }
    const glm::vec3& half = shape.half;
    const bool ring = shape.kind == SHAPE_TORUS;
    if (!(half.x > 0.0f && half.y > 0.0f && half.z > 0.0f && half.x + half.y + half.z < 1e6f) ||
        (ring && !(half.y <= 0.5f * half.x)))
        throw Error(who + "has no inside", "Give it sides above 0; the tube of a torus is at most half as wide as its ring.");
    check_moment(shape, shape.rest);
    if (shape.material >= scene.materials.size())
        throw Error(who + "has a material that the scene lacks", "Name a material of the scene.");
    const Material& m = scene.materials[shape.material];
    const auto refuse = [&](const std::string& what, const std::string& fix) {
        throw Error(who + "shows the material \"" + m.name + "\", which " + what, fix);
    };
    if (m.alpha_mode != AlphaMode::Opaque || m.transmission > 0.0f)
        refuse("has holes or lets light through: a shape is solid", "Give it an opaque material.");
    if (m.decal.on) refuse("is a decal", "Give it a material that is none.");
}

}  // namespace petrichor::scene
