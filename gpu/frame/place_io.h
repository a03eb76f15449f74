// Where the weather of the scene's patches and the water of its hollows are found.
#ifndef PETRICHOR_GPU_FRAME_PLACE_IO_H
#define PETRICHOR_GPU_FRAME_PLACE_IO_H

#include "base/interop.h"
#include "formulas/light/patch_cells.h"

// Texels (RGBA32UI: bits of floats) a patch in the table of states: what pixels show (place.glsl), then SI:
//   0  film 0..1, level in cracks, level in puddles, snow amount
//   1  frost, frozen share, share of the rain that meets it, 0 or 2 + level of the water in the relief
//   2  film mm, mean depth of the water in the relief m, snow m, ice kg/m2
// A level is in heights of the material's relief, of water whose mean depth is that of texel 2; above -1.
// Where there is one, texel 0 has instead of the level in cracks the share of the ground below it.
//   3  liquid share of all water, surface temperature K, clear ice on it (glaze) mm, number of the material
#define PLACE_STATE_TEXELS 4

SHARED_BEGIN

struct PlaceConstants {
    PatchGrid grid;       // levels 0: no patches
    vec2 basin_corner_m;  // world x and z
    float basin_cell_m;
    uint basin_width;  // cells; 0: no hollows
    uint basin_depth;
    uint open_patch;  // state of open ground of its material without a patch; kNoPatch: there is none
    float glazed;     // of what is wet or icy of all patches, how much is clear ice, 0..1: films of places look as that
};

SHARED_END

#endif
