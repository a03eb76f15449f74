#ifndef PETRICHOR_SCENE_DETAIL_MATERIAL_ROW_H
#define PETRICHOR_SCENE_DETAIL_MATERIAL_ROW_H

// How rows of the material table are written.

#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/material_table.h"

namespace petrichor::scene::detail {

using M = Material;
using W = MaterialWeather;
using Maps = LayerTextures;
using Row = MaterialProperty;

inline constexpr float kLargest = std::numeric_limits<float>::max();
inline constexpr std::string_view kWeather = "PETRICHOR_materials_weather";
inline constexpr std::string_view kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";
inline constexpr std::string_view kIridescence = "KHR_materials_iridescence";
inline constexpr std::string_view kTwoLobes = "PETRICHOR_materials_two_lobes";
inline constexpr std::string_view kPbr = "pbrMetallicRoughness";

// The member at the end of a chain of pointers to members.
template <auto First, auto... Rest>
auto& follow(auto& object)
{
    if constexpr (sizeof...(Rest) == 0) {
        return object.*First;
    } else {
        return follow<Rest...>(object.*First);
    }
}

template <typename T>
constexpr int components()
{
    if constexpr (std::is_same_v<T, glm::vec2>) return 2;
    if constexpr (std::is_same_v<T, glm::vec3>) return 3;
    if constexpr (std::is_same_v<T, glm::vec4>) return 4;
    return 1;
}

template <auto... Path>
glm::vec4 get(const Material& material)
{
    const auto& value = follow<Path...>(material);
    using T = std::remove_cvref_t<decltype(value)>;
    glm::vec4 out(0.0f);
    if constexpr (components<T>() == 1) {
        out.x = static_cast<float>(value);
    } else {
        for (int i = 0; i < components<T>(); ++i) out[i] = value[i];
    }
    return out;
}

template <auto... Path>
void set(Material& material, const glm::vec4& in)
{
    auto& value = follow<Path...>(material);
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<T, bool>) {
        value = in.x != 0.0f;
    } else if constexpr (components<T>() == 1) {
        value = static_cast<T>(in.x);
    } else {
        for (int i = 0; i < components<T>(); ++i) value[i] = in[i];
    }
}

template <auto... Path>
Row row(std::string_view name, PropertyKind kind, GltfPlace gltf, std::string_view help)
{
    using T = std::remove_cvref_t<decltype(follow<Path...>(std::declval<Material&>()))>;
    Row r{.name = name, .kind = kind, .count = components<T>(), .gltf = gltf, .help = help};
    r.get = get<Path...>;
    r.set = set<Path...>;
    return r;
}

template <auto... Path>
Row number(std::string_view name, glm::vec4 low, glm::vec4 high, GltfPlace gltf,
           std::string_view help)
{
    Row r = row<Path...>(name, PropertyKind::Number, gltf, help);
    r.low = low;
    r.high = high;
    r.keyed = true;
    return r;
}

template <auto... Path>
Row number(std::string_view name, float low, float high, GltfPlace gltf, std::string_view help)
{
    return number<Path...>(name, glm::vec4(low), glm::vec4(high), gltf, help);
}

template <auto... Path>
Row flag(std::string_view name, GltfPlace gltf, std::string_view help)
{
    return row<Path...>(name, PropertyKind::Flag, gltf, help);
}

template <auto... Path>
Row choice(std::string_view name, std::vector<std::string_view> words, GltfPlace gltf,
           std::string_view help)
{
    Row r = row<Path...>(name, PropertyKind::Choice, gltf, help);
    r.high = glm::vec4(static_cast<float>(words.size() - 1));
    r.words = std::move(words);
    return r;
}

template <auto... Path>
Row channel(std::string_view name, std::string_view texture, std::string_view help)
{
    return choice<Path...>(name, {"r", "g", "b", "a"}, {kWeather, texture, "channel"}, help);
}

inline Row or_also(Row r, float value)
{
    r.also = value;
    return r;
}

template <auto... Path>
MaterialTexture texture(std::string_view name, GltfPlace gltf, std::string_view help)
{
    return {name, gltf, help,
            [](const Material& m) -> const TextureUse& { return follow<Path...>(m); },
            [](Material& m) -> TextureUse& { return follow<Path...>(m); }};
}

/// Textures of layers (scene/layer_texture_rows.cpp), and what of a scene's no shader shows.
void add_layer_textures(std::vector<MaterialTexture>& table);
void add_layer_limits(const Scene& scene, std::vector<std::string>& lines);
/// Rows of displacement.
void add_displacement_rows(std::vector<MaterialProperty>& table);

/// Rows of the second set of textures.
void add_second_set_rows(std::vector<MaterialProperty>& table);
/// Rows of a ground of layers.
void add_ground_layer_rows(std::vector<MaterialProperty>& table);
void add_decal_rows(std::vector<MaterialProperty>& table);
void add_wind_rows(std::vector<MaterialProperty>& table);
void add_second_set_textures(std::vector<MaterialTexture>& table);

}  // namespace petrichor::scene::detail

#endif
