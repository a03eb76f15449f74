// Interface of the surface pass.
#ifndef PETRICHOR_GPU_PASSES_SURFACE_SURFACE_IO_H
#define PETRICHOR_GPU_PASSES_SURFACE_SURFACE_IO_H

// Specialization constants. What a draw needs is known before it is compiled: a CPU driver runs
// both sides of every branch.
#define SURFACE_SPEC_HOLES 1  // 0: opaque, so that hidden pixels are never shaded
#define SURFACE_SPEC_SLOTS 2  // texture slots that the material has, one bit each
#define SURFACE_SPEC_WATER 3  // WATER_... bits; 0: no water stands on the material in this frame
#define SURFACE_SPEC_SNOW 4   // SNOW_... bits; 0: no snow lies anywhere in this frame
#define SURFACE_SPEC_FROST 9  // 0: no frost anywhere in this frame
#define SURFACE_SPEC_PARALLAX 10  // PARALLAX_... of the material
#define SURFACE_SPEC_SECOND 14  // SECOND_... of the material
#define SURFACE_SPEC_LOOKS 21   // 1: instances may have other values than the material
#define SURFACE_SPEC_FADE 22    // 1: a level of detail comes or goes
#define SURFACE_SPEC_OWN 15     // number of a user's own surface; 0: none
#define SURFACE_SPEC_LAYER_ROLES_A 30  // where its textures of layers are, LAYER_TEXTURES
#define SURFACE_SPEC_LAYER_ROLES_B 31
#define SURFACE_SPEC_LAYER_ROLES_C 33
#define SURFACE_SPEC_BESIDES 32  // BESIDES_... of the material
#define SURFACE_SPEC_GROUND_VARIES 42  // 0: [look] ground_variation is off in this frame
#define SURFACE_SPEC_FALLS 34  // directions that rain and snow come from, some of no share
#define SURFACE_SPEC_VERTEX_LIGHT 39  // 1: lamps of the scene light by vertex (passes/vertex_light)
#define SURFACE_SPEC_STRETCH 43  // anisotropy of the sampler of the material's textures; 1: none
#define SURFACE_SPEC_PLACE 8  // 1: pixels find their weather in the patch where they lie

// Set 0: the frame. Set 1: the material, as gpu/upload/material_io.h has it.
#define SURFACE_FRAME 0
#define SURFACE_RIPPLE 1
#define SURFACE_FLOW 2
#define SURFACE_SNOW 3
#define SURFACE_SHELTER 4
#define SURFACE_PLACE_TABLE 5  // gpu/frame/place.glsl
#define SURFACE_PLACE_STATES 6
#define SURFACE_PLACE_LABELS 7
#define SURFACE_PLACE_LEVELS 8
#define SURFACE_TRACKS 9
#define SURFACE_INSTANCE_LOOKS 10
#define SURFACE_BINDINGS 11  // how many there are

// A layer of what lets light through: what it lies between, behind those of all surfaces.
#define SURFACE_LAYER_SOLID_DEPTH SURFACE_BINDINGS
#define SURFACE_LAYER_BEFORE (SURFACE_BINDINGS + 1)  // depth of the layer before
#define SURFACE_LAYER_THROUGH 7  // location: what it lets through; share of what it sends
#define SURFACE_SPEC_LAYER_FIRST 20                  // 1: there is none

#endif
