// Interface of the draws of marched shapes.
#ifndef PETRICHOR_GPU_PASSES_SHAPES_SHAPES_IO_H
#define PETRICHOR_GPU_PASSES_SHAPES_SHAPES_IO_H

#include "base/interop.h"

#define SHAPE_SPEC_KIND 0     // SHAPE_... of formulas/geometry/shapes.h
#define SHAPE_SPEC_FLATTEN 1  // 1: what lies before the near plane of a depth map is laid onto it

SHARED_BEGIN

// Push constants of one shape. Its own space: half is half of its box there.
struct ShapeDraw {
    mat4 clip_from_object;
    vec4 eye;        // in its space: a point, or with w 0 the unit direction towards the eye
    vec3 half_size;
    float power;
    vec2 footprint;  // of a pixel, in its units: x + y * distance from the eye
    int iterations;
    uint draw;       // number of its draw, of pictures alone
};

SHARED_END

#endif
