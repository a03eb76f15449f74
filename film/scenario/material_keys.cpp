#include "film/scenario/material_keys.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/words.h"
#include "film/data/folders.h"
#include "gpu/lighting/lighting_models.h"
#include "scene/material_table.h"

namespace petrichor::film {
namespace {

using scene::MaterialProperty;
using scene::PropertyKind;

constexpr const char* kLightingModel = "lighting_model";
constexpr double kAny = std::numeric_limits<float>::max();

std::string ranges(const MaterialProperty& property)
{
    if (property.kind == PropertyKind::Flag) return "";
    if (property.kind == PropertyKind::Choice) {
        std::vector<std::string> words(property.words.begin(), property.words.end());
        return "; " + join_words(words, " | ");
    }
    std::vector<std::string> all;
    for (int i = 0; i < property.count; ++i) all.push_back(property.range_text(i));
    if (std::equal(all.begin() + 1, all.end(), all.begin())) all.resize(1);
    return "; " + join_words(all, " | ");
}

void check(const MaterialProperty& property, const TomlValue& value, std::size_t i, double number)
{
    const int component = static_cast<int>(i);
    if (property.accepts(component, static_cast<float>(number))) return;
    const bool bounded = property.high[component] < static_cast<float>(kAny);
    value.refuse((bounded ? "a number from " : "a number, ") + property.range_text(component));
}

std::vector<double> read_value(const MaterialProperty& property, const TomlValue& value)
{
    switch (property.kind) {
        case PropertyKind::Flag:
            return {value.boolean() ? 1.0 : 0.0};
        case PropertyKind::Choice:
            return {
                static_cast<double>(value.choice({property.words.begin(), property.words.end()}))};
        case PropertyKind::Number:
            break;
    }
    if (property.count == 1) {
        const double number = value.number(-kAny, kAny);
        check(property, value, 0, number);
        return {number};
    }
    const auto numbers = value.numbers(static_cast<std::size_t>(property.count), -kAny, kAny);
    const auto elements = value.elements();
    for (std::size_t i = 0; i < numbers.size(); ++i) check(property, elements[i], i, numbers[i]);
    return numbers;
}

// A file is looked for beside the scenario, then among the shaders of the data.
std::string found_model(const std::string& name, const std::filesystem::path& folder)
{
    const std::filesystem::path path(name);
    if (path.extension() != ".glsl") return name;
    const std::filesystem::path beside = folder / path;
    std::error_code none;
    if (std::filesystem::exists(beside, none)) return beside.string();
    if (const auto data = find_data_folder()) {
        if (std::filesystem::exists(*data / "shaders" / path, none)) {
            return (*data / "shaders" / path).string();
        }
    }
    return beside.string();  // refused by name when the scene is loaded
}

void apply(const MaterialOverride& override, const std::filesystem::path& folder,
           scene::Material& material)
{
    if (!override.lighting_model.empty()) {
        material.lighting_model = found_model(override.lighting_model, folder);
    }
    for (const auto& [name, values] : override.values) {
        glm::vec4 value(0.0f);
        for (std::size_t i = 0; i < values.size(); ++i) {
            value[static_cast<int>(i)] = static_cast<float>(values[i]);
        }
        scene::find_property(name)->set(material, value);
    }
}

}  // namespace

std::vector<ScenarioKey> material_keys()
{
    std::vector<ScenarioKey> keys;
    for (const MaterialProperty& property : scene::material_table()) {
        keys.push_back({.table = "materials",
                        .name = std::string(property.name),
                        .example = property.value_text(scene::default_value(property)),
                        .meaning = std::string(property.help) + ranges(property)});
    }
    keys.push_back({.table = "materials",
                    .name = kLightingModel,
                    .example = "\"standard\"",
                    .meaning = "how it answers to light: " +
                               join_words(gpu::built_in_lighting_models(), " | ") +
                               ", or a GLSL file of your own as data/shaders/minnaert.glsl"});
    return keys;
}

std::vector<MaterialOverride> read_material_overrides(const toml::table& materials,
                                                      const std::string& file)
{
    std::vector<std::string> known;
    for (const MaterialProperty& property : scene::material_table()) {
        known.emplace_back(property.name);
    }
    known.emplace_back(kLightingModel);
    std::vector<std::pair<std::uint32_t, MaterialOverride>> found;
    for (const auto& [glob, node] : materials) {
        const TomlValue value(node, file, "[materials.\"" + std::string(glob.str()) + "\"]");
        MaterialOverride one{std::string(glob.str()), value.place(), {}};
        for (const auto& [name, entry] : value.entries(known)) {
            if (name == kLightingModel) {
                one.lighting_model = entry.text();
                continue;
            }
            one.values.emplace_back(name, read_value(*scene::find_property(name), entry));
        }
        found.emplace_back(node.source().begin.line, std::move(one));
    }
    // toml++ sorts by name; the file's order is what the user sees.
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<MaterialOverride> overrides;
    for (auto& [line, one] : found) overrides.push_back(std::move(one));
    return overrides;
}

std::vector<std::string> apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                                  const std::filesystem::path& folder,
                                                  std::vector<scene::Material>& materials)
{
    std::vector<std::string> unmatched;
    for (const MaterialOverride& one : overrides) {
        bool matched = false;
        for (scene::Material& material : materials) {
            if (!glob_matches(one.glob, material.name)) continue;
            matched = true;
            apply(one, folder, material);
        }
        if (matched) continue;
        std::vector<std::string> names;
        for (const scene::Material& material : materials) names.push_back(material.name);
        if (names.size() > 12) {
            names.resize(12);
            names.push_back("...");
        }
        unmatched.push_back(
            one.place + ": [materials.\"" + one.glob +
            "\"] matches no material of the scene; there are: " + join_words(names));
    }
    return unmatched;
}

}  // namespace petrichor::film
