// Interface of the reflections pass.
#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_IO_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_IO_H

#define REFLECTIONS_TILE 8

#include "base/interop.h"

SHARED_BEGIN
// What a ray meets counts in full up to the first roughness, and from the second on not at all: few
// samples cannot tell what a wide lobe meets.
SHARED_CONST float kSharpRoughness = 0.16f;
SHARED_CONST float kWideRoughness = 0.3f;

// Where a window of a picture lies in it, and the small picture of the whole that stands for what is beyond the window.
struct MirrorWindow {
    ivec2 corner;   // pixels of the picture, as the next
    ivec2 picture;
    ivec2 around;   // size of the small one
    vec2 per_pixel;  // of its pixels
};
SHARED_END

#define REFLECTIONS_FRAME 0
#define REFLECTIONS_DEPTH_ROWS 1  // of the picture that is mirrored, as weather and emission
#define REFLECTIONS_RADIANCE 2
#define REFLECTIONS_MIRROR_WEIGHT 3
#define REFLECTIONS_MIRROR_SHAPE 4
#define REFLECTIONS_SPECULAR 5
#define REFLECTIONS_ACCUMULATED 6
#define REFLECTIONS_PROBES 7        // PROBE_ROWS entries a probe
#define REFLECTIONS_PROBE_LIGHT 8   // levels of each probe, one after the other

#define REFLECTIONS_PIXELS 9        // gpu/frame/pixel_list_io.h: those that mirror
#define REFLECTIONS_WEATHER 10
#define REFLECTIONS_PARTS 11        // gpu/outputs/light_parts_io.h
#define REFLECTIONS_LABEL 12        // the same image, or that of all samples

#define REFLECTIONS_EMISSION 13

#define REFLECTIONS_AROUND_DEPTH 14  // of the small picture, row by row
#define REFLECTIONS_AROUND_LIGHT 15
#define REFLECTIONS_AROUND_GLOW 16
#define REFLECTIONS_OWN_DEPTH 17  // of what mirrors it: the same, but for layers of what lets light through

#define REFLECTIONS_SPEC_PROBES 0   // how many
#define REFLECTIONS_SPEC_SPLIT 1    // 1: what is mirrored is written apart, too
#define REFLECTIONS_SPEC_LABEL 2    // 1: .. and what it is of
#define REFLECTIONS_SPEC_PICTURE 3  // 0: the picture itself is not mirrored
#define REFLECTIONS_SPEC_GLOWS 4    // 1: what glows is a light, too, and has highlights on rough surfaces
#define REFLECTIONS_SPEC_WINDOW 5   // 1: of a picture, of which there is a small one

// Of a probe: position, boost; low corner, blend; high corner, share of sky above.
#define PROBE_ROWS 3

#endif
