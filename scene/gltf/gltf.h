#ifndef PETRICHOR_SCENE_GLTF_GLTF_H
#define PETRICHOR_SCENE_GLTF_GLTF_H

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Gives the bytes of a file that the scene names by a relative URI (already percent-decoded).
/// Throws petrichor::Error when there is none.
using ResourceReader = std::function<std::vector<std::byte>(const std::string& uri)>;

struct GltfOptions {
    std::string variant;  ///< of KHR_materials_variants; empty: the materials of the file
};

/// Reads a glTF 2.0 asset, text or binary (recognised from the content).
///
/// Everything is checked before it is used: every index, byte range, count, node cycle and URI
/// (absolute paths, "..", and schemes other than data: are refused). Textures, accessors and
/// buffers that nothing uses are not read. Missing normals are computed flat, missing tangents as
/// MikkTSpace defines them. Points and lines are left out. Animations, and the skins and morph
/// targets that they move, are in Scene::rig, for settle_animation(); a scene without animations is
/// settled already.
/// The vertex attribute _WEATHER (VEC4, float or normalised) gives the weather masks of
/// Primitive::weather.
///
/// Extensions: KHR_materials_variants, KHR_node_visibility, KHR_animation_pointer (of nodes),
/// KHR_lights_punctual, KHR_texture_transform,
/// KHR_materials_{emissive_strength,specular,ior,clearcoat,sheen,anisotropy,transmission,unlit},
/// KHR_mesh_quantization, EXT_mesh_gpu_instancing, EXT_texture_webp, PETRICHOR_materials_weather.
/// Of the material extensions the factors are read, not the textures. An unknown required extension
/// is an error, an unknown used one a warning in Scene::warnings.
///
///   name     for messages, usually the file name
///   throws   Error that names the JSON path ("meshes[2].primitives[0].indices"), the value, the
///            values accepted and what to do.
Scene load_gltf(std::span<const std::byte> asset, const std::string& name,
                const ResourceReader& read_resource, const GltfOptions& options = {});

/// Whether this build unpacks KHR_draco_mesh_compression.
bool reads_draco();

}  // namespace petrichor::scene

#endif
