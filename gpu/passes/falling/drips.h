// Drops that come off the edges of roofs, awnings, sills and beams.
#ifndef PETRICHOR_GPU_PASSES_FALLING_DRIPS_H
#define PETRICHOR_GPU_PASSES_FALLING_DRIPS_H

#include <span>
#include <vector>

#include "gpu/passes/falling/falling_field.h"
#include "scene/drips/drip_points.h"

namespace petrichor::gpu {

/// Water that runs to edges from a surface in the open, kg/m2 and second: the rain, once it has wetted the
/// surface; for minutes after it what the film still sheds; above 0 C what melts of snow. 0 where all is dry or
/// frozen.
float runs_off_kg_m2_s(const shared::WeatherMoment& weather);

/// Drops a second that a point lets go, without what limits them (kMostDrips_s).
float drips_per_s(const scene::DripPoint& point, float runs_off_kg_m2_s);
inline constexpr float kDripSlot_s = 0.125f;
inline constexpr float kMostDrips_s = 0.9f / kDripSlot_s;  ///< of a point; more is a jet

/// How a drop of such a size falls from rest through air that stands still or blows: its terminal speed is that of
/// rain of its size, drag grows with the square of the speed.
struct DripFall {
    float way_m = 0.0f;      ///< down
    float speed_m_s = 0.0f;
    float share = 0.0f;      ///< of the wind's speed that it has ..
    float blown_s = 0.0f;    ///< .. and for how long the whole wind would have carried it as far
};
DripFall drip_fall(float diameter_mm, float age_s);
float drip_fall_time_s(float diameter_mm, float height_m);

/// The drops of a frame that are in the air, and what they throw up where they hit, as the view sees them; at most
/// about `budget` of them and kMostDrips. Stateless as falling_drops: each point and slot of time lets one go or none.
/// Empty while nothing runs off, where falling things are not drawn, and in orthographic views.
std::vector<shared::FallingDrop> drips(std::span<const scene::DripPoint> points, const Frame& frame,
                                       const FallingView& view, const std::vector<Light>& lamps);
inline constexpr int kMostDrips = 4000;

/// Adds them to what falls, which is sorted, far ones first, and stays so.
void add_drips(std::vector<shared::FallingDrop>& falling, std::vector<shared::FallingDrop> drips);

}  // namespace petrichor::gpu

#endif
