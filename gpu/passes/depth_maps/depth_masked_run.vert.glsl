#version 460
// As depth_masked, of many instances at once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define HOLES
#define PLACES_SET 1
#include "gpu/passes/depth_maps/depth_caster.glsl"
