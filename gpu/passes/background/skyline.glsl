// What stands on the land beyond the scene, before the sky. The includer has `frame`, `sky_map`, air.glsl and the formulas of fog and falling.
#ifndef PETRICHOR_SKYLINE_GLSL
#define PETRICHOR_SKYLINE_GLSL

#include "formulas/light/skyline.h"

const vec3 kLeaves = vec3(0.045, 0.062, 0.028);     // albedo of a wood from the side, with its own shadows
const vec3 kSnowyLeaves = vec3(0.22, 0.23, 0.24);
const vec3 kFields = vec3(0.12, 0.14, 0.07);
const vec3 kSnowyFields = vec3(0.7);
// Clear air without any fog: what keeps blue hills blue, 1/m.
const vec3 kClearAir_per_m = vec3(3.5e-5, 4.5e-5, 7.0e-5);

// radiance: of the sky and the land of the sky in that direction. from_m: nothing stands nearer.
vec3 before_skyline(vec3 radiance, vec3 direction, float from_m)
{
    const float level = length(direction.xz);
    const float rise = direction.y / max(level, 1.0e-3);
    const float eye_m = max(frame.camera_m.y - frame.fog_base_m, 0.0);
    if (rise > kSkylineEnds || level < 0.5) return radiance;
    const vec2 ahead = direction.xz / level;
    const float white = clamp(frame.weather.snow_amount * 1.2, 0.0, 1.0);
    // From the sides half of what is there is land and half sky.
    const vec3 air = textureLod(sky_map, air_level(direction), kAirMip).rgb * frame.sky_scale;
    const vec3 veil = textureLod(sky_map, normalize(vec3(direction.x, 0.012, direction.z)), 2.0).rgb * frame.sky_scale;
    const vec3 land = textureLod(sky_map, vec3(0.0, -1.0, 0.0), kAirMip).rgb * frame.sky_scale;
    const vec3 around = textureLod(sky_map, vec3(0.0, 1.0, 0.0), kAirMip).rgb * frame.sky_scale;
    const vec3 beside = 0.25 * (air + around) + 0.5 * land;
    const vec3 sun = frame.sun_illuminance * skyline_sunlit(dot(direction, frame.sun_direction));
    const vec3 leaves = mix(kLeaves, kSnowyLeaves, white) * (beside + sun);
    const vec3 fields = mix(kFields, kSnowyFields, white) * (0.5 * (air + around) + 0.32 * frame.sun_illuminance * max(frame.sun_direction.y, 0.0));
    for (int k = kSkylineRows - 1; k >= 0; --k) {
        const SkylineRow row = skyline_row(k);
        if (row.away_m < from_m) continue;
        const float over_m = skyline_over_m(row, rise, eye_m);
        if (over_m < -1.0 || over_m > row.hills_m + row.tall_m + 1.0) continue;
        const float width_m = max(pixel_width_m(frame, row.away_m), 1.0e-3);
        const uint seed = 390u + 7u * uint(k);
        // Leaves are ragged.
        const float angle_m = skyline_angle(ahead) * row.away_m;
        const float ragged = 2.4 * (endless_noise(vec2(angle_m, over_m) * 0.55, seed + 6u) - 0.5) * (1.0 - smooth_edge(0.5, 2.0, width_m));
        vec2 tops = skyline_tops(row, ahead, width_m, seed);
        tops.y = max(tops.y - ragged * smooth_edge(0.0, 3.0, tops.y - tops.x), tops.x);
        const float cover = skyline_cover(tops, over_m, width_m);
        if (cover <= 0.0) continue;
        const float wooded = skyline_wooded(row, ahead, tops, over_m, width_m, seed);
        vec3 seen = mix(fields, leaves * skyline_tone(row, ahead, tops, over_m, width_m, seed), wooded);
        vec3 kept = exp(-row.away_m * kClearAir_per_m);
        if (FOG != 0u) {
            const float path = fog_path(row.away_m, eye_m, max(over_m, 0.0), frame.fog_height_m);
            const float drawn = drawn_depth(row.away_m, frame.drawn_per_m, frame.drawn_reach_m);
            kept = vec3(min(fog_kept(frame.fog_mode, path, frame.fog_per_m, frame.fog_start_m, frame.fog_end_m) * exp(drawn), 1.0));
        }
        radiance = mix(radiance, mix(veil, seen, kept), cover);
    }
    return radiance;
}

#endif
