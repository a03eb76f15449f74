// Flat faces near patches: triangles of one plane together, cut to boxes.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_FACES_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_NEAR_FACES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/patches/patches.h"
#include "scene/patches/triangles.h"

namespace petrichor::scene {

/// Convex, of up to 12 corners.
struct NearPolygon {
    std::array<glm::vec3, 12> corner;
    int count = 0;
};

/// What of a polygon lies where dot(n, x) >= least.
NearPolygon cut_above(const NearPolygon& polygon, glm::vec3 n, float least);
/// What of it lies in a box.
NearPolygon cut_to(const NearPolygon& polygon, glm::vec3 low, glm::vec3 high);
/// No more than four corners: those go that cut off least.
void simplify(NearPolygon& polygon);
float area_m2(const NearPolygon& polygon);
/// The point of the polygon that is nearest to x. n: of its plane, unit.
glm::vec3 nearest_in(const NearPolygon& polygon, glm::vec3 n, glm::vec3 x);
/// Its distance, metres.
float distance_m(const NearPolygon& polygon, glm::vec3 n, glm::vec3 x);
/// Whether a point of its plane lies in it, to a margin in metres.
bool holds(const NearPolygon& polygon, glm::vec3 n, glm::vec3 x, float margin_m);

/// Four corners, of a triangle the last one twice; and back. At most four corners.
std::array<glm::vec3, 4> corners_of(const NearPolygon& polygon);
NearPolygon polygon_of(const std::array<glm::vec3, 4>& corners);

/// Unit normal of a quad on its front, from which its corners are in turn; up where it has no area.
glm::vec3 front_of(const std::array<glm::vec3, 4>& corners);
/// A point within a quad, by two numbers of 0..1.
glm::vec3 point_in(const std::array<glm::vec3, 4>& corners, float u, float v);
/// The middle of quarter k of a quad, 0..3, where lamps are asked.
glm::vec3 lamp_point(const std::array<glm::vec3, 4>& corners, std::size_t k);

/// A triangle, or two that make a convex quad of one material: a face of a box is one polygon then, not two.
struct NearFace {
    std::array<std::uint32_t, 2> triangles;  ///< the same twice for one
    NearPolygon polygon;                     ///< in turn, seen from the front
    glm::vec3 normal;
};

/// All triangles of a scene as faces: each triangle and the one or two after it in the mesh are tried.
struct NearFaces {
    std::vector<NearFace> faces;
    std::vector<std::uint32_t> of_triangle;
};
NearFaces near_faces(const Triangles& triangles);

/// The place of a point of a face on that of its triangles that is nearest to hold it.
PatchSample place_on(const Triangles& triangles, const NearFace& face, bool back, glm::vec3 x);

}  // namespace petrichor::scene

#endif
