#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define DECAL_BOX 1
#include "gpu/passes/decals/decal.glsl"
