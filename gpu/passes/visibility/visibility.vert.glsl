#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/passes/visibility/visibility_io.h"

layout(location = 0) in vec3 in_position;
layout(set = 0, binding = VISIBILITY_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(location = 0) flat out uint out_draw;
#include "gpu/passes/visibility/visibility_place.glsl"

void main()
{
    const vec3 world = placed(gl_InstanceIndex, in_position);
    out_draw = INSTANCED != 0u ? uint(gl_InstanceIndex) : draw.draw;
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
