#ifndef PETRICHOR_SCENE_LIGHT_SHAPE_H
#define PETRICHOR_SCENE_LIGHT_SHAPE_H

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// The size of a lamp, as files say it. Its intensity stays in candela: what it sends straight out of its
/// front (of a tube: across it) is spread over its face.
struct LightShape {
    std::optional<float> radius_m = {};  ///< of a point: a sphere; of a spot: a disc
    std::optional<float> length_m = {};  ///< with a radius: a tube along the lamp's y axis
    std::optional<float> width_m = {};   ///< with height: a rectangle in its x and y axes that faces -z
    std::optional<float> height_m = {};
    std::optional<float> specular = {};  ///< of its highlights
    std::optional<float> mask_channel = {};  ///< Light::mask_channel
    std::optional<float> per_vertex = {};  ///< 1: Light::per_vertex, 0: by pixel
    std::optional<float> shadow_strength = {};  ///< Light::shadow_strength
    bool both_sides = false;        ///< of a rectangle
};

/// Whether its light is worked out at vertices: that of a point or a spot, whatever its size. It has no highlights and no shadows.
bool lit_by_vertex(const Light& light);

/// One number of a shape, told once: glTF's extension PETRICHOR_lights_shape and the keys of
/// [lamps."glob"] in a scenario are made from these rows.
struct LightProperty {
    std::string_view name;  ///< key of a scenario
    std::string_view gltf;  ///< member of the extension
    float low = 0.0f;
    float high = 1.0f;
    bool flag = false;      ///< true and false in files, 1 and 0 here
    std::string_view example;
    std::string_view help;
    std::optional<float> (*get)(const LightShape&) = nullptr;
    void (*set)(LightShape&, float) = nullptr;
};
const std::vector<LightProperty>& light_table();

/// Gives a light a size. Says what is wrong with it, "" when nothing is; the light is then as before.
std::string shape_light(Light& light, const LightShape& shape);
/// What shape_light() was told.
LightShape shape_of_light(const Light& light);
/// Turns a rectangle into the plane of the light's x and y axes: after `direction` and `up` were set.
void turn_shape(Light& light);

/// Its `up`, made unit and across its direction whatever the light says.
glm::vec3 up_of(const Light& light);

/// Candela straight on, whatever its shape.
float light_candela(const Light& light);

}  // namespace petrichor::scene

#endif
