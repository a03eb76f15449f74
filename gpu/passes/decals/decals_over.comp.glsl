#version 460
// Lays what the decals hold over the dry material of each pixel; the weather there, unless a decal
// brings its own, lies on both.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/surface_weather.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/decals/decals_io.h"
#include "gpu/upload/material_io.h"

layout(local_size_x = DECALS_OVER_TILE, local_size_y = DECALS_OVER_TILE) in;
layout(constant_id = DECALS_OVER_SPEC_WEATHER) const uint WEATHER = 1u;
layout(constant_id = DECALS_OVER_SPEC_REFUSED) const uint REFUSED = 1u;
layout(binding = DECALS_OVER_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = DECALS_OVER_LAID) uniform sampler2D laid_color;
layout(binding = DECALS_OVER_LAID + 1) uniform sampler2D laid_normal;
layout(binding = DECALS_OVER_LAID + 2) uniform sampler2D laid_matter;
layout(binding = DECALS_OVER_LAID + 3) uniform sampler2D laid_weather;
layout(binding = DECALS_OVER_LAID + 4) uniform sampler2D laid_cover;
layout(binding = DECALS_OVER_LOOKS) uniform samplerBuffer material_looks;
layout(binding = DECALS_OVER_COLOR, rgba8) uniform image2D color_map;
layout(binding = DECALS_OVER_NORMALS, rgba16_snorm) uniform image2D normals_map;
layout(binding = DECALS_OVER_MATERIAL, rgba8) uniform image2D material_map;
layout(binding = DECALS_OVER_WEATHER, rgba16) uniform image2D weather_map;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const vec4 color = texelFetch(laid_color, texel, 0);
    const vec4 normal = texelFetch(laid_normal, texel, 0);
    const vec4 matter = texelFetch(laid_matter, texel, 0);
    const vec4 weather = texelFetch(laid_weather, texel, 0);
    if (color.a + normal.a + matter.a + weather.a <= 0.0) return;
    if (REFUSED != 0u) {
        const int number = int(material_of(imageLoad(weather_map, texel), WEATHER_WHOLE));
        if (texelFetch(material_looks, number * MATERIAL_LOOK_TEXELS + 3).y < 0.5) return;
    }
    vec4 code = imageLoad(color_map, texel);
    code.rgb = sqrt(code.rgb * code.rgb * (1.0 - color.a) + color.rgb);
    code.a = code.a * (1.0 - matter.a) + matter.b;
    imageStore(color_map, texel, code);
    vec4 normals = imageLoad(normals_map, texel);
    const vec3 below = octahedral_decode(normals.xy);
    normals.xy = octahedral_encode(normalize(below * (1.0 - normal.a) + normal.xyz));
    if (WEATHER == 0u) {
        normals.zw = normals.xy;
    } else if (weather.a > 0.0) {
        const vec4 cover = texelFetch(laid_cover, texel, 0);
        // Water of a decal has the rings of what it lies on.
        const float roughness = roughness_of_normal(normals.zw);
        normals.zw = octahedral_encode(
            normalize(octahedral_decode(normals.zw) * (1.0 - cover.a) + cover.xyz));
        if ((frame.flags & FRAME_RINGS) != 0u) normals.zw = rough_normal_code(normals.zw, roughness);
    }
    imageStore(normals_map, texel, normals);
    vec4 dry = imageLoad(material_map, texel);
    if (matter.a > 0.0) {
        const float porosity = porosity_from_smoothness(1.0 - matter.r / matter.a);
        dry.xyz = dry.xyz * (1.0 - matter.a) + vec3(matter.rg, porosity * matter.a);
        imageStore(material_map, texel, dry);
    }
    if (WEATHER != 0u && weather.a > 0.0) {
        vec4 held = imageLoad(weather_map, texel);
        vec4 lies = stores_of(held);
        lies.xyz = lies.xyz * (1.0 - weather.a) + weather.xyz;
        held.zw = stores_code(lies);
        imageStore(weather_map, texel, held);
    }
}
