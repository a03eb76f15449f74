// An example of a surface of your own with its own snow mask: the wind sweeps snow off what faces it and
// leaves it in the lee of every ripple.
//
//   [materials."roof*"]
//   surface = "windswept.glsl"
#include "gpu/passes/surface/own_surface.glsl"

void windswept_input(inout SurfaceInput at)
{
    const vec2 wind = frame.weather.wind_m_s;
    const float speed = length(wind);
    const vec2 along = speed > 0.01 ? wind / speed : vec2(1.0, 0.0);
    // Ripples across the wind.
    const vec2 p = vec2(dot(at.position.xz, along) * 1.6, dot(at.position.xz, vec2(-along.y, along.x)) * 0.4);
    const float ripple = tileable_noise(p, 1024, 31u);
    const float facing = dot(at.normal.xz, -along);
    const float bare = smooth_edge(0.42, 0.6, 0.5 + (0.5 - ripple) + 0.5 * facing);
    const float swept = saturate(speed / 8.0) * bare;
    at.weather.b *= 1.0 - swept;
}

void windswept_surface(SurfaceInput at, inout SurfaceData data) {}
