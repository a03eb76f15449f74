#version 460
// Glow of the lamps before the middle pixel of each block; alpha: how far it is to what is seen there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/brdf.h"
#include "formulas/light/lamp_glow.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/lamp_glow/lamp_glow_io.h"
#include "gpu/passes/lights/lights_io.h"

layout(local_size_x = LAMP_GLOW_TILE, local_size_y = LAMP_GLOW_TILE) in;
layout(binding = LAMP_GLOW_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = LAMP_GLOW_LAMPS, scalar) uniform Lamps { GlowLamps table; };
layout(binding = LAMP_GLOW_FUNCTION) uniform sampler2D function;
layout(binding = LAMP_GLOW_DEPTH) uniform sampler2D depth_map;
layout(binding = LAMP_GLOW_TARGET, rgba32f) uniform writeonly image2D target;

float read_function(float u, float v)
{
    const vec2 size = vec2(textureSize(function, 0));
    const vec2 at = vec2(sqrt(min(u / kGlowMost, 1.0)), v / 1.5707963);
    return textureLod(function, (at * (size - 1.0) + 0.5) / size, 0.0).r;
}

// How much of its intensity a lamp sends in a direction.
float towards(GlowLamp lamp, vec3 onward)
{
    const float facing = dot(lamp.direction, onward);
    if (lamp.kind > -1.5) return spot_attenuation(facing, lamp.inner_cosine, lamp.kind);
    if (lamp.kind > LIGHT_POINT - 0.5) return 1.0;
    return lamp.kind > LIGHT_ONE_SIDE - 0.5 ? max(facing, 0.0) : abs(facing);
}

void main()
{
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(block, imageSize(target)))) return;
    const ivec2 texel =
        min(block * GLOW_BLOCK + GLOW_BLOCK / 2, frame.size - 1);
    const float depth = texelFetch(depth_map, texel, 0).r;
    const vec3 view = pixel_view_direction(frame, vec2(texel) + 0.5);
    const float axial_m = linear_depth(frame, depth);
    const float end_m = min(axial_m / max(dot(view, frame.forward), 1.0e-3), 1.0e5);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < table.count; ++i) {
        const GlowLamp lamp = table.lamps[i];
        const vec3 to_lamp = lamp.position_m - frame.camera_m;
        const float along = dot(to_lamp, view);
        const float aside = max(length(to_lamp - view * along), 0.05);
        const GlowRay ray = glow_ray(lamp.per_m, along, aside, end_m);
        const float scattered = max(ray.begin * read_function(ray.u, ray.begin_v) -
                                        ray.end * read_function(ray.u, ray.end_v),
                                    0.0);
        const vec3 passes = frame.camera_m + view * clamp(along, 0.0, end_m);
        const vec3 way = passes - lamp.position_m;
        const vec3 onward = way / max(length(way), 1.0e-4);
        sum += lamp.color * (scattered * towards(lamp, onward));
    }
    imageStore(target, block, vec4(min(sum, vec3(60000.0)), min(axial_m, 1.0e5)));
}
