#ifndef PETRICHOR_SCENE_SHAPES_H
#define PETRICHOR_SCENE_SHAPES_H

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// One kind of marched shape: a row for each SHAPE_... of formulas/geometry/shapes.h, by its number.
struct ShapeKind {
    std::string name;
    int levels;      ///< iterations when none are given; 0: it is not made in steps
    int most;        ///< of them
    float units;     ///< how many of its units its size is: an edge, or how wide it is
};
const std::vector<ShapeKind>& shape_kinds();

/// The box of a shape in the world at one of its moments.
Bounds shape_bounds(const MarchedShape& shape, const ShapeMoment& at);

/// Half of the box that holds a shape at a moment, in its units.
glm::vec3 half_of(const MarchedShape& shape, const ShapeMoment& at);

/// Throws Error for a shape that no ray can be marched to: a kind, a count or a number out of its range, a
/// transform that is not a turn, one scale and a shift, a material that the scene lacks or that light passes.
void check_shape(const MarchedShape& shape, const Scene& scene);
void check_moment(const MarchedShape& shape, const ShapeMoment& at);

}  // namespace petrichor::scene

#endif
