#version 460
// As depth_only, for materials with holes (alpha mask).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define HOLES
#include "gpu/passes/depth_maps/depth_caster.glsl"
