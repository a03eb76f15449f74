// Interface of the passes that find the lights of each tile.
#ifndef PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H
#define PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H

// A light in the table:
//   0   centre; how far it reaches
//   1   colour, cd (lux of a directional light, cd/m2 of a rectangle); the cosine of a spot's outer
//       cone, or one of the kinds below
//   2   axis (rectangle: half of an edge); cosine of the inner cone
//   3   of a rectangle: half of the other edge, so that cross(2, 3) is its front; else across the axis;
//       the number of its shadow, or -1, and LIGHT_MASK_STEP times its channel of shadow masks, if it has one, and
//       half of what its shadows leave of its light, with LIGHTS_WEAK_SHADOWS
//   4   of lamps that have a size (with LIGHTS_... below): radius, 0 none, of a rectangle 1; half the
//       length of a tube, of a rectangle 0..1 how far its window fades it towards its reach; share of highlights; the number of its profile, or -1,
//       and a half more of a lamp in a lantern
#define LIGHT_TEXELS 5
#define LIGHT_PROFILE_SIDE 128  // texels a side of a profile
#define LIGHT_MASK_STEP 64.0f
#define LIGHT_POINT -2.0f
#define LIGHT_ONE_SIDE -3.0f
#define LIGHT_BOTH_SIDES -4.0f

// What some light of a table has.
// In place of the share of its highlight: a surface that glows, which smooth surfaces mirror as they mirror all.
#define LIGHT_GLOWS (-1.0)
#define LIGHTS_LTC 1u       // a size, lit by linearly transformed cosines
#define LIGHTS_NEAREST 2u   // a size, lit from the point nearest to what is mirrored
#define LIGHTS_FILL 4u      // less than all of its highlights
#define LIGHTS_PROFILE 8u   // a distribution or picture
#define LIGHTS_CONE 16u     // a cone: spots
#define LIGHTS_SKIP 32u     // of the device: a branch round what is dark saves its work (not so on a CPU)
#define LIGHTS_PLAIN 64u    // no shape and no shadow
#define LIGHTS_SHAPED 128u  // a shape and no shadow
#define LIGHTS_TOGETHER 512u  // of the device: invocations of a group read lights for each other
#define LIGHTS_BY_MATERIAL 1024u  // of the scene: some materials see lamps as points
#define LIGHTS_SUN_COOKIE 256u  // a picture before the sun
#define LIGHTS_MANY 2048u  // of the table: more than LIGHTS_FEW
#define LIGHTS_FAR 4096u  // of the table: directional ones
#define LIGHTS_SHADOWED 8192u  // of the table: a shadow and no shape
#define LIGHTS_SHADOWED_SHAPED 16384u  // of the table: a shadow and a shape
#define LIGHTS_ONE_WORD 32768u  // of the table: at most 32, a list has one word at most

#define LIGHTS_MASKED 65536u  // of the table: a channel of shadow masks

#define LIGHTS_LANTERN 131072u  // of the table: a lamp in a lantern
#define LIGHTS_WEAK_SHADOWS 262144u  // of the table: a shadow that does not take all of its lamp's light
#define LIGHTS_WEAK_SUN_SHADOW 524288u  // of the sun: the same
#define LIGHTS_UNSHADOWED 1048576u  // of the scene: some materials receive no shadows
#define LIGHTS_FEW 128u

// So many at once, where a subgroup has as many invocations.
#define LIGHTS_AT_ONCE 8u

// light_coarse: one invocation a word of 32 lights
#define LIGHT_COARSE_GROUP 64
#define LIGHT_COARSE_FRAME 0
#define LIGHT_COARSE_LIGHTS 1
#define LIGHT_COARSE_WORDS 2

// light_lists: one invocation a tile
#define LIGHT_LISTS_TILE 8
#define LIGHT_LISTS_FRAME 0
#define LIGHT_LISTS_LIGHTS 1
#define LIGHT_LISTS_WORDS 2
#define LIGHT_LISTS_DEPTH 3
#define LIGHT_LISTS_LISTS 4

#endif
