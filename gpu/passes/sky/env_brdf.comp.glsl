#version 460
// Directional albedo of GGX split into a scale and an offset of F0 (Karis 2013): u = n.v, v = roughness.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/brdf.h"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_ALONE_TARGET, rg16f) uniform writeonly image2D target;

const int kSamples = 512;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(target);
    if (any(greaterThanEqual(texel, size))) return;
    // Texel centres reach both ends of the axes.
    const float nv = max(float(texel.x) / float(size.x - 1), 0.002);
    const float roughness = max(float(texel.y) / float(size.y - 1), 0.02);
    const float alpha = roughness * roughness;
    const vec3 v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < kSamples; ++i) {
        const float u = (float(i) + 0.5) / float(kSamples);
        const float phi = 6.2831853 * fract(float(i) * 0.61803399);
        const float cos2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
        const float nh = sqrt(cos2);
        const float sh = sqrt(max(1.0 - cos2, 0.0));
        const vec3 h = vec3(sh * cos(phi), sh * sin(phi), nh);
        const float vh = dot(v, h);
        const float nl = 2.0 * vh * h.z - v.z;
        if (nl <= 0.0 || vh <= 0.0) continue;
        const float g = 4.0 * ggx_visibility(nl, nv, alpha) * nl * vh / nh;
        const float m = 1.0 - vh;
        const float fc = m * m * m * m * m;
        sum += vec2(g * (1.0 - fc), g * fc);
    }
    imageStore(target, texel, vec4(sum / float(kSamples), 0.0, 0.0));
}
