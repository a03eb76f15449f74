// How a surface point is written into the G-buffer and read back.
#ifndef PETRICHOR_GBUFFER_GLSL
#define PETRICHOR_GBUFFER_GLSL

#include "formulas/codec/octahedral.h"
#include "formulas/codec/rough_normal.h"
#include "formulas/weather/deep_water.h"
#include "gpu/frame/baked_shadow.glsl"
#include "gpu/frame/frame_io.h"
#include "gpu/frame/gbuffer_table_io.h"

struct GBufferTexel {
    vec3 base_color;
    float occlusion;
    vec3 base_normal;
    vec3 cover_normal;
    float roughness;
    float metallic;
    float porosity;
    vec3 f0;       // reflectance of what is not metal at normal incidence, 0..1
    float tangent; // of anisotropic materials: tangent_code (formulas/light/layers.h)
    uint model;    // lighting model, 0..255; behind the models: a model and layers
    vec4 weather;  // film, water, snow, frost
    float deeper_m;  // of standing water, more than where it closes
    float cover_roughness;  // perceptual, of slopes that cover_normal does not show; kept with FRAME_RINGS
    uint material;          // its number in the scene, 0..65535; 0 where no weather is kept
    float snow_smoothness;  // of the snow here
    float first_share;      // of the first of two sets of textures; kept with FRAME_TWO_SETS
    vec3 emission; // radiance
    float body;    // of a layer that light passes: share of its thickness
    vec3 baked;    // of the light map: what a white Lambert surface sends out
    float baked_sky;  // share of skylight that is in it; kBakedAtVertices, until it is read: it is no map
    bool lamps_at_vertices;  // .. so what is in it came from those
    BakedShadow baked_shadow;
    vec3 lamp_mask;  // what the map says of lamps is seen, by their channels; not of layers that light passes
};

// Two numbers of 8 bits in one of 16.
float two_in_one(float high, float low)
{
    return (floor(clamp(high, 0.0, 1.0) * 255.0 + 0.5) * 256.0 + floor(clamp(low, 0.0, 1.0) * 255.0 + 0.5)) / 65535.0;
}

vec2 one_as_two(float both)
{
    const uint code = uint(both * 65535.0 + 0.5);
    return vec2(code >> 8, code & 255u) / 255.0;
}

// Where water closes over a surface its film says nothing more: that place holds how deep the water is.
bool water_closes(float water) { return water > 254.5 / 255.0; }
vec4 kept_weather(GBufferTexel texel)
{
    vec4 kept = texel.weather;
    if (water_closes(kept.y)) kept.x = water_depth_code(texel.deeper_m);
    return kept;
}

// What the target of the weather holds: film, water, snow and frost, and the number of the material.
vec2 stores_code(vec4 weather)
{
    return vec2(two_in_one(weather.x, weather.y), two_in_one(weather.z, weather.w));
}

vec4 stores_of(vec4 code)
{
    return vec4(one_as_two(code.z), one_as_two(code.w));
}

// The same in half the bytes, where nothing is white: WEATHER_WET.
vec4 wet_code(vec4 weather, uint material)
{
    return vec4(weather.x, weather.y, float(material >> 8) / 255.0, float(material & 255u) / 255.0);
}

// kept: WEATHER_..
uint material_of(vec4 code, uint kept)
{
    if (kept != WEATHER_WET) return uint(code.x * 65535.0 + 0.5);
    return uint(code.z * 255.0 + 0.5) << 8 | uint(code.w * 255.0 + 0.5);
}

// As the targets hold it.
struct GBufferCode {
#define ROW(name, location_, format_, when_, meaning_) vec4 name;
    GBUFFER_TABLE(ROW)
#undef ROW
};

// flags: of the frame.
GBufferCode encode_gbuffer(GBufferTexel texel, uint flags)
{
    GBufferCode code;
    code.color = vec4(sqrt(clamp(texel.base_color, vec3(0.0), vec3(1.0))), texel.occlusion);
    code.normals =
        vec4(octahedral_encode(texel.base_normal), octahedral_encode(texel.cover_normal));
    if ((flags & FRAME_RINGS) != 0u) code.normals.zw = rough_normal_code(code.normals.zw, texel.cover_roughness);
    code.material = vec4(texel.roughness, texel.metallic, texel.porosity,
                         float(texel.model) / 255.0);
    code.payload = vec4(sqrt(clamp(texel.f0, vec3(0.0), vec3(1.0))), texel.tangent);  // 0.04 is exact
    const float snow = (flags & FRAME_TWO_SETS) != 0u
                           ? two_in_one(texel.snow_smoothness, texel.first_share)
                           : texel.snow_smoothness;
    code.weather = vec4(float(texel.material) / 65535.0, snow, stores_code(kept_weather(texel)));
    code.emission = vec4(texel.emission, lamp_mask_code(texel.lamp_mask, texel.body));
    code.baked = vec4(texel.baked, baked_shadow_code(texel.baked_shadow, texel.baked_sky));
    return code;
}

GBufferTexel decode_gbuffer(GBufferCode code, uint kept, uint flags)
{
    GBufferTexel texel;
    texel.base_color = code.color.rgb * code.color.rgb;
    texel.occlusion = code.color.a;
    texel.base_normal = octahedral_decode(code.normals.xy);
    texel.cover_normal = octahedral_decode(code.normals.zw);
    texel.cover_roughness = (flags & FRAME_RINGS) != 0u ? roughness_of_normal(code.normals.zw) : 0.0;
    texel.roughness = code.material.x;
    texel.metallic = code.material.y;
    texel.porosity = code.material.z;
    texel.model = uint(code.material.w * 255.0 + 0.5);
    texel.f0 = code.payload.rgb * code.payload.rgb;
    texel.tangent = code.payload.a;
    const bool wet = kept == WEATHER_WET;
    texel.weather = wet ? vec4(code.weather.xy, 0.0, 0.0) : stores_of(code.weather);
    texel.deeper_m = 0.0;
    if (water_closes(texel.weather.y)) {
        texel.deeper_m = water_depth_of(texel.weather.x);
        texel.weather.x = 1.0;
    }
    texel.material = material_of(code.weather, kept);
    texel.snow_smoothness = wet ? 0.0 : code.weather.y;
    texel.first_share = 1.0;
    if (!wet && (flags & FRAME_TWO_SETS) != 0u) {
        const vec2 both = one_as_two(code.weather.y);
        texel.snow_smoothness = both.x;
        texel.first_share = both.y;
    }
    texel.emission = code.emission.rgb;
    texel.body = code.emission.a < 0.0 ? 1.0 : code.emission.a;
    texel.lamp_mask = lamp_mask_of(code.emission.a);
    texel.baked = code.baked.rgb;
    texel.baked_sky = baked_sky_of(code.baked.a);
    texel.lamps_at_vertices = code.baked.a == kBakedAtVertices;
    texel.baked_shadow = baked_shadow_of(code.baked.a);
    return texel;
}

// Where a pixel is in rows of the picture (targets.h, GBufferRows).
int row_texel(ivec2 texel, ivec2 size)
{
    return texel.y * size.x + texel.x;
}

// Direction from the eye through a pixel centre; perspective: its forward part is 1 long.
vec3 pixel_ray(FrameConstants frame, vec2 pixel)
{
    return frame.ray_corner + frame.ray_dx * pixel.x + frame.ray_dy * pixel.y;
}

// World position of a pixel from its depth (> 0).
vec3 pixel_position(FrameConstants frame, vec2 pixel, float depth)
{
    if ((frame.flags & FRAME_ORTHOGRAPHIC) != 0u) {
        return frame.origin_corner + frame.ray_dx * pixel.x + frame.ray_dy * pixel.y +
               frame.forward * ((1.0 - depth) * frame.far_m);
    }
    return frame.camera_m + pixel_ray(frame, pixel) * (frame.near_m / depth);
}

vec3 pixel_view_direction(FrameConstants frame, vec2 pixel)
{
    if ((frame.flags & FRAME_ORTHOGRAPHIC) != 0u) return frame.forward;
    return normalize(pixel_ray(frame, pixel));
}

// Metres across a pixel of what lies that far along the view axis.
float pixel_width_m(FrameConstants frame, float view_m)
{
    return (frame.flags & FRAME_ORTHOGRAPHIC) != 0u ? length(frame.ray_dx) : view_m * frame.pixel_angle;
}

// Change of depth from a pixel to the next on a surface that goes away from the eye as far as a pixel is wide.
float pixel_depth_step(FrameConstants frame, float depth)
{
    return (frame.flags & FRAME_ORTHOGRAPHIC) != 0u ? length(frame.ray_dx) / frame.far_m : depth * frame.pixel_angle;
}

// Distance along the view axis.
float linear_depth(FrameConstants frame, float depth)
{
    if ((frame.flags & FRAME_ORTHOGRAPHIC) != 0u) return (1.0 - depth) * frame.far_m;
    return frame.near_m / max(depth, 1.0e-9);
}

#endif
