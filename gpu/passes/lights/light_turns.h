#ifndef PETRICHOR_GPU_PASSES_LIGHTS_LIGHT_TURNS_H
#define PETRICHOR_GPU_PASSES_LIGHTS_LIGHT_TURNS_H

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/frame/frame_io.h"

namespace petrichor::gpu {

/// The part of a picture that most lights may reach.
struct LightCrowd {
    std::size_t lights = 0;
    std::size_t turns = 0;  ///< of the loops of one invocation of the lighting there, at most
};

/// CPU drivers cut the loops of one invocation at 65 535 turns, all together, and say nothing. Some are left
/// for loops that have nothing to do with lights.
inline constexpr std::size_t kMostLightTurns = 64000;

/// So few lights fit wherever they stand, where they are walked once.
inline constexpr std::size_t kLightsAnywhere = 34000;

/// A pixel walks its lights once, for what is taken apart once more, and for what is gathered, and for what shadows leave, twice more.
inline constexpr std::size_t kMostLightWalks = 6;

/// .. where an invocation lights eight pixels in turns, so few where it walks the lights once, or again for what is taken apart,
/// gathered or left by shadows.
inline constexpr std::size_t kLightsInTurns = 4000;
inline constexpr std::size_t kLightsInTurnsAgain = 500;

/// Where lights crowd. Of each ball a rectangle of coarse tiles is taken that holds all of it, so what is said is
/// never too little.
///
///   balls   centre and reach of the lights, metres, in the order of their table
///   ranges  of the table: 1..4 loops go over each list
///   views   of all samples; a light that one of them sees counts
LightCrowd largest_light_crowd(std::span<const glm::vec4> balls, int ranges,
                               const std::vector<shared::FrameConstants>& views, int width, int height);

}  // namespace petrichor::gpu

#endif
