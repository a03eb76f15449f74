#ifndef PETRICHOR_SCENE_ICICLES_ICICLES_H
#define PETRICHOR_SCENE_ICICLES_ICICLES_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/drips/drip_points.h"
#include "scene/icicles/icicle.h"
#include "scene/scene.h"

namespace petrichor::scene {

/// An icicle that may hang at an edge, as far as it is the same in all frames.
struct Icicle {
    glm::vec3 root_m{0.0f};    ///< where it is widest, at the edge
    glm::vec2 lean{0.0f};      ///< how far it is off the plumb line, world x and z by its length
    float drained_m2 = 0.0f;
    float share = 1.0f;        ///< of the length of one that has had all water of its place: others had it at times
    float most_m = 0.0f;       ///< what hangs lower touches what lies below
    float shortest_m = 0.0f;   ///< shorter ones are not seen from where the film is
    float turn = 0.0f;         ///< about its axis, radians; the phase of its rings, too
    std::uint32_t drip = 0;    ///< number of its point among those of hang_icicles()
    int sides = 6;             ///< of a section, and ..
    int bands = 12;            ///< .. along it
    std::uint32_t first_vertex = 0;  ///< of icicle_vertices(..) that are its own
};

/// Icicles of a scene; neighbours follow each other.
struct Icicles {
    struct Part {
        std::uint32_t first = 0, end = 0;  ///< of `icicles`
        Bounds box;                        ///< that they never leave
    };
    std::vector<Icicle> icicles;
    std::vector<Part> parts;
    std::uint32_t vertices = 0;   ///< of all of them
    std::uint32_t triangles = 0;
    std::uint32_t material = 0;   ///< of the scene
    std::uint32_t instance = 0;   ///< their name in labels: of the scene, without a mesh

    bool empty() const { return icicles.empty(); }
};

/// Where icicles may hang: at every point that drips, cut finer near an eye of the film (none: as at 5 m), none
/// farther than 80 m from all of them. The same for any number of threads.
Icicles hang_icicles(std::span<const DripPoint> points, std::span<const glm::vec3> eyes_m);

/// How long one is in a frame; 0: it is not drawn.
float icicle_length_m(const Icicle& icicle, const IcicleLengths& lengths);

std::uint32_t icicle_vertices(const Icicle& icicle);
std::uint32_t icicle_triangles(const Icicle& icicle);

/// The surface of one that is so long: closed, rings a centimetre apart (of four bands where those are longer), by a
/// hundredth or two of the radius. The section of its corners has the area of the round one.
///   positions, normals   icicle_vertices() each
void shape_icicle(const Icicle& icicle, float length_m, std::span<glm::vec3> positions, std::span<glm::vec3> normals);
/// 3 numbers a triangle, from its first vertex.
void icicle_indices(const Icicle& icicle, std::span<std::uint32_t> indices);

/// Adds what icicles are made of and the name that labels have for them, behind all others: the material "icicles", clear
/// ice with bubbles, which neither rain nor snow lies on, and an instance without triangles.
void add_icicle_material(Scene& scene);
/// Those of add_icicle_material(); false where they are not there.
bool find_icicle_material(const Scene& scene, Icicles& icicles);

}  // namespace petrichor::scene

#endif
