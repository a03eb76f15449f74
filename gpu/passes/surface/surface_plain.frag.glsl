#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#define FRAME_BY_WORDS
#define SURFACE_WEATHER 0
#define SURFACE_EMISSION 0
#define SURFACE_BAKED 0
#define SURFACE_PLAIN 1
#include "gpu/passes/surface/surface.glsl"
