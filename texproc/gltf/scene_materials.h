#ifndef PETRICHOR_TEXPROC_GLTF_SCENE_MATERIALS_H
#define PETRICHOR_TEXPROC_GLTF_SCENE_MATERIALS_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/gltf/gltf_file.h"
#include "texproc/material/material_names.h"

namespace petrichor::texproc {

struct SceneMaterials {
    std::vector<MaterialFiles> materials;  ///< those that have maps
    std::vector<std::string> notes;        ///< what is left out, and why
};

/// The maps of the materials of a scene as files, by role: base colour, normals (green up, as glTF
/// says), occlusion, roughness and metallic of the packed image, emission. Images that the scene
/// holds are written into `folder` as they are. Factors stay with the scene. A material without a
/// name is called "material_N"; names that are taken get their number.
SceneMaterials scene_materials(const GltfFile& file, const std::filesystem::path& folder);

}  // namespace petrichor::texproc

#endif
