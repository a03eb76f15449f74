#ifndef PETRICHOR_SCENE_TANGENTS_H
#define PETRICHOR_SCENE_TANGENTS_H

#include "scene/scene.h"

namespace petrichor::scene {

/// Replaces the normals by those of the triangles, so that every triangle looks flat. Vertices
/// whose triangles disagree are copied; the order of the triangles and of their corners stays. Old
/// tangents no longer fit and are removed.
///
/// A triangle without area gets the normal +y.
void generate_flat_normals(Primitive& primitive);

/// Replaces the tangents by those of the MikkTSpace method, which normal-map bakers agree on.
///
/// Corners with the same position, normal and texture coordinates are one point. Around a point the
/// triangles that share edges and have the same handedness of uv (not mirrored, or mirrored) form a
/// group; its tangent is the mean of the triangles' directions of growing u, laid into the plane of
/// the normal and weighted by their angle at the point. Nothing is averaged across a mirrored seam.
/// Corners of triangles without area or without uv area follow a neighbour at the same point, else
/// they get some unit vector in the plane of the normal. Vertices whose groups disagree are copied;
/// the order of the triangles and of their corners stays.
///
/// w is chosen for glTF, where v grows downwards: bitangent = w * cross(normal, tangent) points up
/// in the image (+y of the normal map).
///
///   primitive  normals.size() == positions.size(), indices < positions.size()
///   texcoord   0 or 1: the coordinates that the normal map uses. Empty: any unit tangents.
///   source     Mikkelsen 2008, Simulation of Wrinkled Surfaces Revisited, and mikktspace.com; with
///              the default angular threshold of 180 degrees, that is without further splits.
void generate_tangents(Primitive& primitive, int texcoord = 0);

}  // namespace petrichor::scene

#endif
