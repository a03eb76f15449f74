#include "scene/gltf/detail/glb_material.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/error.h"

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

json weather(GlbDocument& glb, const scene::Scene& scene, const scene::MaterialWeather& w)
{
    const scene::MaterialWeather normal;
    json out = json::object();
    if (w.height.present()) out["heightTexture"] = texture_info(glb, scene, w.height);
    if (w.puddle_mask.present()) out["puddleMaskTexture"] = texture_info(glb, scene, w.puddle_mask);
    if (w.snow_mask.present()) out["snowMaskTexture"] = texture_info(glb, scene, w.snow_mask);
    const auto scalar = [&out](const char* name, float value, float usual) {
        if (value != usual) out[name] = number(value);
    };
    scalar("heightScale", w.height_scale_m, normal.height_scale_m);
    scalar("defaultHeight", w.default_height, normal.default_height);
    scalar("porosity", w.porosity, normal.porosity);
    scalar("waterSlopeDamp", w.water_slope_damp, normal.water_slope_damp);
    scalar("flowTiling", w.flow_tiling, normal.flow_tiling);
    scalar("flowSpeed", w.flow_speed, normal.flow_speed);
    scalar("flowInterval", w.flow_interval_s, normal.flow_interval_s);
    scalar("flowRefraction", w.flow_refraction, normal.flow_refraction);
    scalar("flowNormalStrength", w.flow_normal_strength, normal.flow_normal_strength);
    scalar("snowSlopeDamp", w.snow_slope_damp, normal.snow_slope_damp);
    scalar("snowNormalStrength", w.snow_normal_strength, normal.snow_normal_strength);
    scalar("snowDetailStrength", w.snow_detail_strength, normal.snow_detail_strength);
    scalar("snowOpacity", w.snow_opacity, normal.snow_opacity);
    if (w.water_accumulation != normal.water_accumulation) {
        out["waterAccumulation"] = numbers(w.water_accumulation);
    }
    if (w.water_color != normal.water_color) out["waterColor"] = numbers(w.water_color);
    if (w.snow_accumulation != normal.snow_accumulation) {
        out["snowAccumulation"] = numbers(w.snow_accumulation);
    }
    if (w.sheltered) out["sheltered"] = true;
    return out;
}

void add_emission(GlbDocument& glb, const scene::Scene& scene, const scene::Material& m, json& out,
                  json& extensions)
{
    const float strongest = std::max({m.emissive.x, m.emissive.y, m.emissive.z});
    if (strongest <= 0.0f) return;
    const float strength = std::max(strongest, 1.0f);
    out["emissiveFactor"] = numbers(m.emissive / strength);
    if (m.emissive_texture.present())
        out["emissiveTexture"] = texture_info(glb, scene, m.emissive_texture);
    if (strength > 1.0f) {
        extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = number(strength);
    }
}

void add_layers(const scene::Material& m, json& extensions)
{
    if (m.unlit) extensions["KHR_materials_unlit"] = json::object();
    if (m.ior != 1.5f) extensions["KHR_materials_ior"]["ior"] = number(m.ior);
    if (m.specular != 1.0f || m.specular_color != glm::vec3(1.0f)) {
        extensions["KHR_materials_specular"] = {{"specularFactor", number(m.specular)},
                                                {"specularColorFactor", numbers(m.specular_color)}};
    }
    if (m.transmission > 0.0f) {
        extensions["KHR_materials_transmission"]["transmissionFactor"] = number(m.transmission);
    }
    if (m.clearcoat > 0.0f) {
        extensions["KHR_materials_clearcoat"] = {
            {"clearcoatFactor", number(m.clearcoat)},
            {"clearcoatRoughnessFactor", number(m.clearcoat_roughness)}};
    }
    if (m.sheen_color != glm::vec3(0.0f)) {
        extensions["KHR_materials_sheen"] = {{"sheenColorFactor", numbers(m.sheen_color)},
                                             {"sheenRoughnessFactor", number(m.sheen_roughness)}};
    }
    if (m.anisotropy != 0.0f) {
        extensions["KHR_materials_anisotropy"] = {
            {"anisotropyStrength", number(m.anisotropy)},
            {"anisotropyRotation", number(m.anisotropy_rotation_rad)}};
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

void add_material(GlbDocument& glb, const scene::Scene& scene, const scene::Material& m)
{
    json out = {{"name", m.name}};
    json& pbr = out["pbrMetallicRoughness"];
    pbr = json::object();
    if (m.base_color != glm::vec4(1.0f)) pbr["baseColorFactor"] = numbers(m.base_color);
    if (m.base_color_texture.present()) {
        pbr["baseColorTexture"] = texture_info(glb, scene, m.base_color_texture);
    }
    if (m.metallic != 1.0f) pbr["metallicFactor"] = number(m.metallic);
    if (m.roughness != 1.0f) pbr["roughnessFactor"] = number(m.roughness);
    if (m.metallic_roughness_texture.present()) {
        pbr["metallicRoughnessTexture"] = texture_info(glb, scene, m.metallic_roughness_texture);
    }
    if (m.normal_texture.present()) {
        out["normalTexture"] = texture_info(glb, scene, m.normal_texture);
        if (m.normal_scale != 1.0f) out["normalTexture"]["scale"] = number(m.normal_scale);
    }
    if (m.occlusion_texture.present()) {
        out["occlusionTexture"] = texture_info(glb, scene, m.occlusion_texture);
        if (m.occlusion_strength != 1.0f) {
            out["occlusionTexture"]["strength"] = number(m.occlusion_strength);
        }
    }
    json extensions = json::object();
    add_emission(glb, scene, m, out, extensions);
    add_layers(m, extensions);
    const json wet = weather(glb, scene, m.weather);
    if (!wet.empty()) extensions["PETRICHOR_materials_weather"] = wet;
    for (const auto& item : extensions.items()) glb.extensions.insert(item.key());
    if (!extensions.empty()) out["extensions"] = extensions;
    if (m.alpha_mode == scene::AlphaMode::Blend) out["alphaMode"] = "BLEND";
    if (m.alpha_mode == scene::AlphaMode::Mask) {
        out["alphaMode"] = "MASK";
        out["alphaCutoff"] = number(m.alpha_cutoff);
    }
    if (m.double_sided) out["doubleSided"] = true;
    glb.tree["materials"].push_back(out);
}

}  // namespace petrichor::scene::detail
