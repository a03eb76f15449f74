#ifndef PETRICHOR_FILM_FRAMES_FILM_H
#define PETRICHOR_FILM_FRAMES_FILM_H

#include <filesystem>
#include <functional>
#include <string>

#include "base/interrupted.h"
#include "film/frames/job.h"

namespace petrichor::film {

/// The ffmpeg that PATH finds, or "".
std::string find_ffmpeg();

/// Makes an H.264 film (yuv420p, sRGB, plays everywhere) from PNG files, whole or not at all. Odd sizes are cut by
/// one pixel, which the format needs.
///
///   picture   bytes of the PNG of frame 0 .. count - 1, asked in this order
///   throws    Error with ffmpeg's last words; Interrupted (ffmpeg is ended then)
void make_film(const std::function<std::string(int)>& picture, int count, double fps,
               const std::filesystem::path& film, const StopRequest& stop = {});

/// Makes an H.264 film from frame_0000<suffix>.png ... in a folder, likewise.
///
///   first, count   frames first .. first + count - 1 must be there
///   throws         Error with ffmpeg's last words; Interrupted (ffmpeg is ended then)
void make_film(const std::filesystem::path& folder, Job first, int count, double fps,
               const std::filesystem::path& film, const StopRequest& stop = {});

}  // namespace petrichor::film

#endif
