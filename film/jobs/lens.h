#ifndef PETRICHOR_FILM_JOBS_LENS_H
#define PETRICHOR_FILM_JOBS_LENS_H

#include "film/jobs/sequence.h"

namespace petrichor::film {

/// How long the shutter is open where a scenario says nothing.
inline constexpr double kShutter_s = 0.004;

/// The lens of a moment. Throws Error for an orthographic camera with one, and for a focus before the near
/// distance.
gpu::Lens lens_at(const ScenarioCamera& camera, const scene::Camera& view, double time_s);

/// Gives the samples of a frame moments spread over the time that the shutter is open, around the frame's
/// own, which is the first. Keys of a film may run faster than its pictures: a camera blurs by its speed on
/// the screen.
void open_shutter(gpu::Frame& frame, const Sequence& sequence, const ScenarioCamera& camera,
                  double aspect, double time_s);

}  // namespace petrichor::film

#endif
