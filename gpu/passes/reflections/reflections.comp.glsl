#version 460
// What smooth surfaces mirror: the picture itself where the reflected ray meets it, else the sky.
// The ray is walked through the depth of this sample; where it leaves the picture the sky stands in,
// dimmed by how much of the sky the place sees.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "formulas/noise/noise.h"
#include "gpu/passes/reflections/reflections_io.h"

layout(local_size_x = REFLECTIONS_TILE, local_size_y = REFLECTIONS_TILE) in;
layout(binding = REFLECTIONS_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = REFLECTIONS_DEPTH) uniform sampler2D depth_map;
layout(binding = REFLECTIONS_RADIANCE) uniform sampler2D radiance_map;
layout(binding = REFLECTIONS_MIRROR_WEIGHT) uniform sampler2D mirror_weight;
layout(binding = REFLECTIONS_MIRROR_SHAPE) uniform sampler2D mirror_shape;
layout(binding = REFLECTIONS_SPECULAR) uniform samplerCube specular_map;
layout(binding = REFLECTIONS_ACCUMULATED, rgba32f) uniform image2D accumulated;

const int kSteps = 18;
const int kRefinements = 4;

struct Hit {
    vec2 pixel;
    float confidence;  // 0: nothing met
};

// Pixel and view depth of a world position.
vec3 project(vec3 p)
{
    const vec4 clip = frame.world_to_clip * vec4(p, 1.0);
    return vec3((clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.size), clip.w);
}

float scene_depth_m(vec2 pixel)
{
    const float d = texelFetch(depth_map, ivec2(pixel), 0).r;
    return d > 0.0 ? linear_depth(frame, d) : 1.0e9;
}

Hit trace(vec3 origin, vec3 direction, float view_m, float start)
{
    Hit hit;
    hit.confidence = 0.0;
    // Steps grow with distance: about as long as the ray's error on the screen.
    float before = 0.0;
    float t = view_m * 0.02 * (0.5 + start);
    for (int i = 0; i < kSteps; ++i) {
        const vec3 at = project(origin + direction * t);
        if (at.z <= frame.near_m || any(lessThan(at.xy, vec2(0.0))) ||
            any(greaterThanEqual(at.xy, vec2(frame.size)))) {
            return hit;
        }
        const float behind = at.z - scene_depth_m(at.xy);
        // What the ray has passed within this step counts as met; what lies deeper was never near it.
        if (behind > 0.0 && behind < 1.1 * (t - before) + 0.02 * view_m) {
            float low = before;
            float high = t;
            for (int k = 0; k < kRefinements; ++k) {
                const float middle = 0.5 * (low + high);
                const vec3 m = project(origin + direction * middle);
                if (m.z > scene_depth_m(m.xy)) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            hit.pixel = project(origin + direction * high).xy;
            const vec2 edge = min(hit.pixel, vec2(frame.size) - hit.pixel) / vec2(frame.size);
            hit.confidence = clamp(min(edge.x, edge.y) * 12.0, 0.0, 1.0);
            return hit;
        }
        before = t;
        t *= 1.4;
    }
    return hit;
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    vec4 sum = texelFetch(radiance_map, texel, 0);
    const vec4 mirror = texelFetch(mirror_weight, texel, 0);
    const vec3 weight = mirror.rgb;
    if (weight.r + weight.g + weight.b > 0.0) {
        const vec4 shape = texelFetch(mirror_shape, texel, 0);
        const float depth = texelFetch(depth_map, texel, 0).r;
        const vec2 pixel = vec2(texel) + 0.5;
        const vec3 position = pixel_position(frame, pixel, depth);
        const vec3 view = pixel_view_direction(frame, pixel);
        const vec3 n = octahedral_decode(shape.xy);
        const float roughness = shape.z;
        vec3 reflected = reflect(view, n);
        const float view_m = linear_depth(frame, depth);

        // One direction of the lobe a sample.
        const float turn = 6.2831853 * dither(texel, frame.sample_index + 11u);
        const float wide = roughness * roughness * sqrt(dither(texel.yx, frame.sample_index + 3u));
        const vec3 side = normalize(abs(reflected.y) < 0.9 ? cross(reflected, vec3(0, 1, 0))
                                                           : cross(reflected, vec3(1, 0, 0)));
        const vec3 other = cross(reflected, side);
        const vec3 ray = normalize(reflected + (side * cos(turn) + other * sin(turn)) * wide);

        Hit hit;
        hit.confidence = 0.0;
        if ((frame.flags & FRAME_ORTHOGRAPHIC) == 0u && dot(ray, n) > 0.0) {
            // Water stands above the relief that the depth map knows.
            hit = trace(position + n * (0.002 * view_m + 0.05 * mirror.a), ray, view_m,
                        dither(texel, frame.sample_index + 7u));
        }
        const float lod = roughness * float(SKY_PREFILTER_MIPS - 1);
        const vec3 sky = textureLod(specular_map, reflected, lod).rgb;
        // A ray that met nothing saw the sky if the place sees much of it.
        const float open = clamp(shape.w * 1.3 - 0.05, 0.0, 1.0);
        vec3 mirrored = sky * mix(frame.bounce * 0.7, 1.0, open);
        if (hit.confidence > 0.0) {
            const vec3 seen = texelFetch(radiance_map, ivec2(hit.pixel), 0).rgb;
            mirrored = mix(mirrored, seen, hit.confidence);
        }
        sum.rgb += weight * mirrored;
    }
    if (frame.sample_index > 0u) sum += imageLoad(accumulated, texel);
    imageStore(accumulated, texel, sum);
}
