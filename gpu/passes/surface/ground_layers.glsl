// The ground of a terrain: four materials by the weights of a control map, all of it one colour from afar.
#ifndef PETRICHOR_SURFACE_GROUND_LAYERS_GLSL
#define PETRICHOR_SURFACE_GROUND_LAYERS_GLSL

#include "formulas/weather/lost_slopes.h"
#include "formulas/weather/mix_sets.h"
#include "gpu/passes/surface/layer_slots.glsl"

const bool LAYERED = SECOND == SECOND_LAYERS;

vec4 control_weights(SurfaceInput at)
{
    return has(TEXTURE_MIX_MASK) ? texel(mix_mask_texture, coordinates(TEXTURE_MIX_MASK, at, vec2(0.0)))
                                 : vec4(1.0, 0.0, 0.0, 0.0);
}

vec3 color_of_layer(int first_role, SurfaceInput at)
{
    return has_layer(first_role) ? layer_texel(first_role, at, vec2(0.0), 1.0).rgb : vec3(1.0);
}

// Weights, colour and height of the layers here.
void read_layers(inout SurfaceInput at)
{
    vec3 first = vec3(1.0), second = vec3(1.0);
    if (has(TEXTURE_BASE_COLOR)) {
        first = texel(base_color_texture, coordinates(TEXTURE_BASE_COLOR, at, vec2(0.0))).rgb;
    }
    if (has(TEXTURE_SECOND_BASE_COLOR)) {
        second = texel(second_base_color_texture, coordinates(TEXTURE_SECOND_BASE_COLOR, at, vec2(0.0))).rgb;
    }
    const vec3 third = color_of_layer(LAYER_TEXTURE_THIRD, at);
    const vec3 fourth = color_of_layer(LAYER_TEXTURE_FOURTH, at);
    vec4 heights = vec4(first.b, second.b, third.b, fourth.b);
    if (has(TEXTURE_HEIGHT)) {
        heights.x = dot(texel(height_texture, coordinates(TEXTURE_HEIGHT, at, vec2(0.0))),
                        material.slots[TEXTURE_HEIGHT].channel);
    }
    if (has(TEXTURE_SECOND_HEIGHT)) {
        heights.y = dot(texel(second_height_texture, coordinates(TEXTURE_SECOND_HEIGHT, at, vec2(0.0))),
                        material.slots[TEXTURE_SECOND_HEIGHT].channel);
    }
    at.ground = ground_shares(control_weights(at), heights, material.layers_by_height);
    at.relief = dot(at.ground, heights);
    at.ground_color = first * material.base_color_factor.rgb * at.ground.x +
                      second * material.second_color_factor * at.ground.y +
                      third * material.third_color_factor * at.ground.z +
                      fourth * material.fourth_color_factor * at.ground.w;
    at.far = 0.0;
    if (has(TEXTURE_FAR)) {
        at.far = saturate((length(at.position - frame.camera_m) - material.far_start_m) /
                          max(material.far_fade_m, 1.0e-3));
        const vec3 from_afar = texel(far_texture, coordinates(TEXTURE_FAR, at, vec2(0.0))).rgb;
        at.ground_color = mix(at.ground_color, from_afar, at.far);
    }
}

vec3 normal_of_layer(int role, SurfaceInput at, vec2 shift)
{
    return has_layer(role) ? unpack_normal(layer_texel(role, at, shift, 1.0).xy, 1.0) : vec3(0.0, 0.0, 1.0);
}

// What the last normal of ground hides of the slopes of its layers.
float ground_lost = 0.0;

vec3 normal_of_ground(SurfaceInput at, vec2 shift)
{
    vec3 first = vec3(0.0, 0.0, 1.0), second = first;
    if (has(TEXTURE_NORMAL)) {
        first = unpack_normal(texel(normal_texture, coordinates(TEXTURE_NORMAL, at, shift)).xy,
                              material.normal_scale);
    }
    if (has(TEXTURE_SECOND_NORMAL)) {
        second = unpack_normal(texel(second_normal_texture, coordinates(TEXTURE_SECOND_NORMAL, at, shift)).xy,
                               material.second_normal_scale);
    }
    const vec3 third = normal_of_layer(LAYER_TEXTURE_THIRD + 1, at, shift);
    const vec3 fourth = normal_of_layer(LAYER_TEXTURE_FOURTH + 1, at, shift);
    const vec3 n = first * at.ground.x + second * at.ground.y + third * at.ground.z + fourth * at.ground.w;
    const vec3 seen = normalize(mix(n, vec3(0.0, 0.0, 1.0), at.far));
    ground_lost = lost_slopes(dot(at.ground, vec4(slope_2(first), slope_2(second), slope_2(third), slope_2(fourth))), seen);
    return seen;
}

// Occlusion, roughness and metallic of a layer behind the first two. Without a texture it is no metal.
vec3 matter_of_layer(int role, float roughness, SurfaceInput at, vec2 shift)
{
    return has_layer(role) ? layer_texel(role, at, shift, 1.0).rgb * vec3(1.0, roughness, 1.0)
                           : vec3(1.0, roughness, 0.0);
}

// first: of the first layer, as its textures say.
vec3 matter_of_ground(vec3 first, SurfaceInput at, vec2 shift)
{
    vec3 second = vec3(1.0, material.second_roughness_factor, material.second_metallic_factor);
    if (has(TEXTURE_SECOND_METALLIC_ROUGHNESS)) {
        second *= texel(second_metallic_roughness_texture,
                        coordinates(TEXTURE_SECOND_METALLIC_ROUGHNESS, at, shift)).rgb;
    }
    return first * at.ground.x + second * at.ground.y +
           matter_of_layer(LAYER_TEXTURE_THIRD + 2, material.third_roughness_factor, at, shift) * at.ground.z +
           matter_of_layer(LAYER_TEXTURE_FOURTH + 2, material.fourth_roughness_factor, at, shift) * at.ground.w;
}

#endif
