#ifndef PETRICHOR_FILM_FRAMES_FRAMES_JSONL_H
#define PETRICHOR_FILM_FRAMES_FRAMES_JSONL_H

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "film/frames/job.h"
#include "gpu/renderer.h"
#include "weather/moment.h"

namespace petrichor::film {

/// What frames.jsonl says about one frame. The line holds no times of day, durations or paths: the
/// same frame gives the same line on every run.
struct FrameFacts {
    Job job;
    double time_s = 0.0;      ///< on the clock of weather, sun and camera
    weather::Moment moment;   ///< its clock and place
    std::string weather;      ///< name of the preset or file, for the reader
    std::string settings;     ///< fingerprint of everything that decides the picture
    std::string beauty_hash;  ///< of the half-float pixels
    float exposure = 1.0f;    ///< scale from scene light to the PNG
    gpu::Frame input;
    std::map<std::string, std::uintmax_t> files;  ///< name -> bytes
};

/// One line, without the line break: JSON with a fixed order of keys and shortest exact numbers.
/// "variant" and "view" are there where the sequence has some; "utc" and "place" where the weather
/// knows them; "weather" has every row of shared::kMomentRows, null for what is not known.
/// Matrices are rows of rows. "projection" maps camera space to clip space with y up and reversed
/// depth (1 near, 0 infinitely far); intrinsics are in pixels, y down.
std::string frame_line(const FrameFacts& facts);

/// What is needed of a line to tell whether its frame can be kept.
struct FrameRecord {
    std::string settings;
    std::map<std::string, std::uintmax_t> files;
    std::string line;
};

/// Reads folder/frames.jsonl by job; lines that are not whole are left out, a missing file is
/// empty.
std::map<Job, FrameRecord> read_frame_records(const std::filesystem::path& folder);

/// True when every file of the record lies in the folder with its size.
bool files_are_whole(const FrameRecord& record, const std::filesystem::path& folder);

/// Adds or replaces lines in folder/frames.jsonl, in order of jobs, whole or not at all. Several
/// programs may do this to one folder at once: each sees what the others wrote.
void merge_frame_lines(const std::filesystem::path& folder,
                       const std::map<Job, std::string>& lines);

}  // namespace petrichor::film

#endif
