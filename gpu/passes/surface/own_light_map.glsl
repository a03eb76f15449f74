// For surfaces of your own (own_surface.glsl) that decode their light map themselves. NAME_surface finds
// the standard decode in data.texel.baked (light_map_texture times light_map_scale over pi: what a white
// diffuser sends out) and may put another one there; data.texel.baked_sky is the share of skylight that
// the map holds. A map of two pictures has them side by side, the first on the left. What the map knows of
// sun and lamps, map_holds_direct and map_shadows tell the light.
#ifndef PETRICHOR_OWN_LIGHT_MAP_GLSL
#define PETRICHOR_OWN_LIGHT_MAP_GLSL

#include "formulas/light/light_map.h"
#include "gpu/passes/surface/own_surface.glsl"

// Where pixels are looked at from, unit.
vec3 toward_eye(SurfaceInput at)
{
    return (frame.flags & FRAME_ORTHOGRAPHIC) != 0u ? -frame.forward : normalize(frame.camera_m - at.position);
}

// The texel of one of `count` pictures side by side; what a filter reaches stays within it.
vec4 light_map_part(SurfaceInput at, int part, int count)
{
    Uv c = coordinates(TEXTURE_LIGHT_MAP, at, vec2(0.0));
    const float share = 1.0 / float(count);
    c.dx.x *= share;
    c.dy.x *= share;
    const float reach =
        0.5 * max(1.0 / float(textureSize(light_map_texture, 0).x), max(abs(c.dx.x), abs(c.dy.x)));
    const float margin = min(reach, 0.5 * share);
    c.at.x = clamp(fract(c.at.x) * share, margin, share - margin) + float(part) * share;
    return texel(light_map_texture, c);
}

// Irradiance of such a texel as the lighting takes it.
vec3 baked_light(vec3 lux)
{
    return min(lux * (material.light_map_scale * 0.31830989), vec3(60000.0));
}

// The map holds so much of what sun and lamps send straight, 0..1: they fade out by it.
void map_holds_direct(inout SurfaceData data, float share)
{
    data.texel.baked_shadow = BakedShadow(0.0, share, 1.0);
}

// How much the map says is seen, 0..1, of the sun (red) and of lamps by their channels (mask_channel of a lamp: 1
// green, 2 blue, 3 alpha), and how far its word stands in for real-time shadows. For a lamp that has none it
// stands in everywhere.
void map_shadows(inout SurfaceData data, vec4 visible, float share)
{
    data.texel.baked_shadow = BakedShadow(visible.r, share, 0.0);
    data.texel.lamp_mask = visible.gba;
}

// .. of the sun alone.
void map_shadows_sun(inout SurfaceData data, float visible, float share)
{
    data.texel.baked_shadow = BakedShadow(visible, share, 0.0);
}

#endif
