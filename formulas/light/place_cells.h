// The tree in which points of surfaces find the patch whose weather they have: its words, and how far a pixel strays. Rows told
// once for C++ and GLSL; the lookup is place_lookup.inc, the tree is made by gpu/place/place_tree.h.
//
// The tree is one table of words: first the roots, a box of cells for each of the six axes, x fastest. Words of roots and of what they are cut into are a leaf,
// kNoPlace, or kPlaceCut and where the words begin of the cells that this one is cut into: 4 x 4 x 4 two levels finer,
// or 2 x 2 x 2 of the finest. So most points are found in two or three reads, all by the same steps.
//
// A PatchGrid of a tree has in `levels` those of the roots (5 bits) and how many there are across (9 bits for each of x, y and z),
// and in `table_mask` and `neighbors` the key of the first root's cell; in the two bits behind that by how many levels the finest cells of
// the tree are finer than those of level 0 of the patches, whose parts they are. Levels of the tree are counted from its own finest.
#ifndef PETRICHOR_FORMULAS_LIGHT_PLACE_CELLS_H
#define PETRICHOR_FORMULAS_LIGHT_PLACE_CELLS_H

#include "base/interop.h"
#include "formulas/light/patch_cells.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

SHARED_CONST uint kPlaceTexels = 4u;
SHARED_CONST uint kPlaceAsk = 0xffffffffu;
SHARED_CONST uint kPlaceCut = 0x80000000u;
SHARED_CONST uint kNoPlace = 0x7fffffffu;
SHARED_CONST int kMostRootsAcross = 511;

// A leaf: patch (16 bits), level (4), and of the 3 x 3 cells of its plane which it is connected to.
SHARED_FN uint place_leaf_patch(uint leaf) { return leaf & 0xffffu; }
SHARED_FN int place_leaf_level(uint leaf) { return int((leaf >> 16u) & 15u); }
SHARED_FN bool place_leaf_sees(uint leaf, int way) { return ((leaf >> (20u + uint(way))) & 1u) != 0u; }

// By how many levels the cells of a tree are finer than those of the patches, 0..3.
SHARED_FN int place_finer(PatchGrid tree) { return int(tree.neighbors >> 25u) & 3; }

// The finest cell of a tree that holds a point, and its edge.
SHARED_FN ivec3 place_cell(PatchGrid tree, vec3 x)
{
    const int finer = place_finer(tree);
    const vec3 c = floor((x * (1.0f / tree.cell_m) + splat3(kPatchGridShift)) * float(1 << finer));
    const int bias = kPatchCellBias << finer;
    return ivec3(int(c.x), int(c.y), int(c.z)) + ivec3(bias, bias, bias);
}
SHARED_FN float place_edge_m(PatchGrid tree) { return tree.cell_m / float(1 << place_finer(tree)); }

// The number of a way of -1..1 cells along the next axis of the plane, and along the one behind that.
SHARED_FN int place_way(int along, int across) { return along + 1 + 3 * (across + 1); }

// Where among the words of a cut cell those of a cell stand that has these numbers in its own level.
SHARED_FN uint place_cut_at(ivec3 cell, int levels)
{
    const int last = (1 << levels) - 1;
    return uint((cell.x & last) | ((cell.y & last) << levels) | ((cell.z & last) << (2 * levels)));
}

// A turn of its own for every pixel, -0.5 to 0.5, evenly spread over its samples.
SHARED_FN vec3 place_turn(ivec2 pixel, uint sample_index)
{
    const uint seed = hash_u3(uint(pixel.x), uint(pixel.y), 29u);
    const vec3 first = vec3(hash_f(seed), hash_f(seed ^ 0x9e3779b9u), hash_f(seed ^ 0x7f4a7c15u));
    return fract(first + float(sample_index) * vec3(0.8191725f, 0.6710436f, 0.5497005f)) - splat3(0.5f);
}

struct PlaceOwn {
    uint leaf;  // at a point; kNoPlace where none is near
    int axis;   // 0..5, that it looks along
};

struct PlaceLeaves {
    uint own;
    uint own_material;
    uint other;  // the patch at the point moved by the turn, its material in the upper 16 bits
    vec2 way;    // of the turn in its plane, along the next axis and the one behind that
};

struct PlaceFound {
    uint number;       // of a patch; kNoPatch
    bool of_material;  // it is made of what the point is made of
};

SHARED_END

#endif
