// A plate in light that is alike from all sides.
#ifndef PETRICHOR_TESTS_GPU_FURNACE_FRAME_H
#define PETRICHOR_TESTS_GPU_FURNACE_FRAME_H

#include <cmath>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {

/// Its middle at the origin is at pixel (8, 8), seen under the cosine `up` to the vertical.
inline Frame furnace_frame(float up)
{
    Frame frame;
    frame.camera = look(4.0f * glm::vec3(std::sqrt(1.0f - up * up), up, 0.0f), {0, 0, 0}, 0.05f);
    frame.settings.width = 17;
    frame.settings.height = 17;
    frame.settings.samples = 1;
    frame.settings.ambient_occlusion = false;
    frame.sky.sun_illuminance = 0.0f;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

}  // namespace petrichor::gpu

#endif
