// An example of a surface of your own that uses everything: a crust of lava. Its cracks glow, the more in the
// wind and the less in the rain, and keep water, snow and frost off; the plates between are rough and uneven,
// with bits of metal.
//
//   [materials."rock*"]
//   surface = "ember.glsl"
//   emissive_factor = [0.01, 0.0, 0.0]   # so that the picture keeps what glows
#include "gpu/passes/surface/own_surface.glsl"

// Over the surface, in metres, whichever way it faces.
vec2 ember_place(SurfaceInput at)
{
    return at.position.xz + at.position.y * vec2(0.8, 0.6);
}

float ember_height(vec2 p)
{
    return 0.7 * tileable_noise(p * 2.3, 4096, 41u) + 0.3 * tileable_noise(p * 9.7, 4096, 42u);
}

// 0 plate .. 1 crack; never thinner than a pixel.
float ember_crack(SurfaceInput at)
{
    const float pixel_m = length(at.position_dx) + length(at.position_dy);
    const float width = max(0.05, 2.0 * pixel_m);
    const float away = abs(ember_height(ember_place(at)) - 0.5);
    return (1.0 - smooth_edge(0.3 * width, width, away)) * min(0.05 / width, 1.0);
}

void ember_input(inout SurfaceInput at)
{
    const float hot = ember_crack(at);
    at.weather.g *= 1.0 - hot;  // no puddles
    at.weather.b *= 1.0 - hot;  // no snow
    at.weather.r *= 1.0 - hot;  // the second set of textures, where there is one
    // The textures of neighbouring plates do not run on into each other.
    const vec2 plate = floor(ember_place(at) * 1.2);
    at.uv.xy += hash_f(hash_u3(uint(int(plate.x)), uint(int(plate.y)), 43u));
    at.color.rgb *= 0.8 + 0.2 * tileable_noise(ember_place(at) * 31.0, 4096, 44u);
}

void ember_surface(SurfaceInput at, inout SurfaceData data)
{
    const vec2 p = ember_place(at);
    const float hot = ember_crack(at);
    const float h = ember_height(p);
    const float step_m = 0.01;
    const vec2 slope = vec2(ember_height(p + vec2(step_m, 0.0)) - h,
                            ember_height(p + vec2(0.0, step_m)) - h) * (0.08 / step_m);
    const TangentFrame f = tangent_frame(at);
    data.texel.base_normal =
        normalize(data.texel.base_normal - slope.x * f.tangent + slope.y * f.bitangent);
    const float ash = smooth_edge(0.4, 0.8, tileable_noise(p * 3.1, 4096, 45u));
    data.texel.base_color = mix(data.texel.base_color * 0.12, vec3(0.18), 0.5 * ash);
    data.texel.roughness = mix(0.95, 0.6, hot);
    data.texel.metallic = 0.25 * (1.0 - hot) * step(0.8, hash_f(hash_u3(uint(int(floor(p.x * 90.0))), uint(int(floor(p.y * 90.0))), 46u)));
    data.texel.porosity = 0.9;
    data.texel.occlusion *= 0.5 + 0.5 * smooth_edge(0.02, 0.12, abs(h - 0.5));
    const float fanned = 0.6 + 0.06 * min(length(frame.weather.wind_m_s), 12.0);
    const float pulse = 0.85 + 0.15 * sin(1.7 * frame.time_s + 9.0 * h);
    data.emission += vec3(1.0, 0.22, 0.03) * (9000.0 * hot * fanned * pulse * (1.0 - 0.6 * frame.weather.rain));
    data.texel.weather *= 1.0 - hot;
    data.texel.snow_smoothness *= 1.0 - hot;
}
