// What a decal lays over the surface that is seen at a pixel.
//
//   DECAL_BOX  0: triangles, onto surfaces near to their plane
//              1: a box, onto all that lies in it and looks its way
#include "gpu/passes/decals/decals_io.h"

layout(constant_id = DECAL_SPEC_WEATHER) const uint SURFACE_WEATHER = 1u;
layout(constant_id = DECAL_SPEC_EMISSION) const uint SURFACE_EMISSION = 1u;
const uint SURFACE_BAKED = 0u;
#define SURFACE_ALPHA 1
#include "gpu/passes/surface/evaluate_surface.glsl"

#include "gpu/frame/plane_step.glsl"

layout(set = 0, binding = DECAL_DEPTH) uniform sampler2D depth_map;
layout(set = 0, binding = DECAL_NORMALS) uniform sampler2D normals_map;

#if DECAL_BOX
layout(push_constant, scalar) uniform Push { DecalBoxDraw draw; };
#else
layout(push_constant, scalar) uniform Push { DrawConstants draw; };
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec4 in_weather;
#endif

#define ROW(name, location_, meaning_) layout(location = location_) out vec4 out_##name;
DECAL_TARGETS(ROW)
#undef ROW

#if DECAL_BOX
vec3 in_box(vec3 direction)
{
    return vec3(dot(draw.to_box[0].xyz, direction), dot(draw.to_box[1].xyz, direction),
                dot(draw.to_box[2].xyz, direction));
}
#endif

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const float depth = texelFetch(depth_map, texel, 0).r;
    const vec3 seen = pixel_position(frame, gl_FragCoord.xy, max(depth, 1.0e-9));
    const vec3 seen_normal = octahedral_decode(texelFetch(normals_map, texel, 0).xy);
    float share = depth > 0.0 ? 1.0 : 0.0;
    SurfaceInput at;
    at.pixel = texel;
#if DECAL_BOX
    const vec3 p = in_box(seen) + vec3(draw.to_box[0].w, draw.to_box[1].w, draw.to_box[2].w);
    const vec3 to_side = 1.0 - 2.0 * abs(p);
    const float inside = min(to_side.x, min(to_side.y, to_side.z));
    if (inside <= 0.0) share = 0.0;
    share *= draw.edge_fade > 0.0 ? saturate(inside / draw.edge_fade) : 1.0;
    const vec3 z = normalize(vec3(draw.to_world[0].z, draw.to_world[1].z, draw.to_world[2].z));
    share *= smoothstep(draw.none_cos, draw.full_cos, dot(seen_normal, z));
    at.position = seen;
    at.position_dx = plane_step(seen, seen_normal, gl_FragCoord.xy + vec2(1.0, 0.0));
    at.position_dy = plane_step(seen, seen_normal, gl_FragCoord.xy + vec2(0.0, 1.0));
    at.normal = seen_normal;
    at.normal_dx = vec3(0.0);
    at.normal_dy = vec3(0.0);
    at.tangent = vec4(draw.to_world[0].x, draw.to_world[1].x, draw.to_world[2].x, 1.0);
    const vec2 uv = vec2(p.x + 0.5, 0.5 - p.y);
    const vec2 dx = in_box(at.position_dx).xy * vec2(1.0, -1.0);
    const vec2 dy = in_box(at.position_dy).xy * vec2(1.0, -1.0);
    at.uv = vec4(uv, uv);
    at.uv_dx = vec4(dx, dx);
    at.uv_dy = vec4(dy, dy);
    at.color = vec4(1.0);
    at.weather = vec4(1.0);
    at.instance_id = 0u;
    at.look = 0u;
#else
    const float side = gl_FrontFacing ? 1.0 : -1.0;
    at.position = in_position;
    at.position_dx = dFdx(in_position);
    at.position_dy = dFdy(in_position);
    at.normal = normalize(in_normal) * side;
    at.normal_dx = dFdx(at.normal);
    at.normal_dy = dFdy(at.normal);
    at.tangent = vec4(in_tangent.xyz, in_tangent.w * side);
    at.uv = in_uv;
    at.uv_dx = dFdx(in_uv);
    at.uv_dy = dFdy(in_uv);
    at.color = in_color;
    at.weather = in_weather;
    at.instance_id = draw.instance_id;
    at.look = draw.look;
    // Onto what lies near the plane and looks the same way: not onto what stands in it.
    if (abs(dot(at.normal, seen - in_position)) > material.decal_reach_m) share = 0.0;
    share *= smoothstep(0.2, 0.5, dot(seen_normal, at.normal));
#endif
    if (share <= 0.0) discard;
    at.material_id = draw.material_id;

    const SurfaceData data = evaluate_surface(at);
    if (material.alpha_mode == ALPHA_MASK) {
        if (data.alpha < material.alpha_cutoff) discard;
    } else if (material.alpha_mode == ALPHA_BLEND) {
        share *= saturate(data.alpha);
    }
    const vec4 covers = material.decal_weights * share;
    out_color = vec4(clamp(data.texel.base_color, vec3(0.0), vec3(1.0)), 1.0) * covers.x;
    out_normal = vec4(data.texel.base_normal, 1.0) * covers.y;
    out_matter =
        vec4(data.texel.roughness, data.texel.metallic, data.texel.occlusion, 1.0) * covers.z;
    out_weather = vec4(kept_weather(data.texel).xyz, 1.0) * covers.w;
    out_cover = vec4(data.texel.cover_normal, 1.0) * covers.w;
    out_emission = vec4(data.emission, 1.0) * covers.x;
}
