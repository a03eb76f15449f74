#include "scene/gltf/gltf.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "scene/animation/settle.h"
#include "scene/gltf/detail/gltf_container.h"
#include "scene/gltf/detail/gltf_parts.h"
#include "scene/material_table.h"
#include "scene/tangents.h"

namespace petrichor::scene {
namespace {

bool is_known(std::string_view extension)
{
    static constexpr std::array<std::string_view, 14> others{
        "PETRICHOR_lights_shape",
        "KHR_lights_punctual",     "KHR_texture_transform", "KHR_mesh_quantization",
        "EXT_mesh_gpu_instancing", "MSFT_lod", "EXT_texture_webp",      "KHR_texture_basisu",
        "MSFT_texture_dds",        "KHR_node_visibility",   "KHR_animation_pointer",
        "KHR_materials_variants",  "EXT_meshopt_compression", "KHR_draco_mesh_compression"};
    return !extension_members(extension).empty() ||
           std::find(others.begin(), others.end(), extension) != others.end();
}

void check_version(const JsonObject& root)
{
    const auto asset = root.object("asset");
    if (!asset) root.fail("asset", "is missing", "Give a glTF 2.0 file.");
    const std::string version = asset->text("version");
    const bool two = version.size() >= 3 && version.starts_with("2.") &&
                     version.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!two) {
        asset->fail("version", "must be 2.0, got " + in_quotes(version),
                    "Convert the scene to glTF 2.0.");
    }
    if (version != "2.0") {
        asset->warn("version", "newer than 2.0: what is new in it is not understood");
    }
}

void check_extensions(const JsonObject& root)
{
    const JsonArray required = root.array("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required.text(i);
        if (is_known(name)) continue;
        root.log().fail(required.path_to(i),
                        "cannot read the required extension " + in_quotes(name),
                        "Export the scene without it.");
    }
    const JsonArray used = root.array("extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string name = used.text(i);
        if (!is_known(name)) {
            root.log().warnings.add("", "the extension " + in_quotes(name) + " is ignored");
        }
    }
}

// Drops meshes that nothing shows, and instances of meshes that hold nothing.
void prune(Scene& scene)
{
    std::vector<std::uint32_t> new_index(scene.meshes.size(), 0);
    std::vector<bool> shown(scene.meshes.size(), false);
    std::erase_if(scene.instances,
                  [&](const Instance& i) { return scene.meshes[i.mesh].primitives.empty(); });
    for (const Instance& instance : scene.instances) shown[instance.mesh] = true;
    std::vector<Mesh> kept;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (!shown[m]) continue;
        new_index[m] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(scene.meshes[m]));
    }
    scene.meshes = std::move(kept);
    for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh];
}

// Computes what the file leaves out.
void complete(Primitive& primitive, const Material& material)
{
    if (primitive.normals.empty()) generate_flat_normals(primitive);
    if (primitive.uv0.empty()) primitive.uv0.assign(primitive.positions.size(), glm::vec2(0.0f));
    if (primitive.tangents.empty()) {
        const bool second = material.normal_texture.texcoord == 1 && !primitive.uv1.empty();
        generate_tangents(primitive, second ? 1 : 0);
    }
}

bool uses_second_texcoord(const Material& material)
{
    const auto& textures = material_textures();
    return std::any_of(textures.begin(), textures.end(), [&](const MaterialTexture& texture) {
        const TextureUse& use = texture.get(material);
        return use.present() && use.texcoord == 1;
    });
}

}  // namespace

Scene load_gltf(std::span<const std::byte> asset, const std::string& name,
                const ResourceReader& read_resource, const GltfOptions& options)
{
    GltfLog log{name, {}};
    const GltfContainer container = split_container(asset, log);
    const nlohmann::json document = parse_gltf_json(container.json, log);
    const JsonObject root(document, "", log);
    check_version(root);
    check_extensions(root);

    GltfSource source{
        root, GltfBuffers(root, container.bin, container.has_bin, read_resource, asset.size())};
    Scene scene;
    scene.name = name;
    read_materials(source, scene);
    const auto default_material = static_cast<std::uint32_t>(scene.materials.size());
    scene.meshes = read_meshes(source, default_material, options.variant);
    read_nodes(source, scene.meshes.size(), scene);
    prune(scene);

    bool needs_default = scene.materials.empty();
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            needs_default = needs_default || primitive.material == default_material;
        }
    }
    if (needs_default) {
        scene.materials.emplace_back();
        scene.materials.back().name = "default";
    }
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            const Material& material = scene.materials[primitive.material];
            if (uses_second_texcoord(material) && primitive.uv1.empty()) {
                log.warnings.add(mesh.name,
                                 "its material reads TEXCOORD_1, which it does not have");
            }
            complete(primitive, material);
        }
    }
    scene.warnings = log.warnings.lines();
    if (scene.rig && scene.rig->clips.empty()) settle_animation(scene, {});
    return scene;
}

}  // namespace petrichor::scene
