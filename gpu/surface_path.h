#ifndef PETRICHOR_GPU_SURFACE_PATH_H
#define PETRICHOR_GPU_SURFACE_PATH_H

#include "gpu/device/device.h"
#include "gpu/frame/frame.h"
#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// The way in which a scene's surfaces are shaded at a picture size: what was asked for, or with Auto
/// the faster one. It follows from device, scene, size and whether samples are left out alone, so that
/// all frames of a film take the same. Never Auto; Fragment where the other is not possible; Visibility
/// for scenes with users' own surfaces or with textures of coats, sheen and other layers.
///
/// On a CPU, fragments are shaded in blocks of two by two whatever a triangle covers: where triangles
/// are small the resolve wins, where they are large it pays for fetching corners at every pixel.
/// Adaptive samples are the resolve's alone. On a GPU it is Visibility. The measurements are in docs/surface-paths.md.
SurfacePath chosen_surface_path(SurfacePath asked, const Device& device, const GpuScene& scene,
                                int width, int height, bool adaptive);

}  // namespace petrichor::gpu

#endif
