// The material and the weather at a surface point.
//
// One text for a fragment shader and for a compute shader that resolves a visibility buffer: no
// derivative is taken here, no built-in read, nothing discarded. The includer defines
//   SURFACE_WEATHER   1: masks of water, snow and frost are wanted
//   SURFACE_EMISSION  1: radiance of materials that glow is wanted
//   SURFACE_BAKED     1: light of light maps is wanted
#ifndef PETRICHOR_EVALUATE_SURFACE_GLSL
#define PETRICHOR_EVALUATE_SURFACE_GLSL

#include "formulas/geometry/footprint.h"
#include "formulas/light/layers.h"
#include "formulas/light/second_lobe.h"
#include "formulas/weather/ground_fields.h"
#include "formulas/weather/ground_tone.h"
#include "formulas/weather/land_relief.h"
#include "gpu/passes/surface/beads.glsl"
#include "gpu/passes/surface/cover.glsl"
#include "gpu/passes/surface/holes.glsl"
#include "gpu/passes/surface/instance_look.glsl"
#include "gpu/passes/surface/layer_textures.glsl"
#include "gpu/passes/surface/parallax.glsl"
#ifdef OWN_SURFACES
#include "gpu/passes/surface/own_surfaces.glsl"
#endif

// Its colour and relief vary over the land.
const bool VARIED_GROUND = (BESIDES & BESIDES_WIDE_GROUND) != 0u && GROUND_VARIES != 0u;

// Curvature of the geometry inside a pixel widens the lobe (Tokuyoshi and Kaplanyan 2019).
float widened_by_curvature(float roughness, SurfaceInput at)
{
    const float variance =
        min(frame.specular_aa * (dot(at.normal_dx, at.normal_dx) + dot(at.normal_dy, at.normal_dy)),
            frame.specular_aa_limit);
    const float alpha = roughness * roughness;
    return sqrt(sqrt(saturate(alpha * alpha + variance)));
}

// What steep wide ground has of relief, on it and on what covers it: snow fills half of it.
void bend_over_land(inout vec3 normal, inout vec3 cover_normal, SurfaceInput at, float strength)
{
    const vec3 dx = at.position_dx, dy = at.position_dy;
    const float width_m = sqrt(max(dot(dx, dx), dot(dy, dy)));
    const float flatter = slope_relief(at.position, width_m).flatter;
    const float ribs = land_ribs(at.position, width_m);
    normal = land_normal(normal, flatter, ribs, strength);
    cover_normal = land_normal(cover_normal, flatter, ribs, 0.5 * strength);
}

// The samples of a pixel share its footprint: each may read finer levels.
void share_footprint(inout SurfaceInput at)
{
    const float first = footprint_scale(at.uv_dx.xy, at.uv_dy.xy, frame.samples, float(STRETCH));
    const float second = footprint_scale(at.uv_dx.zw, at.uv_dy.zw, frame.samples, float(STRETCH));
    const vec4 scale = vec4(first, first, second, second);
    at.uv_dx *= scale;
    at.uv_dy *= scale;
}

// What lamps give at vertices, as a white Lambert surface sends it out; with a light map it is part of that.
void add_vertex_light(inout GBufferTexel texel, vec3 lit)
{
    texel.baked = min(texel.baked + lit, vec3(60000.0));
    if (!has(TEXTURE_LIGHT_MAP) && texel.baked_shadow.share == 0.0) texel.baked_sky = kBakedAtVertices;
}

SurfaceData evaluate_surface(SurfaceInput at)
{
    share_footprint(at);
#ifdef OWN_SURFACES
#define ROW(number_, name_) \
    if (OWN == uint(number_)) name_##_input(at);
    OWN_SURFACES(ROW)
#undef ROW
#endif
    if (PARALLAX != PARALLAX_NONE) sink(at);
    read_sets(at);
    const TangentFrame f = tangent_frame(at);
    Cover cover = no_cover(at);
    vec3 mapped = vec3(0.0, 0.0, 1.0);
    if (SURFACE_WEATHER != 0) {
        if (bumps_come_first() && has_mapped_normal()) mapped = mapped_normal(at, f, vec2(0.0));
        if (material.sheltered == 0u) cover = cover_on(at, f, mapped);
    }

    // The dry material. Water only moves where it is read; the rest is apply_weather's, in the light.
    const vec2 shift = cover.refraction;
    SurfaceData data;
    data.opacity = -1.0;
    data.filtered = vec3(1.0);
    const Factors factors = factors_of(at);
    vec3 base = factors.base_color * at.color.rgb;
    float second_occlusion = 1.0;
    if (LAYERED) {
        base = at.ground_color * at.color.rgb;
    } else if (has(TEXTURE_BASE_COLOR)) {
        base *= texel(base_color_texture, coordinates(TEXTURE_BASE_COLOR, at, shift)).rgb;
    }
    if (SECOND != SECOND_NONE && !LAYERED) {
        vec3 other = material.second_color_factor;
        if (has(TEXTURE_SECOND_BASE_COLOR)) {
            const vec4 second = texel(second_base_color_texture,
                                      coordinates(TEXTURE_SECOND_BASE_COLOR, at, shift));
            other *= second.rgb;
            if (material.second_occlusion_in_alpha != 0u) second_occlusion = second.a;
        }
        if (MIXED) base = base * at.shares.x + other * at.color.rgb * at.shares.y;
        if (SECOND == SECOND_DETAIL && has(TEXTURE_SECOND_BASE_COLOR)) {
            base = detail_color(base, other, detail_share(at));
        }
    }
    if (VARIED_GROUND) {
        const vec2 dx = at.position_dx.xz;
        const vec2 dy = at.position_dy.xz;
        const float width_m = sqrt(max(dot(dx, dx), dot(dy, dy)));
        // What grows on land of a control map is told by that.
        const float farmed = LAYERED ? 0.0 : farmed_share(at.position.xz, at.normal.y, base);
        base = meadow_tone(base, frame.look.ground_variation) * ground_tone(at.position.xz, width_m, frame.look.ground_variation);
        if (farmed > 0.0) {
            const Field field = field_at(at.position.xz, width_m, frame.look.ground_variation * farmed);
            base *= field.tone;
            if (SNOW != 0u) cover.snow = snow_beside_hedges(cover.snow, field.hedge);
        }
        if (SNOW != 0u) {
            // Blades that hold none stand dull as those beside.
            const float line_up = snow_height_factor(at.position.y, frame.weather.snow_start_height_m, frame.weather.snow_height_blend_m);
            base = turf_in_winter(base, max(cover.around, 0.1 * saturate(3.0 * frame.weather.snow_amount) * line_up));
        }
    }
#ifdef SURFACE_ALPHA
    data.alpha = surface_alpha(at);
#endif
    data.hole = HOLES != 0u && hole_in(at, alpha_at(at));

    float roughness = factors.roughness;
    float metallic = factors.metallic;
    vec4 packed = vec4(1.0);
    if (has(TEXTURE_METALLIC_ROUGHNESS)) {
        packed = texel(metallic_roughness_texture, coordinates(TEXTURE_METALLIC_ROUGHNESS, at, shift));
        roughness *= packed.g;
        metallic *= packed.b;
    }
    float occlusion = 1.0;
    if (has(TEXTURE_OCCLUSION)) {
        if ((BESIDES & BESIDES_ONE_READ) == 0u) {
            packed = texel(occlusion_texture, coordinates(TEXTURE_OCCLUSION, at, shift));
        }
        occlusion = mix(1.0, dot(packed, material.slots[TEXTURE_OCCLUSION].channel), material.occlusion_strength);
    }
    if (MIXED) {
        vec3 other =
            vec3(1.0, material.second_roughness_factor, material.second_metallic_factor);
        if (has(TEXTURE_SECOND_METALLIC_ROUGHNESS)) {
            other *= texel(second_metallic_roughness_texture,
                           coordinates(TEXTURE_SECOND_METALLIC_ROUGHNESS, at, shift)).rgb;
        }
        if (material.second_occlusion_in_alpha != 0u) other.x = second_occlusion;
        const vec3 both = vec3(occlusion, roughness, metallic) * at.shares.x + other * at.shares.y;
        occlusion = both.x;
        roughness = both.y;
        metallic = both.z;
    }
    if (LAYERED) {
        const vec3 all = matter_of_ground(vec3(occlusion, roughness, metallic), at, shift);
        occlusion = all.x;
        roughness = all.y;
        metallic = all.z;
    }
    occlusion *= mix(1.0, at.color.g, material.vertex_occlusion);
    data.texel.metallic = metallic;
    data.texel.f0 = dielectric_reflectance(at, shift);
    if ((BESIDES & BESIDES_SPECULAR_WORKFLOW) != 0u) specular_workflow(data.texel, roughness, at, shift);
    vec3 normal = at.normal;
    if (has_mapped_normal()) {
        // Seen through water: at another place.
        const bool again = SURFACE_WEATHER == 0 || (WATER != 0u && !is_steep()) || !bumps_come_first();
        normal = normalize(to_world(f, again ? mapped_normal(at, f, shift) : mapped));
    }
    const float land = VARIED_GROUND ? frame.look.ground_variation * land_relief_share(at.normal.y) : 0.0;
    if (land > 0.0) bend_over_land(normal, cover.normal, at, land);
    shed_film(cover, normal);
    data.emission = vec3(0.0);
    if (SURFACE_EMISSION != 0) {
        data.emission = material.emissive_factor * material.emissive_strength;
        if (LOOKS != 0u) data.emission *= factors.emission;
        if (has(TEXTURE_EMISSIVE)) {
            data.emission *= texel(emissive_texture, coordinates(TEXTURE_EMISSIVE, at, shift)).rgb;
        }
    }
    data.texel.baked = vec3(0.0);
    data.texel.baked_sky = 0.0;
    data.texel.baked_shadow = no_baked_shadow();
    data.texel.lamp_mask = vec3(1.0);
    if (SURFACE_BAKED != 0) {
        if (has(TEXTURE_LIGHT_MAP)) {
            const vec3 lux = texel(light_map_texture, coordinates(TEXTURE_LIGHT_MAP, at, vec2(0.0))).rgb;
            data.texel.baked = min(lux * (material.light_map_scale * 0.31830989), vec3(60000.0));
            data.texel.baked_sky = 1.0 - material.light_map_sky;
        }
    }
    // Pores are of the material: what the geometry does to the lobe tells nothing of them.
    const float porosity = material.porosity >= 0.0 ? material.porosity
                                                    : porosity_from_smoothness(1.0 - roughness);
    if (SURFACE_WEATHER != 0 && (WATER & WATER_BEADS) != 0u && material.sheltered == 0u) {
        stand_in_beads(cover, at, porosity);
    }
    data.emission *= frame.emissive_scale;
    data.texel.base_color = base;
    data.texel.occlusion = occlusion;
    data.texel.base_normal = normal;
    data.texel.cover_normal = SURFACE_WEATHER != 0 ? cover.normal : normal;
    if (LAYERED && has_mapped_normal()) roughness = with_lost_slopes(roughness, ground_lost);
    data.texel.roughness = widened_by_curvature(roughness, at);
    data.texel.porosity = porosity;
    data.texel.model = material.lighting_model;
    data.texel.tangent = 0.0;
    if ((BESIDES & BESIDES_ALONG) != 0u) {
        float turn = material.anisotropy_rotation;
        if (has_layer(LAYER_TEXTURE_ANISOTROPY)) {
            const vec2 d = layer_texel(LAYER_TEXTURE_ANISOTROPY, at, shift, 1.0).rg * 2.0 - 1.0;
            turn += dot(d, d) > 1.0e-4 ? atan(d.y, d.x) : 0.0;
        }
        data.texel.tangent =
            tangent_code(normal, f.tangent * cos(turn) + f.bitangent * sin(turn));
    }
    data.texel.body = 1.0;
    if ((BESIDES & BESIDES_IRIDESCENT) != 0u) add_thin_film(data.texel, at, shift);
    if ((BESIDES & BESIDES_FILM_TOLD) != 0u) {
        if ((BESIDES & BESIDES_ALONG) == 0u) data.texel.tangent = film_thickness(at, shift);
        as_reflectance(data.texel);
    }
    if ((BESIDES & BESIDES_SHARES) != 0u) data.shares = layer_shares(at, f, normal, shift);
    if ((BESIDES & BESIDES_SHARES) != 0u && has_layer(LAYER_TEXTURE_SECOND_LOBE)) {
        const SecondLobe lobe = second_lobe_of(layer_texel(LAYER_TEXTURE_SECOND_LOBE, at, shift, 1.0));
        const vec2 slope = lobe.normal.xy * material.normal_scale;
        data.shares.second_normal = normalize(to_world(f, vec3(slope, sqrt(1.0 - saturate(dot(slope, slope))))));
        data.shares.second_roughness = widened_by_curvature(lobe.roughness * factors.roughness, at);
        data.shares.second_share = lobe.share;
    }
    data.texel.weather = vec4(cover.film, cover.water, cover.snow, cover.frost);
    data.texel.deeper_m = cover.deeper_m;
    data.texel.cover_roughness = sqrt(sqrt(min(cover.lost, 1.0)));
    data.texel.material = at.material_id;
    data.texel.snow_smoothness = cover.snow_smoothness;
    data.texel.first_share = at.shares.x;
#ifdef OWN_SURFACES
#define ROW(number_, name_) \
    if (OWN == uint(number_)) name_##_surface(at, data);
    OWN_SURFACES(ROW)
#undef ROW
#endif
    return data;
}

#endif
