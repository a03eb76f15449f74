#include <algorithm>
#include <limits>

#include "base/error.h"
#include "scene/gltf/detail/gltf_parts.h"
#include "scene/gltf/detail/gltf_uri.h"

namespace petrichor::scene {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

Wrap read_wrap(const JsonObject& sampler, std::string_view key)
{
    const std::uint64_t code = sampler.whole(key, 10497);
    if (code == 33071) return Wrap::Clamp;
    if (code == 33648) return Wrap::Mirror;
    if (code != 10497) {
        sampler.warn(key, "unknown wrap mode " + std::to_string(code) + ", the texture repeats");
    }
    return Wrap::Repeat;
}

void clamp_numbers(const JsonObject& json, std::string_view key, std::span<float> values,
                   float high)
{
    if (!json.numbers(key, values)) return;
    bool outside = false;
    for (float& value : values) {
        outside = outside || !(value >= 0.0f && value <= high);
        value = std::clamp(value, 0.0f, high);
    }
    if (outside) json.warn(key, "the value is out of range and was clamped");
}

void read_extensions(const JsonObject& json, Material& out)
{
    const auto ignore_textures = [](const JsonObject& extension) {
        for (const std::string& key : extension.keys()) {
            if (key.ends_with("Texture")) {
                extension.warn(key, "textures of this extension are not read, only its factors");
            }
        }
    };
    if (const auto e = json.extension("KHR_materials_emissive_strength")) {
        out.emissive *= e->clamped("emissiveStrength", 1.0f, 0.0f, kLargest);
        out.emissive = glm::min(out.emissive, glm::vec3(kLargest));
    }
    if (const auto e = json.extension("KHR_materials_ior")) {
        const float ior = e->number("ior", 1.5f);
        // 0 stands for a surface that reflects everything; nothing between 0 and 1 exists.
        out.ior = ior == 0.0f ? 0.0f : e->clamped("ior", 1.5f, 1.0f, 100.0f);
    }
    if (const auto e = json.extension("KHR_materials_specular")) {
        out.specular = e->clamped("specularFactor", 1.0f, 0.0f, 1.0f);
        clamp_numbers(*e, "specularColorFactor", {&out.specular_color.x, 3}, kLargest);
        ignore_textures(*e);
    }
    if (const auto e = json.extension("KHR_materials_transmission")) {
        out.transmission = e->clamped("transmissionFactor", 0.0f, 0.0f, 1.0f);
        ignore_textures(*e);
    }
    if (const auto e = json.extension("KHR_materials_clearcoat")) {
        out.clearcoat = e->clamped("clearcoatFactor", 0.0f, 0.0f, 1.0f);
        out.clearcoat_roughness = e->clamped("clearcoatRoughnessFactor", 0.0f, 0.0f, 1.0f);
        ignore_textures(*e);
    }
    if (const auto e = json.extension("KHR_materials_sheen")) {
        clamp_numbers(*e, "sheenColorFactor", {&out.sheen_color.x, 3}, 1.0f);
        out.sheen_roughness = e->clamped("sheenRoughnessFactor", 0.0f, 0.0f, 1.0f);
        ignore_textures(*e);
    }
    if (const auto e = json.extension("KHR_materials_anisotropy")) {
        out.anisotropy = e->clamped("anisotropyStrength", 0.0f, 0.0f, 1.0f);
        out.anisotropy_rotation_rad = e->number("anisotropyRotation", 0.0f);
        ignore_textures(*e);
    }
    out.unlit = json.extension("KHR_materials_unlit").has_value();
}

void read_alpha(const JsonObject& json, Material& out)
{
    const std::string mode = json.text("alphaMode", "OPAQUE");
    if (mode == "MASK") {
        out.alpha_mode = AlphaMode::Mask;
    } else if (mode == "BLEND") {
        out.alpha_mode = AlphaMode::Blend;
    } else if (mode != "OPAQUE") {
        json.warn("alphaMode", "unknown mode " + in_quotes(mode) + ", the material is opaque");
    }
    out.alpha_cutoff = json.clamped("alphaCutoff", out.alpha_cutoff, 0.0f, kLargest);
}

Material read_material(const JsonObject& json, std::size_t number, TextureCollector& textures)
{
    Material out;
    out.name = json.text("name", "material " + std::to_string(number));
    if (const auto pbr = json.object("pbrMetallicRoughness")) {
        clamp_numbers(*pbr, "baseColorFactor", {&out.base_color.x, 4}, 1.0f);
        out.base_color_texture = textures.use(*pbr, "baseColorTexture");
        out.metallic = pbr->clamped("metallicFactor", 1.0f, 0.0f, 1.0f);
        out.roughness = pbr->clamped("roughnessFactor", 1.0f, 0.0f, 1.0f);
        out.metallic_roughness_texture = textures.use(*pbr, "metallicRoughnessTexture");
    }
    out.normal_texture = textures.use(json, "normalTexture");
    if (const auto normal = json.object("normalTexture")) {
        out.normal_scale = normal->number("scale", 1.0f);
    }
    out.occlusion_texture = textures.use(json, "occlusionTexture");
    if (const auto occlusion = json.object("occlusionTexture")) {
        out.occlusion_strength = occlusion->clamped("strength", 1.0f, 0.0f, 1.0f);
    }
    out.emissive_texture = textures.use(json, "emissiveTexture");
    clamp_numbers(json, "emissiveFactor", {&out.emissive.x, 3}, 1.0f);
    out.double_sided = json.flag("doubleSided", false);
    read_alpha(json, out);
    read_extensions(json, out);
    if (const auto weather = json.extension("PETRICHOR_materials_weather")) {
        out.weather = read_weather(*weather, textures);
    }
    return out;
}

}  // namespace

TextureCollector::TextureCollector(GltfSource& source, Scene& scene)
    : source_(source),
      scene_(scene),
      textures_(source.root.array("textures")),
      images_(source.root.array("images")),
      samplers_(source.root.array("samplers"))
{
}

TextureUse TextureCollector::use(const JsonObject& parent, std::string_view key)
{
    TextureUse out;
    const auto info = parent.object(key);
    if (!info) return out;
    out.texture = texture(info->require_index("index", "texture", textures_.size()), *info);
    std::uint64_t texcoord = info->whole("texCoord", 0);
    if (const auto transform = info->extension("KHR_texture_transform")) {
        transform->numbers("offset", {&out.offset.x, 2});
        transform->numbers("scale", {&out.scale.x, 2});
        out.rotation_rad = transform->number("rotation", 0.0f);
        texcoord = transform->whole("texCoord", texcoord);
    }
    if (texcoord > 1) {
        info->warn("texCoord", "only the texture coordinates 0 and 1 are read; 0 stands in");
        texcoord = 0;
    }
    out.texcoord = static_cast<int>(texcoord);
    return out;
}

TextureIndex TextureCollector::texture(std::uint32_t index, const JsonObject& info)
{
    const JsonObject json = textures_.object(index);
    // The plain source is the copy that every reader understands; WebP may be the only one there
    // is.
    auto image = json.index("source", "image", images_.size());
    if (const auto webp = json.extension("EXT_texture_webp"); webp && !image) {
        image = webp->index("source", "image", images_.size());
    }
    if (!image) {
        info.warn("index", "a texture without an image that can be read is left out");
        return kNoTexture;
    }
    EncodedImage out;
    if (const auto sampler = json.index("sampler", "sampler", samplers_.size())) {
        const JsonObject sampler_json = samplers_.object(*sampler);
        out.wrap_u = read_wrap(sampler_json, "wrapS");
        out.wrap_v = read_wrap(sampler_json, "wrapT");
        out.nearest = sampler_json.whole("magFilter", 9729) == 9728;
    }

    const JsonObject image_json = images_.object(*image);
    const std::string uri = image_json.text("uri");
    const bool is_file = !uri.empty() && !is_data_uri(uri);
    const auto view = image_json.index("bufferView", "buffer view", source_.buffers.view_count());
    if (uri.empty() && !view) {
        image_json.fail("", "needs a uri or a bufferView", "Export the scene again.");
    }
    const std::string where = image_json.path_to("uri");
    std::string key = std::to_string(static_cast<int>(out.wrap_u)) +
                      std::to_string(static_cast<int>(out.wrap_v)) + (out.nearest ? "n " : "l ");
    if (is_file) {
        out.name = decode_relative_uri(uri, where, image_json.log());
        key += "file " + out.name;
    } else {
        const std::string name = image_json.text("name");
        out.name = "image " + std::to_string(*image) + (name.empty() ? "" : " (" + name + ")");
        key += uri.empty() ? "view " + std::to_string(*view) : "image " + std::to_string(*image);
    }
    const auto known = made_.find(key);
    if (known != made_.end()) return known->second;

    if (uri.empty()) {
        const auto bytes = source_.buffers.view(*view);
        source_.buffers.budget.take(bytes.size(), 1, image_json.path(), image_json.log());
        out.bytes.assign(bytes.begin(), bytes.end());
    } else {
        out.bytes = source_.buffers.read_resource(uri, where);
        source_.buffers.budget.take(out.bytes.size(), 1, image_json.path(), image_json.log());
    }
    if (out.bytes.empty()) {
        image_json.fail("", "the image has no bytes", "Put the image in place, or export again.");
    }
    const auto made = static_cast<TextureIndex>(scene_.textures.size());
    scene_.textures.push_back(std::move(out));
    made_.emplace(std::move(key), made);
    return made;
}

void read_materials(GltfSource& source, Scene& scene)
{
    TextureCollector textures(source, scene);
    const JsonArray materials = source.root.array("materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        scene.materials.push_back(read_material(materials.object(i), i, textures));
    }
}

}  // namespace petrichor::scene
