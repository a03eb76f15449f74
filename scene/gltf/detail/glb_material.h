#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLB_MATERIAL_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLB_MATERIAL_H

#include "scene/gltf/detail/glb_document.h"
#include "scene/scene.h"

namespace petrichor::scene::detail {

/// Adds the images of a scene with their samplers; texture k of the scene is texture k of the file.
/// Throws Error for an image without bytes.
void add_textures(GlbDocument& glb, const scene::Scene& scene);

/// Adds a material: glTF 2.0, the extensions its values need, and PETRICHOR_materials_weather.
/// What has its usual value is left out. Throws Error for a texture that the scene lacks.
void add_material(GlbDocument& glb, const scene::Scene& scene, const scene::Material& material);

}  // namespace petrichor::scene::detail

#endif
