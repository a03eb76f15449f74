#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "base/error.h"
#include "scene/gltf/detail/gltf_parts.h"
#include "scene/gltf/detail/gltf_uri.h"
#include "scene/material_table.h"

namespace petrichor::scene {
namespace {

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

// The object that holds a place's member; none when the file leaves it out.
std::optional<JsonObject> holder_of(const JsonObject& material, const GltfPlace& place)
{
    std::optional<JsonObject> holder = material;
    if (!place.extension.empty()) holder = material.extension(place.extension);
    if (holder && !place.parent.empty()) holder = holder->object(place.parent);
    return holder;
}

// Our own extension is written by hand or by tools of ours: mistakes are errors. In everybody's
// extensions they are mended, since exporters do make them.
bool strict(const MaterialProperty& property)
{
    return property.gltf.extension.starts_with("PETRICHOR_");
}

[[noreturn]] void refuse(const MaterialProperty& property, const JsonObject& holder, int i,
                         float value)
{
    const auto text = [](float x) { return number_text(static_cast<double>(x)); };
    const std::string which = property.count > 1 ? "number " + std::to_string(i) + " " : "";
    holder.fail(property.gltf.member,
                which + "must be in [" + text(property.low[i]) + ", " + text(property.high[i]) +
                    "], got " + text(value),
                "Correct the value in the material's weather.");
}

glm::vec4 read_numbers(const MaterialProperty& property, const JsonObject& holder, glm::vec4 value)
{
    const std::string_view member = property.gltf.member;
    if (property.count == 1) {
        value.x = holder.number(member, value.x);
    } else {
        holder.numbers(member, {&value.x, static_cast<std::size_t>(property.count)});
    }
    bool outside = false;
    for (int i = 0; i < property.count; ++i) {
        if (property.accepts(i, value[i])) continue;
        if (strict(property)) refuse(property, holder, i, value[i]);
        outside = true;
        value[i] = std::clamp(value[i], property.low[i], property.high[i]);
    }
    if (outside) holder.warn(member, "the value is out of range and was clamped");
    return value;
}

float read_choice(const MaterialProperty& property, const JsonObject& holder, float usual)
{
    const std::string_view member = property.gltf.member;
    const auto& words = property.words;
    const std::string word = holder.text(member, words[static_cast<std::size_t>(usual)]);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end()) return static_cast<float>(found - words.begin());
    std::string known;
    for (const std::string_view w : words) known.append(known.empty() ? "" : ", ").append(w);
    if (strict(property)) {
        holder.fail(member, "must be one of " + known + ", got " + in_quotes(word),
                    "Choose one of these words.");
    }
    holder.warn(member, "unknown word " + in_quotes(word) + ", there are " + known + "; " +
                            std::string(words[static_cast<std::size_t>(usual)]) + " stands in");
    return usual;
}

void read_property(const MaterialProperty& property, const JsonObject& material, Material& out)
{
    const auto holder = holder_of(material, property.gltf);
    if (!holder) return;
    glm::vec4 value = property.get(out);
    if (property.gltf.member.empty()) {
        value.x = 1.0f;
    } else if (!holder->has(property.gltf.member)) {
        return;
    } else if (property.kind == PropertyKind::Flag) {
        value.x = holder->flag(property.gltf.member, value.x != 0.0f) ? 1.0f : 0.0f;
    } else if (property.kind == PropertyKind::Choice) {
        value.x = read_choice(property, *holder, value.x);
    } else {
        value = read_numbers(property, *holder, value);
    }
    property.set(out, value);
}

void refuse_unknown(const JsonObject& extension, const std::vector<std::string_view>& known)
{
    for (const std::string& key : extension.keys()) {
        if (key == "extensions" || key == "extras") continue;
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        const auto nearest = nearest_word(key, known);
        std::string fix = "Remove it; the keys are";
        for (const std::string_view word : known) fix.append(" ").append(word);
        if (nearest) fix = "Did you mean " + *nearest + "?";
        extension.fail("", "unknown key " + in_quotes(key), fix);
    }
}

// What an extension of a material says and no row of the tables reads.
void check_extensions(const JsonObject& material)
{
    const auto extensions = material.object("extensions");
    if (!extensions) return;
    for (const std::string& name : extensions->keys()) {
        const auto known = extension_members(name);
        if (known.empty()) continue;
        const auto extension = material.extension(name);
        if (name.starts_with("PETRICHOR_")) {
            refuse_unknown(*extension, known);
            continue;
        }
        for (const std::string& key : extension->keys()) {
            const bool read = std::find(known.begin(), known.end(), key) != known.end();
            if (!read && key.ends_with("Texture")) {
                extension->warn(key, "textures of this extension are not read, only its factors");
            }
        }
    }
}

// A word, or a file: a scene names files beside it and no others.
void read_shader(const JsonObject& material, const GltfPlace& place, std::string& out)
{
    const auto holder = holder_of(material, place);
    if (!holder) return;
    out = holder->text(place.member);
    if (out.ends_with(".glsl"))
        out = decode_relative_uri(out, holder->path_to(place.member), holder->log());
}

// Archived, but files have it: another base colour, reflectance instead of metallic.
void read_specular_workflow(const JsonObject& material, TextureCollector& textures, Material& out)
{
    const auto holder = material.extension(diffuse_color_place().extension);
    if (!holder) return;
    out.specular_workflow = true;
    if (const MaterialProperty* flag = find_property("specular_workflow"))
        read_property(*flag, material, out);
    if (!out.specular_workflow) return;
    out.base_color = glm::vec4(1.0f);
    MaterialProperty color = *find_property("base_color_factor");
    color.gltf = diffuse_color_place();
    read_property(color, material, out);
    out.base_color_texture = textures.use(*holder, diffuse_texture_place().member);
}

// The lighting knows two lobes of what is opaque and lit by the usual model; all else has the one of the
// material's own textures.
bool may_have_two_lobes(const JsonObject& material)
{
    const auto shader = holder_of(material, lighting_model_place());
    const std::string model = shader ? shader->text(lighting_model_place().member) : "";
    return (model.empty() || model == "layered") && material.text("alphaMode", "OPAQUE") != "BLEND" &&
           !material.extension("KHR_materials_transmission") && !material.extension("KHR_materials_unlit");
}

// Where a texture of a material stands. Two lobes take the place of one: their normals, their roughness, and
// the occlusion that is in the same image.
GltfPlace place_of(const MaterialTexture& texture, const JsonObject& material, const JsonObject* lobes)
{
    if (!lobes) return texture.gltf;
    const GltfPlace normal = first_lobe_normal_place(), roughness = first_lobe_roughness_place();
    if (texture.name == "normal_texture" && lobes->has(normal.member)) return normal;
    if (!lobes->has(roughness.member)) return texture.gltf;
    if (texture.name == "metallic_roughness_texture") return roughness;
    if (texture.name != "occlusion_texture") return texture.gltf;
    const auto one = material.object("pbrMetallicRoughness");
    const auto surface = one ? one->object("metallicRoughnessTexture") : std::nullopt;
    const auto occlusion = material.object("occlusionTexture");
    const bool same = surface && occlusion && surface->whole("index", 0) == occlusion->whole("index", 1) &&
                      surface->whole("texCoord", 0) == occlusion->whole("texCoord", 0);
    return same ? roughness : texture.gltf;
}

Material read_material(const JsonObject& json, std::size_t number, TextureCollector& textures)
{
    Material out;
    out.name = json.text("name", "material " + std::to_string(number));
    check_extensions(json);
    const auto lobes = json.extension(first_lobe_normal_place().extension);
    const bool two = lobes && may_have_two_lobes(json);
    for (const MaterialTexture& texture : material_textures()) {
        const GltfPlace place = place_of(texture, json, two ? &*lobes : nullptr);
        if (lobes && !two && place.extension == first_lobe_normal_place().extension) continue;
        const auto holder = holder_of(json, place);
        if (holder) texture.edit(out) = textures.use(*holder, place.member);
    }
    for (const MaterialProperty& property : material_table()) read_property(property, json, out);
    read_specular_workflow(json, textures, out);
    read_shader(json, lighting_model_place(), out.lighting_model);
    read_shader(json, surface_place(), out.surface);
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
    const auto source_of = [&](std::string_view extension) -> std::optional<std::uint32_t> {
        const auto object = json.extension(extension);
        return object ? object->index("source", "image", images_.size()) : std::nullopt;
    };
    EncodedImage out;
    if (const auto sampler = json.index("sampler", "sampler", samplers_.size())) {
        const JsonObject sampler_json = samplers_.object(*sampler);
        out.wrap_u = read_wrap(sampler_json, "wrapS");
        out.wrap_v = read_wrap(sampler_json, "wrapT");
        out.nearest = sampler_json.whole("magFilter", 9729) == 9728;
    }
    // Files with their own mip levels come first. The plain source is the copy that every reader
    // understands; WebP may be the only one there is.
    const auto plain = json.index("source", "image", images_.size());
    auto chosen = source_of("MSFT_texture_dds");
    if (!chosen) chosen = source_of("KHR_texture_basisu");
    if (!chosen) chosen = plain;
    if (!chosen) chosen = source_of("EXT_texture_webp");
    if (!chosen) {
        info.warn("index", "a texture without an image that can be read is left out");
        return kNoTexture;
    }
    return image(*chosen, std::move(out));
}

TextureIndex TextureCollector::image(std::uint32_t index, EncodedImage out)
{
    const JsonObject image_json = images_.object(index);
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
        out.name = "image " + std::to_string(index) + (name.empty() ? "" : " (" + name + ")");
        key += uri.empty() ? "view " + std::to_string(*view) : "image " + std::to_string(index);
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
