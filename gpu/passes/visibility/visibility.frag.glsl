#version 460
// Draw and triangle; the draw counts from 1, so that 0 is the sky.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/visibility/visibility_io.h"

#include "gpu/passes/visibility/visibility_number.glsl"

layout(location = 0) flat in uint in_draw;
layout(location = 0) out uvec2 out_id;

void main()
{
    out_id = id_of(in_draw);
}
