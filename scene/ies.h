#ifndef PETRICHOR_SCENE_IES_H
#define PETRICHOR_SCENE_IES_H

#include <string>
#include <string_view>

#include "scene/scene.h"

namespace petrichor::scene {

/// A measured distribution of light.
struct IesLight {
    LightProfile profile;   ///< 1 where it is strongest
    float peak_cd = 0.0f;   ///< what that is
};

/// Reads photometry of ANSI/IES LM-63 (1986 to 2019), type C: vertical angles from straight down
/// (the light's direction), horizontal ones from the lamp's y axis towards its x axis, in a full turn, a
/// half, a quarter or none, as the standard's symmetries have it. Below 0.5 MiB.
///
///   throws Error "NAME: ..." for anything that is not such a text: no TILT, another type, counts and
///   angles that contradict each other, numbers that are missing, negative, or none.
IesLight read_ies(std::string_view text, const std::string& name);

}  // namespace petrichor::scene

#endif
