#version 460
// Depth of the scene seen from the sun (shadow cascades) or along the falling rain (shelter).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/depth_maps/depth_caster.glsl"
