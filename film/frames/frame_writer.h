#ifndef PETRICHOR_FILM_FRAMES_FRAME_WRITER_H
#define PETRICHOR_FILM_FRAMES_FRAME_WRITER_H

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/interrupted.h"
#include "film/frames/frames_jsonl.h"
#include "gpu/renderer.h"

namespace petrichor::film {

/// What files of a frame say of it.
std::vector<std::pair<std::string, std::string>> frame_metadata(const FrameFacts& facts);

struct WrittenKinds {
    bool exr = true;
    bool png = true;
};

struct FrameWriterOptions {
    std::size_t waiting = 2;                ///< frames held in memory besides the one being written
    StopRequest stop = {};                  ///< once it says so, what is made appears at once
    std::atomic<int>* published = nullptr;  ///< counts frames on the disk, while they are written
};

/// Writes frames in a thread of its own while the next ones are rendered. The pictures of a frame
/// and its line of frames.jsonl appear together, at most a second after they are made.
class FrameWriter {
public:
    FrameWriter(std::filesystem::path folder, WrittenKinds kinds, FrameWriterOptions options = {});
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    ~FrameWriter();  ///< writes what waits, and drops the error if there is one

    /// Hands over a frame; `facts` lacks only beauty_hash, exposure and files. Waits while the
    /// queue is full. Throws what went wrong with an earlier frame (disk full, ...).
    void write(FrameFacts facts, gpu::RenderResult result);

    /// Where pictures may be made by others, before write() is given their facts with beauty_hash, exposure and files, and a
    /// result without pixels.
    const std::filesystem::path& scratch() const;

    /// Waits until everything is written, frames.jsonl included. Throws what went wrong.
    void finish();

    /// Frames on the disk.
    int written() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::film

#endif
