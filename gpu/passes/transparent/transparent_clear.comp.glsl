#version 460
// Before a layer is lit: no light yet.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/passes/transparent/transparent_io.h"

layout(local_size_x = TRANSPARENT_TILE, local_size_y = TRANSPARENT_TILE) in;
layout(binding = TRANSPARENT_CLEAR_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = TRANSPARENT_CLEAR_LIGHT, rgba32f) uniform writeonly image2D light;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    imageStore(light, texel, vec4(0.0));
}
