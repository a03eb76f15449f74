#ifndef PETRICHOR_SCENE_GLTF_GLB_WRITER_H
#define PETRICHOR_SCENE_GLTF_GLB_WRITER_H

#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Packs a scene as a binary glTF 2.0 file with its images inside.
///
/// Images must be PNG or JPEG bytes. Extensions written where they are needed: KHR_lights_punctual,
/// KHR_texture_transform, KHR_materials_{emissive_strength,specular,ior,clearcoat,sheen,anisotropy,
/// transmission,unlit} and PETRICHOR_materials_weather, whose members are the fields of
/// scene::MaterialWeather in camelCase without the unit (heightTexture, heightScale, defaultHeight,
/// puddleMaskTexture, snowMaskTexture, porosity, waterSlopeDamp, waterAccumulation, ...).
/// Vertex masks go into the attribute _WEATHER, VEC4 of normalised bytes; tangents are left to the
/// reader when a primitive has none.
///
///   throws   Error when an index of the scene points outside its array or an attribute is short.
std::vector<std::byte> write_glb(const scene::Scene& scene);

}  // namespace petrichor::scene

#endif
