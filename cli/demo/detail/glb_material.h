#ifndef PETRICHOR_CLI_DEMO_DETAIL_GLB_MATERIAL_H
#define PETRICHOR_CLI_DEMO_DETAIL_GLB_MATERIAL_H

#include "cli/demo/detail/glb_document.h"
#include "gpu/scene.h"

namespace petrichor::cli::detail {

/// Adds the images of a scene with their samplers; texture k of the scene is texture k of the file.
/// Throws Error for an image without bytes.
void add_textures(GlbDocument& glb, const gpu::Scene& scene);

/// Adds a material: glTF 2.0, the extensions its values need, and PETRICHOR_materials_weather.
/// What has its usual value is left out. Throws Error for a texture that the scene lacks.
void add_material(GlbDocument& glb, const gpu::Scene& scene, const gpu::Material& material);

}  // namespace petrichor::cli::detail

#endif
