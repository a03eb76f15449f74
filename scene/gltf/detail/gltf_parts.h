// The parts of a glTF scene, each read by its own function; load_gltf puts them together.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_PARTS_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_PARTS_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/animation/rig.h"
#include "scene/gltf/detail/gltf_buffers.h"
#include "scene/gltf/detail/gltf_json.h"
#include "scene/scene.h"

namespace petrichor::scene {

/// What every part needs.
struct GltfSource {
    JsonObject root;
    GltfBuffers buffers;
};

/// Makes Scene::textures out of the textures that materials ask for. Textures that nobody uses are
/// not read; the same image with the same sampler is one texture.
class TextureCollector {
public:
    TextureCollector(GltfSource& source, Scene& scene);

    /// Reads a textureInfo (index, texCoord, KHR_texture_transform) of `parent`; absent: not
    /// present.
    TextureUse use(const JsonObject& parent, std::string_view key);

private:
    TextureIndex texture(std::uint32_t index, const JsonObject& info);
    /// The image with the sampler of `out`.
    TextureIndex image(std::uint32_t index, EncodedImage out);

    GltfSource& source_;
    Scene& scene_;
    JsonArray textures_;
    JsonArray images_;
    JsonArray samplers_;
    std::map<std::string, TextureIndex> made_;  ///< by image and sampler state
};

/// All materials, in the order of the file. Fills scene.textures too.
void read_materials(GltfSource& source, Scene& scene);

/// All meshes, in the order of the file; indices are checked, triangles only. Primitives without a
/// material get `default_material`. Normals and tangents stay empty where the file gives none.
/// `variant` of KHR_materials_variants replaces materials; empty: none does.
std::vector<Mesh> read_meshes(GltfSource& source, std::uint32_t default_material,
                              const std::string& variant);

/// Fills instances, lights and cameras with what the scene to be shown holds.
void read_nodes(GltfSource& source, std::size_t mesh_count, Scene& scene);

/// Nodes, skins and animations; null when nothing in the file could move or bend. `parents` by node.
/// Channels without a target that we know are left out with a warning.
std::shared_ptr<Rig> read_rig(GltfSource& source, std::span<const std::int32_t> parents);

/// KHR_lights_punctual of the file, at the origin, shining along -z. Lights of a type that we do
/// not know are none.
std::vector<std::optional<Light>> read_lights(const JsonObject& root);
std::vector<Camera> read_cameras(const JsonObject& root);

}  // namespace petrichor::scene

#endif
