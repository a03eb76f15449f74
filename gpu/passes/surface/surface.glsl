// The surface pass: writes the dry material and the weather at each pixel. What weather does to the
// material is decided in the lighting pass (weather/formulas/surface_weather.h).
//
// Compiled four times, since a target that nobody reads is not written:
//   SURFACE_WEATHER   1: masks of water, snow and frost
//   SURFACE_EMISSION  1: radiance of materials that glow
#include "formulas/codec/octahedral.h"
#include "gpu/frame/frame_io.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/upload/material_io.h"
#include "formulas/noise/noise.glsl"
#include "formulas/weather/ripple.h"
#include "formulas/weather/surface_weather.h"

// What a draw needs is known before it is compiled: a CPU driver runs both sides of every branch.
layout(constant_id = 2) const uint SLOTS = 255u;    // texture slots that the material has, one bit each
layout(constant_id = 3) const uint WATER = 1u;      // 0: no water stands anywhere in this frame
layout(constant_id = 4) const uint SNOW = 1u;       // 0: no snow lies anywhere in this frame
layout(constant_id = 1) const uint HOLES = 1u;    // 0: opaque, so that hidden pixels are never shaded

layout(set = 0, binding = 0, scalar) uniform Frame { FrameConstants frame; };
layout(set = 0, binding = 1) uniform sampler2D ripple_map;
layout(set = 0, binding = 2) uniform sampler2D flow_map;
layout(set = 0, binding = 3) uniform sampler2D snow_map;
layout(set = 0, binding = 4) uniform sampler2DShadow shelter_map;
layout(set = 1, binding = 0, scalar) uniform Material { MaterialConstants material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_map;
layout(set = 1, binding = 2) uniform sampler2D normal_map;
layout(set = 1, binding = 3) uniform sampler2D metallic_roughness_map;
layout(set = 1, binding = 4) uniform sampler2D occlusion_map;
layout(set = 1, binding = 5) uniform sampler2D emissive_map;
layout(set = 1, binding = 6) uniform sampler2D height_map;
layout(set = 1, binding = 7) uniform sampler2D puddle_map;
layout(set = 1, binding = 8) uniform sampler2D snow_mask_map;
layout(push_constant, scalar) uniform Push { DrawConstants draw; };

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec4 in_weather;

layout(location = 0) out vec4 out_color;     // square-root base colour, occlusion
layout(location = 1) out vec4 out_normals;   // base and cover normal, octahedral
layout(location = 2) out vec4 out_material;  // roughness, metallic, porosity, model
#if SURFACE_WEATHER
layout(location = 3) out vec4 out_weather;   // film, water, snow, frost
#endif
#if SURFACE_EMISSION
layout(location = 3 + SURFACE_WEATHER) out vec4 out_emission;
#endif

struct Uv {
    vec2 at;
    vec2 dx;
    vec2 dy;
};

bool has(int slot)
{
    return (SLOTS & (1u << slot)) != 0u;
}

// Coordinates of a texture slot with their screen derivatives; `shift` moves the lookup.
Uv coordinates(int slot, vec4 uv, vec4 dx, vec4 dy, vec2 shift)
{
    const bool second = (material.flags & (65536u << slot)) != 0u;
    const vec2 p = (second ? uv.zw : uv.xy) + shift;
    const vec2 px = second ? dx.zw : dx.xy;
    const vec2 py = second ? dy.zw : dy.xy;
    const TextureTransform t = material.transforms[slot];
    Uv result;
    result.at = vec2(dot(t.row0.xy, p) + t.row0.z, dot(t.row1.xy, p) + t.row1.z);
    result.dx = vec2(dot(t.row0.xy, px), dot(t.row1.xy, px));
    result.dy = vec2(dot(t.row0.xy, py), dot(t.row1.xy, py));
    return result;
}

// A normal from two channels of 0..1; longer than 1 only where the strength says so.
vec3 unpack_normal(vec2 xy, float strength)
{
    const vec2 n = (xy * 2.0 - 1.0) * strength;
    return vec3(n, sqrt(1.0 - saturate(dot(n, n))));
}

// How much of the falling rain reaches this point: 1 open sky, 0 under a roof.
float exposure_to_sky(vec3 position, vec3 normal)
{
    if ((frame.flags & FRAME_SHELTER) == 0u) return 1.0;
    const float spread = frame.shelter_spread_m;
    // Off the surface by the spread, so that no tap of a wall ends up inside it.
    const vec3 lifted = position + vec3(normal.x, 0.3 * normal.y, normal.z) * spread;
    const vec4 map = frame.shelter_from_world * vec4(lifted, 1.0);
    const float inside = step(abs(map.x - 0.5), 0.5) * step(abs(map.y - 0.5), 0.5);
    // Splashes and drift soften the edge.
    const float turn = dither(ivec2(gl_FragCoord.xy), frame.sample_index) * 6.2831853;
    const vec2 axis = vec2(cos(turn), sin(turn));
    float open = 0.0;
    for (int i = 0; i < 4; ++i) {
        const float radius = (float(i) + 0.5) * 0.25 * spread;
        const float angle = 2.3999632 * float(i);
        const vec2 d = vec2(cos(angle), sin(angle)) * radius;
        const vec2 offset = vec2(axis.x * d.x - axis.y * d.y, axis.y * d.x + axis.x * d.y);
        const vec3 p = lifted + vec3(offset.x, 0.0, offset.y);
        const vec4 at = frame.shelter_from_world * vec4(p, 1.0);
        open += texture(shelter_map, vec3(at.xy, at.z));
    }
    return mix(1.0, open * 0.25, inside);
}

void main()
{
    const vec4 uv_dx = dFdx(in_uv);
    const vec4 uv_dy = dFdy(in_uv);
    const vec3 position_dx = dFdx(in_position);
    const vec3 position_dy = dFdy(in_position);

    vec3 geometric = normalize(in_normal);
    vec3 tangent = in_tangent.xyz;
    float handedness = in_tangent.w;
    if (!gl_FrontFacing) {
        geometric = -geometric;
        handedness = -handedness;
    }
    tangent = tangent - geometric * dot(tangent, geometric);
    const float tangent_length = length(tangent);
    tangent = tangent_length > 1.0e-6
                  ? tangent / tangent_length
                  : normalize(abs(geometric.y) < 0.9 ? cross(geometric, vec3(0, 1, 0))
                                                     : cross(geometric, vec3(1, 0, 0)));
    const vec3 bitangent = cross(geometric, tangent) * handedness;

    // ---- weather first: it decides where the material is read ------------------------------------
    const bool sheltered = (material.flags & MATERIAL_SHELTERED) != 0u;
    float film = 0.0;
    float frost = 0.0;
    WaterCover water;
    water.anywhere = 0.0;
    water.deep = 0.0;
    SnowCover snow;
    snow.snow = 0.0;
    snow.melt = 0.0;
    vec3 cover_normal = geometric;
    vec2 refraction = vec2(0.0);
    vec3 mapped = vec3(0.0, 0.0, 1.0);  // tangent normal of the normal map

#if SURFACE_WEATHER
    if (has(TEXTURE_NORMAL)) {
        const Uv at = coordinates(TEXTURE_NORMAL, in_uv, uv_dx, uv_dy, vec2(0.0));
        mapped = unpack_normal(textureGrad(normal_map, at.at, at.dx, at.dy).xy, material.normal_scale);
    }
    if (!sheltered) {
        const float open = exposure_to_sky(in_position, geometric);
        // Thin wetness creeps further than rain falls.
        const float damp = sqrt(open);
        const Uv height_uv = coordinates(TEXTURE_HEIGHT, in_uv, uv_dx, uv_dy, vec2(0.0));
        const float height = has(TEXTURE_HEIGHT)
                                 ? textureGrad(height_map, height_uv.at, height_uv.dx, height_uv.dy).r
                                 : material.default_height;
        float puddle_mask = in_weather.g;
        if (has(TEXTURE_PUDDLE_MASK)) {
            const Uv at = coordinates(TEXTURE_PUDDLE_MASK, in_uv, uv_dx, uv_dy, vec2(0.0));
            puddle_mask *= textureGrad(puddle_map, at.at, at.dx, at.dy).r;
        }
        float unique_snow = in_weather.b;
        if (has(TEXTURE_SNOW_MASK)) {
            const Uv at = coordinates(TEXTURE_SNOW_MASK, in_uv, uv_dx, uv_dy, vec2(0.0));
            unique_snow *= textureGrad(snow_mask_map, at.at, at.dx, at.dy).r;
        }
        // Snow, by amount, slope, height and the two-frequency mask.
        const float influence = material.snow_accumulation.y;
        const float constant = material.snow_accumulation.x;
        // What falls does not cling to walls, whatever the slope damp of the material.
        const float clinging = smooth_edge(0.0, 0.4, geometric.y);
        const float amount_raw = frame.snow_amount * open * clinging * influence + constant;
        const float amount = saturate(amount_raw);
        const vec3 smoothed = normalize(mix(mapped, vec3(0.0, 0.0, 1.0), saturate(amount_raw * 0.5)));
        const vec3 smoothed_world =
            normalize(smoothed.x * tangent + smoothed.y * bitangent + smoothed.z * geometric);
        const vec2 xz = in_position.xz;
        const vec2 xz_dx = position_dx.xz;
        const vec2 xz_dy = position_dy.xz;
        if (SNOW != 0u && amount > 0.0) {
            const float mask = textureGrad(snow_map, xz * frame.snow_tiling.z,
                                           xz_dx * frame.snow_tiling.z, xz_dy * frame.snow_tiling.z).b;
            const vec4 detail = textureGrad(snow_map, xz * frame.snow_tiling.w,
                                            xz_dx * frame.snow_tiling.w, xz_dy * frame.snow_tiling.w);
            snow = snow_cover(amount,
                              snow_height_factor(in_position.y, frame.snow_start_m, frame.snow_blend_m),
                              smoothed_world.y, material.snow_slope_damp, unique_snow, mask, detail.b,
                              frame.melt * influence);
        }

        // Standing water in cracks and puddles.
        const vec2 flood =
            frame.flood * open * vec2(material.water_accumulation.y, material.water_accumulation.w) +
            vec2(material.water_accumulation.x, material.water_accumulation.z);
        if (WATER != 0u) water = water_cover(flood, height, puddle_mask, geometric.y, material.water_slope_damp);
        film = damp * saturate(smoothed_world.y + 1.0 - material.water_slope_damp);
        frost = frame.frost * open * saturate(geometric.y * 0.6 + 0.5) * (1.0 - water.anywhere);

        // Ripples and flow bend the water surface.
        vec3 ripple = vec3(0.0, 0.0, 1.0);
        vec3 flow = vec3(0.0, 0.0, 1.0);
        const float dist = length(in_position - frame.camera_m);
        const float fade = pow(saturate((50.0 - dist) / 15.0), 2.0);
        if (WATER != 0u && frame.rain * open > 0.0 && water.deep > 0.0 && fade > 0.001) {
            const float t = frame.ripple_tiling;
            const vec2 xy = textureGrad(ripple_map, xz * t, xz_dx * t, xz_dy * t).xy;
            // A third of the slope in the map, as rings on a real puddle have (Lagarde 2013, 2b).
            ripple = mix(ripple, unpack_normal(xy, 0.35),
                         water.deep * saturate(geometric.y) * saturate(open * 2.0));
        }
        const float constant_puddle = material.water_accumulation.z;
        if (WATER != 0u && flood.y > 0.0 && water.anywhere > 0.0 && fade > 0.001) {
            const vec2 down = vec2(dot(vec3(0, 1, 0), tangent), dot(vec3(0, 1, 0), bitangent));
            const vec2 v = down * material.flow_speed *
                           saturate(1.0 - frame.freeze_exp + constant_puddle);
            const FlowPhases phases = flow_phases(frame.time_s, material.flow_interval_s);
            const float t = material.flow_tiling;
            const vec2 base = xz * t;
            const vec2 first = textureGrad(flow_map, base + phases.first * v, xz_dx * t, xz_dy * t).xy;
            const vec2 second = textureGrad(flow_map, base + phases.second * v, xz_dx * t, xz_dy * t).xy;
            const float slope = 1.0 - saturate(geometric.y) * saturate(geometric.y);
            // On flat ground only the wind moves the water, a little.
            const float breeze = 0.05 + 0.03 * min(length(frame.wind_m_s), 6.0);
            flow = mix(flow,
                       unpack_normal(mix(first, second, phases.blend), material.flow_normal_strength),
                       max(slope, breeze * saturate(geometric.y)) * water.anywhere);
        }
        const vec3 water_normal =
            mix(vec3(0.0, 0.0, 1.0), normalize(vec3(ripple.xy + flow.xy, ripple.z * flow.z)), fade);
        refraction = (ripple.xy * frame.ripple_refraction + flow.xy * material.flow_refraction) *
                     water.deep * (1.0 - saturate(2.0 * snow.snow)) *
                     saturate(1.0 - frame.water_to_snow + constant_puddle) * fade * 0.1;
        // Ripples and waves are laid out in world x and z.
        const vec3 water_world = normalize(vec3(water_normal.x, 0.0, water_normal.y) +
                                           geometric * max(water_normal.z, 0.05));

        cover_normal = water_world;
        if (SNOW != 0u) {
            // A snow cover has its own, softer relief.
            const vec2 snow_xy =
                textureGrad(snow_map, xz * frame.snow_tiling.x, xz_dx * frame.snow_tiling.x,
                            xz_dy * frame.snow_tiling.x).xy;
            const vec2 snow_detail_xy =
                textureGrad(snow_map, xz * frame.snow_tiling.y, xz_dx * frame.snow_tiling.y,
                            xz_dy * frame.snow_tiling.y).xy;
            const vec3 snow_normal = unpack_normal(snow_xy, material.snow_normal_strength);
            const vec3 snow_detail =
                unpack_normal(snow_detail_xy, material.snow_detail_strength * fade);
            const vec3 snow_world = normalize(
                vec3(snow_normal.x + snow_detail.x, 0.0, snow_normal.y + snow_detail.y) +
                mix(smoothed_world, geometric, 0.3 + 0.7 * amount) * (snow_normal.z * snow_detail.z));
            water.anywhere = melt_wetness(water.anywhere, snow.melt, frame.melt_exp);
            const float snow_share = snow.snow / max(snow.snow + water.anywhere, 1.0e-4);
            cover_normal = normalize(mix(water_world, snow_world, saturate(snow_share)));
        }
    }
#endif

    // ---- the dry material, seen through the water -------------------------------------------------
    vec4 base = material.base_color * in_color;
    const Uv base_uv = coordinates(TEXTURE_BASE_COLOR, in_uv, uv_dx, uv_dy, refraction);
    if (has(TEXTURE_BASE_COLOR)) {
        base *= textureGrad(base_color_map, base_uv.at, base_uv.dx, base_uv.dy);
    }
    if (HOLES != 0u && (material.flags & MATERIAL_MASK) != 0u && base.a < material.alpha_cutoff) discard;
    if (HOLES != 0u && (material.flags & MATERIAL_BLEND) != 0u &&
        base.a <= dither(ivec2(gl_FragCoord.xy), frame.sample_index + hash_u(draw.instance_id) % 64u)) {
        discard;
    }

    float roughness = material.roughness;
    float metallic = material.metallic;
    if (has(TEXTURE_METALLIC_ROUGHNESS)) {
        const Uv at = coordinates(TEXTURE_METALLIC_ROUGHNESS, in_uv, uv_dx, uv_dy, refraction);
        const vec4 texel = textureGrad(metallic_roughness_map, at.at, at.dx, at.dy);
        roughness *= texel.g;
        metallic *= texel.b;
    }
    float occlusion = 1.0;
    if (has(TEXTURE_OCCLUSION)) {
        const Uv at = coordinates(TEXTURE_OCCLUSION, in_uv, uv_dx, uv_dy, refraction);
        occlusion = mix(1.0, textureGrad(occlusion_map, at.at, at.dx, at.dy).r,
                        material.occlusion_strength);
    }
    vec3 normal = geometric;
    if (has(TEXTURE_NORMAL)) {
        vec3 n = mapped;
        if (SURFACE_WEATHER == 0 || WATER != 0u) {  // seen through water: at another place
            const Uv at = coordinates(TEXTURE_NORMAL, in_uv, uv_dx, uv_dy, refraction);
            n = unpack_normal(textureGrad(normal_map, at.at, at.dx, at.dy).xy, material.normal_scale);
        }
        normal = normalize(n.x * tangent + n.y * bitangent + n.z * geometric);
    }
#if SURFACE_EMISSION
    vec3 emission = material.emissive;
    if (has(TEXTURE_EMISSIVE)) {
        const Uv at = coordinates(TEXTURE_EMISSIVE, in_uv, uv_dx, uv_dy, refraction);
        emission *= textureGrad(emissive_map, at.at, at.dx, at.dy).rgb;
    }
#endif

    // Curvature of the geometry inside a pixel widens the lobe (Tokuyoshi and Kaplanyan 2019).
    const vec3 normal_dx = dFdx(geometric);
    const vec3 normal_dy = dFdy(geometric);
    const float variance =
        min(0.5 * (dot(normal_dx, normal_dx) + dot(normal_dy, normal_dy)), 0.18);
    const float alpha = roughness * roughness;
    roughness = sqrt(sqrt(saturate(alpha * alpha + variance)));

    const uint model =
        (material.flags & MATERIAL_UNLIT) != 0u ? MODEL_UNLIT : MODEL_STANDARD;
    const float porosity = material.porosity >= 0.0 ? material.porosity
                                                    : porosity_from_smoothness(1.0 - roughness);
    // Murky water hides the ground: its colour takes the place of the material's.
    const float murk = material.water_color.a * water.anywhere;
    base.rgb = mix(base.rgb, material.water_color.rgb, murk);
    metallic *= 1.0 - murk;
    out_color = vec4(sqrt(clamp(base.rgb, vec3(0.0), vec3(1.0))), mix(occlusion, 1.0, murk));
    const vec2 base_code = octahedral_encode(normal);
#if SURFACE_WEATHER
    out_normals = vec4(base_code, octahedral_encode(cover_normal));
#else
    out_normals = vec4(base_code, base_code);
#endif
    out_material = vec4(roughness, metallic, porosity * (1.0 - murk),
                        float(model | (encode_reflectance(material.f0) << 1)) / 255.0);
#if SURFACE_WEATHER
    out_weather = vec4(film, water.anywhere, snow.snow, frost);
#endif
#if SURFACE_EMISSION
    // Murk and snow cover what glows.
    const float kept = (1.0 - murk) * mix(1.0, 1.0 - snow.snow * material.snow_opacity, snow.snow);
    out_emission = vec4(emission * (frame.emissive_scale * kept), 1.0);
#endif
}
