// Reads the G-buffer. Before the include:
//   GBUFFER_FIRST_BINDING   binding of the depth; the targets follow
#ifndef PETRICHOR_GBUFFER_READ_GLSL
#define PETRICHOR_GBUFFER_READ_GLSL

#include "gpu/frame/gbuffer.glsl"

layout(binding = GBUFFER_FIRST_BINDING) uniform sampler2D depth_map;
#define ROW(name, location_, format_, when_, meaning_) \
    layout(binding = GBUFFER_FIRST_BINDING + 1 + location_) uniform sampler2D gbuffer_##name;
GBUFFER_TABLE(ROW)
#undef ROW

// What a frame does not keep reads as zero.
GBufferCode fetch_gbuffer(ivec2 texel, bool has_weather, bool has_emission, bool has_baked)
{
    const bool ALWAYS = true;
    const bool WEATHER = has_weather;
    const bool EMISSION = has_emission;
    const bool BAKED = has_baked;
    GBufferCode code;
#define ROW(name, location_, format_, when_, meaning_) \
    code.name = when_ ? texelFetch(gbuffer_##name, texel, 0) : vec4(0.0);
    GBUFFER_TABLE(ROW)
#undef ROW
    return code;
}

#endif
