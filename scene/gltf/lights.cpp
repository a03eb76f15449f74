#include <limits>
#include <optional>

#include "scene/gltf/detail/gltf_parts.h"
#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kPi = 3.14159265358979f;

void read_spot(const JsonObject& json, Light& light)
{
    const auto spot = json.object("spot");
    if (!spot) return;
    light.inner_cone_rad = spot->number("innerConeAngle", 0.0f, 0.0f, kPi / 2.0f);
    light.outer_cone_rad = spot->number("outerConeAngle", kPi / 4.0f, 0.0f, kPi / 2.0f);
    if (!(light.inner_cone_rad < light.outer_cone_rad)) {
        spot->fail("innerConeAngle",
                   "must be less than outerConeAngle (" +
                       number_text(static_cast<double>(light.outer_cone_rad)) + "), got " +
                       number_text(static_cast<double>(light.inner_cone_rad)),
                   "Make the inner cone narrower than the outer one.");
    }
}

// PETRICHOR_lights_shape: the size of a lamp, metres.
void read_shape(const JsonObject& json, Light& light)
{
    const auto extension = json.extension("PETRICHOR_lights_shape");
    if (!extension) return;
    LightShape shape;
    for (const LightProperty& row : light_table()) {
        if (row.gltf.empty() || !extension->has(row.gltf)) continue;
        row.set(shape, row.flag ? float(extension->flag(row.gltf, false)) : extension->number(row.gltf, 0.0f, row.low, row.high));
    }
    if (extension->has("bothSides")) shape.both_sides = extension->flag("bothSides", false);
    const std::string problem = shape_light(light, shape);
    if (!problem.empty()) extension->fail("", problem, "Correct the lamp's shape.");
}

std::optional<Light> read_light(const JsonObject& json, std::size_t number)
{
    Light light;
    light.name = json.text("name", "light " + std::to_string(number));
    const std::string type = json.text("type");
    if (type == "directional") {
        light.kind = LightKind::Directional;
    } else if (type == "spot") {
        light.kind = LightKind::Spot;
    } else if (type != "point") {
        json.warn("type", "a light of unknown type " + in_quotes(type) + " is left out");
        return std::nullopt;
    }
    light.direction = {0.0f, 0.0f, -1.0f};
    if (json.numbers("color", {&light.color.x, 3})) {
        const glm::vec3 given = light.color;
        light.color = glm::max(given, glm::vec3(0.0f));
        if (light.color != given) json.warn("color", "the value is out of range and was clamped");
    }
    light.intensity = json.clamped("intensity", 1.0f, 0.0f, kLargest);
    if (light.kind != LightKind::Directional && json.has("range")) {
        light.range_m = json.number("range", 0.0f, std::numeric_limits<float>::min());
    }
    if (light.kind == LightKind::Spot) read_spot(json, light);
    read_shape(json, light);
    return light;
}

Camera read_camera(const JsonObject& json, std::size_t number)
{
    Camera camera;
    camera.name = json.text("name", "camera " + std::to_string(number));
    const std::string type = json.text("type");
    constexpr const char* kFix = "Correct the camera, or export the scene again.";
    if (type == "perspective") {
        const auto lens = json.object("perspective");
        if (!lens) json.fail("perspective", "is missing", kFix);
        camera.vertical_fov_rad = lens->number("yfov", camera.vertical_fov_rad);
        if (!(camera.vertical_fov_rad > 0.0f && camera.vertical_fov_rad < kPi)) {
            lens->fail("yfov",
                       "must be between 0 and pi, got " +
                           number_text(static_cast<double>(camera.vertical_fov_rad)),
                       kFix);
        }
        camera.near_m = lens->number("znear", camera.near_m);
        if (!(camera.near_m > 0.0f)) {
            lens->fail(
                "znear",
                "must be more than 0, got " + number_text(static_cast<double>(camera.near_m)),
                kFix);
        }
    } else if (type == "orthographic") {
        const auto lens = json.object("orthographic");
        if (!lens) json.fail("orthographic", "is missing", kFix);
        const float half = lens->number("ymag", 1.0f);
        if (!(half > 0.0f && half < kLargest / 2.0f)) {
            lens->fail("ymag", "must be more than 0, got " + number_text(static_cast<double>(half)),
                       kFix);
        }
        camera.orthographic_height_m = 2.0f * half;
        camera.near_m = lens->number("znear", 0.0f, 0.0f);
    } else {
        json.fail("type", "must be perspective or orthographic, got " + in_quotes(type), kFix);
    }
    return camera;
}

}  // namespace

std::vector<std::optional<Light>> read_lights(const JsonObject& root)
{
    std::vector<std::optional<Light>> lights;
    const auto extension = root.extension("KHR_lights_punctual");
    if (!extension) return lights;
    const JsonArray json = extension->array("lights");
    for (std::size_t i = 0; i < json.size(); ++i) lights.push_back(read_light(json.object(i), i));
    return lights;
}

std::vector<Camera> read_cameras(const JsonObject& root)
{
    std::vector<Camera> cameras;
    const JsonArray json = root.array("cameras");
    for (std::size_t i = 0; i < json.size(); ++i) cameras.push_back(read_camera(json.object(i), i));
    return cameras;
}

}  // namespace petrichor::scene
