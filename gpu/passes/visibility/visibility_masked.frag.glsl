#version 460
// As visibility.frag, for materials with holes.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/surface/holes.glsl"
#include "gpu/passes/visibility/visibility_io.h"

layout(push_constant, scalar) uniform Push { VisibilityDraw draw; };
layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 0) out uvec2 out_id;

void main()
{
    SurfaceInput at;
    at.uv = in_uv;
    at.uv_dx = dFdx(in_uv);
    at.uv_dy = dFdy(in_uv);
    at.pixel = ivec2(gl_FragCoord.xy);
    at.instance_id = draw.instance_id;
    float alpha = material.base_color_factor.a * in_alpha;
    if (has(TEXTURE_BASE_COLOR)) {
        alpha *= texel(base_color_texture, coordinates(TEXTURE_BASE_COLOR, at, vec2(0.0))).a;
    }
    if (hole_in(at, seen_alpha(alpha))) discard;
    out_id = uvec2(draw.draw + 1u, uint(gl_PrimitiveID));
}
