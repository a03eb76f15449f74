#include "film/jobs/eyes.h"

#include <algorithm>

#include "film/jobs/camera.h"
#include "scene/animation/rig.h"

namespace petrichor::film {
namespace {

constexpr int kMoments = 64;

}  // namespace

std::vector<glm::vec3> eyes_of(const Sequence& sequence)
{
    const Scenario& s = sequence.scenario;
    const double aspect = static_cast<double>(s.output.width) / s.output.height;
    const int last = std::max(s.output.frames - 1, 0);
    const int moments = std::min(last + 1, kMoments);
    // In one order, whichever of the views a run shows.
    std::vector<ScenarioView> views = s.unseen_views;
    for (const ScenarioView& view : sequence.views) {
        const auto same = [&](const ScenarioView& other) { return other.name == view.name; };
        if (std::none_of(views.begin(), views.end(), same)) views.push_back(view);
    }
    std::vector<glm::vec3> eyes;
    for (const ScenarioView& view : views) {
        for (int i = 0; i < moments; ++i) {
            const int frame = moments > 1 ? static_cast<int>(static_cast<long>(last) * i / (moments - 1)) : 0;
            scene::Camera camera = camera_at(view.camera, sequence.scene, sequence.framing, aspect,
                                             frame_time_s(sequence, frame));
            if (sequence.scene.rig) {
                const double at_s = s.scene.animation_start_s +
                                    s.scene.animation_speed * frame / s.output.fps;
                camera = scene::carried(camera, scene::posture_at(*sequence.scene.rig, at_s));
            }
            const glm::vec3 eye(camera.to_world[3]);
            if (eyes.empty() || eyes.back() != eye) eyes.push_back(eye);
        }
    }
    return eyes;
}

}  // namespace petrichor::film
