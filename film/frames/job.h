#ifndef PETRICHOR_FILM_FRAMES_JOB_H
#define PETRICHOR_FILM_FRAMES_JOB_H

#include <compare>
#include <string>
#include <string_view>

namespace petrichor::film {

/// One picture of a sequence: a frame, under one of its variants, from one of its views. The names
/// are "" where a sequence has only its own conditions and its own camera. It is the key of a
/// picture in file names and frames.jsonl.
struct Job {
    int frame = 0;
    std::string variant = {};
    std::string view = {};

    auto operator<=>(const Job&) const = default;
};

/// "frame_0030.exr", "frame_0030_wet_left.exr".
std::string file_name(const Job& job, const std::string& extension);
/// What follows the frame's number: "", "_wet_left". Also of the film.
std::string name_suffix(const Job& job);

/// A part of the jobs of a command: the index-th of count equal shares, 1 .. count.
struct Shard {
    int index = 1;
    int count = 1;
};
/// "2/8". Throws Error for anything else.
Shard parse_shard(std::string_view text);

}  // namespace petrichor::film

#endif
