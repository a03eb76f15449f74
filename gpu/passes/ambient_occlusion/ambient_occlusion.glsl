// How much of the light from all around nearby geometry takes away: over a slice of directions through the
// eye's, the horizon on either side is the highest of some depths, and what lies above it is counted by its
// cosine in closed form (Jimenez et al. 2016). Slices turn from pixel to pixel and from sample to sample, so
// that the average is smooth.
#ifndef PETRICHOR_AMBIENT_OCCLUSION_GLSL
#define PETRICHOR_AMBIENT_OCCLUSION_GLSL
#include "gpu/frame/gbuffer.glsl"
#include "formulas/light/area.h"
#include "formulas/light/bent_normal.h"
#include "formulas/light/occlusion_points.h"
#include "formulas/noise/noise.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"
#define PIXEL_LIST_BINDING AMBIENT_OCCLUSION_PIXELS
#include "gpu/frame/pixel_list.glsl"
#include "gpu/frame/occlusion_blocks.glsl"

layout(constant_id = AMBIENT_OCCLUSION_SPEC_BENT) const uint BENT = 0u;
layout(binding = AMBIENT_OCCLUSION_FRAME, scalar) uniform Frame { FrameConstants frame; };
#include "gpu/frame/picture_pixel.glsl"
layout(binding = AMBIENT_OCCLUSION_DEPTH) uniform samplerBuffer depth_rows;
layout(binding = AMBIENT_OCCLUSION_NORMALS) uniform samplerBuffer normal_rows;
#include "gpu/frame/geometry_normal.glsl"

const int kSteps = 3;  // of either side of a slice

// Cosine, to the eye, of the horizon on one side; `low` where nothing is higher.
float horizon(ivec2 texel, vec3 x, vec3 to_eye, vec2 way_px, float radius_m, float start, float low)
{
    float highest = low;
    for (int i = 0; i < kSteps; ++i) {
        const float r = (float(i) + start) / float(kSteps);
        const ivec2 at = texel + ivec2(round(way_px * (r * r)));
        const float d = depth_at(at);
        const vec3 v = position_at(at, max(d, 1.0e-9)) - x;
        const float far2 = dot(v, v);
        // What is farther than the radius belongs to the light, not to what takes it away.
        const float there = d > 0.0 && at != texel ? clamp(5.0 - 5.0 * far2 / (radius_m * radius_m), 0.0, 1.0) : 0.0;
        highest = max(highest, mix(low, dot(v, to_eye) * inversesqrt(max(far2, 1.0e-12)), there));
    }
    return highest;
}

// Light by its cosine above a horizon, of one side of a slice.   cosine, sine: of the angle by which the normal
// leans from the eye to this side
float above(float horizon_cosine, float cosine, float sine)
{
    const float c = clamp(horizon_cosine, -1.0, 1.0);
    const float s = sqrt(1.0 - c * c);
    // cos(2 h - lean), of the horizon's angle h
    const float doubled = (2.0 * c * c - 1.0) * cosine + 2.0 * s * c * sine;
    return 0.25 * (cosine + 2.0 * arc_cosine(c) * sine - doubled);
}

struct Slice {
    float open;
    float whole;   // with nothing near: one by one they are more or less than 1
    vec3 missing;  // of the sum of directions that are open (formulas/light/bent_normal.h)
};

Slice slice_of(ivec2 texel, vec3 x, vec3 normal, vec3 to_eye, vec2 way, vec3 right, vec3 down, float radius_px,
               float radius_m, float start)
{
    const vec3 along = right * way.x + down * way.y;
    const vec3 level = along - to_eye * dot(along, to_eye);
    const vec3 axis = normalize(cross(along, to_eye));
    const vec3 flat_normal = normal - axis * dot(normal, axis);
    const float size = max(length(flat_normal), 1.0e-6);
    const float cosine = clamp(dot(flat_normal, to_eye) / size, 0.0, 1.0);
    const float side = dot(level, flat_normal) >= 0.0 ? 1.0 : -1.0;
    const float leans = side * arc_cosine(cosine);
    const float sine = side * sqrt(1.0 - cosine * cosine);
    const float before = horizon(texel, x, to_eye, way * radius_px, radius_m, start, -sine);
    const float behind = horizon(texel, x, to_eye, -way * radius_px, radius_m, start, sine);
    vec3 missing = vec3(0.0);
    if (BENT != 0u) {
        const vec2 left = bent_side(before, cosine, sine) - bent_side(-sine, cosine, sine);
        const vec2 other = bent_side(behind, cosine, -sine) - bent_side(sine, cosine, -sine);
        missing = size * (level * (inversesqrt(max(dot(level, level), 1.0e-12)) * (left.x - other.x)) + to_eye * (left.y + other.y));
    }
    return Slice(size * (above(before, cosine, sine) + above(behind, cosine, -sine)), size * (cosine + leans * sine), missing);
}

struct Open {
    float share;
    vec3 bent;  // unit: the mean direction of it
};

// What is left of the light at a pixel that shows a surface.   seed: by which its slices turn
Open open_at(ivec2 texel, float depth, ivec2 seed)
{
    const vec3 mesh = position_at(texel, depth);
    const float z = linear_depth(frame, depth);
    const float metres_per_pixel = pixel_width_m(frame, z);
    const vec3 normal = geometry_normal(texel, mesh, depth, octahedral_decode(texelFetch(normal_rows, row_texel(texel, frame.size)).xy));
    const vec3 to_eye = -pixel_view_direction(frame, vec2(texel) + 0.5);
    // Off the depths of the surface itself.
    const vec3 x = mesh + (normal + to_eye) * (0.0007 * z);
    const float radius_px = clamp(frame.ao_radius_m / max(metres_per_pixel, 1.0e-6), 3.0, 96.0);
    const float radius_m = radius_px * metres_per_pixel;
    const vec3 right = normalize(frame.ray_dx);
    const vec3 down = normalize(frame.ray_dy);
    // Turn and start of a pixel's samples fill the square evenly (Roberts 2018).
    const float turn = fract(dither(seed, 0u) + 0.7548777 * float(frame.sample_index));
    const float start = fract(dither(seed.yx + 37, 0u) + 0.5698403 * float(frame.sample_index));

    const vec2 first = vec2(cos(1.5707963 * turn), sin(1.5707963 * turn));
    // Two slices across each other, told out: a CPU's driver leaves so long a loop a loop, which costs it half as
    // much again.
    const Slice one = slice_of(texel, x, normal, to_eye, first, right, down, radius_px, radius_m, start);
    const Slice other = slice_of(texel, x, normal, to_eye, vec2(-first.y, first.x), right, down, radius_px, radius_m, start);
    const float whole = one.whole + other.whole;
    const float open = one.open + other.open;
    return Open(clamp(1.0 - frame.ao_strength * (1.0 - open / whole), 0.0, 1.0),
                BENT != 0u ? bent_normal(normal, one.missing + other.missing, frame.ao_strength) : normal);
}

#endif
