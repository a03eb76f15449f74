#include "texproc/gltf/image_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

using Keys = std::vector<std::string>;

const JsonText& list(const JsonText& json, std::string_view key)
{
    static const JsonText none = JsonText::array();
    const JsonText* found = json.find(key);
    return found && found->kind() == JsonText::Kind::Array ? *found : none;
}

float number_or(const JsonText* object, std::string_view key, float otherwise)
{
    const JsonText* member = object ? object->find(key) : nullptr;
    const std::optional<double> value = member ? member->as_number() : std::nullopt;
    return value && std::isfinite(*value) ? static_cast<float>(*value) : otherwise;
}

std::optional<std::size_t> index_of(const JsonText& object, std::string_view key)
{
    const JsonText* member = object.find(key);
    return member ? member->as_index() : std::nullopt;
}

struct KnownSlot {
    const char* owner;  // an extension, "" or pbrMetallicRoughness
    const char* key;
    ImageMeaning meaning;
};
constexpr auto kColor = ImageMeaning::Color, kData = ImageMeaning::Data;
constexpr std::array kKnown{
    KnownSlot{"pbrMetallicRoughness", "baseColorTexture", kColor},
    KnownSlot{"pbrMetallicRoughness", "metallicRoughnessTexture", ImageMeaning::Surface},
    KnownSlot{"", "normalTexture", ImageMeaning::Normal},
    KnownSlot{"", "occlusionTexture", kData},
    KnownSlot{"", "emissiveTexture", kColor},
    KnownSlot{"KHR_materials_clearcoat", "clearcoatTexture", kData},
    KnownSlot{"KHR_materials_clearcoat", "clearcoatRoughnessTexture", kData},
    KnownSlot{"KHR_materials_clearcoat", "clearcoatNormalTexture", ImageMeaning::Normal},
    KnownSlot{"KHR_materials_sheen", "sheenColorTexture", kColor},
    KnownSlot{"KHR_materials_sheen", "sheenRoughnessTexture", kData},
    KnownSlot{"KHR_materials_transmission", "transmissionTexture", kData},
    KnownSlot{"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture", kData},
    KnownSlot{"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture", kColor},
    KnownSlot{"KHR_materials_volume", "thicknessTexture", kData},
    KnownSlot{"KHR_materials_specular", "specularTexture", kData},
    KnownSlot{"KHR_materials_specular", "specularColorTexture", kColor},
    KnownSlot{"KHR_materials_anisotropy", "anisotropyTexture", kData},
    KnownSlot{"KHR_materials_iridescence", "iridescenceTexture", kData},
    KnownSlot{"KHR_materials_iridescence", "iridescenceThicknessTexture", kData},
    KnownSlot{"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", kColor},
    KnownSlot{"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture", kColor},
    KnownSlot{"PETRICHOR_materials_weather", "heightTexture", kData},
    KnownSlot{"PETRICHOR_materials_weather", "puddleMaskTexture", kData},
    KnownSlot{"PETRICHOR_materials_weather", "snowMaskTexture", kData},
};

const KnownSlot* known_slot(const Keys& keys)
{
    const std::string_view owner = keys.size() < 2 ? "" : std::string_view(keys[keys.size() - 2]);
    for (const KnownSlot& slot : kKnown) {
        if (owner == slot.owner && keys.back() == slot.key) return &slot;
    }
    return nullptr;
}

// Where a texture lies on the surface.
struct Placement {
    std::size_t texcoord = 0;
    std::array<double, 5> transform{0.0, 0.0, 0.0, 1.0, 1.0};  // offset, rotation, scale
    std::size_t sampler = ~std::size_t{0};
    bool operator==(const Placement&) const = default;
};

Placement placement_of(const GltfFile& file, const JsonText& info)
{
    Placement to;
    to.texcoord = index_of(info, "texCoord").value_or(0);
    const JsonText* extensions = info.find("extensions");
    const JsonText* transform = extensions ? extensions->find("KHR_texture_transform") : nullptr;
    if (transform) {
        to.texcoord = index_of(*transform, "texCoord").value_or(to.texcoord);
        const auto pair = [&](const char* key, std::size_t at) {
            const JsonText& values = list(*transform, key);
            for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 2); ++i)
                to.transform[at + i] = values.at(i).as_number().value_or(0.0);
        };
        pair("offset", 0);
        to.transform[2] = static_cast<double>(number_or(transform, "rotation", 0.0f));
        pair("scale", 3);
    }
    const JsonText& textures = list(file.json, "textures");
    const std::size_t texture = index_of(info, "index").value_or(~std::size_t{0});
    if (texture < textures.size())
        to.sampler = index_of(textures.at(texture), "sampler").value_or(to.sampler);
    return to;
}

// How the edges of a texture meet; samplers that repeat alike count as one.
std::array<Edge, 2> edges_of(const GltfFile& file, std::size_t sampler)
{
    const JsonText& samplers = list(file.json, "samplers");
    const auto edge = [&](const char* key) {
        if (sampler >= samplers.size()) return Edge::Wrap;
        const std::size_t code = index_of(samplers.at(sampler), key).value_or(10497);
        return code == 33071 ? Edge::Clamp : code == 33648 ? Edge::Mirror : Edge::Wrap;
    };
    return {edge("wrapS"), edge("wrapT")};
}

struct Found {
    Keys keys;
    const JsonText* info;
};
// Every object below a material that looks like a textureInfo.
void find_infos(const JsonText& value, Keys& keys, std::vector<Found>& to)
{
    for (std::size_t i = 0; i < value.size() && value.kind() == JsonText::Kind::Object; ++i) {
        const JsonText& member = value.at(i);
        if (value.keys()[i] == "extras" || member.kind() != JsonText::Kind::Object) continue;
        keys.push_back(value.keys()[i]);
        if (keys.back().ends_with("Texture") && index_of(member, "index"))
            to.push_back({keys, &member});
        find_infos(member, keys, to);
        keys.pop_back();
    }
}

// What the renderer shades with two lobes (scene/gltf/material.cpp).
bool may_have_two_lobes(const JsonText& material)
{
    const JsonText* mode = material.find("alphaMode");
    if (mode && mode->as_string() == "BLEND") return false;
    const JsonText* extensions = material.find("extensions");
    if (!extensions) return true;
    const JsonText* own = extensions->find("PETRICHOR_materials_weather");
    return !extensions->find("KHR_materials_transmission") && !extensions->find("KHR_materials_unlit") &&
           !extensions->find(kTwoLobes) && !(own && own->find("lightingModel"));
}

class Planner {
public:
    Planner(const GltfFile& file, bool bake, int lobes, bool by_class)
        : file_(file), bake_(bake), lobes_(lobes), by_class_(by_class)
    {
    }

    ImagePlan plan()
    {
        const JsonText& materials = list(file_.json, "materials");
        for (std::size_t m = 0; m < materials.size(); ++m) plan_material(m, materials.at(m));
        return std::move(plan_);
    }

private:
    void plan_material(std::size_t number, const JsonText& material);
    void plan_two_lobes(std::size_t number, const Found& surface, const Found& normal);
    std::size_t add(const ImageRecipe& recipe)
    {
        const auto at = std::find(plan_.recipes.begin(), plan_.recipes.end(), recipe);
        if (at == plan_.recipes.end()) plan_.recipes.push_back(recipe);
        return static_cast<std::size_t>(
            std::find(plan_.recipes.begin(), plan_.recipes.end(), recipe) - plan_.recipes.begin());
    }
    // The image of a slot of this material, if it is to be made anew.
    int image(const Found* slot) const
    {
        return slot ? source_image(file_, index_of(*slot->info, "index").value()) : -1;
    }
    bool lie_alike(const Found& a, const Found& b) const
    {
        Placement one = placement_of(file_, *a.info), other = placement_of(file_, *b.info);
        if (edges_of(file_, one.sampler) != edges_of(file_, other.sampler)) return false;
        one.sampler = other.sampler;
        return one == other;
    }
    void keep(std::size_t texture, const std::string& why)
    {
        if (kept_.insert(texture).second) {
            plan_.kept_textures.push_back(texture);
            plan_.notes.push_back("texture " + std::to_string(texture) + " " + why);
        }
    }

    const GltfFile& file_;
    bool bake_;
    int lobes_;
    bool by_class_;
    ImagePlan plan_;
    std::set<std::size_t> kept_;
};

void Planner::plan_material(std::size_t number, const JsonText& material)
{
    std::vector<Found> infos;
    Keys keys;
    find_infos(material, keys, infos);
    const auto slot = [&](const char* owner, const char* key) -> const Found* {
        for (const Found& found : infos) {
            const KnownSlot* known = known_slot(found.keys);
            if (known && std::string_view(known->owner) == owner &&
                std::string_view(known->key) == key)
                return &found;
        }
        return nullptr;
    };
    const JsonText* pbr = material.find("pbrMetallicRoughness");
    const Found* base = slot("pbrMetallicRoughness", "baseColorTexture");
    const Found* surface = slot("pbrMetallicRoughness", "metallicRoughnessTexture");
    const Found* normal = slot("", "normalTexture");
    const float scale = normal ? number_or(normal->info, "scale", 1.0f) : 1.0f;
    const float roughness = number_or(pbr, "roughnessFactor", 1.0f);
    const float metallic = number_or(pbr, "metallicFactor", 1.0f);
    const bool paired = image(normal) >= 0 && image(surface) >= 0 && scale != 0.0f &&
                        roughness > 0.0f && lie_alike(*surface, *normal);
    if (normal && surface && !paired && image(normal) >= 0 && image(surface) >= 0) {
        plan_.notes.push_back("material " + std::to_string(number) +
                              ": its normals lie otherwise than its roughness; neither is filtered "
                              "with the other");
    }
    const JsonText* mode_text = material.find("alphaMode");
    const std::string mode = mode_text ? mode_text->as_string().value_or("OPAQUE") : "OPAQUE";

    for (const Found& found : infos) {
        const std::size_t texture = index_of(*found.info, "index").value();
        const KnownSlot* known = known_slot(found.keys);
        const int source = source_image(file_, texture);
        if (!known || source < 0) {
            keep(texture, !known ? "is used as " + found.keys.back() + ", which is not known"
                                 : "has levels or a format of its own");
            continue;
        }
        ImageRecipe recipe;
        recipe.image = static_cast<std::size_t>(source);
        recipe.meaning = known->meaning;
        const auto edges = edges_of(file_, placement_of(file_, *found.info).sampler);
        recipe.edge_u = edges[0];
        recipe.edge_v = edges[1];
        // Occlusion in the file of the roughness is one image with it.
        const bool rides = std::string_view(known->key) == "occlusionTexture" && surface &&
                           image(surface) == source && lie_alike(found, *surface);
        if (&found == surface || rides) {
            recipe.meaning = ImageMeaning::Surface;
            if (paired) {
                recipe.normal = image(normal);
                recipe.normal_scale = scale;
                recipe.roughness_factor = roughness;
                if (by_class_) recipe.metallic_factor = metallic;
            }
        } else if (&found == base) {
            recipe.alpha_covers = mode != "OPAQUE";
            if (mode == "MASK") {
                const JsonText& factor = pbr ? list(*pbr, "baseColorFactor") : list(material, "");
                const double alpha =
                    factor.size() > 3 ? factor.at(3).as_number().value_or(1.0) : 1.0;
                const float cutoff = number_or(&material, "alphaCutoff", 0.5f);
                if (alpha > 0.0) recipe.alpha_cutoff = cutoff / static_cast<float>(alpha);
            }
            if (image(normal) >= 0 && lie_alike(*base, *normal)) {
                recipe.normal = image(normal);
                recipe.normal_scale = scale;
                recipe.metallic_factor = metallic;
                if (metallic > 0.0f && image(surface) >= 0 && lie_alike(*base, *surface))
                    recipe.surface = image(surface);
            }
        } else if (&found == normal && paired) {
            recipe.surface = image(surface);
            recipe.normal_scale = scale;
            recipe.roughness_factor = roughness;
            if (by_class_) recipe.metallic_factor = metallic;
        }
        plan_.slots.push_back({number, found.keys, texture, add(recipe)});
    }
    if (paired && bake_ && roughness != 1.0f) plan_.baked_materials.push_back(number);
    if (lobes_ != 2 || !paired) return;
    if (may_have_two_lobes(material)) {
        plan_two_lobes(number, *surface, *normal);
    } else {
        plan_.notes.push_back("material " + std::to_string(number) +
                              " lets light through, or has lighting of its own: it has one lobe");
    }
}

// The recipes of one lobe are there.
void Planner::plan_two_lobes(std::size_t number, const Found& surface, const Found& normal)
{
    const auto beside = [&](const Found& found, const char* key, std::optional<ImageMeaning> meaning) {
        const auto own = std::find_if(plan_.slots.begin(), plan_.slots.end(), [&](const TextureSlot& s) {
            return s.material == number && s.keys == found.keys;
        });
        ImageRecipe recipe = plan_.recipes[own->recipe];
        recipe.lobes = 2;
        if (meaning) recipe.meaning = *meaning;
        const TextureSlot slot{number, {"extensions", kTwoLobes, key}, own->texture, add(recipe), found.keys};
        plan_.slots.push_back(slot);
    };
    beside(normal, "normalTexture", {});
    beside(surface, "metallicRoughnessTexture", {});
    beside(normal, "secondLobeTexture", ImageMeaning::SecondLobe);
}

}  // namespace

int source_image(const GltfFile& file, std::size_t texture)
{
    const JsonText& textures = list(file.json, "textures");
    const JsonText& images = list(file.json, "images");
    if (texture >= textures.size()) {
        throw Error("glTF " + file.path.string() + ": a material names texture " +
                        std::to_string(texture) + ", there are " + std::to_string(textures.size()),
                    "Export the scene again.");
    }
    const JsonText& json = textures.at(texture);
    std::optional<std::size_t> image = index_of(json, "source");
    if (const JsonText* extensions = json.find("extensions")) {
        if (extensions->find("KHR_texture_basisu") || extensions->find("MSFT_texture_dds"))
            return -1;
        const JsonText* webp = extensions->find("EXT_texture_webp");
        if (webp && !image) image = index_of(*webp, "source");
    }
    if (!image) return -1;
    if (*image >= images.size()) {
        throw Error("glTF " + file.path.string() + ": texture " + std::to_string(texture) +
                        " names image " + std::to_string(*image) + ", there are " +
                        std::to_string(images.size()),
                    "Export the scene again.");
    }
    return static_cast<int>(*image);
}

ImagePlan plan_images(const GltfFile& file, bool bake_roughness, int lobes, bool by_class)
{
    return Planner(file, bake_roughness, lobes, by_class).plan();
}

}  // namespace petrichor::texproc
