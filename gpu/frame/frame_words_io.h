// The members of FrameConstants in their order, so that a shader can read them word by word (lane_words.glsl).
#ifndef PETRICHOR_GPU_FRAME_FRAME_WORDS_IO_H
#define PETRICHOR_GPU_FRAME_FRAME_WORDS_IO_H

#include "gpu/frame/frame_io.h"

#define FRAME_WORD_COUNT 240  // behind them FrameArrays begins, with its falls
#define FRAME_FALL_WORDS 19
#define FRAME_SPEC_LANES 255  // of a CPU's subgroup, FrameTargets::lanes; 0: constants are read as they are
// X(type, member)
#define FRAME_MEMBERS(X) \
    X(mat4, world_to_clip) X(mat4, shelter_from_world) X(vec3, camera_m) X(float, time_s)                    \
    X(vec3, ray_corner) X(vec3, ray_dx) X(float, near_m) X(vec3, ray_dy) X(float, far_m) X(vec3, forward)    \
    X(uint, sample_index) X(vec3, origin_corner) X(float, pixel_angle) X(vec3, sun_direction)                \
    X(float, shadow_texel_m) X(vec3, sun_illuminance) X(vec3, cookie_right) X(vec3, cookie_down)             \
    X(int, cookie_texel) X(float, cookie_texel_m) X(vec4, cascade_end_m) X(vec4, cascade_scale)              \
    X(vec3, moon_direction) X(vec3, moon_radiance) X(vec3, moon_lit_from) X(vec3, stars_x) X(vec3, stars_y)  \
    X(vec3, stars_z) X(float, weather.rain) X(float, weather.snowfall) X(float, weather.flood_cracks)        \
    X(float, weather.flood_puddles) X(float, weather.film_albedo) X(float, weather.film_smoothness)          \
    X(float, weather.snow_amount) X(float, weather.water_to_snow) X(float, weather.freeze_exp)               \
    X(float, weather.melt) X(float, weather.melt_exp) X(float, weather.frost)                                \
    X(float, weather.snow_start_height_m) X(float, weather.snow_height_blend_m)                              \
    X(float, weather.air_temperature_k) X(float, weather.surface_temperature_k)                              \
    X(float, weather.rain_kg_m2_s) X(float, weather.snowfall_kg_m2_s) X(float, weather.snow_fraction)        \
    X(float, weather.film_mm) X(float, weather.crack_water_depth_m) X(float, weather.puddle_depth_m)         \
    X(float, weather.ice_kg_m2) X(float, weather.snow_depth_m) X(float, weather.swe_kg_m2)                   \
    X(float, weather.snow_liquid_fraction) X(float, weather.snow_temperature_k)                              \
    X(float, weather.snow_albedo) X(vec2, weather.wind_m_s) X(float, weather.relative_humidity)              \
    X(float, weather.pressure_pa) X(float, weather.visibility_m) X(float, weather.cloud_fraction)            \
    X(float, weather.direct_normal_w_m2) X(float, weather.diffuse_horizontal_w_m2)                           \
    X(float, weather.longwave_down_w_m2) X(vec3, look.snow_color) X(vec3, look.snow_specular)                \
    X(vec4, look.snow_tiling) X(vec2, look.snow_strength) X(vec3, look.snow_scatter_color)                   \
    X(float, look.snow_scatter_bias) X(float, look.snow_scatter_contraction) X(float, look.snow_line_ragged) \
    X(float, look.snow_sparkle) X(float, look.ground_variation) X(float, look.water_mud) X(float, look.ripple_tiling) \
    X(float, look.ripple_speed) X(float, look.ripple_refraction) X(float, look.ripple_strength)              \
    X(float, look.detail_distance_m) X(float, look.detail_fade_m) X(ivec2, size) X(ivec2, light_tiles)       \
    X(ivec2, coarse_tiles) X(uint, light_count) X(uint, light_words) X(uint, directional_count)              \
    X(uint, shaped_shadows) X(uint, plain_lights) X(uint, shaped_lights) X(float, ao_radius_m)               \
    X(float, ao_strength) X(float, ambient_scale) X(float, sky_scale) X(vec4, land) X(float, fog_per_m)      \
    X(int, fog_mode) X(float, fog_start_m) X(float, fog_end_m) X(float, fog_height_m) X(float, fog_base_m)   \
    X(float, mist_per_m) X(vec2, mist_air_m)                                                                 \
    X(float, drawn_per_m) X(float, drawn_reach_m) X(vec3, gusts) X(vec3, white_gains) X(float, bloom)        \
    X(float, wet_lens) X(float, emissive_scale) X(float, exposure) X(float, exposure_bias) X(float, samples) \
    X(float, sun_angular_cos) X(float, shelter_spread_m) X(float, horizon_fade) X(float, specular_aa)        \
    X(float, specular_aa_limit) X(vec3, grain_dither) X(float, occlusion_direct) X(float, bounce)            \
    X(uint, flags) X(int, ripple_bits) X(int, flow_bits) X(vec4, tracks) X(vec2, tracks_y_m)                   \
    X(float, patches.cell_m) X(uint, patches.levels) X(uint, patches.patches) X(uint, patches.table_mask)    \
    X(uint, patches.neighbors) X(float, snow_lift_m) X(float, place.grid.cell_m) X(uint, place.grid.levels)  \
    X(uint, place.grid.patches) X(uint, place.grid.table_mask) X(uint, place.grid.neighbors)                 \
    X(vec2, place.basin_corner_m) X(float, place.basin_cell_m) X(uint, place.basin_width)                    \
    X(uint, place.basin_depth) X(uint, place.open_patch) X(float, place.glazed)

#ifdef __cplusplus
#include <cstddef>
#include <utility>

namespace petrichor::shared {

constexpr bool frame_members_follow_each_other()
{
    std::size_t at = 0;
    bool follow = true;
#define FRAME_MEMBER(type, member)                                   \
    follow = follow && offsetof(FrameConstants, member) == at &&     \
             sizeof(std::declval<FrameConstants&>().member) == sizeof(type); \
    at += sizeof(type);
    FRAME_MEMBERS(FRAME_MEMBER)
#undef FRAME_MEMBER
    return follow && at == 4 * FRAME_WORD_COUNT && offsetof(FrameConstants, arrays) == at;
}
static_assert(frame_members_follow_each_other());
static_assert(sizeof(FallConstants) == 4 * FRAME_FALL_WORDS && offsetof(FrameArrays, falls) == 0);

}  // namespace petrichor::shared
#endif

#endif
