#ifndef PETRICHOR_FILM_FRAMES_FRAMES_JSONL_H
#define PETRICHOR_FILM_FRAMES_FRAMES_JSONL_H

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "film/frames/job.h"
#include "gpu/renderer.h"
#include "weather/moment.h"

namespace petrichor::film {

/// What tells a file that was written from any other.
struct FileMark {
    std::uintmax_t bytes = 0;
    std::string hash;  ///< of all its bytes; "" in lines of version 0.1.0, which had sizes only
};

/// What decides a picture: a fingerprint for each part of it ("camera", "weather", "scene files").
using FrameParts = std::map<std::string, std::string>;

/// One fingerprint of all of them, to tell pictures apart.
std::string fingerprint_of(const FrameParts& parts);

/// Where a frame's exposure comes from.
struct ExposureFacts {
    std::string mode = "fixed";          ///< auto, incident or fixed, as in a scenario
    std::optional<float> metered_ev100;  ///< with auto: of the picture and those around it
    std::optional<glm::vec3> metered_light;  ///< with white_balance_k = "auto": linear sRGB, of luminance 1
};

/// What frames.jsonl says about one frame. The line holds no times of day, durations or paths: the
/// same frame gives the same line on every run.
struct FrameFacts {
    Job job;
    double time_s = 0.0;      ///< on the clock of weather, sun and camera
    weather::Moment moment;   ///< its clock and place
    std::string weather;      ///< name of the preset or file, for the reader
    FrameParts made_from;     ///< everything that decides the picture
    std::string beauty_hash;  ///< of the half-float pixels
    float exposure = 1.0f;    ///< scale from scene light to the PNG
    ExposureFacts exposure_by;  ///< what decided it
    gpu::Frame input;
    gpu::FallingFacts falling;  ///< written where something falls
    gpu::LightFacts light;
    std::map<std::string, double> ground;  ///< sums over the scene's patches, SI; empty: none
    std::map<std::string, FileMark> files;  ///< by name
};

/// The mark of a file as it lies there now. Throws Error when it cannot be read.
FileMark file_mark(const std::filesystem::path& file);

/// One line, without the line break: JSON with a fixed order of keys and shortest exact numbers.
/// "variant" and "view" are there where the sequence has some; "utc" and "place" where the weather
/// knows them; "weather" has every row of shared::kMomentRows, null for what is not known.
/// Matrices are rows of rows. "projection" maps camera space to clip space with y up and reversed
/// depth (1 near, 0 infinitely far); intrinsics are in pixels, y down.
std::string frame_line(const FrameFacts& facts);

/// What is needed of a line to tell whether its frame can be kept.
struct FrameRecord {
    FrameParts made_from;
    std::string beauty_hash;
    std::map<std::string, FileMark> files;
    std::string line;
};

/// Reads folder/frames.jsonl by job; lines that are not whole are left out, a missing file is
/// empty.
std::map<Job, FrameRecord> read_frame_records(const std::filesystem::path& folder);

/// "" when every file of the record lies in the folder with its size and its hash, else what is
/// wrong: "frame_0003.png is not the file that was written".
std::string wrong_with_files(const FrameRecord& record, const std::filesystem::path& folder);

/// Adds or replaces lines in folder/frames.jsonl, in order of jobs, whole or not at all. Several
/// programs may do this to one folder at once: each sees what the others wrote.
void merge_frame_lines(const std::filesystem::path& folder,
                       const std::map<Job, std::string>& lines);

}  // namespace petrichor::film

#endif
