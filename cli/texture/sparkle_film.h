#ifndef PETRICHOR_CLI_TEXTURE_SPARKLE_FILM_H
#define PETRICHOR_CLI_TEXTURE_SPARKLE_FILM_H

#include <filesystem>
#include <functional>

#include "base/interrupted.h"
#include "cli/texture/sparkle_sheet.h"

namespace petrichor::cli {

/// How a material holds still: the floor of the picture yardstick under a moving camera (texproc/prefilter/picture.h)
/// in four lights and on metal, plain mips beside prefiltered ones beside the truth, each with its RMSE and flicker. The camera
/// goes on by one repeat of the material, so that a film may play again and again. Colour of the maps is not used.
///
///   film      .mp4, by ffmpeg (throws Error without it), or .png: the first of its frames, as a strip
///   progress  called with the share done, 0..1
/// Throws Error when the maps do not fit together; Interrupted.
void write_sparkle_film(const SparkleSheet& sheet, const std::filesystem::path& film,
                        const std::function<void(double)>& progress, const StopRequest& stop = {});

}  // namespace petrichor::cli

#endif
