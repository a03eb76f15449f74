#ifndef PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_ALBEDO_H
#define PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_ALBEDO_H

#include <glm/glm.hpp>
#include <vector>

#include "gpu/frame/frame.h"
#include "gpu/frame/patch_scene.h"

namespace petrichor::gpu {

/// What a patch sends back of its light, and what is left of its glow, under a weather.
struct PatchLook {
    std::vector<glm::vec3> albedo;
    std::vector<float> glow;  ///< 0..1
};

/// The formulas of a pixel (formulas/weather) at every patch: masks at the middle of their quarters,
/// height maps at the material's default, roofs by the visibility towards the falling rain. What is
/// mirrored counts as sent back evenly.
PatchLook patch_look(const PatchScene& patches, const shared::WeatherMoment& weather,
                     const shared::WeatherLook& look, bool shelter);

}  // namespace petrichor::gpu

#endif
