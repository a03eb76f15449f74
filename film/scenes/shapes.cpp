#include "film/scenes/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "film/scenario/shape_keys.h"
#include "formulas/geometry/shapes.h"
#include "scene/shapes.h"

namespace petrichor::film {
namespace {

constexpr double kSize_m = 2.0;
constexpr double kPower = 8.0;

std::uint32_t material_of(const ScenarioShape& one, const std::vector<MaterialOverride>& materials,
                          scene::Scene& scene)
{
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == one.material) return i;
        names.push_back(scene.materials[i].name);
    }
    const bool described = std::any_of(materials.begin(), materials.end(),
                                       [&](const auto& table) { return glob_matches(table.glob, one.material); });
    if (!described) {
        throw Error(one.place + ": the shape \"" + one.name + "\" shows the material \"" + one.material +
                        "\", which neither the scene has nor the scenario describes." +
                        did_you_mean(one.material, names),
                    "Name a material of the scene, or add [materials.\"" + one.material + "\"], with its roughness for "
                    "example.");
    }
    scene::Material made;
    made.name = one.material;
    made.metallic = 0.0f;
    scene.materials.push_back(std::move(made));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void check_kind(const ScenarioShape& one)
{
    const auto& kinds = scene::shape_kinds();
    if (one.kind < 0) {
        std::vector<std::string> names;
        for (const scene::ShapeKind& kind : kinds) names.push_back(kind.name);
        throw Error(one.place + ": the shape \"" + one.name + "\" has no kind", "Give it a kind: " + join_words(names) + ".");
    }
    const scene::ShapeKind& kind = kinds[static_cast<std::size_t>(one.kind)];
    for (const std::string& key : one.given) {
        if (has_key(one.kind, key)) continue;
        throw Error(one.place + ": the shape \"" + one.name + "\" is a " + kind.name + ", which has no " + key,
                    "Leave " + key + " out, or choose another kind.");
    }
    if (one.iterations > kind.most) {
        throw Error(one.place + ": the shape \"" + one.name + "\" has " + std::to_string(one.iterations) +
                        " iterations; a " + kind.name + " has 1 to " + std::to_string(kind.most),
                    "More are smaller than any pixel; give fewer.");
    }
}

double channel_at(const std::vector<KeyedNumber>& channels, std::size_t i, double time_s)
{
    return channels.empty() ? 0.0 : value_at(channels[i], time_s);
}

scene::ShapeMoment moment_of(const ScenarioShape& one, double time_s)
{
    scene::ShapeMoment at;
    at.power = static_cast<float>(value_at(one.power, time_s, kPower));
    const double units = static_cast<double>(scene::shape_kinds()[static_cast<std::size_t>(one.kind)].units);
    glm::dmat4 m(1.0);
    // A tetrahedron stands on a face, one edge of it along x.
    if (one.kind == SHAPE_SIERPINSKI) {
        const glm::dvec3 up = glm::normalize(glm::dvec3(1.0)), right = glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
        m = glm::dmat4(glm::transpose(glm::dmat3(right, up, glm::cross(right, up))));
    }
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        m = glm::rotate(glm::dmat4(1.0), glm::radians(channel_at(one.turn_degrees, static_cast<std::size_t>(i), time_s)), axis) * m;
    }
    m = m * (value_at(one.size_m, time_s, kSize_m) / units);
    m[3] = glm::dvec4(channel_at(one.center_m, 0, time_s), channel_at(one.center_m, 1, time_s),
                      channel_at(one.center_m, 2, time_s), 1.0);
    at.to_world = glm::mat4(m);
    return at;
}

bool changes(const KeyedNumber& number)
{
    return number.keys.size() > 1;
}

bool changes(const ScenarioShape& one)
{
    const auto any = [](const std::vector<KeyedNumber>& channels) {
        return std::any_of(channels.begin(), channels.end(), [](const KeyedNumber& n) { return changes(n); });
    };
    return changes(one.size_m) || changes(one.power) || any(one.center_m) || any(one.turn_degrees);
}

// All that it passes through: numbers over time stay between their keys.
scene::Bounds reach_of(const ScenarioShape& one, const scene::MarchedShape& shape)
{
    scene::ShapeMoment widest = shape.rest;
    double largest_m = kSize_m;
    if (one.size_m.given()) largest_m = 0.0;
    for (const NumberKey& key : one.size_m.keys) largest_m = std::max(largest_m, key.value);
    for (const NumberKey& key : one.power.keys) widest.power = std::min(widest.power, static_cast<float>(key.value));
    const float units = scene::shape_kinds()[static_cast<std::size_t>(one.kind)].units;
    const float radius_m = static_cast<float>(largest_m) / units * glm::length(scene::half_of(shape, widest));
    scene::Bounds reach{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (std::size_t i = 0; i < one.center_m.size(); ++i) {
        const auto [low, high] = std::minmax_element(one.center_m[i].keys.begin(), one.center_m[i].keys.end(),
                                                     [](const NumberKey& a, const NumberKey& b) { return a.value < b.value; });
        reach.low[static_cast<int>(i)] = static_cast<float>(low->value);
        reach.high[static_cast<int>(i)] = static_cast<float>(high->value);
    }
    return {reach.low - radius_m, reach.high + radius_m};
}

void add_number(Hasher& hasher, const KeyedNumber& number)
{
    hasher.add(number.keys.size());
    for (const NumberKey& key : number.keys) {
        hasher.add(key.time_s);
        hasher.add(key.value);
    }
}

}  // namespace

std::string add_shapes(const std::vector<ScenarioShape>& shapes, const std::vector<MaterialOverride>& materials,
                       scene::Scene& scene)
{
    if (shapes.empty()) return "";
    Hasher hasher;
    for (const ScenarioShape& one : shapes) {
        check_kind(one);
        scene::MarchedShape shape;
        shape.name = one.name;
        shape.kind = one.kind;
        shape.material = material_of(one, materials, scene);
        shape.iterations =
            one.iterations > 0 ? one.iterations : scene::shape_kinds()[static_cast<std::size_t>(one.kind)].levels;
        if (one.kind == SHAPE_BOX) shape.half = glm::vec3(one.sides);
        if (one.kind == SHAPE_TORUS) shape.half = {1.0f, static_cast<float>(one.tube), 1.0f};
        shape.rest = moment_of(one, 0.0);
        if (changes(one)) shape.reach = reach_of(one, shape);
        hasher.add(one.material);
        hasher.add(shape.kind);
        hasher.add(shape.iterations);
        for (int i = 0; i < 3; ++i) hasher.add(shape.half[i]);
        for (const auto* channels : {&one.center_m, &one.turn_degrees}) {
            hasher.add(channels->size());
            for (const KeyedNumber& channel : *channels) add_number(hasher, channel);
        }
        add_number(hasher, one.size_m);
        add_number(hasher, one.power);
        scene.shapes.push_back(std::move(shape));
    }
    return hasher.text();
}

void check_shapes(const scene::Scene& scene)
{
    for (const scene::MarchedShape& shape : scene.shapes) scene::check_shape(shape, scene);
}

std::vector<scene::ShapeMoment> shape_moments(const std::vector<ScenarioShape>& shapes, const scene::Scene& scene,
                                              double time_s)
{
    std::vector<scene::ShapeMoment> moments;
    if (scene.shapes.size() != shapes.size()) return moments;  // a scene of other things
    if (std::none_of(shapes.begin(), shapes.end(), [](const ScenarioShape& one) { return changes(one); })) return moments;
    for (const ScenarioShape& one : shapes) moments.push_back(moment_of(one, time_s));
    return moments;
}

}  // namespace petrichor::film
