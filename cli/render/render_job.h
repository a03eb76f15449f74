#ifndef PETRICHOR_CLI_RENDER_JOB_H
#define PETRICHOR_CLI_RENDER_JOB_H

#include <filesystem>
#include <string>
#include <vector>

#include "cli/render/sequence.h"

namespace petrichor::cli {

/// What a user asks of `petrichor render`, apart from the scenario.
struct RenderRequest {
    std::filesystem::path folder;  ///< where the frames go
    FrameRange range;
    bool resume = false;       ///< keep frames that are whole and would come out the same
    std::string device;        ///< as in gpu::RendererOptions
    int threads = 0;           ///< of the image readers; 0: all cores
    bool validation = false;   ///< run the validation layer; its messages are an error
    bool dump_graph = false;   ///< print the passes of the last frame on stdout
    std::string weather_name;  ///< for frames.jsonl
    std::string command;       ///< how to go on after Ctrl-C: the command line with --resume
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
};

/// Renders the frames of a range into a folder, writing while rendering: frame_0000.exr and .png,
/// frames.jsonl, and film.mp4 once every frame of the sequence is there. The sequence's scene loses
/// its encoded images on the way.
///
/// Every file is whole or absent at any time. Throws Error for what the user can mend, Interrupted
/// after Ctrl-C (finished frames are kept).
RenderReport render_sequence(Sequence& sequence, const RenderRequest& request);

}  // namespace petrichor::cli

#endif
