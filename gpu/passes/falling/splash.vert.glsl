#version 460
// The crown that a drop throws up where it hits: found on the map that looks along the rain.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/spherical_harmonics.h"
#include "formulas/weather/falling.h"
#include "gpu/frame/frame_io.h"
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/falling/falling_io.h"
#include "gpu/passes/sky/sky_light_io.h"

layout(binding = FALLING_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = FALLING_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
layout(binding = FALLING_DROPS) uniform samplerBuffer splashes;
layout(binding = FALLING_SHELTER) uniform sampler2D shelter_map;

layout(location = 0) noperspective out vec2 at;  // across, -1 .. 1, and up, 0 .. 1
layout(location = 1) flat out vec4 light;        // radiance; distance along the view axis
layout(location = 2) flat out float opacity;

const vec2 kCorners[4] = vec2[](vec2(-1, 0), vec2(1, 0), vec2(1, 1), vec2(-1, 1));
const float kFromBelow = 0.25;  // sine; flatter ways from below may pass the edge of a roof on which a crown stands
const float kOpacity = 0.6;   // of a young crown: sheets and beads with air between them; by eye

// Where what passes a point hits; w 0: nothing.
vec4 hit(vec3 above)
{
    const vec4 map = frame.shelter_from_world * vec4(above, 1.0);
    if (any(greaterThan(abs(map.xy - 0.5), vec2(0.5)))) return vec4(0.0);
    const float depth = textureLod(shelter_map, map.xy, 0.0).r;
    const vec3 row = vec3(frame.shelter_from_world[0].z, frame.shelter_from_world[1].z,
                          frame.shelter_from_world[2].z);
    // Depth falls by |row| a metre along the rain.
    return vec4(above - row * ((map.z - depth) / dot(row, row)), depth > 0.0 ? 1.0 : 0.0);
}

void main()
{
    const int splash = gl_VertexIndex / 4;
    const vec2 corner = kCorners[gl_VertexIndex - 4 * splash];
    const vec4 place = texelFetch(splashes, splash * SPLASH_TEXELS);
    const vec4 lamps = texelFetch(splashes, splash * SPLASH_TEXELS + 1);
    const float diameter = abs(lamps.w);
    vec3 above = place.xyz;
    if (lamps.w < 0.0) {
        // Aside by as much as the rain drives it until it hits: exact where the ground around is level.
        const vec4 first = hit(above);
        above.xz += first.w * (above.xz - first.xz);
    }
    const vec4 p = hit(above);
    const vec4 beside = hit(above + vec3(0.06, 0.0, 0.0));
    const vec4 before = hit(above + vec3(0.0, 0.0, 0.06));
    const vec3 n = normalize(cross(before.xyz - p.xyz, beside.xyz - p.xyz) + vec3(0.0, 1.0e-9, 0.0));

    const vec3 from_eye = p.xyz - frame.camera_m;
    const float view_m = dot(from_eye, frame.forward);
    const float age = place.w / kSplashLife_s;
    const float wide_m = crown_radius_m(diameter, drop_speed_m_s(diameter * 1000.0), place.w);
    // Beads fly higher than the rim.
    const float high_m = 2.2 * wide_m * (1.0 - 0.3 * age);
    const float pixel_m = pixel_width_m(frame, max(view_m, 0.1));
    // Not narrower than a pixel and a half; what is wider than it is, is fainter.
    const vec2 size_m = max(vec2(wide_m, high_m), vec2(0.75, 1.5) * pixel_m);
    const float share = wide_m * high_m / (size_m.x * size_m.y);
    const vec3 right = normalize(frame.ray_dx);
    const vec3 up = -normalize(frame.ray_dy);
    const vec3 position = p.xyz + right * (corner.x * size_m.x) + up * (corner.y * size_m.y);
    at = corner;
    opacity = kOpacity * share * (1.0 - age * age) * smoothstep(0.4, 0.8, view_m) *
              (1.0 - smoothstep(0.6 * kSplashReach_m, kSplashReach_m, length(from_eye)));

    const vec3 view = normalize(from_eye);
    vec3 sky = vec3(0.0);
    for (int i = 0; i < kHarmonics; ++i) sky += sky_light.harmonics[i].xyz * harmonic(i, view);
    light = vec4(min(0.94 * max(sky, vec3(0.0)) * frame.ambient_scale + lamps.rgb, vec3(60000.0)),
                 view_m);
    gl_Position = frame.world_to_clip * vec4(position, 1.0);
    gl_Position.z = 0.5 * gl_Position.w;
    const bool level = n.y > 0.75 && p.w * beside.w * before.w > 0.0;
    // Depth hides what is 4 cm behind a surface: roofs are thinner.
    const bool below = view.y > kFromBelow;
    if (!level || below || view_m < 0.4 || opacity <= 0.004) gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
}
