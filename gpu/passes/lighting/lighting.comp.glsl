#version 460
// Lights the G-buffer: weather is applied to the dry material here, in one place; then sun, lights from
// the tile's list, the sky, emission, fog. Pixels without a surface are left alone.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#define FRAME_BY_WORDS
#include "gpu/lighting/models_io.h"
#include "formulas/color/srgb.h"
#include "formulas/light/area.h"
#include "formulas/light/bent_normal.h"
#include "formulas/light/grain.h"
#include "formulas/light/ltc.h"
#include "formulas/light/occlusion_points.h"
#include "formulas/light/skin.h"
#include "formulas/light/sun_cookie.h"
#include "formulas/light/weak_shadow.h"
#include "formulas/weather/ice_pattern.h"
#include "formulas/weather/lost_slopes.h"
#include "formulas/weather/run_off.h"
#include "formulas/weather/soaked_walls.h"
#include "formulas/light/fog.h"
#include "formulas/light/mist.h"
#include "formulas/light/spherical_harmonics.h"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/lighting/lighting_io.h"
#define GBUFFER_FIRST_BINDING LIGHTING_GBUFFER
#include "gpu/frame/gbuffer_read.glsl"
#include "gpu/frame/layer_shares.glsl"
#define PIXEL_LIST_BINDING LIGHTING_PIXELS
#include "gpu/frame/pixel_list.glsl"
#include "gpu/frame/occlusion_blocks.glsl"
#include "gpu/passes/lights/lights_io.h"
#include "formulas/light/reflection_probe.h"
#include "gpu/passes/sky/sky_light_io.h"
#include "gpu/upload/material_io.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/apply_weather.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/gusts.h"
#include "formulas/weather/ice_pattern.h"
#include "formulas/weather/snow_glints.h"

#include "gpu/passes/lighting/lighting_places.glsl"

#include "gpu/passes/lighting/lighting_words.glsl"
#include "gpu/frame/picture_pixel.glsl"
#include "gpu/frame/air.glsl"
#include "gpu/frame/sky_quads.glsl"
#include "gpu/passes/lamp_shadows/lamp_shadow.glsl"
#include "gpu/passes/patch_light/patch_spread.glsl"

// Smoother surfaces than this mirror their surroundings, in a pass of its own.
const float kMirrorRoughness = 0.32;

vec3 sky_irradiance(vec3 n)
{
    vec3 e = vec3(0.0);  // divided by pi: what a white Lambert surface sends out
#define BAND(K) e += sky_light.harmonics[K].xyz * harmonic(K, n);
    BAND(0) BAND(1) BAND(2) BAND(3) BAND(4) BAND(5) BAND(6) BAND(7) BAND(8)
#undef BAND
    e += over_sky_axes(n, sky_light.missed[0].xyz, sky_light.missed[1].xyz, sky_light.missed[2].xyz,
                       sky_light.missed[3].xyz, sky_light.missed[4].xyz, sky_light.missed[5].xyz);
    return max(e, vec3(0.0));
}

#include "gpu/frame/geometry_normal.glsl"
#include "gpu/passes/lighting/sun_and_sky_shadow.glsl"

// Scale and offset of F0 for GGX.
vec2 split_sum(vec3 n, vec3 v, float roughness)
{
    if (LAZAROV != 0u) return lazarov_split_sum(clamp(dot(n, v), 0.0, 1.0), roughness);
    const vec2 size = vec2(textureSize(env_brdf, 0));
    const vec2 at = (vec2(clamp(dot(n, v), 0.0, 1.0), roughness) * (size - 1.0) + 0.5) / size;
    return textureLod(env_brdf, at, 0.0).rg;
}

#include "gpu/passes/lighting/model_answers.glsl"
#include "gpu/passes/lighting/two_lobes.glsl"
#include "gpu/passes/lighting/light_rows.glsl"
#include "gpu/passes/lighting/area_lights.glsl"
#include "gpu/passes/lighting/light_groups.glsl"
#include "gpu/passes/lighting/light_parts.glsl"
#include "gpu/passes/lighting/light_loops.glsl"

const bool AT_VERTICES = (BAKED & LIGHTING_BAKED_VERTICES) != 0u;
const bool MAPPED = (BAKED & LIGHTING_BAKED_MAPS) != 0u;

// The answer to light of lamps at vertices, of which it is not known whence it comes: that to light straight on, below
// what covers the surface, without highlights.
//   lit  what a white Lambert surface sends out
vec3 vertex_lit(LitPoint p, vec3 lit)
{
    LitPoint q = matt_part(p, 0.0);
    q.gathers = GATHERS_NOTHING_FIRST;
    q.film.lit = 0.0;
    return filmed_light(q, p.normal) * (kPi * lit);
}

// The surface without what it scatters. Whatever the model: its answer less that of this is scattered.
LitPoint mirroring_part(LitPoint p)
{
    LitPoint q = p;
    q.albedo = vec3(0.0);
    q.diffuse = vec3(0.0);
    q.translucency.strength = 0.0;
    q.lobe.diffuse = vec3(0.0);
    q.layers.through = vec3(0.0);
    // The light through hair takes its colour from there, models of users' own what they scatter.
    if (USES_hair == 0u || p.model != uint(LIGHTING_MODEL_HAIR)) q.base_color = vec3(0.0);
    return q;
}

#include "gpu/passes/lighting/ambient.glsl"
#include "gpu/passes/lighting/gathered_light.glsl"
#include "gpu/passes/lighting/left_by_shadows.glsl"
#include "gpu/passes/lighting/rough_mirror.glsl"
#include "gpu/passes/lighting/ambient_light.glsl"
#include "gpu/passes/lighting/ground_mist.glsl"
#include "gpu/passes/lighting/snow_sparkle.glsl"
#include "gpu/passes/lighting/mirror_list.glsl"

// inside: of the picture; where all stay for each other others come, too
void light_pixel(ivec2 texel, bool inside)
{
    const vec2 pixel = vec2(texel) + 0.5;
    const float depth = texelFetch(depth_rows, row_texel(texel, frame.size)).r;
    const bool there = inside && depth > 0.0;
    vec3 radiance;
    vec4 mirror = vec4(0.0);  // what a smooth surface reflects; alpha: how far water closes over relief
    vec4 shape = vec4(0.0);
    PartsOfLight parts;
    if (PARTS != 0u) parts = no_parts();
    if (TOGETHER || there) {
        GBufferTexel g =
            decode_gbuffer(fetch_gbuffer(row_texel(texel, frame.size), WEATHER, EMISSION != 0u, BAKED != 0u), WEATHER, frame.flags);
        const vec3 position = pixel_position(frame, pixel, depth);
        const vec3 v = -pixel_view_direction(frame, pixel);
        const float view_m = linear_depth(frame, depth);

        DryMaterial dry;
        dry.base_color = g.base_color;
        dry.metallic = g.metallic;
        dry.f0 = g.f0;
        dry.roughness = g.roughness;
        dry.occlusion = g.occlusion;
        dry.porosity = g.porosity;
        dry.water_color = vec4(0.0);
        dry.snow_opacity = 0.0;
        ThinFilm thin = ThinFilm(0.0, 1.0, 0.0, g.f0);
        if ((LAYERS & LAYERS_IRIDESCENT) != 0u && g.model >= LIGHTING_MODEL_COUNT) {
            const int row = int(g.model - LIGHTING_MODEL_COUNT) * LAYERS_TEXELS;
            const vec4 told = texelFetch(layers_table, row + 8);
            float thick = g.tangent;  // of a grain and of hair it is the tangent: shares have it there, or it is the same everywhere
            float covered = 1.0;
            if (SHARES != 0u) {
                const LayerShares share = unpack_shares(texelFetch(layer_shares, texel, 0), kind_of_shares(g.model));
                covered = share.film;
                if (!has_second_lobe(g.model)) thick = share.film_thickness;
            }
            if ((uint(texelFetch(layers_table, row + 9).w) & ROW_FILM_PLACED) != 0u) {
                covered = g.metallic;
                g.metallic = dry.metallic = 0.0;
            }
            thin = ThinFilm(told.x * covered, told.y, mix(told.z, told.w, thick), g.f0);
            // As the eye sees it.
            if (thin.share > 0.0) dry.f0 = filmed_f0(thin, clamp(abs(dot(g.base_normal, v)), 0.02, 1.0));
        }
        if (GAMMA != 0u) {
            dry.base_color = srgb_codes(dry.base_color);
            dry.f0 = srgb_codes(dry.f0);  // 0.04 becomes 0.22
        }
        WeatheredMaterial m = dry_material(dry);
        vec3 n = g.base_normal;
        DryLobe beside = DryLobe(n, 1.0, 0.0);
        if (TWO_LOBES) beside = dry_second_lobe(g.model, texel);
        WaterFilm film = WaterFilm(0.0, 1.0, 0.0, 0.0, n);
        float closed = 0.0;  // share of a flat water surface over the relief
        if (WEATHER != 0u) {
            SurfaceState state;
            state.film = g.weather.x;
            state.water = g.weather.y;
            state.snow = g.weather.z;
            state.frost = g.weather.w;
            state.snow_smoothness = g.snow_smoothness;
            state.deeper_m = GAMMA == 0u ? g.deeper_m : 0.0;  // Lux knows no depth
            state.way = water_way(clamp(v.y, 0.0, 1.0));
            const int look = int(g.material) * MATERIAL_LOOK_TEXELS;
            dry.water_color = texelFetch(material_looks, look);
            if ((frame.flags & FRAME_TWO_SETS) != 0u) {
                dry.water_color =
                    mix(texelFetch(material_looks, look + 2), dry.water_color, g.first_share);
            }
            if (GAMMA != 0u) dry.water_color.rgb = srgb_codes(dry.water_color.rgb);
            dry.snow_opacity = texelFetch(material_looks, look + 1).x;
            if (FILM != 0u) {
                // The film is not mixed into the surface: below it that is as rough as it was.
                WeatherMoment below = frame.weather;
                below.film_smoothness = 0.0;
                WeatherMoment frozen = frame.weather;
                // What of a patch's film is frozen is in its glaze already.
                if (frame.place.grid.levels > 0u) frozen.water_to_snow = frame.place.glazed;
                film = water_film(dry, state, frozen);
                const float wall = state.film > 0.0 ? drinking_wall(g.base_normal.y, dry.porosity * (1.0 - dry.metallic)) : 0.0;
                const vec3 along = along_wall(g.base_normal);
                // Where water runs down, over stone and wood as over plaster; on glass it stands in beads.
                const float runs = film.share > 0.0 ? upright(g.base_normal.y) * saturate(2.0 * frame.weather.rain) *
                                                          smooth_edge(0.15, 0.3, dry.roughness) : 0.0;
                RunOff off;
                off.thick = kRunOffMean;
                off.lean = vec2(0.0);
                if (runs > 0.0)
                    off = run_off(dot(position, along), position.y, frame.time_s, pixel_width_m(frame, view_m));
                if (wall > 0.0) {
                    state.film = mix(state.film, soaked_share(state.film, dot(position, along), position.y), wall);
                    film.share *= film_not_drunk(wall, min(saturate(2.0 * frame.weather.rain) * off.thick / kRunOffMean, 2.0));
                }
                m = apply_weather(dry, state, below, frame.look);
                m = below_film(m, film.share);
                if (TWO_LOBES) {
                    DryMaterial other = dry;
                    other.roughness = beside.roughness;
                    beside.roughness = 1.0 - below_film(apply_weather(other, state, below, frame.look), film.share).smoothness;
                }
                vec3 below_normal = g.base_normal;
                if (TWO_LOBES) below_normal = mix(below_normal, beside.normal, beside.share);
                film.normal = normalize(mix(below_normal, g.cover_normal, film.level) +
                                        (off.lean.x * along + off.lean.y * vec3(0.0, 1.0, 0.0)) * runs);
                const float film_facing = dot(film.normal, v);
                if (film_facing < 0.02) film.normal = normalize(film.normal + v * (0.02 - film_facing));
            } else {
                m = apply_weather(dry, state, frame.weather, frame.look);
                if (TWO_LOBES) {
                    DryMaterial other = dry;
                    other.roughness = beside.roughness;
                    beside.roughness = 1.0 - apply_weather(other, state, frame.weather, frame.look).smoothness;
                }
            }
            closed = closed_water(state);
            // Lux knows the rings that are seen alone.
            const float unseen = GAMMA == 0u ? closed * g.cover_roughness * g.cover_roughness : 0.0;
            m.smoothness = 1.0 - with_lost_slopes(1.0 - m.smoothness, unseen * unseen);
            // Cracks and bubbles, where any of a group is ice.
            const float ice = ICE != 0u ? closed * frame.weather.water_to_snow : 0.0;
            if (ice > 0.0)
                m.albedo = patterned_ice(m.albedo, ice, ice_white(position.xz, v, pixel_width_m(frame, view_m) * inversesqrt(max(v.y, 0.05))));
            n = normalize(mix(n, g.cover_normal, m.normal_mix));
            if (TWO_LOBES) beside.normal = normalize(mix(beside.normal, g.cover_normal, m.normal_mix));
        }
        // A normal map must not turn a visible point away from the eye.
        const float facing = dot(n, v);
        if (facing < 0.02) n = normalize(n + v * (0.02 - facing));
        const vec3 first_normal = n;  // of the lobe, where what is diffuse has another
        if (TWO_LOBES && beside.share > 0.0) {
            beside.normal = toward_eye(beside.normal, v);
            n = normalize(mix(n, beside.normal, beside.share));
        }
        if (SNOW_SCATTER != 0u) m.albedo = snow_scattered(m.albedo, frame.look, dot(n, v), g.weather.z);
        LitPoint p;
        p.position = position;
        p.normal = n;
        p.view = v;
        p.base_color = dry.base_color;
        p.albedo = m.albedo;
        p.diffuse = m.albedo * (1.0 - max(m.specular.r, max(m.specular.g, m.specular.b)));
        p.specular = m.specular;
        p.roughness = clamp(1.0 - m.smoothness, 0.045, 1.0);
        p.emission = g.emission * m.emission_scale;
        p.exposure = sky_light.exposure;
        p.model = g.model;
        p.gathers = GATHERS_NOTHING_FIRST;
        p.layers = Layers(0.0, 0.0, vec3(0.0), 0.0, 0.0, vec3(0.0), 0.0, vec3(0.0), n, 0.0);
        // Snow and standing water cover it; in codes for light it stays as the eye sees it.
        p.thin_film = thin;
        if (GAMMA != 0u) p.thin_film.share = 0.0;
        if (WEATHER != 0u) p.thin_film.share *= (1.0 - g.weather.z) * (1.0 - g.weather.y);
        p.translucency = Translucency(0.0, 1.0, 0.0, 0.0, 0.0, vec3(0.0));
        p.curvature = 0.0;
        p.hair_shift = 0.0;
        p.sunlit = 1.0;
        p.left = 1.0;
        uint ways = 0u;
        if ((WAYS & (LIGHTS_BY_MATERIAL | LIGHTS_UNSHADOWED)) != 0u)
            ways = uint(texelFetch(material_looks, int(g.material) * MATERIAL_LOOK_TEXELS + 3).w);
        p.point_lamps = (ways & LOOK_POINT_LAMPS) != 0u;
        p.unshadowed = (ways & LOOK_UNSHADOWED) != 0u;
        p.film = film;
        p.second = LobeBeside(make_lobe(n, v, vec3(0.0), vec3(0.0), 1.0), 1.0, 0.0);
        if (TWO_LOBES && beside.share > 0.0) {
            p.second.roughness = clamp(beside.roughness, 0.045, 1.0);
            p.second.share = beside.share;
            Lobe second = make_lobe(beside.normal, v, vec3(0.0), m.specular, p.second.roughness * p.second.roughness);
            second.f0 = sent_on_f0(p, m.specular);
            p.second.lobe = with_all_light(second, p.second.roughness, lost_along_lobe(p.second.roughness));
            p.second.lobe.f0 = m.specular;
        }
        vec3 mirror_normal = first_normal;
        // Where both are in the picture only one is compiled: without layers it is the same.
        if (USES_layered != 0u && p.model == uint(LIGHTING_MODEL_STANDARD)) p.model = uint(LIGHTING_MODEL_LAYERED);
        if (LAYERS != 0u && g.model >= LIGHTING_MODEL_COUNT) {
            const int at = int(g.model - LIGHTING_MODEL_COUNT) * LAYERS_TEXELS;
            const vec4 first = texelFetch(layers_table, at);
            p.model = uint(first.x);
            if (USES_layered != 0u && p.model == uint(LIGHTING_MODEL_STANDARD)) p.model = uint(LIGHTING_MODEL_LAYERED);
            // Snow lies over all of it; standing water over fibres.
            const float bare = WEATHER != 0u ? 1.0 - g.weather.z : 1.0;
            const float open = WEATHER != 0u ? bare * (1.0 - g.weather.y) : 1.0;
            LayerShares share = all_shares(n);
            if (SHARES != 0u) {
                share = unpack_shares(texelFetch(layer_shares, texel, 0), kind_of_shares(g.model));
                // Under snow and standing water it is what they cover all with.
                p.layers.other_normal = share.other_normal;
                if (WEATHER != 0u)
                    p.layers.other_normal = normalize(mix(share.other_normal, g.cover_normal, m.normal_mix));
            }
            if ((LAYERS & LAYERS_TRANSMISSION) != 0u) p.layers.transmitted = first.y * bare * g.first_share * share.transmitted;
            if ((LAYERS & LAYERS_COAT) != 0u) {
                p.layers.coat = first.z * bare * share.coat;
                p.layers.coat_roughness = clamp(first.w * share.coat_roughness, 0.045, 1.0);
            }
            if ((LAYERS & LAYERS_SHEEN) != 0u) {
                const vec4 second = texelFetch(layers_table, at + 1);
                p.layers.sheen = second.rgb * share.sheen * open;
                p.layers.sheen_roughness = second.w * share.sheen_roughness;
            }
            if ((LAYERS & LAYERS_LATER) != 0u) later_layers(p, at, share, g.first_share, g.metallic, bare, open, m.emission_scale, view_m, texel);
            if ((LAYERS & LAYERS_TRANSMISSION) != 0u) {
                // The base colour, or one of its own, which is dry; without what is mirrored at the front.
                const vec4 told = texelFetch(layers_table, at + 9);
                vec3 color = told.rgb * share.through;
                if (GAMMA != 0u) color = srgb_codes(color);
                p.layers.through = (uint(told.w) & ROW_THROUGH_OF_BASE) != 0u
                                       ? p.diffuse
                                       : color * ((1.0 - g.metallic) * (1.0 - max(p.specular.r, max(p.specular.g, p.specular.b))));
            }
            if ((LAYERS & (LAYERS_ANISOTROPY | LAYERS_HAIR)) != 0u) {
                // Along the surface as it is seen.
                const vec3 tangent = tangent_at(g.base_normal, g.tangent * kPi);
                const vec3 level = tangent - n * dot(n, tangent);
                const float size = length(level);
                p.layers.tangent = level / max(size, 1.0e-3);
                p.layers.anisotropy =
                    size < 1.0e-3 ? 0.0 : texelFetch(layers_table, at + 2).x * open * share.anisotropy;
                if (p.layers.anisotropy > 0.0) {
                    // What is mirrored is smeared along the tangent.
                    mirror_normal = grain_middle(n, p.layers.tangent, v, p.layers.anisotropy);
                    if (GRAIN != 0u) mirror_normal = grained_mirror(p, mirror_normal, view_m, texel);
                }
            }
        }
        Lobe lobe = make_lobe(first_normal, v, p.diffuse * (1.0 - p.layers.transmitted), m.specular, p.roughness * p.roughness);
        lobe.f0 = sent_on_f0(p, m.specular);
        p.lobe = with_light_along_grain(lobe, p.roughness, p.layers.tangent, p.layers.anisotropy);
        p.lobe.f0 = m.specular;

        p.shaped = shaped_lobes(p);
        if ((SUN != 0u && SHADOWS != 0u) || LAMP_SHADOWS != 0u || BENT_NORMALS)
            p.mesh_normal = geometry_normal(texel, position, depth, g.base_normal);

        if (GATHERS != 0u && model_gathers(p.model)) p.gathers = GATHERS_DIFFUSE;
        const bool composes = GATHERS != 0u && p.gathers != GATHERS_NOTHING_FIRST;
        vec3 direct = vec3(0.0);
        vec3 glints = vec3(0.0);
        const float sun_lit = dot(n, frame.sun_direction);
        bool sunny = false;
        vec3 sunlight = vec3(0.0);
        if (SUN != 0u && (sun_lit > 0.0 || p.layers.transmitted > 0.0 || BLEEDS || TWO_LOBES) &&
            frame.sun_illuminance.g + frame.sun_illuminance.r > 0.0) {
            float visible = 1.0;
            if (SHADOWS != 0u) visible = sun_visibility(position, p.mesh_normal, view_m, texel);
            if (BAKED != 0u) visible = mix(visible, g.baked_shadow.visible, g.baked_shadow.share);
            if ((WAYS & LIGHTS_WEAK_SUN_SHADOW) != 0u) visible = weak_shadow(visible, frame.cascade_scale.w);
            visible = received(visible, p);
            p.sunlit = visible;
            sunny = visible > 0.0 || BLEEDS;
            if (sunny) {
                sunlight = frame.sun_illuminance * sun_cookie(position, view_m);
                direct += shadowed_light(p, frame.sun_direction, visible) * sunlight;
                if (SPARKLE != 0u && g.weather.z > 0.0) {
                    const vec3 crystals = sparkle(p, g.weather.z, view_m) * (sunlight * visible);
                    if (composes) glints = crystals;
                    else direct += crystals;
                }
            }
        }
        // Lamps whose light the map holds are in it.
        if (MASKED) {
            lamp_mask = g.lamp_mask;
            lamp_mask_share = g.baked_shadow.share;
        }
        const float lamps = BAKED != 0u ? 1.0 - g.baked_shadow.share * g.baked_shadow.lamps : 1.0;
        add_lights(direct, p, lamps, there, texel);
        Gathered gathered;
        if (GATHERS != 0u) {
            gathered = gather_rest(p, direct, sunlight, lamps, there, texel);
            if (composes) direct = model_compose(p, gathered.sum) + gathered.rest + glints;
        }
        if (USES_unlit_shadowed != 0u) p.left = left_by_shadows(p, view_m, lamps, there, texel);
        // Occlusion maps tell of the sky; on sun and lamps they are a choice.
        const vec3 own = model_own(p);
        const float direct_open = mix(1.0, m.occlusion, frame.occlusion_direct);
        radiance = own + direct * direct_open;
        if (PARTS != 0u) {
            LitPoint q = mirroring_part(p);
            if (composes) q.gathers = GATHERS_REST;
            vec3 bright = vec3(0.0);
            if (sunny) bright = shadowed_light(q, frame.sun_direction, p.sunlit) * sunlight;
            add_lights(bright, q, lamps, there, texel);
            if (composes) bright += model_compose(q, gathered.sum) + glints;
            parts.of[PART_EMITTED] = own;
            parts.of[PART_SPECULAR_DIRECT] = bright * direct_open;
            parts.of[PART_DIFFUSE_DIRECT] = (direct - bright) * direct_open;
        }
        const bool by_vertex = AT_VERTICES && g.lamps_at_vertices;
        if (AT_VERTICES) {
            const vec3 lamplight = vertex_lit(p, by_vertex ? g.baked : vec3(0.0)) * direct_open;
            radiance += lamplight;
            if (PARTS != 0u) parts.of[PART_DIFFUSE_DIRECT] += lamplight;
        }
        if (MAPPED) {
            // Light of the map comes from all around; the crevices of its own it holds already.
            Surroundings s;
            s.irradiance = by_vertex ? vec3(0.0) : g.baked;
            s.irradiance_behind = vec3(0.0);
            s.occlusion = m.occlusion;
            s.specular_occlusion = 0.0;
            s.split_sum = split_sum(first_normal, v, p.roughness);
            s.scale = 1.0;
            const vec3 baked = model_surround(p, s).radiance;
            radiance += baked;
            if (PARTS != 0u) parts.of[PART_DIFFUSE_INDIRECT] = baked;
        }
        if (IMAGE_BASED_LIGHT != 0u) {
            const float screen =
                AMBIENT_OCCLUSION != 0u ? screen_open(texel) : 1.0;
            const Ambient around = ambient_light(p, g.base_normal, m.occlusion, screen, view_m, texel);
            const vec3 seen = around.mirrored;
            const ProbesHere probed = probes_here(p, around);
            const float sky_open = around.open;
            const float nv = clamp(dot(n, v), 0.0, 1.0);
            Surroundings s;
            s.irradiance = around.irradiance;
            s.occlusion = around.occlusion;
            s.irradiance_behind = p.layers.transmitted > 0.0 ? sky_irradiance(-n) * seen : vec3(0.0);
            if (BAKED != 0u) s.irradiance *= 1.0 - g.baked_sky;
            // A water surface lies above the crevices that its ground has.
            const float mirror_occlusion = mix(BENT_NORMALS ? m.occlusion : m.occlusion * around.screen, 1.0, closed);
            float mean_roughness = p.roughness;
            if (TWO_LOBES) mean_roughness = mix(p.roughness, p.second.roughness, p.second.share);
            // Lagarde and de Rousiers 2014.
            s.specular_occlusion =
                saturate(pow(nv + mirror_occlusion, exp2(-16.0 * mean_roughness - 1.0)) - 1.0 +
                         mirror_occlusion);
            if (BENT_NORMALS)
                s.specular_occlusion *= mix(mirror_left(around.screen, n, normalize(n + around.lean), reflect(-v, n), mean_roughness), 1.0, closed);
            if (HORIZON != 0u) s.specular_occlusion *= horizon_occlusion(p, mirror_normal, texel);
            s.split_sum = split_sum(first_normal, v, p.roughness);
            vec3 of_second = vec3(0.0);  // of what is mirrored
            if (TWO_LOBES && p.second.share > 0.0) {
                const vec2 other = split_sum(p.second.lobe.normal, v, p.second.roughness);
                of_second = share_of_second(p, s.split_sum, other);
                s.split_sum = mix(s.split_sum, other, p.second.share);
            }
            s.scale = frame.ambient_scale;
            Reflected reflected = model_surround(p, s);
            vec3 coat = vec3(0.0);
            if (p.layers.coat > 0.0) {  // it mirrors first, what is left goes on
                const float coat_nv = clamp(dot(p.layers.other_normal, v), 0.0, 1.0);
                const float kept = p.layers.coat * coat_fresnel(coat_nv);
                reflected.radiance *= 1.0 - kept;
                reflected.mirror *= 1.0 - kept;
                coat = vec3(kept * s.specular_occlusion * s.scale);
            }
            vec3 film_mirror = vec3(0.0);
            if (FILM != 0u) {
                const vec2 sum = split_sum(film.normal, v, film.roughness);
                const float kept = film.share * (kWaterF0 * sum.x + sum.y);
                reflected.radiance *= 1.0 - kept;
                reflected.mirror *= 1.0 - kept;
                coat *= 1.0 - kept;
                film_mirror = vec3(kept * s.specular_occlusion * s.scale);
            }
            radiance += reflected.radiance;
            if (PARTS != 0u) parts.of[PART_DIFFUSE_INDIRECT] += reflected.radiance;
            vec3 blurred = vec3(0.0);  // what is mirrored by the maps of the sky alone
            // The pass of reflections takes one lobe: the coat's where there is one, else the stronger.
            const bool coated = p.layers.coat > 0.0 && p.layers.coat_roughness < kMirrorRoughness;
            if (coated) {
                mirror = vec4(coat, closed);
                shape = vec4(octahedral_encode(p.layers.other_normal), p.layers.coat_roughness, sky_open);
            } else if (p.layers.coat > 0.0) {
                blurred = coat * rough_mirror(p, around, probed, p.layers.other_normal, p.layers.coat_roughness);
                radiance += blurred;
            }
            const bool filmed = FILM != 0u && !coated && film.roughness < kMirrorRoughness &&
                                (p.roughness >= kMirrorRoughness || film_mirror.g > reflected.mirror.g);
            if (filmed) {
                mirror = vec4(film_mirror, closed);
                shape = vec4(octahedral_encode(film.normal), film.roughness, sky_open);
            } else if (FILM != 0u) {
                const vec3 over = film_mirror * rough_mirror(p, around, probed, film.normal, film.roughness);
                radiance += over;
                blurred += over;
            }
            const bool first_sharp = p.roughness < kMirrorRoughness;
            const bool sharp = !coated && !filmed && first_sharp;
            if (TWO_LOBES && p.second.share > 0.0) {
                const vec3 second_mirror = reflected.mirror * of_second;
                const vec3 first_mirror = reflected.mirror - second_mirror;
                const vec3 second_normal = p.second.lobe.normal;
                const bool second_sharp = p.second.roughness < kMirrorRoughness;
                const bool traced = !coated && !filmed && (first_sharp || second_sharp);
                vec3 base = vec3(0.0);
                if (!traced || !first_sharp) base += first_mirror * rough_mirror(p, around, probed, mirror_normal, p.roughness);
                if (!traced || !second_sharp) base += second_mirror * rough_mirror(p, around, probed, second_normal, p.second.roughness);
                if (traced) {
                    vec4 lobe = joined_lobe(p, mirror_normal);
                    if (!second_sharp) lobe = vec4(mirror_normal, p.roughness);
                    if (!first_sharp) lobe = vec4(second_normal, p.second.roughness);
                    mirror = vec4(first_sharp && second_sharp ? reflected.mirror : first_sharp ? first_mirror : second_mirror, closed);
                    shape = vec4(octahedral_encode(lobe.xyz), lobe.w, sky_open);
                }
                radiance += base;
                blurred += base;
            } else if (sharp) {
                mirror = vec4(reflected.mirror, closed);
                shape = vec4(octahedral_encode(mirror_normal), p.roughness, sky_open);
            } else {
                const vec3 base = reflected.mirror * rough_mirror(p, around, probed, mirror_normal, p.roughness);
                radiance += base;
                blurred += base;
            }
            if (PARTS != 0u) parts.of[PART_SPECULAR_INDIRECT] = blurred;
        }
        if (FOG != 0u) {
            float kept = air_kept(position);
            if (WEATHER != 0u && frame.mist_per_m > 0.0) kept *= mist_kept(position, g.cover_normal.y, g.weather);
            const vec3 veil = sky_veil(air_level(-v));
            radiance = mix(veil, radiance, kept);
            if (PARTS != 0u) veil_parts(parts, kept, veil);
            mirror.rgb *= kept;
        }
    }
    if (there) {  // else it is the background's
        if (PARTS != 0u) {
            limit_parts(parts, radiance, vec3(60000.0));
            store_parts(parts, texel);
        }
        const vec4 result = vec4(min(radiance, vec3(60000.0)), 1.0);
        if (IMAGE_BASED_LIGHT != 0u) {
            imageStore(radiance_out, texel, result);
            const bool mirrors = mirror.r + mirror.g + mirror.b > 0.0;
            if (mirrors) {  // no other is read
                imageStore(mirror_weight, texel, mirror);
                imageStore(mirror_shape, texel, shape);
            }
            list_mirror(mirrors, texel);
        }
        imageStore(accumulated, texel, frame.sample_index > 0u ? result + imageLoad(accumulated, texel) : result);
    }
}

// A CPU has one invocation a lane for all pixels of a group, where the lights are not too many: constants are read once for them.
void main()
{
    read_frame();
    read_sky_light();
    read_probes();
    uint number = gl_LocalInvocationID.x;
    uint turns = PIXEL_LIST_GROUP / gl_WorkGroupSize.x;
    bool goes_on;
    do {
        ivec2 texel;
        const bool inside = this_pixel(number, frame.size, texel);
        if (TOGETHER) {
            light_pixel(min(texel, frame.size - 1), inside);  // all stay, for each other
        } else if (inside) {
            light_pixel(texel, true);
        }
        number += gl_WorkGroupSize.x;
        goes_on = --turns > 0u && (LISTED != 1u || inside);
    } while (goes_on);
}
