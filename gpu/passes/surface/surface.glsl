// The surface pass: writes the material and the weather at each pixel (evaluate_surface.glsl).
//
// Compiled four times, since a target that nobody reads is not written:
//   SURFACE_WEATHER   1: masks of water, snow and frost
//   SURFACE_EMISSION  1: radiance of materials that glow
#include "gpu/passes/surface/evaluate_surface.glsl"

layout(push_constant, scalar) uniform Push { DrawConstants draw; };

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec4 in_weather;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_normals;
layout(location = 2) out vec4 out_material;
#if SURFACE_WEATHER
layout(location = 3) out vec4 out_weather;
#endif
#if SURFACE_EMISSION
layout(location = 3 + SURFACE_WEATHER) out vec4 out_emission;
#endif

void main()
{
    const float side = gl_FrontFacing ? 1.0 : -1.0;
    SurfaceInput at;
    at.position = in_position;
    at.position_dx = dFdx(in_position);
    at.position_dy = dFdy(in_position);
    at.normal = normalize(in_normal) * side;
    at.normal_dx = dFdx(at.normal);
    at.normal_dy = dFdy(at.normal);
    at.tangent = vec4(in_tangent.xyz, in_tangent.w * side);
    at.uv = in_uv;
    at.uv_dx = dFdx(in_uv);
    at.uv_dy = dFdy(in_uv);
    at.color = in_color;
    at.weather = in_weather;
    at.pixel = ivec2(gl_FragCoord.xy);
    at.instance_id = draw.instance_id;

    const SurfaceData data = evaluate_surface(at);
    if (HOLES != 0u && data.hole) discard;
    const GBufferCode code = encode_gbuffer(data.texel);
    out_color = code.color;
    out_normals = code.normals;
    out_material = code.material;
#if SURFACE_WEATHER
    out_weather = code.weather;
#endif
#if SURFACE_EMISSION
    out_emission = vec4(data.emission, 1.0);
#endif
}
