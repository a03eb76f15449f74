#version 460
// As visibility.frag, for materials with holes.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/geometry/footprint.h"
#include "gpu/passes/surface/holes.glsl"
#include "gpu/passes/surface/parallax.glsl"
#include "gpu/passes/visibility/visibility_io.h"

#include "gpu/passes/visibility/visibility_number.glsl"
layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;
layout(location = 0) out uvec2 out_id;

void main()
{
    SurfaceInput at;
    at.uv = in_uv;
    at.uv_dx = dFdx(in_uv);
    at.uv_dy = dFdy(in_uv);
    at.pixel = ivec2(gl_FragCoord.xy);
    at.instance_id = draw.instance_id;
    if (INSTANCED != 0u)
        at.instance_id = texelFetch(draw_table, int(in_draw) * RESOLVE_DRAW_TEXELS + 6).w;
    at.color = vec4(0.0, 0.0, 0.0, in_alpha);
    if (PARALLAX != PARALLAX_NONE) {
        // Holes lie in the relief, as they do where it is shaded.
        at.position = pixel_position(frame, gl_FragCoord.xy, gl_FragCoord.z);
        at.position_dx = dFdx(at.position);
        at.position_dy = dFdy(at.position);
        at.normal = normalize(cross(at.position_dx, at.position_dy));
        if (dot(at.normal, pixel_view_direction(frame, gl_FragCoord.xy)) > 0.0) at.normal = -at.normal;
        at.weather = vec4(1.0);
        sink(at);
    }
    // The samples of a pixel share its footprint, as where it is shaded: in the level of a whole pixel what is cut out finely, as a bough
    // far away, is a lump, however many samples look.
    const float finer = footprint_scale(at.uv_dx.xy, at.uv_dy.xy, frame.samples, float(STRETCH));
    const float second = footprint_scale(at.uv_dx.zw, at.uv_dy.zw, frame.samples, float(STRETCH));
    at.uv_dx *= vec4(finer, finer, second, second);
    at.uv_dy *= vec4(finer, finer, second, second);
    if (FADE != 0u && faded(draw.fade, at.pixel)) discard;
    if (hole_in(at, alpha_at(at))) discard;
    out_id = id_of(in_draw);
}
