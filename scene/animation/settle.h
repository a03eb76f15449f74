#ifndef PETRICHOR_SCENE_ANIMATION_SETTLE_H
#define PETRICHOR_SCENE_ANIMATION_SETTLE_H

#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::scene {

/// Which of a scene's animations play.
struct Playing {
    std::string animation = "all";  ///< "all", "none", or the name of one
    bool loop = true;               ///< each begins again when it ends; else it stays as it ended
};

/// Decides what of a loaded scene moves. What the chosen animations do not reach takes its place and
/// shape at rest for good (skins bent as their joints stand, morph targets by their default weights)
/// and is scene like any other; the rest is marked Instance::moves and keeps what moves it.
/// Of "all", one that drives something that an earlier one drives too is left out.
///
/// Gives a line about what plays, and one about what does not; none for a scene without animations.
/// Throws Error for a name that is not there.
std::vector<std::string> settle_animation(Scene& scene, const Playing& playing);

}  // namespace petrichor::scene

#endif
