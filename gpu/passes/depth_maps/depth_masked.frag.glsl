#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/depth_maps/depth_holes.glsl"

layout(location = 0) in vec4 in_uv;

void main()
{
    const float alpha = texture(base_color_map, slot_uv(TEXTURE_BASE_COLOR, in_uv)).a;
    if (hole_of(alpha, ivec2(gl_FragCoord.xy))) discard;
}
