#ifndef PETRICHOR_GPU_UPLOAD_WIDE_GROUND_H
#define PETRICHOR_GPU_UPLOAD_WIDE_GROUND_H

#include <vector>

#include "scene/scene.h"

namespace petrichor::gpu {

/// By material: whether what faces up of it, in all instances together, is at least
/// `kWideGround_m2` (formulas/weather/ground_tone.h). In the pose in which the scene was loaded; triangles with
/// corners that are no numbers count nothing.
std::vector<bool> wide_ground(const scene::Scene& scene);

}  // namespace petrichor::gpu

#endif
