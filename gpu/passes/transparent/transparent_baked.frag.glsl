#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SURFACE_WEATHER 1
#define SURFACE_EMISSION 1
#define SURFACE_BAKED 1
#define SURFACE_LAYER 1
#include "gpu/passes/surface/surface.glsl"
