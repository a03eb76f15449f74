// What an instance has instead of its material's own values.
#ifndef PETRICHOR_SURFACE_INSTANCE_LOOK_GLSL
#define PETRICHOR_SURFACE_INSTANCE_LOOK_GLSL

#include "gpu/passes/surface/surface_bindings.glsl"
#include "gpu/passes/surface/surface_data.glsl"

struct Factors {
    vec3 base_color;
    float metallic;
    float roughness;
    float emission;
};

Factors factors_of(SurfaceInput at)
{
    Factors f;
    f.base_color = material.base_color_factor.rgb;
    f.metallic = material.metallic_factor;
    f.roughness = material.roughness_factor;
    f.emission = 1.0;
    if (LOOKS != 0u && at.look != 0u) {
        const int row = int(at.look) * INSTANCE_LOOK_TEXELS;
        const vec4 first = texelFetch(instance_looks, row);
        const vec4 second = texelFetch(instance_looks, row + 1);
        if (first.r >= 0.0) f.base_color = first.rgb;
        if (first.a >= 0.0) f.metallic = first.a;
        if (second.r >= 0.0) f.roughness = second.r;
        if (second.g >= 0.0) f.emission = second.g;
    }
    return f;
}

#endif
