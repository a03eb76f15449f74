// Two sets of textures on one material: how much of each is here.
#ifndef PETRICHOR_SURFACE_SETS_GLSL
#define PETRICHOR_SURFACE_SETS_GLSL

#include "formulas/weather/mix_sets.h"
#include "gpu/passes/surface/ground_layers.glsl"
#include "gpu/passes/surface/textures.glsl"

const bool MIXED = SECOND == SECOND_MIX;

// Of whatever height map the material has.
bool has_relief()
{
    return has(TEXTURE_HEIGHT) || (MIXED && has(TEXTURE_SECOND_HEIGHT));
}

float channel_of(vec4 value, int slot)
{
    return dot(value, material.slots[slot].channel);
}

// What a mask and the heights of both sets say. mask: as read, 1 without one.
vec2 shares_of(SurfaceInput at, float mask, vec2 heights)
{
    const float first = saturate(material.mix_factor * at.weather.r * mask);
    return has_relief() ? mix_by_height(first, heights) : vec2(first, 1.0 - first);
}

void read_sets(inout SurfaceInput at)
{
    at.shares = vec2(1.0, 0.0);
    at.relief = 0.0;
    if (LAYERED) read_layers(at);
    if (!MIXED) return;
    float mask = 1.0;
    if (has(TEXTURE_MIX_MASK)) mask = number_at(mix_mask_texture, TEXTURE_MIX_MASK, at);
    vec2 heights = vec2(material.default_height);
    if (has(TEXTURE_HEIGHT)) heights.x = number_at(height_texture, TEXTURE_HEIGHT, at);
    if (has(TEXTURE_SECOND_HEIGHT)) {
        heights.y = number_at(second_height_texture, TEXTURE_SECOND_HEIGHT, at);
    }
    at.shares = shares_of(at, mask, heights);
    at.relief = dot(at.shares, heights);
}

// Height of the relief where the material has one.
float relief_height(SurfaceInput at)
{
    if (MIXED || LAYERED) return at.relief;
    return number_at(height_texture, TEXTURE_HEIGHT, at);
}

// The same of the nearest of its levels, for water: half the texels, and no line is seen where levels meet.
float relief_height_of_level(SurfaceInput at)
{
    if (MIXED || LAYERED) return at.relief;
    const Uv uv = coordinates(TEXTURE_HEIGHT, at, vec2(0.0));
    const vec2 size = vec2(textureSize(height_texture, 0));
    const float level = float(max(whole_level(uv.dx * size, uv.dy * size), 0));
    return channel_of(textureLod(height_texture, uv.at, level), TEXTURE_HEIGHT);
}

vec4 water_accumulation(SurfaceInput at)
{
    if (!MIXED) return material.water_accumulation;
    return material.water_accumulation * at.shares.x + material.second_water_accumulation * at.shares.y;
}

// How strong fine detail is: as the mask has it, gone in the distance.
float detail_share(SurfaceInput at)
{
    float share = saturate(material.mix_factor);
    if (has(TEXTURE_MIX_MASK)) share *= number_at(mix_mask_texture, TEXTURE_MIX_MASK, at);
    const float left_m = frame.look.detail_distance_m - length(at.position - frame.camera_m);
    const float near = saturate(left_m / max(frame.look.detail_fade_m, 1.0e-3));
    return share * near * near;
}

// A normal over the second texture coordinates, in the tangent frame of the first.
vec3 in_first_frame(vec3 n, Uv uv, SurfaceInput at, TangentFrame f)
{
    const float det = uv.dx.x * uv.dy.y - uv.dx.y * uv.dy.x;
    if (abs(det) < 1.0e-20) return n;
    const vec3 u = (at.position_dx * uv.dy.y - at.position_dy * uv.dx.y) / det;
    const vec3 v = (at.position_dy * uv.dx.x - at.position_dx * uv.dy.x) / det;
    const vec3 along = u / max(length(u), 1.0e-20);
    const vec3 up = -v / max(length(v), 1.0e-20);  // rows of an image go down
    const vec3 lean = n.x * along + n.y * up;
    return vec3(dot(lean, f.tangent), dot(lean, f.bitangent), n.z);
}

vec3 second_normal(SurfaceInput at, TangentFrame f, vec2 shift)
{
    if (!has(TEXTURE_SECOND_NORMAL)) return vec3(0.0, 0.0, 1.0);
    const Uv uv = coordinates(TEXTURE_SECOND_NORMAL, at, shift);
    const vec3 n = unpack_normal(texel(second_normal_texture, uv).xy, material.second_normal_scale);
    const bool other = material.slots[TEXTURE_SECOND_NORMAL].texcoord !=
                       material.slots[TEXTURE_NORMAL].texcoord;
    return other ? in_first_frame(n, uv, at, f) : n;
}

// Whatever normal maps the material has.
bool has_mapped_normal()
{
    if (LAYERED && (has_layer(LAYER_TEXTURE_THIRD + 1) || has_layer(LAYER_TEXTURE_FOURTH + 1))) return true;
    return has(TEXTURE_NORMAL) || (SECOND != SECOND_NONE && has(TEXTURE_SECOND_NORMAL));
}

vec3 mapped_normal(SurfaceInput at, TangentFrame f, vec2 shift)
{
    if (LAYERED) return normal_of_ground(at, shift);
    vec3 n = vec3(0.0, 0.0, 1.0);
    if (has(TEXTURE_NORMAL)) {
        n = unpack_normal(texel(normal_texture, coordinates(TEXTURE_NORMAL, at, shift)).xy,
                          material.normal_scale);
    }
    if (MIXED) n = normalize(n * at.shares.x + second_normal(at, f, shift) * at.shares.y);
    if (SECOND == SECOND_DETAIL && has(TEXTURE_SECOND_NORMAL)) {
        n = detail_normal(n, second_normal(at, f, shift), detail_share(at));
    }
    return n;
}

#endif
