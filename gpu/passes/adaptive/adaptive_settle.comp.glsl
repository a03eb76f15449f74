#version 460
// A pixel is calm when the first two samples saw one surface and their light would look the same on the
// display, and when no neighbour shows something else: the edge of a shadow may lie between any of the
// samples.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/adaptive/adaptive_io.h"
#include "gpu/upload/steep_io.h"
#include "gpu/passes/sky/sky_light_io.h"

layout(local_size_x = ADAPTIVE_TILE, local_size_y = ADAPTIVE_TILE) in;
layout(constant_id = ADAPTIVE_SETTLE_SPEC_SUM) const uint SUM = 1u;
layout(binding = ADAPTIVE_SETTLE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = ADAPTIVE_SETTLE_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
layout(binding = ADAPTIVE_SETTLE_IDS) uniform usampler2D ids;
layout(binding = ADAPTIVE_SETTLE_DEPTH) uniform sampler2D depth_map;
layout(binding = ADAPTIVE_SETTLE_LIT) uniform sampler2D lit;
layout(binding = ADAPTIVE_SETTLE_LIGHT) uniform sampler2D light;
layout(binding = ADAPTIVE_SETTLE_SEEN, rg32ui) uniform uimage2D seen;
layout(binding = ADAPTIVE_SETTLE_MEAN, rgba16f) uniform writeonly image2D mean;
layout(push_constant, scalar) uniform Push { AdaptiveSettleParams params; };

const float kNeighbours = 5.0;  // so many thresholds may they differ by
const float kOneSurface = 0.1;  // of the distance, between two samples of a pixel

// About as the display codes it.
vec3 shown(vec3 radiance)
{
    const vec3 x = max(radiance, vec3(0.0)) * sky_light.exposure;
    return sqrt(x / (1.0 + x));
}

// The light of both samples, and the first's.
vec4 both_at(ivec2 at, out vec4 first)
{
    first = texelFetch(light, at, 0);
    const vec4 sum = texelFetch(lit, at, 0);
    return SUM != 0u ? sum : sum + first;
}

bool differ(vec3 a, vec3 b, float limit)
{
    return any(greaterThan(abs(a - b), vec3(limit)));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const uvec2 first = imageLoad(seen, texel).xy;
    const uint draw = texelFetch(ids, texel, 0).r & ID_DRAW;
    const float first_m = uintBitsToFloat(first.y);
    const float depth_m = draw != 0u ? linear_depth(frame, texelFetch(depth_map, texel, 0).r) : 0.0;
    vec4 first_light;
    const vec4 both = both_at(texel, first_light);
    bool calm = draw == first.x && abs(depth_m - first_m) <= kOneSurface * depth_m &&
                !differ(shown(first_light.rgb), shown((both - first_light).rgb), params.threshold);
    imageStore(mean, texel, 0.5 * both);
    const vec3 here = shown(0.5 * both.rgb);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
        const vec4 there = both_at(clamp(texel + step, ivec2(0), frame.size - 1), first_light);
        calm = calm && !differ(here, shown(0.5 * there.rgb), kNeighbours * params.threshold);
    }
    const vec2 range = vec2(min(depth_m, first_m), max(depth_m, first_m));
    imageStore(seen, texel, uvec4(calm ? draw : ADAPTIVE_RESTLESS,
                                  packHalf2x16(min(range, vec2(65000.0))), 0u, 0u));
}
