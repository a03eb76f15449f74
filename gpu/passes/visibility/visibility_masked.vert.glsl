#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/passes/visibility/visibility_io.h"

layout(location = 0) in vec3 in_position;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec4 in_color;
layout(set = 0, binding = VISIBILITY_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(location = 2) flat out uint out_draw;
#include "gpu/passes/visibility/visibility_place.glsl"

layout(location = 0) out vec4 out_uv;
layout(location = 1) out float out_alpha;

void main()
{
    const vec3 world = placed(gl_InstanceIndex, in_position);
    out_draw = INSTANCED != 0u ? uint(gl_InstanceIndex) : draw.draw;
    out_uv = vec4(in_uv0, in_uv1);
    out_alpha = in_color.a;
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
