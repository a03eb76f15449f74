#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/gltf/detail/gltf_levels.h"

namespace petrichor::scene {

namespace {

constexpr const char* kFixLevels = "Let every level be a root node of its own, outside of the scene.";

// Without coverages each level is shown down to half the size of the one before.
std::vector<float> coverages(const JsonObject& node, std::size_t levels)
{
    std::vector<float> values;
    const auto extras = node.object("extras");
    const std::size_t given = extras ? extras->array("MSFT_screencoverage").size() : 0;
    if (given == levels || given + 1 == levels) {
        values.resize(given);
        extras->numbers("MSFT_screencoverage", values);
        float before = std::numeric_limits<float>::max();
        for (float& value : values) {
            if (!(value >= 0.0f) || value > before) {
                extras->warn("MSFT_screencoverage", "must fall from level to level; it is not used");
                values.clear();
                break;
            }
            before = value;
        }
    } else if (given != 0) {
        extras->warn("MSFT_screencoverage",
                     "has not as many numbers as there are levels; it is not used");
    }
    if (values.empty()) {
        for (std::size_t i = 0; i + 1 < levels; ++i)
            values.push_back(0.25f * std::pow(0.5f, static_cast<float>(i)));
    }
    values.resize(levels, 0.0f);
    return values;
}

}  // namespace

DetailGroups::DetailGroups(const JsonArray& nodes, const std::vector<std::int32_t>& parents)
    : parents_(parents), node_count_(nodes.size()), taken_(nodes.size(), false)
{
}

std::vector<std::pair<std::uint32_t, DetailGroups::Place>> DetailGroups::open(const JsonObject& node,
                                                                              Place& place)
{
    std::vector<std::pair<std::uint32_t, Place>> levels;
    const auto extension = node.extension("MSFT_lod");
    if (!extension) return levels;
    if (place.group >= 0) {
        node.warn("extensions", "MSFT_lod inside of a level of detail is not read");
        return levels;
    }
    const JsonArray ids = extension->array("ids");
    if (ids.size() == 0) return levels;
    place = {static_cast<std::int32_t>(groups_.size()), 0};
    groups_.push_back({coverages(node, ids.size() + 1)});
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::uint32_t level = ids.index(i, "node", node_count_);
        if (parents_[level] >= 0 || taken_[level]) {
            node.log().fail(ids.path_to(i),
                            "node " + std::to_string(level) + " is part of the scene already",
                            kFixLevels);
        }
        taken_[level] = true;
        levels.push_back({level, {place.group, static_cast<std::uint32_t>(i + 1)}});
    }
    return levels;
}

void DetailGroups::placed(const Place& place, std::size_t count)
{
    places_.insert(places_.end(), count, place);
}

void DetailGroups::finish(Scene& scene) const
{
    const glm::vec3 none(std::numeric_limits<float>::max());
    std::vector<Bounds> boxes(groups_.size(), Bounds{none, -none});
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (places_[i].group < 0 || places_[i].level != 0) continue;
        const Instance& instance = scene.instances[i];
        Bounds& box = boxes[static_cast<std::size_t>(places_[i].group)];
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                const glm::vec3 world(instance.to_world * glm::vec4(position, 1.0f));
                box.low = glm::min(box.low, world);
                box.high = glm::max(box.high, world);
            }
        }
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Place& place = places_[i];
        if (place.group < 0) continue;
        const Bounds& box = boxes[static_cast<std::size_t>(place.group)];
        const std::vector<float>& coverage = groups_[static_cast<std::size_t>(place.group)].coverage;
        if (!(box.high.x >= box.low.x)) continue;
        DetailLevel& detail = scene.instances[i].detail;
        detail.level = place.level;
        detail.low = coverage[place.level];
        detail.high = place.level > 0 ? coverage[place.level - 1] : 0.0f;
        detail.centre_m = 0.5f * (box.low + box.high);
        detail.radius_m = std::max(0.5f * glm::length(box.high - box.low), 1.0e-6f);
    }
}

}  // namespace petrichor::scene
