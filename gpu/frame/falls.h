#ifndef PETRICHOR_GPU_FRAME_FALLS_H
#define PETRICHOR_GPU_FRAME_FALLS_H

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "formulas/weather/moment.h"
#include "gpu/frame/frame_io.h"

namespace petrichor::gpu {

/// Where rain and snow come from: a direction towards the sky, as the number of its depth map, and the
/// share of the rain and of the snow that falls along it. Each sums to 1.
struct Fall {
    int direction = 0;
    float rain = 0.0f;
    float snow = 0.0f;
};

/// The directions of the sky that what falls comes from, most of it spread over several: drops of five
/// sizes, 10 to 90 % of the water, fall at their own speed (Atlas, Srivastava & Sekhon 1973; median size
/// 1.10 R^0.19 mm) through gusts of 20 degrees to either side; snow at 1 m/s, half of it turned
/// about by eddies and so within 30 degrees of the vertical. Wind is that
/// 2 m above ground between houses, 0.46 of its speed at 10 m. Changes smoothly with wind and rain.
std::vector<Fall> falls(const shared::WeatherMoment& weather,
                        const std::array<glm::vec3, SKY_DIRECTIONS>& sky);

}  // namespace petrichor::gpu

#endif
