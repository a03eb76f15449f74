#ifndef PETRICHOR_FILM_JOBS_SEQUENCE_H
#define PETRICHOR_FILM_JOBS_SEQUENCE_H

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "film/frames/frames_jsonl.h"
#include "film/jobs/air_travel.h"
#include "film/jobs/camera.h"
#include "film/jobs/weather_source.h"
#include "film/scenario/scenario.h"
#include "film/scenes/node_tracks.h"
#include "film/weather/icicle_history.h"
#include "film/weather/snow_history.h"
#include "gpu/renderer.h"
#include "scene/scene.h"

namespace petrichor::film {

/// The frames that a command asks for, both ends included.
struct FrameRange {
    int first = 0;
    int last = 0;
};

/// "A:B", "A:" (to the end), ":B", or "N" (that one) within a sequence of `count` frames.
/// Throws Error for anything else and for frames that the sequence has not.
FrameRange parse_frame_range(std::string_view text, int count);

struct ImageSize {
    int width = 0;
    int height = 0;
};

/// "640x360". Throws Error for anything else, for 0 and for more than 16384 a side.
ImageSize parse_size(std::string_view text);
void check_size(const ImageSize& size);

/// The conditions of a variant, and the weather that follows from them.
struct SequenceVariant {
    std::string name;  ///< "" of the scenario's own
    Conditions conditions;
    WeatherSource weather;
    std::string environment = {};  ///< fingerprint of its sky's picture; "": none
    AirTravel air = {};            ///< of the weather's wind, about true north
    SnowHistory snow = {};         ///< of the weather's snow, over the seconds of the film
    IcicleHistory icicles = {};    ///< over the clock of the weather
};

/// A scene and a scenario that together say what every frame shows.
struct Sequence {
    Scenario scenario;
    std::vector<SequenceVariant> variants;  ///< at least one
    std::vector<ScenarioView> views;        ///< at least one
    scene::Scene scene;                     ///< as loaded; the pixels may be gone
    Framing framing;                        ///< of the scene as loaded, without its outskirts
    double duration_s = 0.0;      ///< frame 0 to one after the last, on the scenario's clock
    std::string content;          ///< fingerprint of the scene's files
    std::string lighting_models;  ///< of the scene's own ones, own_models_fingerprint()
    std::shared_ptr<const DisplayTransform> display = {};  ///< of [render] ocio_config; null: curves of our own
    std::string weather_textures;  ///< of [render]'s, weather_textures_fingerprint()
    std::size_t triangles = 0;     ///< of all instances
    std::vector<glm::vec3> eyes_m = {};  ///< eyes_of(), once the scene is loaded
    std::map<std::string, gpu::SunCookie> sun_cookies = {};  ///< by the files that conditions name
    std::vector<NodeWay> node_ways = {};  ///< in snow, over the whole film
    std::vector<std::string> notes = {};  ///< about the scene: which of its animations play
};

/// A sequence without its scene: weather of every variant, views, duration (the scenario's, else of
/// the longest weather, else as long as the film), colour management. Throws Error as weather_source and
/// DisplayTransform.
Sequence make_sequence(Scenario scenario);

/// Scenes of more triangles are lit by patches only when the scenario asks for it: that takes minutes,
/// and 150 bytes each while they are traced.
inline constexpr std::size_t kMostAutoTriangles = 1'000'000;
/// Whether frames are lit by patches: [render] indirect, the scene's size, light from the sky.
bool wants_patches(const Sequence& sequence);

/// Time of a frame on the clock of weather, sun and camera.
double frame_time_s(const Sequence& sequence, int frame);

/// Jobs of a range of frames in their order: by frame, then variant, then view. Of them a shard.
std::vector<Job> jobs_of(const Sequence& sequence, const FrameRange& range,
                         const Shard& shard = {});

/// The camera of the job's view. Throws Error for a view that is not there.
const ScenarioCamera& camera_of(const Sequence& sequence, const Job& job);

struct SequenceFrame {
    Job job;
    double time_s = 0.0;
    weather::Moment moment;    ///< its clock, place and sun; values as in frame.weather
    std::string weather_name;  ///< of the preset or file
    std::string environment;   ///< as in SequenceVariant
    gpu::Frame frame;
};

/// Everything that the renderer is told about a job but a metered exposure (film/jobs/exposure.h);
/// depends on nothing but the sequence and the
/// job, so any picture can be rendered alone. Throws Error for a variant or view that is not there.
SequenceFrame frame_at(const Sequence& sequence, const Job& job);

/// Everything that decides a picture: one made from the same is the same picture.
FrameParts frame_parts(const Sequence& sequence, const SequenceFrame& frame);

}  // namespace petrichor::film

#endif
