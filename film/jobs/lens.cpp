#include "film/jobs/lens.h"

#include <cmath>

#include "base/error.h"
#include "film/jobs/camera.h"
#include "scene/animation/rig.h"

namespace petrichor::film {

gpu::Lens lens_at(const ScenarioCamera& camera, const scene::Camera& view, double time_s)
{
    gpu::Lens lens;
    if (!camera.f_stop.given()) return lens;
    if (view.orthographic_height_m > 0.0f) {
        throw Error("[camera] f_stop: an orthographic camera has no lens",
                    "Leave it out, or choose another camera.");
    }
    const double focal_m =
        0.5e-3 * camera.sensor_mm / static_cast<double>(scene::half_extent_m(view, 1, 1).y);
    lens.radius_m = static_cast<float>(0.5 * focal_m / value_at(camera.f_stop, time_s));
    lens.focus_m = static_cast<float>(value_at(camera.focus_m, time_s, 5.0));
    if (!(lens.focus_m > view.near_m)) {
        throw Error("[camera] focus_m must be beyond near_m, " + std::to_string(view.near_m) +
                        ", got " + std::to_string(lens.focus_m),
                    "Focus farther away, or bring near_m closer.");
    }
    return lens;
}

void open_shutter(gpu::Frame& frame, const Sequence& sequence, const ScenarioCamera& camera,
                  double aspect, double time_s)
{
    const Scenario& scenario = sequence.scenario;
    const double open_s = value_at(camera.shutter_s, time_s, kShutter_s);
    const double clock = sequence.duration_s * scenario.output.fps / scenario.output.frames;
    for (int i = 0; i < scenario.output.samples; ++i) {
        const double u = 0.5 + 0.618033988749895 * i;
        gpu::ShutterMoment moment;
        moment.off_s = i == 0 ? 0.0 : (u - std::floor(u) - 0.5) * open_s;
        moment.animation_s = frame.animation_s;
        moment.camera = camera_at(camera, sequence.scene, sequence.framing, aspect,
                                  time_s + moment.off_s * clock);
        if (sequence.scene.rig) {
            moment.animation_s += scenario.scene.animation_speed * moment.off_s;
            moment.camera = scene::carried(
                moment.camera, scene::posture_at(*sequence.scene.rig, moment.animation_s));
        }
        frame.shutter.push_back(moment);
    }
}

}  // namespace petrichor::film
