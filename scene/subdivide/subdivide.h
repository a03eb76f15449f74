#ifndef PETRICHOR_SCENE_SUBDIVIDE_SUBDIVIDE_H
#define PETRICHOR_SCENE_SUBDIVIDE_SUBDIVIDE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

struct SubdivideOptions {
    /// Whether an edge is still too long. Asked with the ends in one order, whichever triangle has
    /// the edge; a pure function of them.
    std::function<bool(const glm::vec3&, const glm::vec3&)> too_long;
    /// By primitive: whose edges are asked. Others are cut only along the edges that they share with
    /// those, and what lies there is pinned. Shorter or empty: all.
    std::vector<bool> cut;
    int most_levels = 6;  ///< an edge becomes at most 2^most_levels edges
    std::size_t most_triangles = 4'000'000;
    float phong = 0.0f;  ///< 0 flat .. 1 on the tangent planes of the corners
};

/// Primitives that were cut together. A point is a place of the mesh; vertices that differ in normal,
/// texture coordinates or primitive share one.
struct CutMesh {
    std::vector<Primitive> primitives;
    std::vector<std::vector<std::uint32_t>> points;  ///< of each primitive: the point of each vertex
    std::vector<glm::vec3> normals;  ///< of each point, unit: the mean of its vertices'
    std::vector<bool> pinned;        ///< of each point: on an edge of a primitive that is not cut
    std::vector<std::vector<std::uint32_t>> origins;  ///< of each primitive: which of its triangles each was a part of
    bool limited = false;            ///< `most_triangles` ended it
};

/// Cuts triangles until no edge is too long: each edge in its middle, each triangle into two to four.
///
/// Whether and where an edge is cut is decided once for all triangles that meet there, across seams
/// and primitives, so there are neither cracks nor T junctions: all vertices of a point have the same
/// position to the bit. Between the ends everything is the mean: normals, tangents, texture
/// coordinates, colours, masks, morph targets; of joints the strongest stay. The order is that of the
/// triangles, whatever else runs.
///
///   primitives  of one mesh; indices < positions.size()
///   source      Boubekeur & Alexa 2008, Phong Tessellation, ACM Trans. Graph. 27(5), for `phong`
CutMesh subdivide(const std::vector<Primitive>& primitives, const SubdivideOptions& options);

/// Unit normals of the points from the triangles around them, by area; where there is none, as before.
std::vector<glm::vec3> point_normals(const CutMesh& mesh);

}  // namespace petrichor::scene

#endif
