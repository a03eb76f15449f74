#ifndef PETRICHOR_FILM_SCENES_NODE_TRACKS_H
#define PETRICHOR_FILM_SCENES_NODE_TRACKS_H

#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/scenes/snow_tracks.h"
#include "scene/scene.h"

namespace petrichor::film {

/// How the clock of a scene's animations runs along a film.
struct AnimationClock {
    double start_s = 0.0;  ///< of the animations, at the film's first frame
    double speed = 1.0;
    double fps = 24.0;
    int frames = 1;
};

/// A way that a node goes near the ground, and when it is where. `at_s` are seconds of the film, which never fall;
/// below 0: what it went before the first frame.
struct NodeWay {
    TrackWay way;
    std::vector<double> at_s;  ///< of each point
};

/// Nodes leave tracks where the lowest of them is no more than this over what stands below it ..
inline constexpr double kNearGround_m = 0.15;
/// .. or so deep in it.
inline constexpr double kInGround_m = 0.5;

/// The ways of all nodes that the tracks of a list name, from the beginning of their animation to the film's last
/// frame: below the middle of what hangs on the node. A wide node leaves two tracks of tyres, one narrower than
/// 0.5 m one; the foot that is lifted between its steps leaves one print where it is set down.
///
/// A function of scene and clock alone. The animation is settled. Adds notes about nodes that leave none.
/// Throws Error for a name that no node has, with those that there are.
std::vector<NodeWay> node_ways(const std::vector<ScenarioTrack>& tracks, const scene::Scene& scene, const AnimationClock& clock,
                               std::vector<std::string>& notes);

/// What of a way the node has gone by a second of the film; without points: nothing yet. `left` is not filled.
NodeWay gone_by(const NodeWay& way, double film_s);

}  // namespace petrichor::film

#endif
