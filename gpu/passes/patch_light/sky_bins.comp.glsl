#version 460
// Mean radiance of each bin of the sky, times pi: what patches get of it. Without the sun's disc.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/patch_cells.h"
#include "gpu/passes/patch_light/patch_light_io.h"

layout(local_size_x = SKY_BINS_GROUP) in;
layout(binding = SKY_BINS_SOURCE) uniform samplerCube sky;
layout(binding = SKY_BINS_TARGET, scalar) writeonly buffer Output { vec4 bins[]; };

const int kSide = 4;  // directions along a side of a bin

void main()
{
    const int bin = int(gl_GlobalInvocationID.x);
    if (bin >= kSkyBins) return;
    const float across = float(kSkyBinsAcross * kSide);
    const ivec2 corner = ivec2(bin % kSkyBinsAcross, bin / kSkyBinsAcross) * kSide;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const vec2 uv = (vec2(corner + ivec2(x, y)) + 0.5) / across * 2.0 - 1.0;
            sum += textureLod(sky, octahedral_decode(uv), float(SKY_BINS_MIP)).rgb;
        }
    }
    bins[bin] = vec4(sum * (3.14159265 / float(kSide * kSide)), 0.0);
}
