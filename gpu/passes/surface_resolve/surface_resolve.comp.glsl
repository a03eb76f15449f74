#version 460
// Shades the pixels of one material, from a list of them: the triangle that is seen is met again by the ray
// through the pixel and by the rays through its neighbours, whose differences are the derivatives.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#define FRAME_BY_WORDS
#define LOOKS_LATER
#include "gpu/passes/surface_resolve/surface_resolve_io.h"

layout(constant_id = RESOLVE_SPEC_WEATHER) const uint SURFACE_WEATHER = 1u;
layout(constant_id = RESOLVE_SPEC_EMISSION) const uint SURFACE_EMISSION = 1u;
layout(constant_id = RESOLVE_SPEC_PAYLOAD) const uint SURFACE_PAYLOAD = 1u;
layout(constant_id = RESOLVE_SPEC_BAKED) const uint SURFACE_BAKED = 0u;
layout(constant_id = RESOLVE_SPEC_SHAPES) const uint SHAPES = 0u;
layout(constant_id = RESOLVE_SPEC_IN_WORLD) const uint IN_WORLD = 0u;
#include "gpu/passes/surface/evaluate_surface.glsl"

layout(local_size_x_id = RESOLVE_SPEC_INVOCATIONS) in;
layout(set = 0, binding = RESOLVE_IDS) uniform usamplerBuffer ids;  // row by row
layout(set = 0, binding = RESOLVE_VERTICES) uniform usamplerBuffer vertices;
layout(set = 0, binding = RESOLVE_INDICES) uniform usamplerBuffer indices;
layout(set = 0, binding = RESOLVE_DRAWS) uniform usamplerBuffer draws;
layout(set = 0, binding = RESOLVE_PIXELS) uniform usamplerBuffer pixels;
layout(set = 0, binding = RESOLVE_COUNTS) uniform usamplerBuffer ends;
#define IMAGE_R8G8B8A8_UNORM rgba8
#define IMAGE_R16G16B16A16_UNORM rgba16
#define IMAGE_R16G16B16A16_SNORM rgba16_snorm
#define IMAGE_R16G16B16A16_SFLOAT rgba16f
#define ROW(name, location_, format_, when_, meaning_)                     \
    layout(set = 0, binding = RESOLVE_TARGETS + location_, IMAGE_##format_) \
        uniform writeonly image2D out_##name;
GBUFFER_TABLE(ROW)
#undef ROW
layout(set = 0, binding = RESOLVE_WET, rgba8) uniform writeonly image2D out_wet;
layout(set = 0, binding = RESOLVE_SHARES, rgba32ui) uniform writeonly uimage2D out_shares;
layout(set = 0, binding = RESOLVE_DEPTH) uniform sampler2D depth_map;
layout(push_constant, scalar) uniform Push { SurfaceResolveParams params; };

#define VERTEX_LIGHT_PLACE RESOLVE_LIT_VERTICES
#define VERTEX_LIGHT_FIRSTS RESOLVE_LIT_FIRSTS
#include "gpu/passes/vertex_light/vertex_light.glsl"
#include "gpu/frame/plane_step.glsl"

struct Corner {
    vec3 position;  // world, relative to the camera
    vec3 normal;
    vec4 tangent;
    vec4 uv;
    vec4 color;
    vec4 weather;
};

struct Triangle {
    Corner corners[3];
    uint material;
    uint instance_id;
    bool mirrored;
};

vec4 row_of(int draw, int row)
{
    return uintBitsToFloat(texelFetch(draws, draw * RESOLVE_DRAW_TEXELS + row));
}

Corner corner_of(int draw, int vertex)
{
    const uvec4 a = texelFetch(vertices, vertex * 4);
    const uvec4 b = texelFetch(vertices, vertex * 4 + 1);
    const uvec4 c = texelFetch(vertices, vertex * 4 + 2);
    const uvec4 d = texelFetch(vertices, vertex * 4 + 3);
    const vec3 n = uintBitsToFloat(uvec3(a.w, b.xy));
    const vec3 t = uintBitsToFloat(uvec3(b.zw, c.x));
    Corner corner;
    if (IN_WORLD != 0u) {
        corner.position = uintBitsToFloat(a.xyz) - frame.camera_m;
        corner.normal = n;
        corner.tangent = vec4(t, uintBitsToFloat(c.y));
    } else {
        const vec4 x = row_of(draw, 0);
        const vec4 y = row_of(draw, 1);
        const vec4 z = row_of(draw, 2);
        const vec4 p = vec4(uintBitsToFloat(a.xyz), 1.0);
        corner.position = vec3(dot(x, p), dot(y, p), dot(z, p)) - frame.camera_m;
        corner.normal = vec3(dot(row_of(draw, 3).xyz, n), dot(row_of(draw, 4).xyz, n),
                             dot(row_of(draw, 5).xyz, n));
        corner.tangent =
            vec4(dot(x.xyz, t), dot(y.xyz, t), dot(z.xyz, t), uintBitsToFloat(c.y));
    }
    corner.uv = uintBitsToFloat(uvec4(c.zw, d.xy));
    corner.color = unpackUnorm4x8(d.z);
    corner.weather = unpackUnorm4x8(d.w);
    return corner;
}

// Shares of the second and third corner where a ray meets the triangle's plane (Moeller and
// Trumbore 1997). A plane seen edge-on is met far away: what it says there is held in bounds.
vec2 met_by(Triangle t, vec3 origin, vec3 direction, float limit)
{
    const vec3 e1 = t.corners[1].position - t.corners[0].position;
    const vec3 e2 = t.corners[2].position - t.corners[0].position;
    const vec3 h = cross(direction, e2);
    const float a = dot(e1, h);
    const vec3 s = origin - t.corners[0].position;
    const vec3 q = cross(s, e1);
    const vec2 met = vec2(dot(s, h), dot(direction, q)) / (abs(a) > 1.0e-30 ? a : 1.0e-30);
    return clamp(met, vec2(-limit), vec2(1.0 + limit));
}

vec4 mixed(vec4 a, vec4 b, vec4 c, vec2 at)
{
    return a + (b - a) * at.x + (c - a) * at.y;
}

vec3 mixed(vec3 a, vec3 b, vec3 c, vec2 at)
{
    return a + (b - a) * at.x + (c - a) * at.y;
}

// On the side that is seen.
vec3 lit_at_vertices(int draw, ivec3 corners, vec2 at, float side)
{
    vec3 lit[3];
    for (int i = 0; i < 3; ++i) {
        const uvec2 code = vertex_light_code(draw, corners[i]);
        lit[i] = shared_exponent_value(side > 0.0 ? code.x : code.y);
    }
    return mixed(lit[0], lit[1], lit[2], at);
}

#include "gpu/passes/surface_resolve/shape_point.glsl"

void shade(uint at_list)
{
    const uint packed = texelFetch(pixels, int(at_list)).r;
    const ivec2 pixel = ivec2(packed & 65535u, packed >> 16);
    const uvec2 id = texelFetch(ids, pixel.y * int(params.width) + pixel.x).rg;
    const int draw = int(id.x & ID_DRAW) - 1;
    const uvec4 facts = texelFetch(draws, draw * RESOLVE_DRAW_TEXELS + 6);
    const uvec4 more = texelFetch(draws, draw * RESOLVE_DRAW_TEXELS + 7);
    const bool mirrored = IN_WORLD == 0u && more.x != 0u;

    Triangle t;
    ivec3 numbers;
    for (int i = 0; i < 3; ++i) {
        const uint index = texelFetch(indices, int(facts.x + 3u * id.y) + i).r;
        numbers[i] = int(index + facts.y);
        t.corners[i] = corner_of(draw, numbers[i]);
    }
    const vec2 centre = vec2(pixel) + 0.5;
    const bool orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    const vec3 origin =
        orthographic
            ? frame.origin_corner + frame.ray_dx * centre.x + frame.ray_dy * centre.y - frame.camera_m
            : vec3(0.0);
    const vec3 along = orthographic ? frame.forward : pixel_ray(frame, centre);
    const vec3 step_origin_x = orthographic ? frame.ray_dx : vec3(0.0);
    const vec3 step_origin_y = orthographic ? frame.ray_dy : vec3(0.0);
    const vec3 step_x = orthographic ? vec3(0.0) : frame.ray_dx;
    const vec3 step_y = orthographic ? vec3(0.0) : frame.ray_dy;
    const vec2 at = met_by(t, origin, along, 0.0);
    const vec2 at_x = met_by(t, origin + step_origin_x, along + step_x, 64.0);
    const vec2 at_y = met_by(t, origin + step_origin_y, along + step_y, 64.0);

    const vec3 face = cross(t.corners[1].position - t.corners[0].position,
                            t.corners[2].position - t.corners[0].position);
    const float side = (dot(face, along) < 0.0) != mirrored ? 1.0 : -1.0;

    SurfaceInput s;
    s.pixel = pixel;
    const Corner a = t.corners[0];
    const Corner b = t.corners[1];
    const Corner c = t.corners[2];
    s.position = mixed(a.position, b.position, c.position, at) + frame.camera_m;
    s.position_dx = mixed(a.position, b.position, c.position, at_x) + frame.camera_m - s.position;
    s.position_dy = mixed(a.position, b.position, c.position, at_y) + frame.camera_m - s.position;
    s.normal = normalize(mixed(a.normal, b.normal, c.normal, at)) * side;
    s.normal_dx = normalize(mixed(a.normal, b.normal, c.normal, at_x)) * side - s.normal;
    s.normal_dy = normalize(mixed(a.normal, b.normal, c.normal, at_y)) * side - s.normal;
    const vec4 tangent = mixed(a.tangent, b.tangent, c.tangent, at);
    s.tangent = vec4(tangent.xyz, tangent.w * side);
    s.uv = mixed(a.uv, b.uv, c.uv, at);
    s.uv_dx = mixed(a.uv, b.uv, c.uv, at_x) - s.uv;
    s.uv_dy = mixed(a.uv, b.uv, c.uv, at_y) - s.uv;
    s.color = mixed(a.color, b.color, c.color, at);
    s.weather = mixed(a.weather, b.weather, c.weather, at);
    s.instance_id = facts.w;
    s.material_id = params.material;
    s.look = more.y;
    if (SHAPES != 0u && more.z != 0u) shape_point(s, draw, id.y);

    SurfaceData data = evaluate_surface(s);
    if (later() && sky_look.asked) return;
    if (SHAPES != 0u && more.z != 0u) data.texel.occlusion *= shape_decode(id.y).z;
    const bool shape = SHAPES != 0u && more.z != 0u;
    if (VERTEX_LIGHT != 0u && !shape) add_vertex_light(data.texel, lit_at_vertices(draw, numbers, at, side));
    data.texel.emission = data.emission;
    place_film(data.texel, s);
    const GBufferCode code = encode_gbuffer(data.texel, frame.flags);
    if (waves_later()) {
        waves_left.pixel = pixel;
        waves_left.base = code.normals.xy;
    }
    const bool ALWAYS = true;
    const bool WEATHER = SURFACE_WEATHER == WEATHER_WHOLE;
    const bool EMISSION = SURFACE_EMISSION != 0u;
    const bool BAKED = SURFACE_BAKED != 0u;
#define ROW(name, location_, format_, when_, meaning_) \
    if (when_ && (SURFACE_PAYLOAD != 0u || location_ != GBUFFER_PAYLOAD)) imageStore(out_##name, pixel, code.name);
    GBUFFER_TABLE(ROW)
#undef ROW
    if (SURFACE_WEATHER == WEATHER_WET) imageStore(out_wet, pixel, wet_code(kept_weather(data.texel), data.texel.material));
    if ((BESIDES & BESIDES_SHARES) != 0u) imageStore(out_shares, pixel, pack_shares(data.shares, kind_of_shares()));
}

// What is steep has no rings, and no roughness by them.
void bend_by_waves()
{
    if (!waves_left.asked) return;
    const Wave flow = flow_wave(waves_left.waves);
    const vec4 bent = normalize(vec4(flow.lean, flow.up));
    vec2 code = octahedral_encode(bent_normal(bent, waves_left.waves.normal, waves_left.fade));
    if ((frame.flags & FRAME_RINGS) != 0u) code = rough_normal_code(code, 0.0);
    imageStore(out_normals, waves_left.pixel, vec4(waves_left.base, code));
}

bool of_any(bool lane) { return subgroupBallot(lane).x != 0u; }

// A CPU has one invocation a lane for all pixels of a group: its constants are read once for them.
void main()
{
    read_constants();
    // A list ends where listing left its counter; it begins where the one before ends.
    const uint group = LANES != 0u ? RESOLVE_CPU_GROUP : RESOLVE_GROUP;
    const int number = int(params.list);
    const uint begin = (number > 0 ? texelFetch(ends, number - 1).r : 0u) + gl_WorkGroupID.x * group;
    const uint end = min(texelFetch(ends, number).r, begin + group);
    uint at_list = begin + gl_LocalInvocationID.x;
    if (later()) {
        sky_look.asked = false;
        sky_look.position = vec3(0.0);
        sky_look.normal = vec3(0.0, 1.0, 0.0);
        sky_look.pixel = ivec2(0);
        // The loops end for all lanes at once. Nothing but a loop's end skips code on a CPU: the outer turns are few.
        bool more = true;
        do {
            look_to_sky();
            bool asked = false;
            do {
                bool waves = false;
                do {
                    waves_left.asked = false;
                    if (at_list < end) {
                        shade(at_list);
                        if (!sky_look.asked) {
                            at_list += gl_WorkGroupSize.x;
                            sky_look.known = false;
                        }
                    }
                    asked = of_any(sky_look.asked);
                    more = of_any(at_list < end);
                    if (waves_later()) {
                        waves_left.asked = waves_left.asked && !sky_look.asked;
                        waves = of_any(waves_left.asked);
                    }
                } while (more && !asked && !waves);
                if (waves_later()) bend_by_waves();
            } while (waves_later() && more && !asked);
        } while (more);
        return;
    }
    do {
        if (at_list < end) shade(at_list);
        at_list += gl_WorkGroupSize.x;
    } while (at_list < end);
}
