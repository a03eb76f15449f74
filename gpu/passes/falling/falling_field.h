#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_FIELD_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_FIELD_H

#include <vector>

#include "gpu/passes/falling/falling_view.h"

namespace petrichor::gpu {

/// Drops or flakes of about one size: all of a class fall at one speed.
struct FallingClass {
    std::uint32_t id = 0;          ///< the same for the same sizes, whatever else falls
    float low_mm = 0.0f, high_mm = 0.0f;
    float snow_kg_m2 = 0.0f;       ///< 0: rain; else as kDrySnow_kg_m2
    float fall_m_s = 1.0f;
    float per_m3 = 0.0f;
    float extinction_per_m = 0.0f;
    float cell_m = 1.0f;           ///< side of the cells that the air is divided into
    float reach_m = 0.0f;          ///< drawn up to here; 0: none
};

/// Which of what falls is drawn one by one, and what is left to dim the picture.
struct FallingPlan {
    std::vector<FallingClass> classes;
    glm::vec3 air_m_s{0.0f};       ///< where drops go besides falling
    /// Along which roofs keep it off: of drops of middle size, else of flakes, in half the wind, as
    /// eddies bring them into the lee of houses (ours).
    glm::vec3 shelter_fall_m_s{0.0f, -6.5f, 0.0f};
    float least_opacity = 1.0f;    ///< fainter ones are not drawn
    float per_m3 = 0.0f;           ///< of all classes
    float extinction_per_m = 0.0f; ///< of all classes
    float drawn_per_m = 0.0f;      ///< of the classes that are drawn, not more than the air's own ..
    float drawn_reach_m = 0.0f;    ///< .. to this distance, in the mean
    glm::vec3 gusts{0.0f};         ///< of what is not drawn: gust_veil()'s way_m and strength
    double seen = 0.0;             ///< how many lie between the camera and the visibility
};

/// What falls by the SI values of the weather. As many are drawn as the budget allows, those that
/// hide most first: a class reaches as far as one of its drops hides `least_opacity`. Snow is never
/// denser than the visibility of the weather allows three times over (what falls and how far one
/// sees scatter by so much: Rasmussen et al. 1999). More than 1000 mm/h of rain or 100 mm/h of snow
/// are drawn as those.
///
/// Orthographic views and a budget of 0: nothing is drawn one by one.
FallingPlan plan_falling(const Frame& frame, const FallingView& view);

/// Every drop of the plan that the view may see, far ones first.
///
/// Stateless: space is divided into cells that move with the air, a cell's drops follow from the
/// hash of its number, so a drop has its own way through the world whatever the camera does and
/// whichever frame is asked for.
///
///   lamps   that light them
std::vector<shared::FallingDrop> falling_drops(const FallingPlan& plan, const Frame& frame,
                                               const FallingView& view,
                                               const std::vector<Light>& lamps);

}  // namespace petrichor::gpu

#endif
