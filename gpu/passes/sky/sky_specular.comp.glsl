#version 460
// One level of the environment as a GGX lobe of fixed roughness sees it (Karis 2013; sample levels by
// Krivanek and Colbert 2008).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/brdf.h"
#include "formulas/light/cube_map.h"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_SOURCE) uniform samplerCube sky;
layout(binding = SKY_TARGET, rgba16f) uniform writeonly image2DArray target;

layout(push_constant, scalar) uniform Push { PrefilterParams params; };

const int kSamples = 48;

void main()
{
    const ivec3 id = ivec3(gl_GlobalInvocationID);
    const ivec3 size = imageSize(target);
    if (any(greaterThanEqual(id.xy, size.xy))) return;
    const vec2 st = (vec2(id.xy) + 0.5) / vec2(size.xy) * 2.0 - 1.0;
    const vec3 n = normalize(cube_direction(id.z, st));
    if (params.roughness < 0.01) {
        const float lod = log2(params.source_size / float(size.x));
        imageStore(target, id, vec4(textureLod(sky, n, lod).rgb, 1.0));
        return;
    }
    const float alpha = params.roughness * params.roughness;
    const vec3 side = normalize(abs(n.y) < 0.9 ? cross(n, vec3(0, 1, 0)) : cross(n, vec3(1, 0, 0)));
    const vec3 other = cross(n, side);
    const float texel_angle = 4.0 * kPi / (6.0 * params.source_size * params.source_size);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const float u = (float(i) + 0.5) / float(kSamples);
        const float phi = 2.3999632 * float(i);
        const float cos2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
        const float nh = sqrt(cos2);
        const float sh = sqrt(max(1.0 - cos2, 0.0));
        const vec3 h = side * (sh * cos(phi)) + other * (sh * sin(phi)) + n * nh;
        const vec3 l = 2.0 * nh * h - n;
        const float nl = dot(n, l);
        if (nl <= 0.0) continue;
        const float pdf = ggx_distribution(nh, alpha) * 0.25;
        const float sample_angle = 1.0 / (float(kSamples) * max(pdf, 1.0e-6));
        const float lod = clamp(0.5 * log2(sample_angle / texel_angle) + 0.5, params.source_first, params.source_mips - 1.0);
        sum += textureLod(sky, l, lod).rgb * nl;
        total += nl;
    }
    imageStore(target, id, vec4(sum / max(total, 1.0e-4), 1.0));
}
