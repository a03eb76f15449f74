#include "cli/texture/maps/material_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/words.h"
#include "cli/rooms.h"
#include "film/data/folders.h"
#include "film/toml/toml_value.h"
#include "formulas/color/srgb.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> kind_names()
{
    std::vector<std::string> names;
    for (const texproc::MaterialKindInfo& kind : texproc::material_kinds()) names.push_back(kind.name);
    return names;
}

const texproc::MaterialKindInfo& info_of(texproc::MaterialKind kind)
{
    return texproc::material_kinds()[static_cast<std::size_t>(kind)];
}

}  // namespace

glm::vec3 parse_color(std::string_view text, const std::string& what)
{
    const auto refuse = [&]() -> glm::vec3 {
        throw Error(what + ": '" + std::string(text) + "' is no colour", "Write #rrggbb, for example #8a7d6b.");
    };
    if (text.empty() || text.front() != '#' || (text.size() != 7 && text.size() != 4)) return refuse();
    const bool brief = text.size() == 4;
    glm::vec3 color(0.0f);
    for (int c = 0; c < 3; ++c) {
        const std::string_view digits =
            brief ? text.substr(1 + static_cast<std::size_t>(c), 1) : text.substr(1 + 2 * static_cast<std::size_t>(c), 2);
        unsigned code = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        if (error != std::errc() || end != digits.data() + digits.size()) return refuse();
        color[c] = shared::linear_from_srgb(static_cast<float>(brief ? 17 * code : code) / 255.0f);
    }
    return color;
}

NamedMaterial read_material_file(const fs::path& file)
{
    const toml::table table = parse_toml(read_toml_text(file, "material"), file.string());
    NamedMaterial material;
    material.name = file.stem().string();
    const TomlValue whole(table, file.string(), "material");
    const auto entries = whole.entries({"kind", "note", "color", "parameters"});
    for (const auto& [key, value] : entries) {
        if (key == "kind") {
            const std::vector<std::string> names = kind_names();
            material.kind = names[static_cast<std::size_t>(value.choice(names))];
            material.recipe.kind = *texproc::find_material_kind(material.kind);
        }
        if (key == "note") material.note = value.text();
        if (key == "color") material.recipe.color = parse_color(value.text(), value.place() + ": color");
    }
    if (material.kind.empty()) {
        throw Error(file.string() + ": no kind", "Write a line such as: kind = \"gravel\"");
    }
    std::vector<std::string> names;
    for (const texproc::MaterialParameter& parameter : info_of(material.recipe.kind).parameters)
        names.push_back(parameter.name);
    for (const auto& [key, value] : entries) {
        if (key != "parameters") continue;
        for (const auto& [name, number] : value.entries(names)) {
            const auto& parameters = info_of(material.recipe.kind).parameters;
            const auto found = std::find_if(parameters.begin(), parameters.end(),
                                            [&](const auto& p) { return p.name == name; });
            material.recipe.values[name] = static_cast<float>(
                number.number(static_cast<double>(found->low), static_cast<double>(found->high)));
        }
    }
    return material;
}

std::vector<std::string> material_presets()
{
    std::vector<std::string> names;
    const auto folder = find_data_folder();
    std::error_code none;
    if (!folder) return names;
    for (const fs::directory_entry& entry : fs::directory_iterator(*folder / "materials", none)) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

NamedMaterial named_material(const std::string& text)
{
    if (fs::path(text).extension() == ".toml") return read_material_file(text);
    if (const auto kind = texproc::find_material_kind(text)) {
        NamedMaterial material{text, text, {}, {}};
        material.recipe.kind = *kind;
        return material;
    }
    std::vector<std::string> names = kind_names();
    const std::vector<std::string> presets = material_presets();
    if (std::find(presets.begin(), presets.end(), text) != presets.end())
        return read_material_file(data_folder() / "materials" / (text + ".toml"));
    names.insert(names.end(), presets.begin(), presets.end());
    throw Error("texture generate: there is no material '" + text + "'." + did_you_mean(text, names),
                "Use one of " + join_words(names) + ", or a file of yours (.toml).");
}

void set_parameter(texproc::MaterialRecipe& recipe, const std::string& assignment)
{
    const std::size_t at = assignment.find('=');
    float value = 0.0f;
    const char* const end = assignment.data() + assignment.size();
    const auto read = at == std::string::npos ? std::from_chars_result{end, std::errc::invalid_argument}
                                              : std::from_chars(assignment.data() + at + 1, end, value);
    if (at == 0 || read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) {
        throw Error("texture generate: '" + assignment + "' is no parameter with a number",
                    "Write NAME=NUMBER, for example --set cracks=0.8; --list NAME shows the names.");
    }
    recipe.values[assignment.substr(0, at)] = value;
}

std::string material_file_text(const NamedMaterial& material)
{
    std::string text = "kind = " + toml_quoted(material.kind) + "\n";
    if (!material.note.empty()) text += "note = " + toml_quoted(material.note) + "\n";
    if (material.recipe.color) {
        static constexpr char kDigits[] = "0123456789abcdef";
        text += "color = \"#";
        for (int c = 0; c < 3; ++c) {
            const int code = static_cast<int>(std::lround(255.0f * shared::srgb_from_linear((*material.recipe.color)[c])));
            text += kDigits[code / 16];
            text += kDigits[code % 16];
        }
        text += "\"\n";
    }
    text += "\n[parameters]\n";
    for (const texproc::MaterialParameter& parameter : info_of(material.recipe.kind).parameters) {
        const auto found = material.recipe.values.find(parameter.name);
        const float value = found == material.recipe.values.end() ? parameter.usual : found->second;
        text += parameter.name + " = " + number_text(value) + "  # " + parameter.unit +
                ": " + parameter.meaning + "\n";
    }
    return text;
}

}  // namespace petrichor::cli
