// Reads the G-buffer from its rows. Before the include:
//   GBUFFER_FIRST_BINDING   binding of the depth; the targets follow
#ifndef PETRICHOR_GBUFFER_READ_GLSL
#define PETRICHOR_GBUFFER_READ_GLSL

#include "gpu/frame/gbuffer.glsl"

layout(binding = GBUFFER_FIRST_BINDING) uniform samplerBuffer depth_rows;
#define ROW(name, location_, format_, when_, meaning_) \
    layout(binding = GBUFFER_FIRST_BINDING + 1 + location_) uniform samplerBuffer gbuffer_##name;
GBUFFER_TABLE(ROW)
#undef ROW

// at: row_texel of the pixel; kept: WEATHER_.. What a frame does not keep reads as zero.
GBufferCode fetch_gbuffer(int at, uint kept, bool has_emission, bool has_baked)
{
    const bool ALWAYS = true;
    const bool WEATHER = kept != WEATHER_DRY;
    const bool EMISSION = has_emission;
    const bool BAKED = has_baked;
    GBufferCode code;
#define ROW(name, location_, format_, when_, meaning_) \
    code.name = when_ ? texelFetch(gbuffer_##name, at) : vec4(0.0);
    GBUFFER_TABLE(ROW)
#undef ROW
    return code;
}

#endif
