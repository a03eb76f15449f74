// A list of what a pass shades in place of all pixels. Its first word says how many pixels it has, or that it has tiles;
// then x + 65536 y of each.
#ifndef PETRICHOR_GPU_FRAME_PIXEL_LIST_IO_H
#define PETRICHOR_GPU_FRAME_PIXEL_LIST_IO_H

#define PIXEL_LIST_SPEC 90     // 0: all pixels; 1: by the list; 2: by the list, which has tiles
#define PIXEL_LIST_SPEC_INVOCATIONS 91  // of a workgroup, where a pass leaves it open: PIXEL_LIST_GROUP, or the lanes of a CPU, which take turns
#define PIXEL_LIST_ALL 0xffffffffu    // in place of how many: all, after all
#define PIXEL_LIST_TILES 0xfffffffeu  // .. as many tiles as there are groups
#define PIXEL_LIST_TILE 8
#define PIXEL_LIST_GROUP 64    // pixels that a workgroup shades

// list_groups: how many groups shade a list of pixels
#define LIST_GROUPS_LIST 0
#define LIST_GROUPS_GROUPS 1   // VkDispatchIndirectCommand

// tile_lists: which tiles show a surface, and which show the background
#define TILE_LISTS_GROUP 64
#define TILE_LISTS_FRAME 0
#define TILE_LISTS_DEPTH_ROWS 1
#define TILE_LISTS_SURFACES 2
#define TILE_LISTS_SURFACE_GROUPS 3
#define TILE_LISTS_OPEN 4
#define TILE_LISTS_OPEN_GROUPS 5

#endif
