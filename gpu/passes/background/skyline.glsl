// What stands on the land beyond the scene, before the sky. The includer has `frame`, `sky_light` and the formulas of fog and falling.
#ifndef PETRICHOR_SKYLINE_GLSL
#define PETRICHOR_SKYLINE_GLSL

#include "formulas/light/skyline.h"
#include "formulas/light/spherical_harmonics.h"

const vec3 kLeaves = vec3(0.045, 0.062, 0.028);     // albedo of a wood from the side, with its own shadows
const vec3 kSnowyLeaves = vec3(0.22, 0.23, 0.24);
const vec3 kFields = vec3(0.12, 0.14, 0.07);
const vec3 kSnowyFields = vec3(0.7);
// Clear air without any fog: what keeps blue hills blue, 1/m.
const vec3 kClearAir_per_m = vec3(3.5e-5, 4.5e-5, 7.0e-5);

// What the sky and the land of the sky send onto a surface, over pi.
vec3 skylight_on(vec3 normal)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i) sum += sky_light.harmonics[i].rgb * harmonic(i, normal);
    return max(sum, vec3(0.0));
}

// radiance: of the sky, or of the land of the sky behind its air, in that direction: what lies before far rows takes on the same.
// from_m: nothing stands nearer.
vec3 before_skyline(vec3 radiance, vec3 direction, float from_m)
{
    const float level = max(length(direction.xz), 1.0e-3);
    const float rise = direction.y / level;
    const float eye_m = max(frame.camera_m.y - frame.fog_base_m, 0.0);
    const vec2 ahead = direction.xz / level;
    const float white = clamp(frame.weather.snow_amount * 1.2, 0.0, 1.0);
    const vec3 leaves = mix(kLeaves, kSnowyLeaves, white) *
                        (skylight_on(vec3(-ahead.x, 0.0, -ahead.y)) + frame.sun_illuminance * skyline_sunlit(dot(direction, frame.sun_direction)));
    const vec3 fields = mix(kFields, kSnowyFields, white) *
                        (skylight_on(vec3(0.0, 1.0, 0.0)) + frame.sun_illuminance * (max(frame.sun_direction.y, 0.0) / kPi));
    vec3 before = vec3(0.0);
    float left = 1.0;
    // As a loop without another end, which is what a CPU leaves out where no pixel of a group is so low.
    int k = rise < kSkylineEnds && rise > -0.5 ? 0 : kSkylineRows;
    do {
        const SkylineRow row = skyline_row(k);
        const float over_m = skyline_over_m(row, rise, eye_m);
        const float width_m = max(pixel_width_m(frame, row.away_m), 1.0e-3);
        const uint seed = 390u + 7u * uint(k);
        vec2 tops = skyline_tops(row, ahead, width_m, seed);
        // Leaves are ragged.
        const float ragged = 2.4 * (endless_noise(vec2(skyline_angle(ahead) * row.away_m, over_m) * 0.55, seed + 6u) - 0.5) * (1.0 - smooth_edge(0.5, 2.0, width_m));
        tops.y = max(tops.y - ragged * smooth_edge(0.0, 3.0, tops.y - tops.x), tops.x);
        const float cover = k < kSkylineRows && row.away_m >= from_m ? skyline_cover(tops, over_m, width_m) : 0.0;
        const float wooded = skyline_wooded(row, ahead, tops, over_m, width_m, seed);
        const vec3 seen = mix(fields, leaves * skyline_tone(row, ahead, tops, over_m, width_m, seed), wooded);
        vec3 kept = exp(-row.away_m * kClearAir_per_m);
        if (FOG != 0u) {
            const float path = fog_path(row.away_m, eye_m, max(over_m, 0.0), frame.fog_height_m);
            const float drawn = drawn_depth(row.away_m, frame.drawn_per_m, frame.drawn_reach_m);
            kept = vec3(min(fog_kept(frame.fog_mode, path, frame.fog_per_m, frame.fog_start_m, frame.fog_end_m) * exp(drawn), 1.0));
        }
        before += left * cover * mix(radiance, seen, kept);
        left *= 1.0 - cover;
        ++k;
    } while (k < kSkylineRows);
    return before + left * radiance;
}

#endif
