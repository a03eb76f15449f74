#include "scene/light_shape.h"

#include <cmath>

namespace petrichor::scene {
namespace {

template <auto Member>
LightProperty row(std::string_view name, std::string_view gltf, float low, float high,
                  std::string_view example, std::string_view help)
{
    return {name, gltf, low, high, false, example, help,
            [](const LightShape& s) -> std::optional<float> { return s.*Member; },
            [](LightShape& s, float value) { s.*Member = value; }};
}

LightProperty as_flag(LightProperty property)
{
    property.flag = true;
    return property;
}

float rectangle_area(const Light& light)
{
    return 4.0f * glm::length(light.half_u_m) * glm::length(light.half_v_m);
}

}  // namespace

const std::vector<LightProperty>& light_table()
{
    using S = LightShape;
    static const std::vector<LightProperty> table{
        row<&S::radius_m>("radius_m", "radius", 0.0f, 40.0f, "0.2",
                          "a point lamp is a sphere of this radius, a spot a disc; 0: a point"),
        row<&S::length_m>("length_m", "length", 0.0f, 40.0f, "1.0",
                          "with radius_m: a point lamp is a tube along its y axis"),
        row<&S::width_m>("width_m", "width", 1e-3f, 1e3f, "1.0",
                         "with height_m: the lamp is a rectangle in its x and y axes, facing -z"),
        row<&S::height_m>("height_m", "height", 1e-3f, 1e3f, "0.5", "of that rectangle"),
        row<&S::specular>("specular", "specular", 0.0f, 1.0f, "1.0",
                          "of its highlights; 0 fills shadows and is mirrored nowhere"),
        row<&S::mask_channel>("mask_channel", "maskChannel", 0.0f, 3.0f, "0",
                              "where shadow masks hold its shadow: 1 green, 2 blue, 3 alpha, 0 nowhere; "
                              "`scene --bake shadow_mask` writes it"),
        as_flag(row<&S::per_vertex>("per_vertex", "perVertex", 0.0f, 1.0f, "true",
                                    "of a point or a spot: its light is worked out at vertices and is cheap, without "
                                    "highlights, shadows and bumps of normal maps")),
        row<&S::shadow_strength>("shadow_strength", "shadowStrength", 0.0f, 1.0f, "1.0",
                                 "share of its light that its shadows take away: 1 all of it, 0 it throws none"),
    };
    return table;
}

std::string shape_light(Light& light, const LightShape& shape)
{
    const bool flat = shape.width_m || shape.height_m;
    const bool round = shape.radius_m || shape.length_m;
    const bool by_vertex = shape.per_vertex ? *shape.per_vertex > 0.5f : light.per_vertex;
    if (by_vertex && light.kind == LightKind::Directional) return "a directional light does not light by vertex";
    if (by_vertex && (flat || light.kind == LightKind::Rectangle)) return "a rectangle does not light by vertex";
    light.per_vertex = by_vertex;
    if (shape.specular) light.specular = *shape.specular;
    if (shape.shadow_strength) light.shadow_strength = *shape.shadow_strength;
    if (shape.mask_channel) {
        if (*shape.mask_channel != std::floor(*shape.mask_channel)) return "the channel of a shadow mask is a whole number";
        light.mask_channel = static_cast<int>(*shape.mask_channel);
    }
    if (!flat && !round) {
        light.both_sides = light.both_sides || (shape.both_sides && light.shaped);
        return "";
    }
    if (light.kind == LightKind::Directional) return "a directional light has no size";
    if (flat && round) return "a lamp is either round (radius, length) or a rectangle (width, height)";
    if (flat) {
        if (!shape.width_m || !shape.height_m) return "width and height of a lamp go together";
        const float candela = light_candela(light);
        light.kind = LightKind::Rectangle;
        light.shaped = true;
        light.both_sides = shape.both_sides;
        light.intensity = candela / (*shape.width_m * *shape.height_m);
        light.radius_m = light.length_m = 0.0f;
        light.half_u_m = {0.5f * *shape.width_m, 0.0f, 0.0f};
        light.half_v_m = {0.0f, -0.5f * *shape.height_m, 0.0f};
        turn_shape(light);
        return "";
    }
    if (light.kind == LightKind::Rectangle) return "the lamp is a rectangle: it has no radius";
    if (shape.length_m && *shape.length_m > 0.0f && light.kind == LightKind::Spot)
        return "a spot is a disc: it has no length";
    const float radius = shape.radius_m.value_or(light.radius_m);
    if (shape.length_m && *shape.length_m > 0.0f && !(radius > 0.0f))
        return "a lamp with a length needs a radius";
    light.radius_m = radius;
    if (shape.length_m) light.length_m = *shape.length_m;
    return "";
}

LightShape shape_of_light(const Light& light)
{
    LightShape shape;
    if (light.radius_m > 0.0f) shape.radius_m = light.radius_m;
    if (light.length_m > 0.0f) shape.length_m = light.length_m;
    if (light.kind == LightKind::Rectangle && light.shaped) {
        shape.width_m = 2.0f * glm::length(light.half_u_m);
        shape.height_m = 2.0f * glm::length(light.half_v_m);
        shape.both_sides = light.both_sides;
    }
    if (light.per_vertex) shape.per_vertex = 1.0f;
    if (light.specular != 1.0f) shape.specular = light.specular;
    if (light.shadow_strength != 1.0f) shape.shadow_strength = light.shadow_strength;
    if (light.mask_channel > 0) shape.mask_channel = static_cast<float>(light.mask_channel);
    return shape;
}

bool lit_by_vertex(const Light& light)
{
    return light.per_vertex && (light.kind == LightKind::Point || light.kind == LightKind::Spot);
}

void turn_shape(Light& light)
{
    if (light.kind != LightKind::Rectangle || !light.shaped) return;
    const glm::vec3 up = up_of(light);
    light.half_u_m = glm::cross(light.direction, up) * glm::length(light.half_u_m);
    light.half_v_m = up * -glm::length(light.half_v_m);
}

glm::vec3 up_of(const Light& light)
{
    const glm::vec3 across = light.up - light.direction * glm::dot(light.up, light.direction);
    if (glm::dot(across, across) > 1e-6f) return glm::normalize(across);
    const glm::vec3 other =
        std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    return glm::normalize(other - light.direction * glm::dot(other, light.direction));
}

float light_candela(const Light& light)
{
    return light.kind == LightKind::Rectangle ? light.intensity * rectangle_area(light)
                                              : light.intensity;
}

}  // namespace petrichor::scene
