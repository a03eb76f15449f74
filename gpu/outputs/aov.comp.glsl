#version 460
// Labelled outputs from the G-buffer of the pixel-centre sample: every row of the table that is asked
// for, one image behind the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/outputs/aov_io.h"
#include "gpu/outputs/aov_table_io.h"
#define GBUFFER_FIRST_BINDING AOV_GBUFFER
#include "gpu/frame/gbuffer_read.glsl"

layout(local_size_x = AOV_TILE, local_size_y = AOV_TILE) in;
layout(constant_id = AOV_SPEC_ROWS_LOW) const uint ROWS_LOW = 0xffffffffu;
layout(constant_id = AOV_SPEC_ROWS_HIGH) const uint ROWS_HIGH = 0xffffffffu;
layout(constant_id = AOV_SPEC_WEATHER) const uint WEATHER = 1u;
layout(constant_id = AOV_SPEC_HAS_EMISSION) const uint HAS_EMISSION = 1u;
layout(constant_id = AOV_SPEC_HAS_BAKED) const uint HAS_BAKED = 1u;
layout(push_constant, scalar) uniform Push { AovPush push; };
layout(binding = AOV_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(constant_id = AOV_SPEC_PLACE) const uint PLACE = 0u;
layout(constant_id = AOV_SPEC_MATERIALS) const uint MATERIALS = 0u;
layout(binding = AOV_PLACE_TABLE) uniform usamplerBuffer place_table;
layout(binding = AOV_PLACE_STATES) uniform usamplerBuffer place_states;
layout(binding = AOV_PLACE_LABELS) uniform usamplerBuffer place_labels;
layout(binding = AOV_PLACE_LEVELS) uniform samplerBuffer place_levels;
#include "gpu/frame/place.glsl"
layout(binding = AOV_OUTPUT, scalar) writeonly buffer Output { float values[]; };

// What a row's value is made from.
struct AovPoint {
    float depth;    // as in the depth buffer
    vec3 position;  // world, metres
    GBufferTexel g;
    // SI: film mm, standing water m, snow m, ice kg/m2; liquid share, surface K, rain share, wind.
    vec4 stores;
    vec4 state;
};

// What the patch of a point holds, as it is: not blended. Without patches the frame's state where
// its masks say that it shows.
void set_si(inout AovPoint p)
{
    const WeatherMoment w = frame.weather;
    p.stores = vec4(w.film_mm * p.g.weather.x, w.puddle_depth_m * p.g.weather.y,
                    w.snow_depth_m * p.g.weather.z, w.ice_kg_m2 * p.g.weather.x);
    p.state = vec4(1.0 - w.water_to_snow, w.surface_temperature_k, p.g.weather.x, 1.0);
    if (PLACE == 0u) return;
    uint patch_number = place_patch(p.position, p.g.base_normal);
    if (patch_number == kNoPatch) {
        if (!place_open(p.g.base_normal, p.g.material)) return;
        patch_number = frame.place.open_patch;
    }
    p.stores = place_state(patch_number, 2);
    p.state = place_state(patch_number, 3);
    p.state.z = place_state(patch_number, 1).z;
    if (p.g.base_normal.y > 0.3) p.stores.y = max(p.stores.y, place_depth(p.position));
}

float lighting_path(uint model)
{
    if (model < push.built_in) return 0.0;
    return (push.gather[model >> 5 & 7u] >> (model & 31u) & 1u) != 0u ? 1.0 : 2.0;
}

#define kInfinity uintBitsToFloat(0x7f800000u)  // no constant expression in GLSL

bool asked(uint row)
{
    return (((row < 32u ? ROWS_LOW : ROWS_HIGH) >> (row & 31u)) & 1u) != 0u;
}

vec4 wide(float v) { return vec4(v, 0.0, 0.0, 0.0); }
vec4 wide(vec2 v) { return vec4(v, 0.0, 0.0); }
vec4 wide(vec3 v) { return vec4(v, 0.0); }
vec4 wide(vec4 v) { return v; }

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    AovPoint p;
    p.depth = texelFetch(depth_rows, row_texel(texel, frame.size)).r;
    const bool surface = p.depth > 0.0;
    p.position = pixel_position(frame, vec2(texel) + 0.5, max(p.depth, 1.0e-9));
    p.g = decode_gbuffer(
        fetch_gbuffer(row_texel(texel, frame.size), WEATHER, HAS_EMISSION != 0u, HAS_BAKED != 0u), WEATHER, frame.flags);
    if (MATERIALS != 0u) p.g.weather = vec4(0.0);
    set_si(p);

    const uint pixels = uint(frame.size.x * frame.size.y);
    const uint pixel = uint(texel.y * frame.size.x + texel.x);
    uint row = 0u;
    uint before = 0u;  // numbers a pixel of the rows before
#define ROW(name_, count_, channels_, unit_, precision_, meaning_, value_, background_)  \
    if (asked(row)) {                                                                    \
        vec4 value = vec4(background_);                                                  \
        if (surface) value = wide(value_);                                               \
        for (uint i = 0u; i < count_; ++i) {                                             \
            values[before * pixels + pixel * count_ + i] = value[i];                     \
        }                                                                                \
        before += count_;                                                                \
    }                                                                                    \
    ++row;
    AOV_TABLE(ROW)
#undef ROW
}
