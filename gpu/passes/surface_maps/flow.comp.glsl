#version 460
// Small waves on flowing and wind-blown water: a tileable sum of travelling sines, as a normal map.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/noise/noise.h"
#include "gpu/passes/surface_maps/surface_maps_io.h"

layout(local_size_x = SURFACE_MAPS_TILE, local_size_y = SURFACE_MAPS_TILE) in;
layout(binding = SURFACE_MAPS_ALONE_TARGET, rgba8) uniform writeonly image2D target;

layout(push_constant, scalar) uniform Push { FlowParams params; };

// A wave, by its number; time_s is all of it that is not known when the shader is made.
vec2 wave_slope(int i, vec2 uv, float time_s, float tile_m)
{
    const uint id = hash_u(uint(i) * 7919u + 13u);
    const float angle = hash_f(id) * 6.2831853;
    const float frequency = 2.0 + 14.0 * hash_f(id + 1u) * hash_f(id + 2u);
    // Whole numbers of waves a tile keep the seam closed.
    const vec2 k = floor(vec2(cos(angle), sin(angle)) * frequency + 0.5);
    const float waves = max(length(k), 1.0);
    const float wavelength_m = tile_m / waves;
    // Deep-water dispersion with surface tension.
    const float k_m = 6.2831853 / wavelength_m;
    const float omega = sqrt(9.81 * k_m + 7.3e-5 * k_m * k_m * k_m);
    const float phase = 6.2831853 * (dot(k, uv) + hash_f(id + 3u)) - omega * time_s * 0.35;
    return k / waves * cos(phase) * (0.35 / sqrt(waves));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    const vec2 uv = (vec2(texel) + 0.5) / vec2(size);
    vec2 slope = vec2(0.0);
    // No loop: each wave's numbers are constants then.
#define WAVE(i) slope += wave_slope(i, uv, params.time_s, params.tile_m);
    WAVE(0) WAVE(1) WAVE(2) WAVE(3) WAVE(4) WAVE(5) WAVE(6) WAVE(7) WAVE(8)
    WAVE(9) WAVE(10) WAVE(11) WAVE(12) WAVE(13) WAVE(14) WAVE(15) WAVE(16) WAVE(17)
#undef WAVE
    const vec3 normal = normalize(vec3(slope * 0.5, 1.0));
    imageStore(target, texel, vec4(0.5 * normal + 0.5, 1.0));
}
