#ifndef PETRICHOR_FILM_JOBS_RENDER_JOB_H
#define PETRICHOR_FILM_JOBS_RENDER_JOB_H

#include <atomic>
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
    /// Rays look for what the scene's surfaces see; share 0..1 of it is done. Only where that is not
    /// in the cache, and before begin().
    virtual void tracing(double share) { static_cast<void>(share); }
    /// Before the first of `count` pictures.
    virtual void begin(int count, const ScenarioOutput& output, const gpu::DeviceInfo& device) = 0;
    /// `done` of the `count` tiles of a frame's picture are rendered; from any thread.
    virtual void tile(int frame, int done, int count)
    {
        static_cast<void>(frame);
        static_cast<void>(done);
        static_cast<void>(count);
    }
    /// `count` pictures are on disk.
    virtual void written(int count) = 0;
};

/// How far the work is; may be read from any thread meanwhile.
struct RenderTally {
    std::atomic<int> asked{0};  ///< pictures; 0 until that is known
    std::atomic<int> there{0};  ///< of them in the folder, kept ones too
};

/// What a user asks of `petrichor render`, apart from the scenario.
struct RenderRequest {
    std::filesystem::path folder;  ///< where the frames go
    FrameRange range;
    Shard shard;          ///< of the jobs of that range
    bool resume = false;  ///< keep frames whose files have the hashes they were written with and
                          ///< that would come out the same
    bool verify = false;  ///< with resume: also decode the pictures and compare their pixels
    std::string device;   ///< as in gpu::RendererOptions
    std::uint64_t memory_budget = 0;  ///< bytes that the scene may take; 0: default_memory_budget()
    int threads = 0;                  ///< of the image readers; 0: all cores
    int in_flight = 0;                ///< pictures rendered at a time; 0: frames_in_flight()
    bool validation = false;          ///< run the validation layer; its messages are an error
    bool passes_apart = false;        ///< as in gpu::RendererOptions
    std::string command;              ///< how to go on after a stop: the command line with --resume
    StopRequest stop = {};            ///< asked between frames
    RenderTally* tally = nullptr;
    RenderWatcher* watcher = nullptr;
};

/// What rendering left behind.
struct RenderReport {
    int rendered = 0;
    int kept = 0;
    int films = 0;
    double seconds = 0.0;
    long peak_mib = 0;
    std::vector<std::string> notes;       ///< for the log
    std::vector<std::string> validation;  ///< messages of the validation layer
    std::string graph;                    ///< passes of the last frame, a line each
};

/// A renderer that holds the sequence's scene with its textures; notes go into the report. The
/// scene loses its encoded images.
gpu::Renderer sequence_renderer(Sequence& sequence, const RenderRequest& request,
                                RenderReport& report);
/// As many as pay for that many pictures, alike; at least one, no more than the memory budget lets.
std::vector<gpu::Renderer> sequence_renderers(Sequence& sequence, const RenderRequest& request,
                                              std::size_t pictures, RenderReport& report);

/// How many pictures a device renders at a time, of so many: one on a GPU. A CPU's driver does half
/// of a picture (vertices, rows of commands) on one thread, so there two, or one for every four
/// threads up to four, and one for every four pictures: each renderer is loaded by itself.
int frames_in_flight(const gpu::DeviceInfo& device, int threads, std::size_t pictures);

/// Gives it the sky's picture of the job's variant, or none; a renderer holds one at a time.
void set_environment_of(gpu::Renderer& renderer, const Sequence& sequence, const Job& job);

/// What to say when the work was stopped: how far it got, and how to go on.
std::string stop_message(const RenderTally& tally, const RenderRequest& request);

/// Renders the jobs of a range into a folder, several at a time (the bytes do not depend on it),
/// writing in their order while rendering: frame_0000.exr and .png
/// (with the names of variant and view), frames.jsonl, and for each variant and view film.mp4 once
/// every frame of it is there. The sequence's scene loses its encoded images on the way.
///
/// Every file is whole or absent at any time. Throws Error for what the user can mend, Interrupted
/// after a stop (finished frames are kept).
RenderReport render_sequence(Sequence& sequence, const RenderRequest& request);

}  // namespace petrichor::film

#endif
