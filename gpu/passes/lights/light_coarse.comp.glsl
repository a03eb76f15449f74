#version 460
// First step of light culling: for each coarse tile a bit per light, by the tile's four side planes.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/lights/light_volume.glsl"
#include "gpu/passes/lights/lights_io.h"

layout(local_size_x = LIGHT_COARSE_GROUP) in;
layout(binding = LIGHT_COARSE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = LIGHT_COARSE_LIGHTS) uniform samplerBuffer lights;
layout(binding = LIGHT_COARSE_WORDS, scalar) writeonly buffer Words { uint words[]; };

void main()
{
    const uint word = gl_GlobalInvocationID.x;
    const uint tile = gl_WorkGroupID.y;
    if (word >= frame.light_words) return;
    const ivec2 at = ivec2(int(tile) % frame.coarse_tiles.x, int(tile) / frame.coarse_tiles.x);
    const int side = LIGHT_TILE * LIGHT_COARSE;
    const TileVolume volume = tile_volume(frame, vec2(at * side), vec2((at + 1) * side));
    uint bits = 0u;
    for (uint i = 0u; i < 32u; ++i) {
        const uint light = word * 32u + i;
        if (light >= frame.light_count) break;
        const vec4 sphere = texelFetch(lights, int(light * LIGHT_TEXELS));
        if (touches_sides(volume, sphere.xyz, sphere.w)) bits |= 1u << i;
    }
    words[tile * frame.light_words + word] = bits;
}
