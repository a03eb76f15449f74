#version 460
// As depth_only, of many instances at once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define PLACES_SET 0
#include "gpu/passes/depth_maps/depth_caster.glsl"
