#version 460
// Second step of light culling: one list a tile, in the order of the lights, by sides and depth range.
// A list holds words of 32 lights, those that are not empty: (their number, 0), then (word, bits). It
// has room for every word, so that no light is ever dropped.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/lights/light_volume.glsl"
#include "gpu/passes/lights/lights_io.h"

layout(local_size_x = LIGHT_LISTS_TILE, local_size_y = LIGHT_LISTS_TILE) in;
layout(binding = LIGHT_LISTS_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = LIGHT_LISTS_LIGHTS) uniform samplerBuffer lights;
layout(binding = LIGHT_LISTS_WORDS) uniform usamplerBuffer words;
layout(binding = LIGHT_LISTS_DEPTH) uniform sampler2D depth_map;
layout(binding = LIGHT_LISTS_LISTS, scalar) writeonly buffer Lists { uvec2 lists[]; };

void main()
{
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, frame.light_tiles))) return;
    const uint list = uint(tile.y * frame.light_tiles.x + tile.x) * (frame.light_words + 1u);

    float nearest = 0.0;
    float farthest = 2.0;
    const ivec2 low = tile * LIGHT_TILE;
    const ivec2 high = min(low + LIGHT_TILE, frame.size);
    // Four at a time; beyond the picture's edge stands what is at it.
    const vec2 texel = 1.0 / vec2(textureSize(depth_map, 0));
    for (int y = low.y; y < high.y; y += 2) {
        for (int x = low.x; x < high.x; x += 2) {
            const vec4 d = textureGather(depth_map, (vec2(x, y) + 1.0) * texel);
            const vec4 there = mix(vec4(2.0), d, greaterThan(d, vec4(0.0)));
            nearest = max(nearest, max(max(d.x, d.y), max(d.z, d.w)));
            farthest = min(farthest, min(min(there.x, there.y), min(there.z, there.w)));
        }
    }
    uint count = 0u;
    if (nearest > 0.0) {
        const TileVolume volume = tile_volume(frame, vec2(low), vec2(low + LIGHT_TILE));
        const float near_m = linear_depth(frame, nearest);
        const float far_m = linear_depth(frame, farthest);
        // Axis-aligned box of the slab in camera axes: a sphere near a corner is told apart by it.
        const vec3 right = normalize(frame.ray_dx);
        const vec3 down = normalize(frame.ray_dy);
        const bool orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
        vec2 box_low = vec2(1.0e30);
        vec2 box_high = vec2(-1.0e30);
        for (int i = 0; i < 4; ++i) {
            const vec3 ray = orthographic ? volume.rays[i] - frame.camera_m : volume.rays[i];
            const vec2 at = vec2(dot(ray, right), dot(ray, down));
            const vec2 a = orthographic ? at : at * near_m;
            const vec2 b = orthographic ? at : at * far_m;
            box_low = min(box_low, min(a, b));
            box_high = max(box_high, max(a, b));
        }
        const ivec2 coarse = tile / LIGHT_COARSE;
        const uint first = uint(coarse.y * frame.coarse_tiles.x + coarse.x) * frame.light_words;
        // Most words of a wide scene have nothing here: a loop of its own passes them over.
        uint next = 0u;
        do {
            uint bits;
            do bits = next < frame.light_words ? texelFetch(words, int(first + next)).r : 0u;
            while (++next < frame.light_words && bits == 0u);
            const uint w = next - 1u;
            uint kept = 0u;
            do {
                const int bit = max(findLSB(bits), 0);
                const uint light = w * 32u + uint(bit);
                const bool asked = bits != 0u && light >= frame.directional_count;
                bits &= bits - 1u;
                const vec4 sphere = texelFetch(lights, int(light * LIGHT_TEXELS));
                const vec3 offset = sphere.xyz - frame.camera_m;
                const float along = dot(offset, frame.forward);
                const vec2 across = vec2(dot(offset, right), dot(offset, down));
                const vec2 gap = max(max(box_low - across, across - box_high), vec2(0.0));
                const float gap_z = max(max(near_m - along, along - far_m), 0.0);
                const bool far = dot(gap, gap) + gap_z * gap_z > sphere.w * sphere.w;
                if (asked && !far && touches_sides(volume, sphere.xyz, sphere.w)) kept |= 1u << uint(bit);
            } while (bits != 0u);  // a CPU takes a loop that asks at its beginning once more
            if (kept != 0u) {
                ++count;
                lists[list + count] = uvec2(w, kept);
            }
        } while (next < frame.light_words);
    }
    lists[list] = uvec2(count, 0u);
}
