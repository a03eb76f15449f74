#ifndef PETRICHOR_FILM_JOBS_SEQUENCE_H
#define PETRICHOR_FILM_JOBS_SEQUENCE_H

#include <functional>
#include <string>
#include <string_view>

#include "film/jobs/bridge.h"
#include "film/scenario/scenario.h"
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

/// "640x360". Throws Error for anything else, for 0 and for more than 16384 a side or 64 Mpixels.
ImageSize parse_size(std::string_view text);
void check_size(const ImageSize& size);

/// A scene and a scenario that together say what every frame shows.
struct Sequence {
    Scenario scenario;
    scene::Scene scene;       ///< as loaded; the pixels may be gone
    scene::Bounds bounds;     ///< of the scene's content, for framing
    double duration_s = 0.0;  ///< frame 0 to one after the last, on the scenario's clock
    std::function<WeatherMoment(double time_s)> weather;  ///< a function of the time alone
    std::string content;  ///< fingerprint of the files behind scene and environment
};

/// Time of a frame on the clock of weather, sun and camera.
double frame_time_s(const Sequence& sequence, int frame);

struct SequenceFrame {
    double time_s = 0.0;
    gpu::Frame frame;
};

/// Everything that the renderer is told about a frame; depends on nothing but the sequence and the
/// number, so any frame can be rendered alone.
SequenceFrame frame_at(const Sequence& sequence, int frame);

/// Fingerprint of everything that decides the picture of a frame: a picture made under the same one
/// is the same picture.
std::string frame_fingerprint(const Sequence& sequence, const gpu::Frame& frame);

}  // namespace petrichor::film

#endif
