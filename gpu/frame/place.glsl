// The patch at a surface point, and the hollow that lies below it. The includer has `frame` and
//
//   usamplerBuffer place_table     words of a tree (formulas/light/place_cells.h)
//   usamplerBuffer place_states    kPlaceTexels a patch (place_cells.h), behind all of them PLACE_STATE_TEXELS a patch, floats
//   usamplerBuffer place_labels    of the cells of the ground: the pit they drain to, 0 none
//   samplerBuffer place_levels     world y of the water over a pit
#ifndef PETRICHOR_PLACE_GLSL
#define PETRICHOR_PLACE_GLSL

#include "formulas/light/place_cells.h"
#include "gpu/frame/place_io.h"

uint place_word(uint index)
{
    return texelFetch(place_table, int(index)).r;
}

uvec4 place_texel(uint index)
{
    return texelFetch(place_states, int(index));
}

#include "formulas/light/place_lookup.inc"

// The patch at a point of a surface, kNoPatch where none is near.
uint place_patch(vec3 x, vec3 n)
{
    const uint leaf = place_own(frame.place.grid, x, n).leaf;
    return leaf == kNoPlace ? kNoPatch : place_leaf_patch(leaf);
}

vec4 place_state(uint patch_number, int texel)
{
    const uint first = frame.place.grid.patches * kPlaceTexels;
    return uintBitsToFloat(texelFetch(place_states, int(first + patch_number * PLACE_STATE_TEXELS) + texel));
}

// Whether a point without a patch is open ground whose state is known (PlaceConstants::open_patch).
bool place_open(vec3 n, uint material_id)
{
    return frame.place.open_patch != kNoPatch && n.y > 0.3 &&
           uint(place_state(frame.place.open_patch, 3).w) == material_id;
}

// How deep a point of the ground lies below the water of its hollow, m; 0 where there is none.
float place_depth(vec3 x)
{
    if (frame.place.basin_width == 0u) return 0.0;
    const ivec2 cell = ivec2(floor((x.xz - frame.place.basin_corner_m) / frame.place.basin_cell_m));
    if (any(lessThan(cell, ivec2(0))) || cell.x >= int(frame.place.basin_width) ||
        cell.y >= int(frame.place.basin_depth)) {
        return 0.0;
    }
    const uint label =
        texelFetch(place_labels, cell.y * int(frame.place.basin_width) + cell.x).x;
    if (label == 0u || label == 0xffffffffu) return 0.0;
    const float depth = texelFetch(place_levels, int(label)).x - x.y;
    // Cellars are no ponds.
    return depth > 0.0 && depth < 2.0 ? depth : 0.0;
}

#endif
