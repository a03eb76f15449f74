// The patch at a surface point, and the hollow that lies below it. The includer has `frame` and
//
//   usamplerBuffer place_table     key of a cell, its node, its connection bits
//   samplerBuffer place_states     PLACE_STATE_TEXELS a patch
//   usamplerBuffer place_labels    of the cells of the ground: the pit they drain to, 0 none
//   samplerBuffer place_levels     world y of the water over a pit
#ifndef PETRICHOR_PLACE_GLSL
#define PETRICHOR_PLACE_GLSL

#include "gpu/frame/place_io.h"

// The leaf of an axis that holds a cell of the finest level: its number (kNoPatch), connection bits
// and level.
uvec3 place_leaf(ivec3 cell0, int axis)
{
    const PatchGrid grid = frame.place.grid;
    uvec3 found = uvec3(kNoPatch, 0u, 0u);
    bool going = true;
    for (int level = int(grid.levels) - 1; level >= 0 && going; --level) {
        const PatchKey key =
            patch_key(ivec3(cell0.x >> level, cell0.y >> level, cell0.z >> level), axis, level);
        uint slot = patch_key_hash(key) & grid.table_mask;
        going = false;
        for (int probe = 0; probe < 64; ++probe) {
            const uvec4 entry = texelFetch(place_table, int(slot));
            if (entry.z == kNoPatch) break;
            if (entry.x == key.low && entry.y == key.high) {
                // An interior node: the leaf is finer.
                going = entry.z >= grid.patches;
                if (!going) found = uvec3(entry.z, entry.w, uint(level));
                break;
            }
            slot = (slot + 1u) & grid.table_mask;
        }
    }
    return found;
}

// x: the patch at a point of a surface, kNoPatch where none is near. y: the one at the point moved by
// `turn`, -0.5 to 0.5, of the patch's cell along the surface, of the finer one of two: the mean over many
// turns blends between patches linearly. Not across walls.
uvec2 place_patches(vec3 x, vec3 n, vec3 turn)
{
    if (frame.place.grid.levels == 0u) return uvec2(kNoPatch);
    const float inverse_cell = 1.0 / frame.place.grid.cell_m;
    const vec3 lifted = x + n * (0.06 * frame.place.grid.cell_m);
    const ivec3 cell0 = patch_cell(lifted, inverse_cell);
    // The axis that the normal points along most, then the next ones.
    vec3 along = abs(n);
    uvec3 own = uvec3(kNoPatch, 0u, 0u);
    int axis = 0;
    for (int turned = 0; turned < 3 && own.x == kNoPatch; ++turned) {
        const int most = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
        axis = 2 * most + (n[most] >= 0.0 ? 0 : 1);
        along[most] = -1.0;
        own = place_leaf(cell0, axis);
    }
    if (own.x == kNoPatch || turn == vec3(0.0)) return own.xx;
    turn[axis / 2] = 0.0;
    const float cell_m = frame.place.grid.cell_m * float(1 << own.z);
    const ivec3 there = patch_cell(lifted + turn * cell_m, inverse_cell);
    const int up = int(own.z);
    const ivec3 way = ivec3(there.x >> up, there.y >> up, there.z >> up) -
                      ivec3(cell0.x >> up, cell0.y >> up, cell0.z >> up) + ivec3(1);
    const uint bit = uint(way.x + 3 * way.y + 9 * way.z);
    if (((own.y >> bit) & 1u) == 0u) return own.xx;
    uvec3 other = place_leaf(there, axis);
    if (other.x != kNoPatch && other.z < own.z) {
        // Where cells are finer they blend over half of their own width: further in lies what this
        // cell does not see, as the ground within a well.
        const float finer_m = frame.place.grid.cell_m * float(1 << other.z);
        const ivec3 nearer = patch_cell(lifted + turn * finer_m, inverse_cell);
        if (ivec3(nearer.x >> up, nearer.y >> up, nearer.z >> up) ==
            ivec3(cell0.x >> up, cell0.y >> up, cell0.z >> up)) {
            return own.xx;
        }
        other = place_leaf(nearer, axis);
    }
    return uvec2(own.x, other.x == kNoPatch ? own.x : other.x);
}

uint place_patch(vec3 x, vec3 n, vec3 turn)
{
    return place_patches(x, n, turn).y;
}

vec4 place_state(uint patch_number, int texel)
{
    return texelFetch(place_states, int(patch_number) * PLACE_STATE_TEXELS + texel);
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
