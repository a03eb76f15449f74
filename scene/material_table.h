#ifndef PETRICHOR_SCENE_MATERIAL_TABLE_H
#define PETRICHOR_SCENE_MATERIAL_TABLE_H

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Where glTF keeps a property: extensions.EXTENSION.PARENT.MEMBER of a material, the empty parts
/// left out. An empty member: that the extension is there says it all.
struct GltfPlace {
    std::string_view extension;
    std::string_view parent;
    std::string_view member;
};

enum class PropertyKind {
    Number,  ///< one to four numbers
    Flag,    ///< false or true, 0 or 1
    Choice,  ///< one of `words`, by its index
};

/// One property of a material, told once: glTF in and out, the keys of [materials."glob"] in a
/// scenario, `petrichor init`, range checks and upload are made from these rows.
struct MaterialProperty {
    std::string_view name;  ///< glTF's own in snake case, with the unit; also the shader's
    PropertyKind kind = PropertyKind::Number;
    int count = 1;         ///< numbers, 1..4
    glm::vec4 low{0.0f};   ///< smallest value, by component
    glm::vec4 high{1.0f};  ///< largest value, by component
    GltfPlace gltf;
    std::string_view help;                     ///< one line
    std::vector<std::string_view> words = {};  ///< of a Choice, as glTF writes them
    /// A value that means something though it is out of range; NaN: there is none.
    float also = std::numeric_limits<float>::quiet_NaN();
    bool shaded = true;  ///< false: read and kept, but no shader knows it yet (unshaded_properties)
    bool at_load = false;  ///< shapes the mesh when a sequence is loaded; the renderer knows it not
    bool keyed = false;  ///< may have another value in every frame of a film
    glm::vec4 (*get)(const Material&) = nullptr;  ///< the first `count` components count
    void (*set)(Material&, const glm::vec4&) = nullptr;

    bool accepts(int component, float value) const;
    /// The values of a component, for messages and documentation: "0 to 1", "0 or more, or -1".
    std::string range_text(int component) const;
    /// A value as TOML and JSON write it.
    std::string value_text(const glm::vec4& value) const;
};

/// All rows, in the order in which they are documented.
const std::vector<MaterialProperty>& material_table();
/// The row of that name; null when there is none.
const MaterialProperty* find_property(std::string_view name);
/// The value of a material that says nothing.
glm::vec4 default_value(const MaterialProperty& property);

/// A property of a material that has another value in one frame than when the scene was loaded.
struct MaterialChange {
    std::uint32_t material = 0;      ///< index into Scene::materials
    std::string_view property = {};  ///< name of a row that is keyed
    glm::vec4 value{0.0f};

    bool operator==(const MaterialChange&) const = default;
};

/// One texture of a material.
struct MaterialTexture {
    std::string_view name;  ///< as MaterialProperty::name
    GltfPlace gltf;
    std::string_view help;  ///< which channels mean what
    const TextureUse& (*get)(const Material&) = nullptr;
    TextureUse& (*edit)(Material&) = nullptr;
};
const std::vector<MaterialTexture>& material_textures();

/// Where glTF keeps Material::lighting_model: a word, or the name of a file beside the scene.
GltfPlace lighting_model_place();

/// Where glTF keeps Material::surface: the name of a file beside the scene.
GltfPlace surface_place();

/// Where glTF keeps the base colour of a material with Material::specular_workflow.
GltfPlace diffuse_color_place();
GltfPlace diffuse_texture_place();

/// Where glTF keeps the normals and the roughness of the first of two lobes; a reader that does not know them
/// shows the material's own, which are those of one.
GltfPlace first_lobe_normal_place();
GltfPlace first_lobe_roughness_place();

/// Members of an extension that the tables know; empty: a foreign extension.
std::vector<std::string_view> extension_members(std::string_view extension);

/// What a scene asks for and no shader shows yet: one line a property or attribute that some
/// material or mesh sets, with the number of those that do and the first of their names.
std::vector<std::string> unshaded_properties(const Scene& scene);

}  // namespace petrichor::scene

#endif
