#include "film/scenes/decals.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "scene/animation/rig.h"

namespace petrichor::film {
namespace {

std::uint32_t material_of(const ScenarioDecal& one, const std::vector<MaterialOverride>& materials,
                          scene::Scene& scene)
{
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == one.material) return i;
    }
    const bool described = std::any_of(materials.begin(), materials.end(), [&](const auto& table) {
        return glob_matches(table.glob, one.material);
    });
    if (!described) {
        throw Error(one.place + ": the decal \"" + one.name + "\" shows the material \"" +
                        one.material + "\", which neither the scene has nor the scenario describes",
                    "Name a material of the scene, or add [materials.\"" + one.material +
                        "\"] with its textures.");
    }
    scene::Material made;
    made.name = one.material;
    made.alpha_mode = scene::AlphaMode::Blend;
    made.metallic = 0.0f;
    made.decal.on = true;
    scene.materials.push_back(std::move(made));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

// From the cube of -0.5 to 0.5 to where the table has it.
glm::mat4 box_of(const ScenarioDecal& one)
{
    const glm::dvec3 z = -glm::normalize(one.direction);
    const glm::dvec3 up = std::abs(z.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    const glm::dvec3 y = glm::cross(z, x);
    const double turn = glm::radians(one.turn_degrees);
    const glm::dvec3 across = x * std::cos(turn) + y * std::sin(turn);
    const glm::dvec3 high = y * std::cos(turn) - x * std::sin(turn);
    return glm::mat4(glm::dmat4(glm::dvec4(across * one.size_m.x, 0.0),
                                glm::dvec4(high * one.size_m.y, 0.0),
                                glm::dvec4(z * one.size_m.z, 0.0), glm::dvec4(one.center_m, 1.0)));
}

void put_on_node(const ScenarioDecal& one, const scene::Scene& scene, scene::ProjectedDecal& box)
{
    std::vector<std::string> names;
    if (scene.rig) {
        for (std::size_t i = 0; i < scene.rig->nodes.size(); ++i) {
            names.push_back(scene.rig->nodes[i].name);
            if (names.back() != one.node) continue;
            box.node = static_cast<std::int32_t>(i);
            box.to_world = glm::mat4(scene::posture_at(*scene.rig, 0.0).to_world[i]) * box.in_node;
            return;
        }
    }
    for (const scene::Instance& instance : scene.instances) {
        names.push_back(instance.name);
        if (names.back() != one.node) continue;
        box.to_world = instance.to_world * glm::inverse(instance.in_node) * box.in_node;
        return;
    }
    throw Error(one.place + ": the decal \"" + one.name + "\" hangs on the node \"" + one.node +
                    "\", which is not in the scene." + did_you_mean(one.node, names),
                "Name a node, or leave `node` out.");
}

}  // namespace

std::string add_decals(const std::vector<ScenarioDecal>& decals,
                       const std::vector<MaterialOverride>& materials, scene::Scene& scene)
{
    if (decals.empty()) return "";
    Hasher hasher;
    for (const ScenarioDecal& one : decals) {
        scene::ProjectedDecal box;
        box.name = one.name;
        box.material = material_of(one, materials, scene);
        box.in_node = box.to_world = box_of(one);
        if (!one.node.empty()) put_on_node(one, scene, box);
        box.full_angle_rad = static_cast<float>(glm::radians(one.full_degrees));
        box.none_angle_rad = static_cast<float>(glm::radians(one.none_degrees));
        box.edge_fade = static_cast<float>(one.edge_fade);
        hasher.add(one.material);
        hasher.add(one.node);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) hasher.add(box.in_node[c][r]);
        for (const float v : {box.full_angle_rad, box.none_angle_rad, box.edge_fade}) hasher.add(v);
        scene.decals.push_back(std::move(box));
    }
    return hasher.text();
}

void check_decals(scene::Scene& scene)
{
    const auto check = [&](const std::string& who, const scene::Material& m) {
        if (m.surface.empty()) return;
        throw Error(who + " shows the material \"" + m.name + "\", whose `surface` is \"" + m.surface +
                        "\": a decal has no surface of its own, it lies over those of others",
                    "Give the decal a material without `surface`, or name the surface in the materials "
                    "below it.");
    };
    for (const scene::ProjectedDecal& box : scene.decals)
        check("decals: the decal \"" + box.name + "\"", scene.materials[box.material]);
    for (const scene::Material& m : scene.materials) {
        if (!m.decal.on) continue;
        check("decals: what", m);
        if (!m.lighting_model.empty() && m.lighting_model != "standard") {
            scene.warnings.push_back("decals: the material \"" + m.name + "\" has the lighting model \"" +
                                     m.lighting_model + "\", which is left out: a decal is lit as what "
                                     "lies below it");
        }
    }
}

}  // namespace petrichor::film
