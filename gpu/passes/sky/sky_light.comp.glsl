#version 460
// Irradiance of the sky as spherical harmonics, and the exposure that follows from it and the sun.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/cube_map.h"
#include "formulas/light/spherical_harmonics.h"
#include "gpu/passes/sky/sky_io.h"
#include "gpu/passes/sky/sky_light_io.h"

const int kSums = kHarmonics + kSkyAxes;
const int kParts = 16;  // of the rows of the cube: a GPU has little to do with one sum a lane
layout(local_size_x = 240) in;  // kSums * kParts
layout(binding = SKY_SOURCE) uniform samplerCube sky;
layout(binding = SKY_TARGET, scalar) writeonly buffer Output { SkyLight result; };

layout(push_constant, scalar) uniform Push { SkyLightParams params; };

shared vec4 partial[kSums * kParts];
shared vec3 coefficients[kHarmonics];
shared vec3 exact[kSkyAxes];

void main()
{
    const int i = int(gl_LocalInvocationID.x) % kSums;
    const int part = int(gl_LocalInvocationID.x) / kSums;
    const bool axis = i >= kHarmonics;
    const vec3 along = sky_axis(axis ? i - kHarmonics : 0);
    const int n = int(params.face_size);
    vec4 sum = vec4(0.0);  // and the weight
    for (int row = part; row < 6 * n; row += kParts) {
        for (int x = 0; x < n; ++x) {
            const vec2 st = (vec2(x, row % n) + 0.5) / params.face_size * 2.0 - 1.0;
            const float w = cube_texel_weight(st);
            const vec3 d = normalize(cube_direction(row / n, st));
            const float factor = w * (axis ? max(dot(d, along), 0.0) : harmonic(i, d));
            sum += vec4(textureLod(sky, d, params.mip).rgb * factor, w);
        }
    }
    partial[part * kSums + i] = sum;
    barrier();
    if (part == 0) {
        for (int k = 1; k < kParts; ++k) sum += partial[k * kSums + i];
        if (axis) {
            exact[i - kHarmonics] = sum.rgb * (4.0 / sum.w);
        } else {
            const vec3 coefficient = sum.rgb * (12.566371 / sum.w) * cosine_band(i);
            coefficients[i] = coefficient;
            result.harmonics[i] = vec4(coefficient, 0.0);
        }
    }
    barrier();
    if (part != 0) return;
    if (axis) {
        vec3 told = vec3(0.0);
        for (int k = 0; k < kHarmonics; ++k) told += coefficients[k] * harmonic(k, along);
        result.missed[i - kHarmonics] = vec4(exact[i - kHarmonics] - told, 0.0);
    }
    if (i != 0) return;

    // What falls on level ground: the sky's irradiance along +y and the sun.
    const vec3 up = exact[2];
    const vec3 weights = vec3(0.2126, 0.7152, 0.0722);
    const float sky_lux = max(dot(up, weights), 0.0) * 3.14159265 * params.ambient_scale;
    const float lux =
        max(sky_lux + dot(params.sun_illuminance, weights) * max(params.sun_up, 0.0), params.floor_lux);
    // A photographer's meter: half a stop above grey for streets between walls; dusk stays a little dark.
    const float dusk = 1.5 * clamp(pow(lux / 5000.0, 0.12), 0.35, 1.0);
    result.illuminance = lux;
    result.exposure = (params.exposure > 0.0 ? params.exposure : 3.14159265 / lux * dusk) * params.bias;
}
