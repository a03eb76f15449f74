#include "film/scenario/node_keys.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/words.h"

namespace petrichor::film {
namespace {

struct NodeRule {
    ScenarioKey key;
    void (*apply)(scene::InstanceLook&, const TomlValue&);
};

float share(const TomlValue& value)
{
    return static_cast<float>(value.number(0.0, 1.0));
}

const std::vector<NodeRule>& node_rules()
{
    static const std::vector<NodeRule> rules{
        {{"nodes", "color", "[1.0, 0.8, 0.6]",
          "linear red, green and blue for base_color_factor of its materials; 0 to 1"},
         [](scene::InstanceLook& look, const TomlValue& v) {
             const auto c = v.numbers(3, 0.0, 1.0);
             look.color = glm::vec3(static_cast<float>(c[0]), static_cast<float>(c[1]),
                                    static_cast<float>(c[2]));
         }},
        {{"nodes", "metallic", "0.0", "for metallic_factor; 0 to 1"},
         [](scene::InstanceLook& look, const TomlValue& v) { look.metallic = share(v); }},
        {{"nodes", "roughness", "0.5", "for roughness_factor; 0 to 1"},
         [](scene::InstanceLook& look, const TomlValue& v) { look.roughness = share(v); }},
        {{"nodes", "emission", "1.0",
          "times what its materials send out, as it is seen (its surroundings are lit as before); 0 to "
          "1e6"},
         [](scene::InstanceLook& look, const TomlValue& v) {
             look.emission = static_cast<float>(v.number(0.0, 1e6));
         }},
    };
    return rules;
}

std::string no_match(const NodeOverride& one, const scene::Scene& scene)
{
    std::vector<std::string> names;
    for (const scene::Instance& instance : scene.instances) {
        if (std::find(names.begin(), names.end(), instance.name) == names.end())
            names.push_back(instance.name);
        if (names.size() > 12) break;
    }
    if (names.size() > 12) names.back() = "...";
    return one.place + ": [nodes.\"" + one.glob +
           "\"] matches no node of the scene that has a mesh; there are: " + join_words(names);
}

}  // namespace

std::vector<ScenarioKey> node_keys()
{
    std::vector<ScenarioKey> keys;
    for (const NodeRule& rule : node_rules()) keys.push_back(rule.key);
    return keys;
}

std::vector<NodeOverride> read_node_overrides(const toml::table& nodes, const std::string& file)
{
    std::vector<std::string> known;
    for (const NodeRule& rule : node_rules()) known.push_back(rule.key.name);
    std::vector<std::pair<std::uint32_t, NodeOverride>> found;
    for (const auto& [glob, node] : nodes) {
        const TomlValue value(node, file, "[nodes.\"" + std::string(glob.str()) + "\"]");
        NodeOverride one{std::string(glob.str()), value.place(), {}};
        for (const auto& [key, entry] : value.entries(known)) {
            for (const NodeRule& rule : node_rules()) {
                if (rule.key.name == key) rule.apply(one.look, entry);
            }
        }
        found.emplace_back(node.source().begin.line, std::move(one));
    }
    // toml++ sorts by name; the file's order is what the user sees.
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<NodeOverride> overrides;
    for (auto& [line, one] : found) overrides.push_back(std::move(one));
    return overrides;
}

std::vector<std::string> apply_node_overrides(const std::vector<NodeOverride>& overrides,
                                              scene::Scene& scene)
{
    std::vector<std::string> unmatched;
    for (const NodeOverride& one : overrides) {
        bool matched = false;
        for (scene::Instance& instance : scene.instances) {
            if (!glob_matches(one.glob, instance.name)) continue;
            matched = true;
            const scene::InstanceLook& look = one.look;
            if (look.color) instance.look.color = look.color;
            if (look.metallic) instance.look.metallic = look.metallic;
            if (look.roughness) instance.look.roughness = look.roughness;
            if (look.emission) instance.look.emission = look.emission;
        }
        if (!matched) unmatched.push_back(no_match(one, scene));
    }
    return unmatched;
}

}  // namespace petrichor::film
