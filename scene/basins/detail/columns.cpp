#include "scene/basins/detail/columns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace petrichor::scene::detail {

namespace {

constexpr double kClosed = 1e-4;      // sum of area vectors over the area of a closed mesh
constexpr double kInsideOut = -1e-4;  // signed volume over area^1.5
constexpr double kLeastSlope = 1e-3;  // cosine below which a triangle stands upright

bool finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Whether a mesh encloses a volume, and whether its faces look inwards. The area vectors of a
// closed mesh sum to zero; those of open ground, however bowl-shaped, do not.
struct Enclosure {
    bool closed = false, inside_out = false;
};
Enclosure enclosure_of(const std::vector<std::array<glm::dvec3, 3>>& triangles)
{
    glm::dvec3 vectors(0.0), middle(0.0);
    double area = 0.0, volume = 0.0;
    for (const auto& t : triangles) middle += t[0] + t[1] + t[2];
    if (!triangles.empty()) middle /= 3.0 * static_cast<double>(triangles.size());
    for (const auto& t : triangles) {
        const glm::dvec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
        vectors += cross;
        area += glm::length(cross);
        volume += glm::dot(t[0] - middle, glm::cross(t[1] - middle, t[2] - middle)) / 6.0;
    }
    Enclosure found;
    if (!(area > 0.0)) return found;
    // A flat sheet with both its sides sums to zero as well, and encloses nothing.
    const double shape = volume / std::pow(0.5 * area, 1.5);
    found.closed = glm::length(vectors) < kClosed * area && std::abs(shape) > -kInsideOut;
    found.inside_out = found.closed && shape < kInsideOut;
    return found;
}

}  // namespace

GroundTriangles ground_triangles(const Scene& scene, const GroundOptions& options)
{
    GroundTriangles out;
    std::vector<std::array<glm::dvec3, 3>> world;
    bool any_up = false;
    for (const Instance& instance : scene.instances) {
        if (instance.backdrop || instance.moves) continue;
        const glm::dmat4 to_world(instance.to_world);
        const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0.0;
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            const Material& material = scene.materials[primitive.material];
            GroundUse use = GroundUse::Auto;
            if (primitive.material < options.use.size()) use = options.use[primitive.material];
            if (use == GroundUse::Never || material.decal.on) continue;
            if (material.alpha_mode == AlphaMode::Blend && use == GroundUse::Auto) continue;
            world.clear();
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                std::array<glm::dvec3, 3> t;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 p(primitive.positions[primitive.indices[i + k]]);
                    t[k] = glm::dvec3(to_world * glm::dvec4(p, 1.0));
                }
                if (mirrored) std::swap(t[1], t[2]);
                if (!finite(t[0]) || !finite(t[1]) || !finite(t[2]))
                    ++out.not_finite;
                else
                    world.push_back(t);
            }
            const Enclosure enclosure = enclosure_of(world);
            const bool turned = enclosure.inside_out != material.cull_front;
            if (turned) ++out.turned;
            for (const auto& t : world) {
                const glm::dvec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
                const double length = glm::length(cross);
                if (!(length > 0.0) || std::abs(cross.y) < kLeastSlope * length) continue;
                const bool faces_up = (cross.y > 0.0) != turned;
                const bool both = material.double_sided;
                out.all.push_back({t, faces_up || both, !faces_up || both, enclosure.closed, use});
                any_up = any_up || faces_up || both;
            }
        }
    }
    if (!any_up && !out.all.empty()) {
        out.upside_down = true;
        for (GroundTriangle& t : out.all) std::swap(t.up, t.down);
    }
    return out;
}

float ground_of_column(std::vector<Layer>& layers, const GroundOptions& options)
{
    std::sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) {
        return std::tie(a.height_m, a.up, a.down, a.closed, a.ground) <
               std::tie(b.height_m, b.up, b.down, b.closed, b.ground);
    });
    for (std::size_t i = layers.size(); i-- > 0;)
        if (layers[i].ground && layers[i].up) return layers[i].height_m;
    std::size_t at = 0;
    while (at < layers.size() && !layers[at].up) ++at;
    if (at == layers.size()) return kNoGround_m;
    const float lowest = layers[at].height_m;
    float ground = lowest;
    for (std::size_t i = at + 1; i < layers.size(); ++i) {
        const double gap = static_cast<double>(layers[i].height_m) - static_cast<double>(ground);
        // A surface that faces down with air below it: an awning, the floor of a car.
        if (layers[i].down && gap > options.least_air_m) break;
        if (!layers[i].up) continue;
        if (!layers[i].closed && gap > options.sheet_gap_m) break;
        ground = layers[i].height_m;
    }
    if (static_cast<double>(ground) - static_cast<double>(lowest) > options.solid_above_m)
        return kSolid_m;
    return ground;
}

}  // namespace petrichor::scene::detail
