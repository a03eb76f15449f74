#ifndef PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_ALBEDO_H
#define PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_ALBEDO_H

#include <glm/glm.hpp>
#include <vector>

#include "gpu/frame/frame.h"
#include "gpu/frame/patch_scene.h"

namespace petrichor::gpu {

/// What a patch sends back of its light and sends out by itself, under a weather; and each entry of PatchScene::near.
struct PatchLook {
    std::vector<glm::vec3> albedo;
    std::vector<glm::vec3> emission;  ///< radiance
    std::vector<glm::vec3> near_albedo;
    std::vector<glm::vec3> near_emission;  ///< radiance
};

/// The formulas of a pixel (formulas/weather) at every patch: masks at the middle of their quarters,
/// height maps at the material's default, roofs by the visibility towards the falling rain. What is
/// mirrored counts as sent back evenly. Entries by their own material, way and shelter; the weather of places they
/// have from the patch on whose surface they lie.
/// changes: of materials since the scene was loaded (Frame::materials).
/// place: the weather of the patches themselves; counts where it is of these patches, else null.
PatchLook patch_look(const PatchScene& patches, const shared::WeatherMoment& weather,
                     const shared::WeatherLook& look, bool shelter,
                     const std::vector<scene::MaterialChange>& changes = {},
                     const PlaceWeather* place = nullptr);

}  // namespace petrichor::gpu

#endif
