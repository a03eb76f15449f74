#include "film/scenario/lamp_keys.h"

#include <algorithm>

#include "base/words.h"
#include "scene/light_shape.h"

namespace petrichor::film {
namespace {

const scene::LightProperty* find_row(const std::string& name)
{
    for (const scene::LightProperty& row : scene::light_table()) {
        if (row.name == name) return &row;
    }
    return nullptr;
}

std::string range_of(const scene::LightProperty& row)
{
    if (row.flag) return "";
    return "; " + number_text(row.low) + " to " +
           number_text(row.high);
}

}  // namespace

std::vector<ScenarioKey> lamp_keys()
{
    std::vector<ScenarioKey> keys;
    const auto add = [&](std::string name, std::string example, std::string meaning) {
        keys.push_back({.table = "lamps",
                        .name = std::move(name),
                        .example = std::move(example),
                        .meaning = std::move(meaning)});
    };
    for (const scene::LightProperty& row : scene::light_table())
        add(std::string(row.name), std::string(row.example), std::string(row.help) + range_of(row));
    add("both_sides", "false", "of a rectangle: it shines from its back too");
    add("color", "[1.0, 0.8, 0.6]", "linear red, green and blue instead of the scene's; 0 to 1");
    add("intensity", "100.0", "candela instead of the scene's, lux of a directional light; 0 to 1e9");
    add("range_m", "10.0", "nothing farther away is lit; 0: unlimited; 0 to 5000");
    add("profile", "\"spot.ies\"",
        "how it shines by direction, relative to this file: measured (.ies, LM-63 type C; candela too, "
        "unless intensity is given), or a picture before a spot");
    return keys;
}

std::vector<LampOverride> read_lamp_overrides(const toml::table& lamps, const std::string& file)
{
    std::vector<std::string> known;
    for (const ScenarioKey& key : lamp_keys()) known.push_back(key.name);
    std::vector<std::pair<std::uint32_t, LampOverride>> found;
    for (const auto& [glob, node] : lamps) {
        const TomlValue value(node, file, "[lamps.\"" + std::string(glob.str()) + "\"]");
        LampOverride one;
        one.glob = std::string(glob.str());
        one.place = value.place();
        for (const auto& [name, entry] : value.entries(known)) {
            if (const scene::LightProperty* row = find_row(name); row && row->flag) {
                one.shape.emplace_back(name, entry.boolean() ? 1.0f : 0.0f);
            } else if (row) {
                one.shape.emplace_back(name, static_cast<float>(entry.number(
                                                 static_cast<double>(row->low),
                                                 static_cast<double>(row->high))));
            } else if (name == "both_sides") {
                one.both_sides = entry.boolean();
            } else if (name == "color") {
                const auto c = entry.numbers(3, 0.0, 1.0);
                one.color = glm::vec3(static_cast<float>(c[0]), static_cast<float>(c[1]),
                                      static_cast<float>(c[2]));
            } else if (name == "intensity") {
                one.intensity = static_cast<float>(entry.number(0.0, 1e9));
            } else if (name == "range_m") {
                one.range_m = static_cast<float>(entry.number(0.0, 5000.0));
            } else {
                one.profile = entry.text();
            }
        }
        found.emplace_back(node.source().begin.line, std::move(one));
    }
    // toml++ sorts by name; the file's order is what the user sees.
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<LampOverride> overrides;
    for (auto& [line, one] : found) overrides.push_back(std::move(one));
    return overrides;
}

}  // namespace petrichor::film
