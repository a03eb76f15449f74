// Interface of the passes that turn a visibility buffer into a G-buffer.
//
//   tile_materials   how many pixels of a tile show each material: counted, then listed; what is steep in lists of its own
//   tile_offsets     where each material's list of pixels begins, and how many groups shade it
//   surface_resolve  one dispatch a material over its pixels
#ifndef PETRICHOR_GPU_PASSES_SURFACE_RESOLVE_SURFACE_RESOLVE_IO_H
#define PETRICHOR_GPU_PASSES_SURFACE_RESOLVE_SURFACE_RESOLVE_IO_H

#include "base/interop.h"
#include "gpu/passes/surface/surface_io.h"
#include "gpu/upload/steep_io.h"

#define RESOLVE_TILE 8  // pixels a side, of the tiles that are listed
#define RESOLVE_GROUP 64  // pixels that a workgroup shades
#define RESOLVE_CPU_GROUP 256  // of a CPU, which reads constants once for all of them
#define RESOLVE_TILE_MATERIALS 64

// Texels (RGBA32UI) of one draw in the table of draws: the rows of its two transforms, then
// first index, vertex offset, material and what it is of DRAW_.., instance; then 1 when mirrored, the instance's look, 1 of a marched shape.
#define RESOLVE_DRAW_TEXELS 8

#define TILE_MATERIALS_GROUP 8
#define TILE_MATERIALS_IDS 0
#define TILE_MATERIALS_DRAWS 1
#define TILE_MATERIALS_COUNTS 2  // two words a material, the second of what is steep: pixels that show it, later where their list ends
#define TILE_MATERIALS_PIXELS 3  // x + 65536 y, list after list
#define TILE_MATERIALS_ASKED 4   // passes/adaptive: the pixels of a tile that are shaded, by bits
#define TILE_MATERIALS_SPEC_LIST 0   // 0: count, 1: list
#define TILE_MATERIALS_SPEC_ASKED 1  // 0: all pixels

#define TILE_OFFSETS_GROUP 1
#define TILE_OFFSETS_COUNTS 0
#define TILE_OFFSETS_GROUPS 1  // VkDispatchIndirectCommand a list

// Behind the bindings of set 0 that every evaluation of a surface reads:
#define RESOLVE_IDS SURFACE_BINDINGS
#define RESOLVE_VERTICES (SURFACE_BINDINGS + 1)
#define RESOLVE_INDICES (SURFACE_BINDINGS + 2)
#define RESOLVE_DRAWS (SURFACE_BINDINGS + 3)
#define RESOLVE_PIXELS (SURFACE_BINDINGS + 4)
#define RESOLVE_COUNTS (SURFACE_BINDINGS + 5)
#define RESOLVE_SHARES (SURFACE_BINDINGS + 6)  // of layers a pixel; in scenes that have textures of them
#define RESOLVE_DEPTH (SURFACE_BINDINGS + 7)  // of scenes that have marched shapes
#define RESOLVE_WET (SURFACE_BINDINGS + 8)    // in place of the target of the weather
#define RESOLVE_TARGETS (SURFACE_BINDINGS + 9)  // of the G-buffer, by location
#define RESOLVE_LIT_VERTICES (RESOLVE_TARGETS + 7)  // behind all of those
#define RESOLVE_LIT_FIRSTS (RESOLVE_TARGETS + 8)
#define RESOLVE_SPEC_WEATHER 5  // WEATHER_..
#define RESOLVE_SPEC_EMISSION 6
#define RESOLVE_SPEC_BAKED 7
#define RESOLVE_SPEC_SHAPES 36   // 1: marched shapes show the material
#define RESOLVE_SPEC_IN_WORLD 37  // 1: meshes that show the material are laid out in the world
#define RESOLVE_SPEC_INVOCATIONS 44  // of a workgroup: RESOLVE_GROUP, or the lanes of a CPU, which take turns
#define RESOLVE_SPEC_PAYLOAD 35  // 0: as the target is cleared

SHARED_BEGIN

struct TileMaterialsParams {
    ivec2 size;      // pixels
    uint steep;  // DRAW_.. of what has a list of its own; 0: nothing
};

struct TileOffsetsParams {
    uint lists;
    uint group;  // pixels that a workgroup shades
};

struct SurfaceResolveParams {
    uint material;
    uint list;
    uint width;  // pixels of a row
};

SHARED_END

#endif
