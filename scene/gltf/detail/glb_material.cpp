#include "scene/gltf/detail/glb_material.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "base/error.h"
#include "scene/material_table.h"

namespace petrichor::scene::detail {
namespace {

json texture_info(GlbDocument& glb, const scene::Scene& scene, const scene::TextureUse& texture)
{
    if (static_cast<std::size_t>(texture.texture) >= scene.textures.size()) {
        throw Error("glb: texture " + std::to_string(texture.texture) + " of " +
                        std::to_string(scene.textures.size()),
                    "Add the image to the scene before a material uses it.");
    }
    json info = {{"index", texture.texture}};
    if (texture.texcoord != 0) info["texCoord"] = texture.texcoord;
    if (texture.offset != glm::vec2(0.0f) || texture.scale != glm::vec2(1.0f) ||
        texture.rotation_rad != 0.0f) {
        glb.extensions.insert("KHR_texture_transform");
        json transform = {{"offset", numbers(texture.offset)}, {"scale", numbers(texture.scale)}};
        if (texture.rotation_rad != 0.0f) transform["rotation"] = number(texture.rotation_rad);
        info["extensions"]["KHR_texture_transform"] = transform;
    }
    return info;
}

// The object that holds a place's member, made when it is not there yet.
json& holder_of(json& material, const GltfPlace& place)
{
    json* holder = &material;
    if (!place.extension.empty()) {
        holder = &(*holder)["extensions"][std::string(place.extension)];
        if (holder->is_null()) *holder = json::object();
    }
    return place.parent.empty() ? *holder : (*holder)[std::string(place.parent)];
}

// The scale of a texture that is not there has no place.
bool has_texture_of(const scene::Material& material, const GltfPlace& place)
{
    for (const MaterialTexture& texture : material_textures()) {
        if (texture.gltf.extension == place.extension && texture.gltf.member == place.parent) {
            return texture.get(material).present();
        }
    }
    return true;
}

json value_of(const MaterialProperty& property, const glm::vec4& value)
{
    if (property.kind == PropertyKind::Flag) return value.x != 0.0f;
    if (property.kind == PropertyKind::Choice) {
        return property.words[static_cast<std::size_t>(value.x)];
    }
    if (property.count == 1) return number(value.x);
    json list = json::array();
    for (int i = 0; i < property.count; ++i) list.push_back(number(value[i]));
    return list;
}

// glTF's emissive factor ends at 1; what is brighter goes into the strength.
scene::Material with_dim_factor(scene::Material material)
{
    const glm::vec3& e = material.emissive;
    const float brightest = std::max({e.x, e.y, e.z, 1.0f});
    material.emissive /= brightest;
    material.emissive_strength *= brightest;
    return material;
}

// The extension says by being there that its workflow is the material's: what is otherwise is said.
void write_specular_workflow(GlbDocument& glb, const scene::Scene& scene, const scene::Material& m,
                             json& out)
{
    const std::string extension(diffuse_color_place().extension);
    const bool there = out.contains("extensions") && out["extensions"].contains(extension);
    if (!m.specular_workflow) {
        const MaterialProperty& flag = *find_property("specular_workflow");
        if (there) holder_of(out, flag.gltf)[std::string(flag.gltf.member)] = false;
        return;
    }
    json& holder = holder_of(out, diffuse_color_place());
    const MaterialProperty& color = *find_property("base_color_factor");
    holder[std::string(diffuse_color_place().member)] = value_of(color, color.get(m));
    if (m.base_color_texture.present()) {
        holder[std::string(diffuse_texture_place().member)] =
            texture_info(glb, scene, m.base_color_texture);
    }
}

}  // namespace

void add_textures(GlbDocument& glb, const scene::Scene& scene)
{
    std::map<std::tuple<int, int, bool>, std::size_t> samplers;
    for (const scene::EncodedImage& image : scene.textures) {
        if (image.bytes.size() < 8) {
            throw Error("glb: image " + image.name + " is empty", "Encode it before writing.");
        }
        const bool png = image.bytes[0] == std::byte{0x89};
        const std::size_t view = glb.add_view(image.bytes.data(), image.bytes.size());
        glb.tree["images"].push_back({{"name", image.name},
                                      {"mimeType", png ? "image/png" : "image/jpeg"},
                                      {"bufferView", view}});
        const auto code = [](scene::Wrap wrap) {
            return wrap == scene::Wrap::Repeat ? 10497 : wrap == scene::Wrap::Clamp ? 33071 : 33648;
        };
        const auto key = std::make_tuple(code(image.wrap_u), code(image.wrap_v), image.nearest);
        auto found = samplers.find(key);
        if (found == samplers.end()) {
            glb.tree["samplers"].push_back({{"magFilter", image.nearest ? 9728 : 9729},
                                            {"minFilter", 9987},
                                            {"wrapS", std::get<0>(key)},
                                            {"wrapT", std::get<1>(key)}});
            found = samplers.emplace(key, glb.tree["samplers"].size() - 1).first;
        }
        glb.tree["textures"].push_back(
            {{"source", glb.tree["images"].size() - 1}, {"sampler", found->second}});
    }
}

void add_material(GlbDocument& glb, const scene::Scene& scene, const scene::Material& material)
{
    const scene::Material m = with_dim_factor(material);
    json out = {{"name", m.name}, {"pbrMetallicRoughness", json::object()}};
    for (const MaterialTexture& texture : material_textures()) {
        const scene::TextureUse& use = texture.get(m);
        if (!use.present()) continue;
        holder_of(out, texture.gltf)[std::string(texture.gltf.member)] =
            texture_info(glb, scene, use);
    }
    for (const MaterialProperty& property : material_table()) {
        const glm::vec4 value = property.get(m);
        if (value == default_value(property)) continue;
        if (!has_texture_of(m, property.gltf)) continue;
        json& holder = holder_of(out, property.gltf);
        if (!property.gltf.member.empty()) {
            holder[std::string(property.gltf.member)] = value_of(property, value);
        }
    }
    write_specular_workflow(glb, scene, m, out);
    if (m.maps.second_lobe.present()) {
        // Readers of one lobe get the first of two: what the scene had for them is not kept.
        for (const GltfPlace& place : {first_lobe_normal_place(), first_lobe_roughness_place()}) {
            const bool normal = place.member == first_lobe_normal_place().member;
            const scene::TextureUse& use = normal ? m.normal_texture : m.metallic_roughness_texture;
            if (use.present()) holder_of(out, place)[std::string(place.member)] = texture_info(glb, scene, use);
        }
    }
    const auto add_shader = [&](const GltfPlace& place, const std::string& name) {
        // Of a file its name: it lies beside the scene.
        if (!name.empty())
            holder_of(out, place)[std::string(place.member)] = name.substr(name.rfind('/') + 1);
    };
    add_shader(lighting_model_place(), m.lighting_model);
    add_shader(surface_place(), m.surface);
    if (out.contains("extensions")) {
        for (const auto& item : out["extensions"].items()) glb.extensions.insert(item.key());
    }
    glb.tree["materials"].push_back(out);
}

}  // namespace petrichor::scene::detail
