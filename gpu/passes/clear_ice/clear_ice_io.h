// Interface of the passes of icicles: ice_list tells which pixels show some, clear_ice what is seen through them.
#ifndef PETRICHOR_GPU_PASSES_CLEAR_ICE_CLEAR_ICE_IO_H
#define PETRICHOR_GPU_PASSES_CLEAR_ICE_CLEAR_ICE_IO_H

#include "gpu/passes/reflections/reflections_io.h"

SHARED_BEGIN
struct ClearIcePush {
    MirrorWindow window;
    uint model;  // what the G-buffer has for the ice: of its lighting model and layers
};
SHARED_END

#define CLEAR_ICE_FRAME 0
#define CLEAR_ICE_DEPTH_ROWS 1  // of the G-buffer, as the next two
#define CLEAR_ICE_NORMALS 2
#define CLEAR_ICE_MATERIAL 3
#define CLEAR_ICE_RADIANCE 4
#define CLEAR_ICE_ACCUMULATED 5
#define CLEAR_ICE_SPECULAR 6
#define CLEAR_ICE_PROBES 7       // as the pass of reflections has them
#define CLEAR_ICE_PROBE_LIGHT 8
#define CLEAR_ICE_PIXELS 9       // gpu/frame/pixel_list_io.h
#define CLEAR_ICE_PARTS 10       // gpu/outputs/light_parts_io.h
#define CLEAR_ICE_AROUND_DEPTH 11
#define CLEAR_ICE_AROUND_LIGHT 12

#define CLEAR_ICE_SPEC_PROBES 0  // how many
#define CLEAR_ICE_SPEC_SPLIT 1   // 1: what is seen through it is written apart, too
#define CLEAR_ICE_SPEC_GUSTS 2   // 1: the fog is thick in places
#define CLEAR_ICE_SPEC_WINDOW 3  // 1: of a picture, of which there is a small one

#define ICE_LIST_FRAME 0
#define ICE_LIST_MATERIAL 1
#define ICE_LIST_DEPTH_ROWS 2
#define ICE_LIST_PIXELS 3
#define ICE_LIST_LIST 4

#endif
