#ifndef PETRICHOR_SCENE_PATCHES_MASK_CHANNELS_H
#define PETRICHOR_SCENE_PATCHES_MASK_CHANNELS_H

#include <span>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Channels of a shadow mask for lamps; the sun has one of its own.
inline constexpr int kMaskChannels = 3;

/// A lamp without a range reaches as far as it gives this light, in a shadow mask.
inline constexpr float kMaskLeast_lux = 0.25f;

/// A ball that holds all that a lamp lights. Directional lights: of infinite radius.
struct LampReach {
    glm::vec3 centre_m{0.0f};
    float radius_m = 0.0f;
};
LampReach lamp_reach(const Light& light, float least_lux = kMaskLeast_lux);

/// Gives lamps channels of a shadow mask: Light::mask_channel by lamp, 1..kMaskChannels, 0 where none is left.
/// Lamps whose reaches do not meet share one. Lamps of one name go together, since files tell them apart by
/// it. The strongest choose first, the earlier of equals. Only those that are `wanted` get one; empty: all.
std::vector<int> mask_channels(std::span<const Light> lamps, const std::vector<bool>& wanted = {});

}  // namespace petrichor::scene

#endif
