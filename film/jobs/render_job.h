#ifndef PETRICHOR_FILM_JOBS_RENDER_JOB_H
#define PETRICHOR_FILM_JOBS_RENDER_JOB_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/interrupted.h"
#include "film/jobs/sequence.h"

namespace petrichor::film {

/// Told how the work goes on; nothing is printed here.
class RenderWatcher {
public:
    virtual ~RenderWatcher() = default;
    /// Before the first of `count` frames.
    virtual void begin(int count, const ScenarioOutput& output, const gpu::DeviceInfo& device) = 0;
    /// `count` frames are on disk.
    virtual void written(int count) = 0;
};

/// What a user asks of `petrichor render`, apart from the scenario.
struct RenderRequest {
    std::filesystem::path folder;  ///< where the frames go
    FrameRange range;
    bool resume = false;  ///< keep frames whose files have the hashes they were written with and
                          ///< that would come out the same
    bool verify = false;  ///< with resume: also decode the pictures and compare their pixels
    std::string device;   ///< as in gpu::RendererOptions
    std::uint64_t memory_budget = 0;  ///< bytes that the scene may take; 0: default_memory_budget()
    int threads = 0;                  ///< of the image readers; 0: all cores
    bool validation = false;          ///< run the validation layer; its messages are an error
    std::string weather_name;         ///< for frames.jsonl
    std::string command;              ///< how to go on after a stop: the command line with --resume
    StopRequest stop = {};            ///< asked between frames
    RenderWatcher* watcher = nullptr;
};

/// What rendering left behind.
struct RenderReport {
    int rendered = 0;
    int kept = 0;
    bool film = false;
    double seconds = 0.0;
    long peak_mib = 0;
    std::vector<std::string> notes;       ///< for the log
    std::vector<std::string> validation;  ///< messages of the validation layer
    std::string graph;                    ///< passes of the last frame, a line each
};

/// Renders the frames of a range into a folder, writing while rendering: frame_0000.exr and .png,
/// frames.jsonl, and film.mp4 once every frame of the sequence is there. The sequence's scene loses
/// its encoded images on the way.
///
/// Every file is whole or absent at any time. Throws Error for what the user can mend, Interrupted
/// after a stop (finished frames are kept).
RenderReport render_sequence(Sequence& sequence, const RenderRequest& request);

}  // namespace petrichor::film

#endif
