#include "film/scenario/decal_keys.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace petrichor::film {
namespace {

struct DecalRule {
    ScenarioKey key;
    void (*apply)(ScenarioDecal&, const TomlValue&);
};

const std::vector<DecalRule>& decal_rules()
{
    static const std::vector<DecalRule> rules{
        {{"decals", "material", "\"poster\"",
          "what is projected: a material of the scene, or one that [materials.\"poster\"] describes; "
          "without it the name of the table"},
         [](ScenarioDecal& d, const TomlValue& v) { d.material = v.text(); }},
        {{"decals", "center_m", "[0.0, 0.0, 0.0]", "of its box"},
         [](ScenarioDecal& d, const TomlValue& v) { d.center_m = v.point(); }},
        {{"decals", "size_m", "[1.0, 1.0, 0.5]",
          "width and height of the picture, depth of the box; 0.001 to 10000 each"},
         [](ScenarioDecal& d, const TomlValue& v) {
             const auto n = v.numbers(3, 0.001, 10000.0);
             d.size_m = {n[0], n[1], n[2]};
         }},
        {{"decals", "direction", "[0.0, -1.0, 0.0]", "the way it is projected"},
         [](ScenarioDecal& d, const TomlValue& v) {
             d.direction = v.point();
             if (!(glm::length(d.direction) > 1e-6)) v.refuse("a direction, not a point");
         }},
        {{"decals", "turn_degrees", "0.0",
          "of the picture, counter-clockwise; at 0 its top is up, on the ground -z; -360 to 360"},
         [](ScenarioDecal& d, const TomlValue& v) { d.turn_degrees = v.number(-360.0, 360.0); }},
        {{"decals", "fade_degrees", "[46.0, 75.0]",
          "faces that turn from it by more than the first fade, beyond the second there is none; 0 to "
          "180"},
         [](ScenarioDecal& d, const TomlValue& v) {
             const auto n = v.numbers(2, 0.0, 180.0);
             if (!(n[1] > n[0])) v.refuse("two angles, the second larger");
             d.full_degrees = n[0];
             d.none_degrees = n[1];
         }},
        {{"decals", "edge_fade", "0.0", "share of the half box over which it fades, 0 to 1"},
         [](ScenarioDecal& d, const TomlValue& v) { d.edge_fade = v.number(0.0, 1.0); }},
        {{"decals", "node", "\"\"",
          "a node of the scene that carries it: center_m and direction are in its space"},
         [](ScenarioDecal& d, const TomlValue& v) { d.node = v.text(); }},
    };
    return rules;
}

}  // namespace

std::vector<ScenarioKey> decal_keys()
{
    std::vector<ScenarioKey> keys;
    for (const DecalRule& rule : decal_rules()) keys.push_back(rule.key);
    return keys;
}

std::vector<ScenarioDecal> read_decals(const toml::table& decals, const std::string& file)
{
    std::vector<std::string> known;
    for (const DecalRule& rule : decal_rules()) known.push_back(rule.key.name);
    std::vector<std::pair<std::uint32_t, ScenarioDecal>> found;
    for (const auto& [name, node] : decals) {
        const TomlValue value(node, file, "[decals.\"" + std::string(name.str()) + "\"]");
        ScenarioDecal one;
        one.name = one.material = std::string(name.str());
        one.place = value.place();
        for (const auto& [key, entry] : value.entries(known)) {
            for (const DecalRule& rule : decal_rules()) {
                if (rule.key.name == key) rule.apply(one, entry);
            }
        }
        found.emplace_back(node.source().begin.line, std::move(one));
    }
    // toml++ sorts by name; of two of one order the later lies over the earlier.
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<ScenarioDecal> out;
    for (auto& [line, one] : found) out.push_back(std::move(one));
    return out;
}

}  // namespace petrichor::film
