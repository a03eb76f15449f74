#ifndef PETRICHOR_FILM_FRAMES_KEPT_H
#define PETRICHOR_FILM_FRAMES_KEPT_H

#include <filesystem>
#include <map>
#include <string>

#include "film/frames/frame_writer.h"
#include "film/frames/frames_jsonl.h"

namespace petrichor::film {

/// "" when the picture of a job can stay as it lies in the folder, else why it is made again: it is
/// not there, it would come out differently (and from what: "the camera changed"), or a file of it
/// is not the one that was written.
///
///   parts    what would decide the picture now, as in FrameFacts
///   verify   also decode the pictures, and compare the pixels of an EXR with beauty_hash
std::string why_again(const std::map<Job, FrameRecord>& records, const Job& job,
                      const FrameParts& parts, const WrittenKinds& kinds,
                      const std::filesystem::path& folder, bool verify);

}  // namespace petrichor::film

#endif
