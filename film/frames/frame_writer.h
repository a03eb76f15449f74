#ifndef PETRICHOR_FILM_FRAMES_FRAME_WRITER_H
#define PETRICHOR_FILM_FRAMES_FRAME_WRITER_H

#include <filesystem>
#include <memory>
#include <string>

#include "base/interrupted.h"
#include "film/frames/frames_jsonl.h"
#include "gpu/renderer.h"

namespace petrichor::film {

/// "frame_0030.exr"
std::string frame_file_name(int frame, const std::string& extension);

struct WrittenKinds {
    bool exr = true;
    bool png = true;
};

/// Writes frames in a thread of its own while the next ones are rendered: at most `waiting` frames
/// are held in memory besides the one being written. frames.jsonl follows about once a second.
class FrameWriter {
public:
    /// `stop`: once it says so, frames.jsonl is brought up to date at once.
    FrameWriter(std::filesystem::path folder, WrittenKinds kinds, int waiting = 2,
                StopRequest stop = {});
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    ~FrameWriter();  ///< writes what waits, and drops the error if there is one

    /// Hands over a frame; `facts` lacks only beauty_hash, exposure and files. Waits while the
    /// queue is full. Throws what went wrong with an earlier frame (disk full, ...).
    void write(FrameFacts facts, gpu::RenderResult result);

    /// Waits until everything is written, frames.jsonl included. Throws what went wrong.
    void finish();

    /// Frames on the disk.
    int written() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes one frame now: the files, and the line that belongs into frames.jsonl.
std::string write_frame(const std::filesystem::path& folder, const WrittenKinds& kinds,
                        FrameFacts facts, const gpu::RenderResult& result);

}  // namespace petrichor::film

#endif
