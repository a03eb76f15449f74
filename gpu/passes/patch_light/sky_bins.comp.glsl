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

// A texel of the sky above the horizon, behind the bins: its light, then the way it comes from by luminance.
void write_texel(int texel)
{
    vec3 light = vec3(0.0);
    vec3 way = vec3(0.0);
    vec3 even = vec3(0.0);
    float bright = 0.0;
    float weights = 0.0;
    for (int s = 0; s < kSkySubsamples; ++s) {
        const vec4 d = visibility_subsample(texel, s);
        const vec3 here = textureLod(sky, d.xyz, float(SKY_BINS_MIP)).rgb * d.w;
        const float luminance = dot(here, vec3(0.2126, 0.7152, 0.0722));
        light += here;
        way += d.xyz * luminance;
        even += d.xyz * d.w;
        bright += luminance;
        weights += d.w;
    }
    bins[kSkyBins + 2 * texel] = vec4(light * (3.14159265 / weights), 0.0);
    bins[kSkyBins + 2 * texel + 1] = vec4(bright > 0.0 ? way / bright : even / weights, 0.0);
}

void main()
{
    const int bin = int(gl_GlobalInvocationID.x);
    if (bin >= kSkyBins + kVisibilityTexels) return;
    if (bin >= kSkyBins) {
        write_texel(bin - kSkyBins);
        return;
    }
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
