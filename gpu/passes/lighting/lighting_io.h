// Interface of the lighting pass.
#ifndef PETRICHOR_GPU_PASSES_LIGHTING_LIGHTING_IO_H
#define PETRICHOR_GPU_PASSES_LIGHTING_LIGHTING_IO_H

#define LIGHTING_MOST_PROBES 8

// Specialization constants: 0 leaves the part out of the compiled shader.
#define LIGHTING_SPEC_WEATHER 0
#define LIGHTING_SPEC_SHADOWS 1
#define LIGHTING_SPEC_IMAGE_BASED_LIGHT 2
#define LIGHTING_SPEC_AMBIENT_OCCLUSION 3  // 2: with bent normals
#define LIGHTING_SPEC_EMISSION 4
#define LIGHTING_SPEC_ALL_LIGHTS 5  // 1: no lists; what they are tested against
#define LIGHTING_SPEC_BAKED 6       // bits of LIGHTING_BAKED_..: light that came with the surface
#define LIGHTING_BAKED_MAPS 1u      // .. of light maps
#define LIGHTING_BAKED_VERTICES 2u  // .. of lamps at vertices
#define LIGHTING_SPEC_GAMMA 7       // 1: colours are lit as codes
#define LIGHTING_SPEC_LAMP_SHADOWS 8
#define LIGHTING_SPEC_RECTANGLES 9
#define LIGHTING_SPEC_GUSTS 10    // air is thick in places
#define LIGHTING_SPEC_FOG 11
#define LIGHTING_SPEC_PATCHES 12  // irradiance from patches, not from sky maps
#define LIGHTING_SPEC_LAYERS 13   // bits of LAYERS_..., gpu/upload/material_io.h: in the picture
#define LIGHTING_SPEC_WAYS 14     // bits of LIGHTS_..., gpu/passes/lights/lights_io.h: in the table
#define LIGHTING_SPEC_LAZAROV 15  // another fit of what is mirrored
#define LIGHTING_SPEC_HORIZON 16
#define LIGHTING_SPEC_SNOW_SCATTER 17
#define LIGHTING_SPEC_GATHERS 18      // models of users' own that gather light first are in the picture
#define LIGHTING_SPEC_SHARES 19      // textures of layers: gpu/frame/layer_shares.glsl
#define LIGHTING_SPEC_SOFT_LAMPS 20
#define LIGHTING_SPEC_SUN 21      // 0: it does not shine
#define LIGHTING_SPEC_PARTS 22    // the light is written taken apart, too
#define LIGHTING_SPEC_FILM 23     // a film of water is a lobe of its own
#define LIGHTING_SPEC_GRAIN 24    // anisotropic surfaces mirror along their grain, by chance
#define LIGHTING_SPEC_PICTURE 25  // smooth surfaces mirror the picture itself
#define LIGHTING_SPEC_SPARKLE 26  // snow under the sun has single crystals
#define LIGHTING_SPEC_PROBES 27   // how many rough surfaces see
#define LIGHTING_SPEC_ICE 28      // water that stands is frozen: its cracks and bubbles are drawn
#define LIGHTING_SPEC_MODEL 29    // + number of a lighting model: in the picture

#define LIGHTING_FRAME 0
#define LIGHTING_SKY_LIGHT 1
#define LIGHTING_OCCLUSION 2
#define LIGHTING_SHADOW 3
#define LIGHTING_SKY_VISIBILITY 4
#define LIGHTING_SKY_QUADS 5
#define LIGHTING_ENV_BRDF 6
#define LIGHTING_PROBE_BANDS 7  // kProbeBandTexels of each
#define LIGHTING_LIGHTS 8
#define LIGHTING_LIGHT_LISTS 9
#define LIGHTING_ACCUMULATED 10
#define LIGHTING_RADIANCE 11
#define LIGHTING_MIRROR_WEIGHT 12
#define LIGHTING_MIRROR_SHAPE 13
#define LIGHTING_MATERIALS 14
#define LIGHTING_LAMP_SHADOWS 15
#define LIGHTING_PATCH_POINTS 16
#define LIGHTING_LAYERS 17
#define LIGHTING_LTC 18
#define LIGHTING_PROFILES 19
#define LIGHTING_SKIN 20
#define LIGHTING_SHARES 21
#define LIGHTING_PIXELS 22   // gpu/frame/pixel_list_io.h
#define LIGHTING_PARTS 23
#define LIGHTING_MIRROR_LIST 24  // gpu/frame/pixel_list_io.h
#define LIGHTING_PROBES 25       // ProbeSpread of each
#define LIGHTING_GBUFFER 26      // depth, then the targets

#endif
