// Calls every shared formula with arguments made from twelve numbers of 0..1, so that one test can
// compare what the device computes with what the CPU computes from the same text.
#ifndef PETRICHOR_FORMULAS_FORMULA_PROBE_H
#define PETRICHOR_FORMULAS_FORMULA_PROBE_H

#include "formulas/codec/half.h"
#include "formulas/codec/octahedral.h"
#include "formulas/codec/shared_exponent.h"
#include "formulas/color/tone_map.h"
#include "formulas/color/white_balance.h"
#include "formulas/geometry/footprint.h"
#include "formulas/geometry/shapes.h"
#include "formulas/light/area.h"
#include "formulas/light/atmosphere.h"
#include "formulas/light/bent_normal.h"
#include "formulas/light/brdf.h"
#include "formulas/light/clouds.h"
#include "formulas/light/cube_map.h"
#include "formulas/light/cube_quads.h"
#include "formulas/light/exposure.h"
#include "formulas/light/fog.h"
#include "formulas/light/lamp_glow.h"
#include "formulas/light/grain.h"
#include "formulas/light/iridescence.h"
#include "formulas/light/layers.h"
#include "formulas/light/light_map.h"
#include "formulas/light/light_profile.h"
#include "formulas/light/ltc.h"
#include "formulas/light/near_light.h"
#include "formulas/light/mist.h"
#include "formulas/light/occlusion_points.h"
#include "formulas/light/other_lobes.h"
#include "formulas/light/patch_cells.h"
#include "formulas/light/rain_clouds.h"
#include "formulas/light/rain_curtains.h"
#include "formulas/light/reflection_probe.h"
#include "formulas/light/seen_lobe.h"
#include "formulas/light/second_lobe.h"
#include "formulas/light/two_lobes.h"
#include "formulas/light/shadow_plane.h"
#include "formulas/light/skin.h"
#include "formulas/light/translucent.h"
#include "formulas/light/vertex_light.h"
#include "formulas/light/water_film.h"
#include "formulas/light/weak_shadow.h"
#include "formulas/light/wet_lens.h"
#include "formulas/light/spherical_harmonics.h"
#include "formulas/weather/apply_weather.h"
#include "formulas/weather/beads.h"
#include "formulas/weather/deep_water.h"
#include "formulas/weather/depth_quads.h"
#include "formulas/weather/falling.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/ground_tone.h"
#include "formulas/weather/gusts.h"
#include "formulas/weather/land_relief.h"
#include "formulas/weather/ice_pattern.h"
#include "formulas/weather/lost_slopes.h"
#include "formulas/weather/mix_sets.h"
#include "formulas/weather/parallax.h"
#include "formulas/weather/drop_births.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/snow_body.h"
#include "formulas/weather/snow_in_turf.h"
#include "formulas/weather/snow_glints.h"
#include "formulas/weather/run_off.h"
#include "formulas/weather/soaked_walls.h"
#include "formulas/weather/surface_weather.h"
#include "formulas/weather/wander.h"
#include "formulas/weather/weather_maps.h"

SHARED_BEGIN

SHARED_CONST int kProbeKinds = 82;

// A table for air_radiance.inc, about as dim as that of a clear sky.
SHARED_FN vec4 again_entry(int index)
{
    return -vec4(3.0f, 2.5f, 2.0f, 1.5f) - splat4(0.1f * float((index * 7) % 13));
}

#include "formulas/light/air_radiance.inc"

SHARED_FN float probe_light_map(vec4 a, vec4 b)
{
    const float fade = light_map_fade(100.0f * a.w, 20.0f, 40.0f);
    const vec3 sides = vec3(b.x, b.y, b.z + 0.1f);
    const vec3 toward = light_map_direction(sides);
    const vec3 near_map = directional_light_map(splat3(1.0f), sides, vec3(toward.y, toward.x, toward.z));
    const vec3 both = dual_light_map(near_map, vec3(a.x, a.y, a.z), fade);
    return both.x + both.y + both.z;
}

SHARED_FN vec3 probe_direction(float u, float v)
{
    const float y = 2.0f * u - 1.0f;
    const float level = sqrt(max(1.0f - y * y, 0.0f));
    return vec3(level * cos(6.2831853f * v), y, level * sin(6.2831853f * v));
}

SHARED_FN MarchedShape probe_shape(int kind, int iterations, float power, vec3 half_m)
{
    MarchedShape s;
    s.kind = kind;
    s.iterations = iterations;
    s.power = power;
    s.half_m = half_m;
    return s;
}

SHARED_FN vec4 probe_material(WeatheredMaterial m)
{
    return vec4(m.albedo.x + m.specular.y, m.smoothness, m.occlusion + m.emission_scale,
                m.normal_mix);
}

SHARED_FN vec4 probe(int kind, vec4 a, vec4 b, vec4 c)
{
    WeatheredMaterial m;
    m.albedo = vec3(a.x, a.y, a.z);
    m.specular = splat3(0.04f + 0.6f * a.w);
    m.smoothness = b.x;
    m.occlusion = b.y;
    m.emission_scale = 1.0f;
    m.normal_mix = 0.0f;
    m.metallic = c.z;
    if (kind == 0) {
        const WaterCover w =
            water_cover_of_mean(vec2(1.5f * a.x, 1.5f * a.y), a.z, a.w, 2.0f * b.x - 1.0f, b.y, 0.3f * b.z);
        return vec4(w.anywhere, w.deep, 0.0f, 0.0f);
    }
    if (kind == 1) {
        const SnowCover s = snow_cover(a.x, a.y, 2.0f * a.z - 1.0f, 2.0f * a.w, b.x, b.y, b.z, b.w, 0.3f * c.x);
        const vec2 across = place_across(300.0f * vec2(a.x, a.y));
        // Within some hundred of its smallest cells: farther out a rounding of the place shows.
        const SlopeRelief slopes = slope_relief(vec3(0.25f * across.x, 40.0f * b.x, 0.25f * across.y), 3.0f * c.y * c.y);
        return vec4(s.snow, s.melt,
                    snow_rests(2.0f * a.z - 1.0f) + mask_of_two(b.y, b.z, b.w) + snow_holds(slopes),
                    snow_mask_blurred(20.0f * c.y, vec2(0.1f + c.z, 2.0f * c.w)) +
                        snow_caught(b.y, slopes));
    }
    if (kind == 2) {
        return vec4(melt_wetness(a.x, a.y, a.z), snow_height_factor(20.0f * a.w, 5.0f, 10.0f * b.x) +
                        snow_line_factor(vec3(90.0f * a.x, 30.0f * a.w, 70.0f * a.y - 20.0f), 5.0f, 10.0f * b.x,
                                         2.0f * b.z),
                    porosity_from_smoothness(b.y), smooth_edge(a.x, b.z, b.w));
    }
    if (kind == 3)
        return probe_material(apply_water(m, vec2(b.z, b.w), c.x, vec4(c.y, c.y, c.y, c.z), c.w));
    if (kind == 4) {
        const vec3 color = splat3(c.x * melting_snow(b.z, c.w));
        return probe_material(apply_snow(m, b.z, color, splat3(0.02f), melting_smoothness(c.y, b.z, c.w), c.z));
    }
    if (kind == 5) return probe_material(apply_frost(m, b.z));
    if (kind == 6) {
        const RippleLayer l = ripple_layer(int(3.999f * a.x), a.y, 10.0f * a.z, 0.5f + a.w);
        return vec4(l.weight, l.offset.x, l.offset.y, l.clock);
    }
    if (kind == 7) {
        const vec2 s = ripple_slope(vec4(a.x, a.y, a.z, a.w), b.x, b.y);
        return vec4(s.x, s.y, 0.0f, 0.0f);
    }
    if (kind == 8) {
        const FlowPhases f = flow_phases(10.0f * a.x, 0.5f + a.y);
        return vec4(f.first, f.second, f.blend, 0.0f);
    }
    if (kind == 9) {
        const float alpha = 0.05f + 0.95f * a.y;
        return vec4(ggx_distribution(a.x, alpha), ggx_visibility(a.x, a.z, alpha),
                    schlick_fresnel(splat3(a.w), b.x).y,
                    light_attenuation(0.2f + 5.0f * b.y, 6.0f * b.z));
    }
    if (kind == 10) {
        const vec3 r =
            shade_direct(probe_direction(a.x, a.y), probe_direction(a.z, a.w),
                         probe_direction(b.x, b.y), splat3(b.z), splat3(0.04f), 0.1f + 0.9f * b.w);
        return vec4(r.x, r.y, r.z, spot_attenuation(c.x, 0.9f, 0.5f * c.y));
    }
    if (kind == 11) {
        const vec2 e = octahedral_encode(probe_direction(a.x, a.y));
        const vec3 d = octahedral_decode(e);
        return vec4(e.x, e.y, d.x, d.z);
    }
    if (kind == 12) {
        const vec3 t = tone_map(vec3(8.0f * a.x, a.y, 0.1f * a.z));
        return vec4(t.x, t.y, t.z, srgb_encode(a.w));
    }
    if (kind == 13) {
        const vec3 t = air_transmittance(2000.0f * a.x, a.y, 1.5f + 8.0f * a.z);
        return vec4(t.x, t.y, t.z, 0.0f);
    }
    if (kind == 16) {
        DryMaterial dry;
        dry.base_color = vec3(a.x, a.y, a.z);
        dry.metallic = a.w;
        dry.f0 = splat3(0.04f);
        dry.roughness = b.x;
        dry.occlusion = b.y;
        dry.porosity = b.z;
        dry.water_color = vec4(0.3f, 0.2f, 0.1f, b.w);
        dry.snow_opacity = 0.5f;
        SurfaceState state;
        state.film = 0.7f;
        state.water = c.x;
        state.snow = c.y;
        state.frost = c.z;
        state.snow_smoothness = 0.4f;
        state.deeper_m = 0.3f * c.x * b.x;
        state.way = water_way(b.y);
        WeatherMoment moment;
        moment.film_albedo = c.w;
        moment.film_smoothness = 0.5f * c.w;
        moment.rain = 0.4f * a.x;
        moment.water_to_snow = a.y;
        moment.melt_exp = b.w;
        WeatherLook look;
        look.snow_color = vec3(0.92f, 0.94f, 0.97f);
        look.snow_specular = splat3(0.02f);
        return probe_material(apply_weather(dry, state, moment, look));
    }
    if (kind == 17) {
        const float ev100 = 40.0f * a.x - 20.0f;
        return vec4(exposure_of_ev100(ev100), ev100_of_luminance(exp2(ev100)), metered_setting(ev100),
                    0.0f);
    }
    if (kind >= 18 && kind <= 20) {
        const vec3 t = display_light(TONE_MAP_AGX + kind - 18,
                                     vec3(8.0f * a.x * a.x, a.y, 0.1f * a.z));
        return vec4(t.x, t.y, t.z, 0.0f);
    }
    if (kind == 21) {
        const vec3 t = white_balanced(vec3(a.x, a.y, a.z), white_balance_gains(1700.0f + 20000.0f * a.w));
        return vec4(t.x, t.y, t.z, planckian_xy(1700.0f + 20000.0f * b.x).y);
    }
    if (kind == 22) {
        const float path = fog_path(500.0f * a.x, 50.0f * a.y, 300.0f * a.z, 20.0f + 200.0f * a.w);
        return vec4(path + fog_path_to_land(-c.y, 50.0f * c.z, 20.0f + 200.0f * c.w) * 1.0e-3f,
                    fog_path_to_sky(b.x, 50.0f * b.y, 20.0f + 200.0f * b.z) * 1.0e-3f,
                    fog_phase(2.0f * b.w - 1.0f), fog_beyond_haze(0.01f * c.x));
    }
    if (kind == 23) {
        const float path = 400.0f * a.x;
        return vec4(fog_kept(FOG_METRES, path, 0.02f * a.y, 0.0f, 1.0f),
                    fog_kept(FOG_EXP2, path, 0.02f * a.y, 0.0f, 1.0f),
                    fog_kept(FOG_LINEAR, path, 1.0f, 100.0f * a.z, 100.0f + 300.0f * a.w),
                    fog_kept(FOG_OFF, path, 1.0f, 0.0f, 1.0f));
    }
    if (kind == 24) {
        const vec3 u = 2.0f * a.w * probe_direction(b.x, b.y);
        const vec3 side = probe_direction(b.z, b.w);
        const vec3 f = rectangle_irradiance(probe_direction(a.x, a.y) * (1.0f + 3.0f * a.z), u,
                                            cross(u, side) * c.x);
        return vec4(f.x, f.y, f.z, sphere_form_factor(c.y, 2.0f * c.z - 1.0f));
    }
    if (kind == 25) {
        const vec2 dx = vec2(a.x, a.y - 0.5f) * 0.1f;
        const vec2 dy = vec2(a.z - 0.5f, a.w) * b.x;
        return vec4(footprint_scale(dx, dy, 1.0f, 8.0f), footprint_scale(dx, dy, 8.0f, 1.0f), footprint_scale(dx, dy, 64.0f, 1.0f),
                    footprint_scale(dx, dy, 8.0f, 8.0f));
    }
    if (kind == 32) {
        const vec3 n = probe_direction(a.x, a.y);
        Layers layers;
        layers.coat = c.x;
        layers.coat_roughness = 0.2f + 0.8f * c.y;
        layers.sheen = vec3(c.z, 0.5f, c.w);
        layers.sheen_roughness = 0.3f + 0.7f * c.w;
        layers.anisotropy = 0.5f * c.z;
        layers.tangent = tangent_at(n, 3.0f * c.x);
        layers.transmitted = 0.5f * c.y;
        layers.other_normal = normalize(n + 0.3f * layers.tangent * c.w);
        layers.coat_spared = 0.5f * b.z;
        const vec3 r = shade_layers(n, probe_direction(a.z, a.w), probe_direction(b.x, b.y),
                                    splat3(b.z), splat3(0.9f * b.z), splat3(0.04f), 0.3f + 0.7f * b.w, layers);
        return vec4(r.x, r.y, r.z, sheen_albedo(a.z, b.w));
    }
    if (kind == 34) {
        const vec3 n = probe_direction(a.x, a.y);
        const vec3 centre = probe_direction(a.z, a.w) * (1.0f + 3.0f * b.x);
        const vec3 half_axis = probe_direction(b.y, b.z) * (0.9f * b.w);
        const Frame3 f = lobe_frame(surface_frame(n, probe_direction(c.x, c.y)),
                                    vec4(1.0f, 0.3f * c.z, -0.2f * c.z, 0.2f + 0.6f * c.w));
        const vec3 tube = outline_irradiance(tube_outline(centre - half_axis, centre + half_axis, 0.1f), f);
        return vec4(tube.x, tube.y, tube.z, cosine_share(tube));
    }
    if (kind == 35) {
        const vec3 n = probe_direction(a.x, a.y);
        const NearestLight at =
            nearest_light(probe_direction(a.z, a.w) * (1.0f + 3.0f * b.x),
                          probe_direction(b.y, b.z) * (0.2f + 0.5f * b.w), 0.1f + 0.4f * c.x, n, c.y);
        const vec3 on = nearest_on_axis(probe_direction(a.z, a.w) * 2.0f, n * c.z);
        return vec4(at.direction.x, at.direction.z, at.energy, on.y);
    }
    if (kind == 36) {
        const vec3 n = probe_direction(a.x, a.y);
        const vec3 v = probe_direction(a.z, a.w);
        const vec3 l = probe_direction(b.x, b.y);
        const float rough = 0.3f + 0.7f * b.w;
        const vec3 lux = shade_lux(n, v, l, splat3(b.z), splat3(0.04f), rough);
        const vec3 hair = shade_hair(n, tangent_at(n, 3.0f * c.x), v, l, splat3(b.z), splat3(c.y), rough,
                                     0.3f * c.z);
        return vec4(shade_lwrp(n, v, l, splat3(b.z), splat3(0.04f), rough * rough).x +
                        shade_burley(n, v, l, splat3(b.z), splat3(0.04f), rough).x,
                    lux.y, hair.z, lazarov_split_sum(c.w, b.w).x + lazarov_split_sum(c.w, b.w).y);
    }
    if (kind == 37) {
        Translucency t;
        t.strength = a.x;
        t.power = 8.0f * a.y;
        t.distortion = a.z;
        t.scale = 8.0f * a.w;
        t.shadow = b.x;
        t.color = splat3(1.0f);
        const vec3 ring = skin_ring(2.0f * b.y - 1.0f, b.z);
        return vec4(light_through(t, probe_direction(b.w, c.x), probe_direction(c.y, c.z),
                                  probe_direction(c.w, a.x)) +
                        shadow_through(t, c.w),
                    ring.x, ring.z, scattered_albedo(splat3(a.x), splat3(a.y), 0.5f * a.z, 10.0f * a.w, b.x).y);
    }
    if (kind == 14) {
        const vec3 d = probe_direction(a.x, a.y);
        const int i = int(8.999f * a.z);
        const float beyond = (b.z - 0.5f) * exp2(40.0f * b.w - 24.0f);  // halves of every kind
        return vec4(harmonic(i, d), cosine_band(i), srgb_from_linear(b.x) + float(half_code(beyond)),
                    linear_from_srgb(b.y));
    }
    if (kind == 26) {
        const uint seed = uint(100.0f * b.x);
        const vec2 uv = vec2(a.x, a.y);
        return vec4(rain_drops(uv, seed).x, snow_relief(uv, seed), snow_preference(uv, seed),
                    snow_gloss(uv, seed));
    }
    if (kind == 27) {
        const float rate = 100.0f * a.x;
        const float low = 4.0f * a.y;
        return vec4(rain_drops_per_m3(rate, low, low + 1.0f) * 1.0e-3f,
                    rain_extinction_per_m(rate, low, low + 1.0f) * 1.0e3f,
                    snow_flakes_per_m3(20.0f * a.z, kDrySnow_kg_m2, 1.0f + a.y, low, low + 1.0f) *
                        1.0e-3f,
                    snow_extinction_per_m(20.0f * a.z, kWetSnow_kg_m2, snow_breakup(10.0f * a.x), low,
                                          low + 1.0f) *
                        1.0e3f);
    }
    if (kind == 28) {
        return vec4(drop_phase(2.0f * a.x - 1.0f), flake_phase(2.0f * a.y - 1.0f),
                    drawn_depth(100.0f * a.z, 0.1f * a.w, 10.0f * b.x),
                    streak_opacity(1000.0f, 0.005f * b.y, 10.0f * b.z, drop_speed_m_s(5.0f * b.y),
                                   0.02f * b.w));
    }
    if (kind == 29) {
        const GlowRay ray =
            glow_ray(0.1f * a.x, 60.0f * a.y - 20.0f, 0.1f + 10.0f * a.z, 100.0f * a.w);
        return vec4(ray.u, glow_tail(ray.u, ray.begin_v), glow_tail(ray.u, ray.end_v),
                    ray.begin + ray.end);
    }
    if (kind == 30) {
        const vec3 from = probe_direction(0.5f + 0.5f * a.x, a.y);
        const float facing = facing_share(probe_direction(a.z, a.w), from);
        const FallShares shares = fall_shares(a.x * a.x);
        return vec4(facing + snow_facing_share(facing), film_share(b.x) + shares.film,
                    flood_share(b.y) + shares.flood, cover_of_share(b.z, 1.5f * b.w));
    }
    if (kind == 31) {
        const vec2 xz = vec2(200.0f * a.x - 100.0f, 200.0f * a.y - 100.0f);
        return vec4(ground_relief_seen(xz, 3.0f * c.x) + ground_relief_blurred(3.0f * c.x) + drifted_cover(3.0f * xz, 0.1f * c.y),
                    level_ground(0.99f + 0.01f * a.z) + ground_tone(7.0f * xz, 300.0f * b.w * b.w, 2.0f * c.y).y,
                    level_share(a.w, b.x) + ground_moisture(3.0f * xz, 40.0f * c.z * c.z) + wide_relief_m(xz, 4.0f * c.w),
                    frost_cover(b.y, b.z, b.w) + probe_material(apply_ice(m, c.x)).x);
    }
    if (kind == 33) {
        const vec3 reach = parallax_reach(probe_direction(a.x, a.y), probe_direction(a.z, a.w), b.x);
        const vec2 p = pixels_along(reach, vec3(b.y, 0.1f, 0.0f), vec3(0.0f, 0.2f, 0.1f + b.z));
        return vec4(p.x, p.y, secant_depth(b.w, c.x, b.w + c.y, c.z), reach.x + reach.z);
    }
    if (kind == 38) {
        const vec3 color = detail_color(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), c.x);
        const vec3 detail = detail_normal(normalize(vec3(a.x - 0.5f, a.y - 0.5f, 1.0f)),
                                          normalize(vec3(b.x - 0.5f, b.y - 0.5f, 1.0f)), c.y);
        const vec4 ground = ground_shares(a, b, c.x);
        return vec4(mix_by_height(a.w, vec2(b.w, c.z)).x + ground.x + 2.0f * ground.y + 3.0f * ground.z,
                    color.x + color.y + color.z, detail.x,
                    detail.y + probe_light_map(a, b));
    }
    if (kind == 39) {
        const SnowCover s =
            snow_cover_of_vertices(a.x, 2.0f * a.y - 1.0f, 2.0f * a.z, a.w, b.x, b.y, 0.2f * b.z);
        WeatherLook look;
        look.snow_scatter_color = splat3(b.z);
        look.snow_scatter_bias = 0.5f * b.w;
        look.snow_scatter_contraction = 1.0f + 9.0f * c.x;
        return vec4(s.snow, s.melt, snow_on_grass(a.x, a.y, a.z, a.w),
                    snow_scattered(splat3(c.y), look, 2.0f * c.z - 1.0f, c.w).x);
    }
    if (kind == 40) {
        ThinFilm thin;
        thin.share = 0.5f + 0.5f * b.w;
        thin.ior = 1.0f + a.x;
        thin.thickness_nm = 200.0f * a.y;
        thin.f0 = vec3(0.9f * b.x, 0.9f * b.y, 0.9f * b.z);
        const vec3 film = filmed_f0(thin, 0.1f + 0.9f * a.z);
        const vec3 fringe = fringe_color(2000.0f * a.w, vec3(0.0f, kPi, 2.0f * kPi));
        return vec4(film.x, film.z, fringe.x, fringe.y + fringe.z);
    }
    if (kind == 41) {
        const vec3 p = 4.0f * vec3(a.x, a.y, a.z) - splat3(2.0f);
        const vec3 low = -vec3(b.x, b.y, b.z) - splat3(0.1f);
        const vec3 high = vec3(b.y, b.z, b.w) + splat3(0.1f);
        const vec3 way = box_projected(p, probe_direction(c.x, c.y), low, high, 0.5f * (low + high));
        const float share = reflection_probe_share(p, low, high, 2.0f * c.z);
        const vec2 blend = reflection_probe_blend(vec3(2.0f, 1.0f + c.w, 1.0f));
        const vec3 rough = rough_mirror_direction(probe_direction(b.x, b.y), probe_direction(c.x, c.y), a.w);
        const uint band_word = probe_band_word(2.0f * vec2(a.x, c.z) - splat2(1.0f));
        const vec2 bands = probe_bands_of_word(band_word) * (1.0f / kProbeBandOne);
        const vec3 over = probe_direction(b.x, b.y), mirrored = probe_direction(c.x, c.y);
        const SeenLobe seen = seen_lobe(over, dot(over, mirrored) < 0.0f ? -mirrored : mirrored, a.w);
        return vec4(way.x + way.y + seen.direction.x, way.z + rough.x + seen.direction.z + seen.roughness, reflection_probe_weight(share, 1.0f + a.w, p) + bands.x,
                    blend.y + ggx_band(int(8.999f * b.z), c.w) + bands.y);
    }
    if (kind == 43) {
        const vec3 n = probe_direction(a.x, a.y);
        vec3 v = probe_direction(b.x, b.y);
        v = normalize(v + n * (0.05f + abs(dot(n, v)) - dot(n, v)));  // the surface is seen
        const vec3 h = grain_normal(n, tangent_at(n, 6.0f * a.z), v,
                                    seen_slope(vec2(b.z, b.x), grain_alpha(0.1f + 0.8f * b.w, c.x), vec2(b.x - 0.5f, 0.1f + b.y)));
        const vec3 middle = grain_middle(n, tangent_at(n, 6.0f * a.z), v, c.x);
        return vec4(h.x + middle.x, h.y + middle.y, h.z + middle.z, grain_share(vec3(1.0f, 50.0f * c.y, 20.0f * c.z), 40.0f * c.w));
    }
    if (kind == 42) {
        DryMaterial dry;
        dry.roughness = a.x;
        dry.porosity = a.y;
        dry.metallic = a.z;
        SurfaceState state;
        state.film = a.w;
        state.water = 0.5f * b.x;
        state.snow = 0.5f * b.y;
        state.frost = 0.5f * b.z;
        WeatherMoment moment;
        moment.film_smoothness = 0.5f * b.w;
        moment.rain = c.x;
        moment.water_to_snow = c.y;
        WaterFilm film = water_film(dry, state, moment);
        film.normal = probe_direction(c.x, c.y);
        film.roughness = 0.2f + 0.8f * film.roughness;
        const vec3 r = under_film(splat3(c.z), film, probe_direction(a.x, a.y), probe_direction(b.x, c.w));
        m.metallic = 0.0f;
        return vec4(r.x, film.share, film.level + film.roughness, below_film(m, c.w).specular.x);
    }
    if (kind == 45) {
        const LensDrop drop = lens_drops(vec2(a.x, a.y) - splat2(0.5f), a.z, 30.0f * a.w);
        const float inside = step(0.999f, drop.cover);
        return vec4(drop.shift.x * inside, drop.shift.y * inside, drop.bright * inside, inside);
    }
    if (kind == 46) {
        const int texel = int(min(a.x * 256.0f, 255.0f));
        return visibility_subsample(texel, int(min(a.y * 16.0f, 15.0f)));
    }
    if (kind == 47) {
        const vec3 sum = over_sky_axes(probe_direction(a.x, a.y), splat3(a.z), splat3(a.w), splat3(b.x), splat3(b.y),
                                       splat3(b.z), splat3(b.w));
        return vec4(sum.x, sky_axis(int(min(c.x * 6.0f, 5.0f))));
    }
    if (kind == 50) {
        const float radius = spot_radius_px(20.0f * a.x, 5.0f * a.y);
        const float half_way = 40.0f * a.z * a.z * a.z;
        return vec4(radius, spot_opacity(20.0f * a.x, radius),
                    streak_cover((2.0f * b.x - 1.0f) * (half_way + radius), (2.0f * b.y - 1.0f) * radius,
                                 half_way, radius),
                    snow_breakup(15.0f * b.z));
    }
    if (kind == 51) {
        const vec3 n = probe_direction(a.x, a.y);
        const vec3 u = (0.01f + a.z) * probe_direction(b.x, b.y);
        const vec3 side = probe_direction(b.x + 0.25f, 0.5f);
        const vec3 v = 0.05f * normalize(cross(u, side));
        const vec3 depth = (0.001f + a.w) * normalize(cross(v, u));
        const vec2 slope = shadow_plane_slope(n, u, v, depth) / (0.001f + a.w);
        const vec2 lamp = lamp_plane_slope(n, vec3(b.z, b.w, 1.0f), vec2(n.x, n.y));
        const vec4 stored = vec4(step(0.5f, c.x), 0.9f, 0.1f, step(0.3f, c.y));
        const float lit = four_texels_lit(splat4(0.5f), stored, four_texel_weights(vec2(c.z, c.w)));
        return vec4(0.01f * slope.x, 0.01f * slope.y, 0.1f * (lamp.x + lamp.y), lit + 0.01f * shadow_lift_texels(n.y, 1.0f, 2.5f));
    }
    if (kind == 52) {
        const vec3 from = 60.0f * vec3(a.x, 0.1f * a.y, a.z);
        const float veil = gust_veil(from, from + 40.0f * vec3(b.x - 0.5f, 0.1f * b.y, b.z - 0.5f),
                                     kGustPeriod_m * vec2(c.x, c.y), a.w);
        const WaterCover pond = pond_cover(0.05f * b.w - 0.005f, 0.03f * a.y);
        const WaterCover marsh = marsh_cover(0.2f * b.w - 0.02f, 0.05f * a.y);
        return vec4(veil, gust_strength(10.0f * c.z, 2.0f * c.w), pond.anywhere + marsh.anywhere, pond.deep + marsh.deep);
    }
    if (kind == 53) {
        // At the middles of cells and of what one serves: elsewhere the last bit chooses another.
        const vec2 at = floor(20.0f * vec2(a.x, a.y)) + vec2(0.3f + 0.4f * a.z, 0.5f);
        const vec2 lean = floor(20.0f * vec2(b.x, b.y)) + splat2(0.5f);
        const uint level = uint(min(b.z * 7.0f, 6.0f));
        return vec4(glints_of_level(at - splat2(0.37f * float(level)), lean, 10.0f * c.x * c.x, level),
                    glint_hill(vec2(c.y, c.z)), 0.0f, 0.0f);
    }
    if (kind == 54) {
        // A parallelogram near the point, above the horizon, across it or below; from its front and from behind.
        const vec3 corner = 2.0f * vec3(a.x, a.y, a.z) - splat3(1.0f);
        const vec3 u = probe_direction(b.x, b.y);
        const vec3 v = probe_direction(b.z, b.w);
        const vec3 n = probe_direction(c.x, c.y);
        const float open = open_beyond(c.z, c.w);
        return vec4(near_form_factor(corner, corner + u, corner + u + v, corner + v, n),
                    near_form_factor(corner, corner + v, corner + u + v, corner + u, n), open,
                    with_close_light(open, a.w));
    }
    if (kind == 55) {
        // Within cells: at their borders the last bit chooses another.
        const vec2 at = 0.034f * (floor(40.0f * vec2(a.x, a.y)) + splat2(0.5f));
        const float over = 0.05f * (b.y - 0.5f);
        const SnowBody body = snow_body_at(0.07f * a.z, over, at, a.w);
        const vec2 slope = thaw_slope(body.slope, 0.1f * c.x, a.w);
        return vec4(body.share + body.wets, snow_body_code(0.07f * b.x) + slope.x,
                    settled_snow_m(0.07f * a.z, over) + slope.y, slush_share(0.07f * a.z, b.y, body.ragged, at, a.w));
    }
    if (kind == 56) {
        const vec2 st = 2.0f * vec2(a.y, a.z) - splat2(1.0f);
        const vec3 d = cube_direction(int(min(a.x * 6.0f, 5.0f)), st);
        return vec4(d.x, d.y, d.z, cube_texel_weight(st));
    }
    if (kind == 59) {
        OcclusionPoint p;
        p.depth = 0.1f + a.z;
        p.open = floor(255.0f * a.w) / 255.0f;
        p.slope = vec2(occlusion_slope_of(192u + uint(16000.0f * a.x)), occlusion_slope_of(192u + uint(16000.0f * a.y)));
        p.alone = uint(15.9f * b.x);
        const OcclusionPoint q = occlusion_point_of(occlusion_point_code(p));
        const float off = occlusion_off_plane(q, vec2(2.0f * b.y, -2.0f * b.z), q.depth + 0.001f * b.w, 0.002f);
        const uint pixel = uint(3.9f * c.x);
        const float spread = occlusion_from(q.open, vec2(c.y, c.z), vec2(c.z, a.x), vec2(c.w, a.y));
        return vec4(spread, occlusion_fit(off) + float(q.alone), 0.01f * (q.slope.x + q.slope.y),
                    occlusion_of_word(occlusion_in_word(q.open, pixel), pixel));
    }
    if (kind == 44) {
        const vec3 n = probe_direction(a.x, a.y);
        const vec3 at = 0.05f * vec3(b.x, b.y, b.z);
        const Beads beads = beads_on(at, n, a.z, a.w, 0.003f * b.w, 10.0f * c.x);
        const vec3 up = bead_normal(beads, n);
        // Inside a bead; its rim is a step of the whole cover where the last bit decides.
        const float inside = step(0.999f, beads.cover);
        return vec4(up.x * inside, up.y * inside, beads.wiped, bead_seen(0.005f, 0.003f * b.w) + beading_share(c.y, c.z));
    }
    if (kind == 49) {
        const vec2 bend = cloud_bend(20.0f * vec2(a.x, a.y));
        return vec4(cloud_field(20.0f * vec2(b.x, b.y), 0.5f * a.z, 1 + int(min(a.w * 7.0f, 6.0f))),
                    cloud_threshold(b.z), bend.x, bend.y);
    }
    if (kind == 48) {
        const int row = int(min(a.z * float(kAgainHeights), float(kAgainHeights - 1)));
        return scattered_again(70000.0f * a.x * a.x, 1.4f * a.y - 0.4f) +
               vec4(again_height(row) / kAgainTop, again_sun_up(row), 0.0f, 0.0f);
    }
    if (kind == 57) {
        const vec3 p = 3.0f * vec3(a.x, a.y, a.z) - splat3(1.5f);
        // Farther than where the orbits of neighbours part.
        const vec3 q = probe_direction(b.x, b.y) * (1.45f + b.z);
        const MarchedShape ring = probe_shape(SHAPE_TORUS, 0, 0.0f, vec3(1.0f + a.w, a.w, 1.0f + a.w));
        return vec4(sierpinski_distance(p, 4.0f * c.x), menger_distance(p, 3.0f * c.y),
                    mandelbulb_distance(q, 3.0f + 9.0f * b.w, 3), shape_distance(ring, p, 0.0f));
    }
    if (kind == 58) {
        // Rays from around to a point within: where they meet a ball, a box of this size; and its normal.
        const vec3 from = 3.0f * probe_direction(a.x, a.y);
        const vec3 along = normalize(1.1f * probe_direction(b.x, b.y) * b.z - from);
        const vec3 size = splat3(0.3f) + 0.7f * vec3(c.x, c.y, c.z);
        const vec2 ends = through_box(from, along, size);
        const MarchedShape ball = probe_shape(SHAPE_SPHERE, 0, 0.0f, splat3(1.0f));
        // Whether a ray that nearly touches it meets it, the last bit decides.
        const float aside = length(cross(from, along));
        const float met = abs(aside - 1.0f) > 0.05f ? shape_met(ball, from, along, 0.0f, 9.0f, vec2(0.001f, 0.001f)) : 0.0f;
        const vec3 n = shape_normal(ball, from, 0.5f);
        const MarchedShape sponge = probe_shape(SHAPE_MENGER, 2, 0.0f, splat3(1.0f));
        const float open = shape_open(sponge, from * 0.3f, n, 0.01f);
        return vec4(min(abs(ends.x), 9.0f), min(abs(ends.y), 9.0f), met, n.x + 2.0f * n.y + open);
    }
    if (kind == 60) {
        const CubePlace place = cube_place(probe_direction(a.x, a.y));
        const CubePlace beside = cube_beside(int(5.999f * a.z), ivec2(-1, int(15.999f * a.w)), 16);
        const vec3 light = light_of_word(light_word(900.0f * b.w * b.w * vec3(b.x, b.y, b.z)), c.x);
        const int quad = cube_quad(cube_quads_begin(1 + int(5.0f * c.y)), 1 << (1 + int(5.0f * c.y)), place.face, ivec2(1, 2));
        return vec4(float(place.face) + 0.25f * place.st.x, place.st.y + float(quad),
                    float(beside.face) + 0.25f * beside.st.x + 0.0625f * beside.st.y, light.x + 2.0f * light.y + 3.0f * light.z);
    }
    if (kind == 61) {
        const uvec2 quad = depth_quad(a);
        const vec2 circle = on_circle(c.x);
        return vec4(float(int(quad.x & 65535u)) + circle.x, float(int(quad.y >> 16u)) + circle.y,
                    share_passed(quad, b.x, vec2(b.y, b.z)), share_passed(quad, a.z, vec2(b.y, b.z)));
    }
    if (kind == 62) {
        const SecondLobe lobe = second_lobe_of(vec4(0.2f + 0.6f * a.x, 0.2f + 0.6f * a.y, a.z, a.w));
        const vec3 mean = diffuse_normal(probe_direction(b.x, b.y), lobe);
        const vec3 shine = shine_of_both(splat3(b.z), vec3(c.x, c.y, c.z), lobe);
        return vec4(mean.x + 2.0f * mean.y + 3.0f * mean.z, lobe.normal.x + 2.0f * lobe.normal.z, lobe.roughness + lobe.share,
                    shine.x + shine.y + shine.z);
    }
    if (kind == 63) {
        const vec3 v = probe_direction(a.x, a.y);
        const vec3 l = probe_direction(a.z, a.w);
        const vec3 n = normalize(v + l + splat3(0.3f));
        const Lobe first = make_lobe(n, v, vec3(b.x, b.y, b.z), splat3(0.04f + 0.9f * c.x), 0.05f + 0.9f * c.y);
        const Lobe second = make_lobe(normalize(n + 0.3f * v), v, splat3(0.0f), first.f0, 0.05f + 0.9f * c.z);
        const vec3 lit = shade_two_lobes(first, second, c.w, normalize(n + 0.1f * l), l);
        return vec4(lit.x, lit.y, lit.z, joined_roughness(a.x, a.y, c.w));
    }
    if (kind == 64) {
        const vec3 at = probe_direction(a.x, 0.02f + 0.96f * a.y);
        const vec2 photometry = photometry_place(vec3(at.z, at.x, at.y));  // no turn of a whole round
        const vec2 cookie = cookie_place(normalize(vec3(b.x - 0.5f, b.y - 0.5f, 0.5f)), 0.1f + 0.8f * a.z);
        const vec2 lantern = lantern_place(at);
        const float seen = lantern_seen(vec2(c.x, 0.1f + 0.2f * c.y), at, 0.6f * c.z);
        const vec3 looks = spline_looks(c.w);
        return vec4((photometry.x + cookie.x) * 0.01f, (photometry.y + cookie.y) * 0.01f, (lantern.x + lantern.y) * 0.01f, seen + looks.x + 2.0f * looks.y + looks.z);
    }
    if (kind == 65) {
        const vec3 at = vec3(60.0f * a.x - 30.0f, 40.0f * a.y, 60.0f * a.z - 30.0f);
        const float width_m = 4.0f * b.w * b.w;
        const SlopeRelief relief = with_gullies(slope_relief(at, width_m), at, width_m, 2.0f * a.w);
        const float ribs = land_ribs(at, width_m);
        const vec3 n = land_normal(probe_direction(b.x, b.y), relief.flatter, ribs, land_relief_share(b.z));
        return vec4(0.3f * n.x + 0.6f * n.y + n.z, ribs, 3.0f + relief.flatter, relief.lost);
    }
    if (kind == 66) {
        const float wall = drinking_wall(2.0f * a.x - 1.0f, a.y);
        return vec4(wall, film_not_drunk(wall, a.z), soaked_share(b.x, 30.0f * b.y - 15.0f, 12.0f * b.z), soaked_share(c.x, c.y, c.z));
    }
    if (kind == 67) {
        const CloudMet met = cloud_met(20.0f * vec2(a.x, a.y), 3.0f * vec2(a.z, a.w), 0.3f * b.x, 0.5f + 0.3f * b.y, 1 + int(5.999f * b.z));
        return vec4(met.above, met.above > 0.001f ? met.up : 0.0f, cloud_lumps(20.0f * vec2(c.x, c.y), 2.0f * c.z, 0.1f * c.w),
                    cloud_tall(b.w) + cloud_rise(c.w));
    }
    if (kind == 68) {
        const vec2 aside = wander(vec2(4.0f * a.x - 2.0f, 4.0f * a.y - 2.0f));
        const vec2 arch = arches(vec2(a.z, a.w));
        return vec4(2.0f + aside.x, 2.0f + aside.y, 2.0f + arch.x, 2.0f + arch.y);
    }
    if (kind == 69) {
        const vec3 up = normalize(vec3(2.0f * a.x - 1.0f, 0.4f + a.y, 2.0f * a.z - 1.0f));
        const vec2 drift_m = 400.0f * vec2(b.x, b.y);
        return vec4(layer_relief_wide(up, drift_m, 0.004f + 0.1f * b.w, b.z), 1.0f + rags_hide(up, drift_m, 0.02f * c.x, b.z),
                    layer_relief(c.y, c.z, b.z) + layer_heavy(c.y, c.z, 12.0f * c.w, b.z), fog_from_above(2.0f * a.y - 1.0f, a.w));
    }
    if (kind == 70) {
        const vec3 low = normalize(vec3(2.0f * a.x - 1.0f, 0.8f * a.y, 2.0f * a.z - 1.0f));
        const vec2 rains = rain_curtains(low, 400.0f * vec2(b.x, b.y), 2.0f * vec2(c.x, c.y) - splat2(1.0f), b.z);
        return vec4(rains.x, 1.0f + rains.y, 1.0f + curtain_cell(20.0f * vec2(a.x, c.z), a.w, 1.0f + 6.0f * c.y, 350u), fog_before_clouds(b.w, c.w));
    }
    if (kind == 71) {
        const RunOff off = run_off(40.0f * a.x - 20.0f, 12.0f * a.y - 2.0f, 30.0f * a.z, 0.04f * a.w * a.w);
        const vec3 along = along_wall(vec3(b.x - 0.5f, b.y, b.z - 0.5f));
        return vec4(1.0f + off.thick, 2.0f + off.lean.x, 2.0f + off.lean.y, upright(2.0f * b.w - 1.0f) + along.x + 2.0f * along.z);
    }
    if (kind == 72) {
        const vec3 to_lamp = (0.2f + 6.0f * a.z) * probe_direction(a.x, a.y);
        const float outer = c.w < 0.3f ? -2.0f : 0.1f + 0.4f * c.z;
        const float falloff = vertex_falloff(to_lamp, 1.0f + 6.0f * a.w, probe_direction(b.x, b.y), 0.55f + 0.4f * b.z, outer);
        const LitSides lit = lit_sides(probe_direction(c.x, c.y), to_lamp, splat3(1.0f));
        const vec3 kept = shared_exponent_value(shared_exponent_code(1000.0f * c.x * vec3(a.x, 0.1f * a.y, a.z * a.z)));
        return vec4(falloff, lit.front.x - lit.back.y, kept.x + kept.y, kept.z);
    }
    if (kind == 73) return vec4(weak_shadow(a.x, b.x), weak_shadow(a.y, 1.0f), weak_shadow(a.z, 0.0f), weak_shadow(0.0f, b.y));
    if (kind == 74) {
        const float white = ice_white(vec2(2.0f * a.x - 1.0f, 2.0f * a.y - 1.0f), probe_direction(b.x, 0.5f + 0.5f * b.y), 0.05f * a.z * a.z);
        const vec3 albedo = patterned_ice(vec3(a.x, a.y, a.z), b.z, b.w);
        return vec4(1.0f + white, albedo.x, albedo.y, albedo.z);
    }
    if (kind == 75) {
        const float wisps = mist_wisps(vec2(2.0f * a.x - 1.0f, 2.0f * a.y - 1.0f), vec2(a.z, a.w), b.x);
        const float depth = mist_depth(b.y, vec3(0.0f, 1.7f, 0.0f), vec3(8.0f * b.z, b.w, 3.0f), 0.5f * c.x);
        return vec4(1.0f + wisps, depth, 1.0f + mist_extinction_per_m(280.0f + 40.0f * c.y, 280.0f + 20.0f * c.z, c.w, a.x), 0.0f);
    }
    if (kind == 76) {
        const vec3 v = probe_direction(a.x, 0.02f + 0.96f * a.y);
        const vec3 n = normalize(v + probe_direction(a.z, a.w));
        const float rough = 0.2f + 0.8f * b.w;
        const Lobe lobe = with_light_along_grain(make_lobe(n, v, splat3(0.1f), vec3(b.x, b.y, b.z), rough * rough), rough,
                                                 frame_tangent(n), 2.0f * c.w - 1.0f);
        const vec3 lit = shade_lobe(lobe, normalize(2.0f * n + probe_direction(c.x, c.y) - v));
        return vec4(lit.x, lit.y, lit.z, lost_at(facet_loss(0.05f + 0.95f * c.z), c.w) + lost_in_all(c.z));
    }
    if (kind == 77) {
        const vec3 passes = standing_water_passes(c.x, 0.5f * a.x, water_way(a.y), 8.0f * c.y) + bottomless_water(2.0f * c.z);
        return vec4(passes.x, passes.y, passes.z, murk_hides(a.z, 0.2f * a.w, water_way(b.x)) + water_depth_of(water_depth_code(b.y)));
    }
    if (kind == 78) {
        const vec3 n = normalize(vec3(a.x - 0.5f, a.y - 0.5f, 0.2f + a.z));
        const float lost = lost_slopes(0.5f * b.x + slope_2(n) * b.y, n);
        return vec4(1.0f + slope_2(n), 1.0f + lost, with_lost_slopes(0.1f + 0.9f * b.z, lost), 0.0f);
    }
    if (kind == 79) {
        const int layer = int(3.999f * a.z);
        const ivec2 cell = ivec2(int(60.0f * a.x) - 30, int(60.0f * a.y) - 30);
        const RingBirth birth = ring_birth(cell, layer, 20.0f * a.w, 0.5f + b.x);
        return vec4(birth.place.x, birth.place.y, 1.0f + birth.turn + birth.age,
                    ring_chance(cell, layer, floor(40.0f * b.y), uint(1000.0f * b.z)) + ring_births_per_m2_s(layer, 0.5f + b.w, c.x));
    }
    if (kind == 80) {
        const SnowCover thin = with_snow_in_turf(snow_cover(a.x, 1.0f, a.y, 0.75f, 1.0f, a.z, a.w, b.x, 0.0f),
                                                 snow_in_turf(b.y * turf_holds(b.z), b.w, 4.0f * c.x - 2.0f));
        const GroundGrowth growth = ground_growth(200.0f * vec2(c.y, c.z), 30.0f * c.w * c.w);
        return vec4(thin.snow, thin.melt, 2.0f + growth.moist, 2.0f + growth.other);
    }
    if (kind == 81) {
        const vec3 n = probe_direction(a.x, a.y);
        const vec2 side = bent_side(2.0f * a.z - 1.0f, cos(1.5f * a.w), sin(1.5f * a.w));
        const vec3 bent = bent_normal(n, b.x * probe_direction(b.y, b.z), b.w);
        const float left = mirror_left(0.02f + 0.96f * c.x, n, bent, probe_direction(c.y, c.z), 0.1f + 0.9f * c.w);
        // Of a fixed direction: at a threshold codes of one that was worked out may differ by a step.
        const vec3 kept = bent_of_code(bent_code(vec3(0.6f, 0.64f, 0.48f)));
        return vec4(1.0f + side.x + side.y, 2.0f + bent.x + 0.5f * bent.y, 1.0f + left, kept.x + kept.y + kept.z);
    }
    const vec3 r = air_radiance(a.x, a.y, 2.0f * a.z - 1.0f, splat3(1.0f), 1.5f + 8.0f * a.w);
    return vec4(r.x, r.y, r.z, 0.0f);
}

SHARED_END

#endif
