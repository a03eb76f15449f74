#include "film/scenario/material_keys.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "base/hash.h"
#include "base/input_file.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "gpu/lighting/lighting_models.h"
#include "scene/material_table.h"

namespace petrichor::film {
namespace {

using scene::MaterialProperty;
using scene::PropertyKind;

constexpr const char* kLightingModel = "lighting_model";
constexpr const char* kSurface = "surface";
constexpr const char* kPreset = "preset";
constexpr const char* kTiling = "tiling";
constexpr std::uint64_t kLargestTexture = 1ull << 30;  // bytes of a file
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

std::vector<KeyedNumber> constant(double number)
{
    return {KeyedNumber{{{0.0, number}}}};
}

std::vector<KeyedNumber> read_value(const MaterialProperty& property, const TomlValue& value)
{
    switch (property.kind) {
        case PropertyKind::Flag:
            return constant(value.boolean() ? 1.0 : 0.0);
        case PropertyKind::Choice:
            return constant(value.choice({property.words.begin(), property.words.end()}));
        case PropertyKind::Number:
            break;
    }
    const auto count = static_cast<std::size_t>(property.count);
    std::vector<KeyedNumber> channels = value.keyed_numbers(count, -kAny, kAny);
    for (std::size_t i = 0; i < count; ++i) {
        const bool moves = channels[i].keys.size() > 1;
        if (moves && !property.keyed) value.refuse("a value without keys over time");
        for (const NumberKey& key : channels[i].keys) {
            // A plain array names the element that is wrong.
            const bool plain = count > 1 && !moves && value.elements().size() == count;
            check(property, plain ? value.elements()[i] : value, i, key.value);
        }
    }
    return channels;
}

glm::vec4 value_of(const std::vector<KeyedNumber>& channels, double time_s)
{
    glm::vec4 value(0.0f);
    for (std::size_t i = 0; i < channels.size(); ++i)
        value[static_cast<int>(i)] = static_cast<float>(value_at(channels[i], time_s));
    return value;
}

bool moves(const std::vector<KeyedNumber>& channels)
{
    return channels[0].keys.size() > 1;
}

const scene::MaterialTexture* find_slot(const std::string& name)
{
    for (const scene::MaterialTexture& slot : scene::material_textures()) {
        if (slot.name == name) return &slot;
    }
    return nullptr;
}

// The textures that a scenario brings into a scene: a file is read once, and stands there once for
// each way of wrapping.
class TexturesOfFiles {
public:
    TexturesOfFiles(const std::filesystem::path& folder, scene::Scene& scene)
        : folder_(folder), scene_(scene)
    {
    }

    scene::TextureIndex index_of(const std::string& file, const std::string& place,
                                 const scene::TextureUse& replaced)
    {
        scene::EncodedImage image;
        image.name = file;
        if (replaced.present()) {
            const auto& old = scene_.textures[static_cast<std::size_t>(replaced.texture)];
            image.wrap_u = old.wrap_u;
            image.wrap_v = old.wrap_v;
            image.nearest = old.nearest;
        }
        const auto key = std::make_tuple(file, image.wrap_u, image.wrap_v, image.nearest);
        const auto found = made_.find(key);
        if (found != made_.end()) return found->second;
        const std::string bytes = read_file(folder_ / file, place + ": texture", kLargestTexture);
        hasher_.add(file);
        hasher_.add_bytes(std::as_bytes(std::span(bytes)));
        image.bytes.resize(bytes.size());
        std::memcpy(image.bytes.data(), bytes.data(), bytes.size());
        const auto index = static_cast<scene::TextureIndex>(scene_.textures.size());
        scene_.textures.push_back(std::move(image));
        return made_[key] = index;
    }

    std::string fingerprint() const { return made_.empty() ? "" : hasher_.text(); }

private:
    const std::filesystem::path& folder_;
    scene::Scene& scene_;
    std::map<std::tuple<std::string, scene::Wrap, scene::Wrap, bool>, scene::TextureIndex> made_;
    Hasher hasher_;
};

void apply(const MaterialOverride& override, const std::filesystem::path& folder,
           TexturesOfFiles& textures, scene::Material& material)
{
    if (!override.lighting_model.empty()) {
        material.lighting_model = find_shader(override.lighting_model, folder);
    }
    if (!override.surface.empty()) material.surface = find_shader(override.surface, folder);
    for (const auto& [name, channels] : override.values)
        scene::find_property(name)->set(material, value_of(channels, -kAny));
    for (const auto& [name, file] : override.textures) {
        scene::TextureUse& use = find_slot(name)->edit(material);
        use.texture = file.empty() ? scene::kNoTexture
                                   : textures.index_of(file, override.place, use);
    }
    for (scene::TextureUse* use :
         {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture, &material.weather.height}) {
        use->scale *= override.tiling;
    }
}

// What the words of `preset` stand for.
struct Preset {
    const char* word;
    scene::AlphaMode alpha;
    bool premultiplied, casts_shadows, double_sided;
};
constexpr Preset kPresets[] = {
    {"opaque", scene::AlphaMode::Opaque, false, true, false},
    {"clip", scene::AlphaMode::Mask, false, true, false},
    {"clip double-sided", scene::AlphaMode::Mask, false, true, true},
    {"fade", scene::AlphaMode::Blend, false, false, false},
    {"fade with shadows", scene::AlphaMode::Blend, false, true, false},
    {"transparent", scene::AlphaMode::Blend, true, false, false},
    {"transparent with shadows", scene::AlphaMode::Blend, true, true, false},
};

std::vector<std::string> preset_words()
{
    std::vector<std::string> words;
    for (const Preset& preset : kPresets) words.emplace_back(preset.word);
    return words;
}

// Keys beside it win.
void put_preset(const TomlValue& value, MaterialOverride& one)
{
    const Preset& preset = kPresets[value.choice(preset_words())];
    const std::pair<const char*, double> rows[] = {
        {"alpha_mode", static_cast<double>(preset.alpha)},
        {"premultiplied_alpha", preset.premultiplied ? 1.0 : 0.0},
        {"casts_shadows", preset.casts_shadows ? 1.0 : 0.0},
        {"double_sided", preset.double_sided ? 1.0 : 0.0}};
    std::vector<std::pair<std::string, std::vector<KeyedNumber>>> values;
    for (const auto& [name, number] : rows) values.emplace_back(name, constant(number));
    one.values.insert(one.values.begin(), values.begin(), values.end());
}

std::string no_match(const MaterialOverride& one, const std::vector<scene::Material>& materials)
{
    std::vector<std::string> names;
    for (const scene::Material& material : materials) names.push_back(material.name);
    if (names.size() > 12) {
        names.resize(12);
        names.push_back("...");
    }
    return one.place + ": [materials.\"" + one.glob +
           "\"] matches no material of the scene; there are: " + join_words(names);
}

}  // namespace

std::vector<ScenarioKey> material_keys()
{
    std::vector<ScenarioKey> keys;
    for (const MaterialProperty& property : scene::material_table()) {
        const bool vector = property.keyed && property.count > 1;
        keys.push_back({.table = "materials",
                        .name = std::string(property.name),
                        .example = property.value_text(scene::default_value(property)),
                        .meaning = std::string(property.help) + ranges(property) +
                                   (vector ? " (keyed: [[time_s, [..]], ...])" : ""),
                        .keyed = property.keyed && !vector});
    }
    for (const scene::MaterialTexture& slot : scene::material_textures()) {
        keys.push_back({.table = "materials",
                        .name = std::string(slot.name),
                        .example = "\"" + std::string(slot.name) + ".png\"",
                        .meaning = "an image relative to this file instead of the scene's, \"\" "
                                   "for none: " +
                                   std::string(slot.help)});
    }
    keys.push_back({.table = "materials",
                    .name = kLightingModel,
                    .example = "\"standard\"",
                    .meaning = "how it answers to light: " +
                               join_words(gpu::built_in_lighting_models(), " | ") +
                               ", or a GLSL file of your own as data/shaders/minnaert.glsl"});
    keys.push_back({.table = "materials",
                    .name = kSurface,
                    .example = "\"moss.glsl\"",
                    .meaning = "a GLSL file of your own that changes the dry surface or its masks, as "
                               "data/shaders/moss.glsl"});
    keys.push_back({.table = "materials",
                    .name = kPreset,
                    .example = "\"opaque\"",
                    .meaning = "alpha_mode, premultiplied_alpha, casts_shadows and double_sided in one "
                               "word: " +
                               join_words(preset_words(), " | ") + "; keys beside it win"});
    keys.push_back({.table = "materials",
                    .name = kTiling,
                    .example = "[1.0, 1.0]",
                    .meaning = "repeats of colour, normal, roughness, occlusion, emission and height, times their "
                               "own; 0 to 10000"});
    return keys;
}

std::vector<MaterialOverride> read_material_overrides(const toml::table& materials,
                                                      const std::string& file)
{
    std::vector<std::string> known;
    for (const MaterialProperty& property : scene::material_table()) {
        known.emplace_back(property.name);
    }
    for (const scene::MaterialTexture& slot : scene::material_textures())
        known.emplace_back(slot.name);
    known.emplace_back(kLightingModel);
    known.emplace_back(kSurface);
    known.emplace_back(kPreset);
    known.emplace_back(kTiling);
    std::vector<std::pair<std::uint32_t, MaterialOverride>> found;
    for (const auto& [glob, node] : materials) {
        const TomlValue value(node, file, "[materials.\"" + std::string(glob.str()) + "\"]");
        MaterialOverride one{std::string(glob.str()), value.place(), {}};
        for (const auto& [name, entry] : value.entries(known)) {
            if (name == kLightingModel) {
                one.lighting_model = entry.text();
            } else if (name == kSurface) {
                one.surface = entry.text();
                if (!one.surface.ends_with(".glsl")) entry.refuse("a file that ends in .glsl");
            } else if (name == kPreset) {
                put_preset(entry, one);
            } else if (name == kTiling) {
                const auto both = entry.numbers(2, 0.0, 10000.0);
                one.tiling = {static_cast<float>(both[0]), static_cast<float>(both[1])};
            } else if (find_slot(name)) {
                one.textures.emplace_back(name, entry.text());
            } else {
                one.values.emplace_back(name, read_value(*scene::find_property(name), entry));
            }
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

AppliedOverrides apply_material_overrides(const std::vector<MaterialOverride>& overrides,
                                          const std::filesystem::path& folder, scene::Scene& scene)
{
    AppliedOverrides applied;
    TexturesOfFiles textures(folder, scene);
    for (const MaterialOverride& one : overrides) {
        bool matched = false;
        for (scene::Material& material : scene.materials) {
            if (!glob_matches(one.glob, material.name)) continue;
            matched = true;
            apply(one, folder, textures, material);
        }
        if (!matched) applied.unmatched.push_back(no_match(one, scene.materials));
    }
    applied.textures = textures.fingerprint();
    return applied;
}

std::vector<scene::MaterialChange> material_changes(const std::vector<MaterialOverride>& overrides,
                                                    const std::vector<scene::Material>& materials,
                                                    double time_s)
{
    std::map<std::pair<std::uint32_t, std::string_view>, glm::vec4> values;
    for (const MaterialOverride& one : overrides) {
        for (std::uint32_t i = 0; i < materials.size(); ++i) {
            if (!glob_matches(one.glob, materials[i].name)) continue;
            for (const auto& [name, channels] : one.values) {
                const std::string_view property = scene::find_property(name)->name;
                // A later table wins, with or without keys.
                values.erase({i, property});
                if (moves(channels)) values[{i, property}] = value_of(channels, time_s);
            }
        }
    }
    std::vector<scene::MaterialChange> changes;
    for (const auto& [what, value] : values) changes.push_back({what.first, what.second, value});
    return changes;
}

}  // namespace petrichor::film
