// The surface pass: writes the material and the weather at each pixel (evaluate_surface.glsl).
//
// Compiled nine times, since a target that nobody reads is not written:
//   SURFACE_WEATHER   1: masks of water, snow and frost
//   SURFACE_EMISSION  1: radiance of materials that glow
//   SURFACE_BAKED     1: light of light maps and of lamps at vertices, with SURFACE_EMISSION only
//   SURFACE_PLAIN     1: all materials have the payload of a cleared target, which is not written
//   SURFACE_LAYER     1: a layer of what lets light through (passes/transparent); what it lets through
//                     has a target of its own behind those of the G-buffer
#ifndef SURFACE_PLAIN
#define SURFACE_PLAIN 0
#endif
#ifndef SURFACE_LAYER
#define SURFACE_LAYER 0
#endif
#include "gpu/passes/surface/evaluate_surface.glsl"

#if SURFACE_LAYER
#include "gpu/passes/surface/let_through.glsl"
layout(constant_id = SURFACE_SPEC_LAYER_FIRST) const uint FIRST = 1u;
layout(set = 0, binding = SURFACE_LAYER_SOLID_DEPTH) uniform sampler2D solid_depth;
layout(set = 0, binding = SURFACE_LAYER_BEFORE) uniform sampler2D depth_before;
#endif

layout(push_constant, scalar) uniform Push { DrawConstants draw; };

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec4 in_weather;
layout(location = 6) flat in uvec2 in_who;
#if SURFACE_BAKED
layout(location = 7) in vec3 in_lit_front;
layout(location = 8) in vec3 in_lit_back;
#endif

#if SURFACE_WEATHER
#define WEATHER_TARGETS(ROW) GBUFFER_WEATHER(ROW)
#else
#define WEATHER_TARGETS(ROW)
#endif
#if SURFACE_EMISSION
#define EMISSION_TARGETS(ROW) GBUFFER_EMISSION(ROW)
#else
#define EMISSION_TARGETS(ROW)
#endif
#if SURFACE_BAKED
#define BAKED_TARGETS(ROW) GBUFFER_BAKED(ROW)
#else
#define BAKED_TARGETS(ROW)
#endif
#define TARGETS(ROW) \
    GBUFFER_ALWAYS(ROW) WEATHER_TARGETS(ROW) EMISSION_TARGETS(ROW) BAKED_TARGETS(ROW)
#define OUTPUT(name, location_) layout(location = location_) out vec4 out_##name;
#define OUT_color OUTPUT
#define OUT_normals OUTPUT
#define OUT_material OUTPUT
#if SURFACE_PLAIN
#define OUT_payload(name, location_) vec4 out_##name;
#else
#define OUT_payload OUTPUT
#endif
#define OUT_weather OUTPUT
#define OUT_emission OUTPUT
#define OUT_baked OUTPUT
#define ROW(name, location_, format_, when_, meaning_) OUT_##name(name, location_)
TARGETS(ROW)
#undef ROW
#if SURFACE_LAYER
layout(location = SURFACE_LAYER_THROUGH) out vec4 out_through;
#endif

void main()
{
#ifdef FRAME_BY_WORDS
    read_constants();
#endif
    const float side = gl_FrontFacing ? 1.0 : -1.0;
    SurfaceInput at;
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
    at.pixel = ivec2(gl_FragCoord.xy);
    at.instance_id = in_who.x;
    at.material_id = draw.material_id;
    at.look = in_who.y;

    SurfaceData data = evaluate_surface(at);
    if (FADE != 0u && faded(draw.fade, at.pixel)) discard;
    if (HOLES != 0u && data.hole) discard;
#if SURFACE_LAYER
    if (gl_FragCoord.z <= texelFetch(solid_depth, at.pixel, 0).r) discard;
    if (FIRST == 0u && gl_FragCoord.z >= texelFetch(depth_before, at.pixel, 0).r) discard;
    if (material.alpha_mode == ALPHA_MASK && surface_alpha(at) < material.alpha_cutoff) discard;
    GBufferTexel seen = data.texel;  // in the colour of its film
    if ((BESIDES & BESIDES_FILM_TOLD) != 0u) add_thin_film(seen, at, vec2(0.0));
    LetThrough l = let_through(at, data.texel.base_color, data.texel.metallic, seen.f0,
                               data.texel.base_normal, data.opacity);
    if (HOLES != 0u) l = LetThrough(1.0, 1.0, vec3(0.0), 1.0);  // by chance: it is here, or it is not
    data.texel.base_color *= l.matt;
    const bool far_side = !gl_FrontFacing && material.transmission_factor > 0.0 && material.thickness_factor > 0.0;
    out_through = vec4(l.through * data.filtered, far_side ? -l.whole : l.whole);
    data.texel.body = l.body;
    data.texel.lamp_mask = vec3(1.0);  // the thickness stands there
#endif
#if SURFACE_BAKED
    if (VERTEX_LIGHT != 0u) add_vertex_light(data.texel, gl_FrontFacing ? in_lit_front : in_lit_back);
#endif
    data.texel.emission = data.emission;
    place_film(data.texel, at);
    const GBufferCode code = encode_gbuffer(data.texel, frame.flags);
#define ROW(name, location_, format_, when_, meaning_) out_##name = code.name;
    TARGETS(ROW)
#undef ROW
}
