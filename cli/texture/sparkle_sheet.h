#ifndef PETRICHOR_CLI_TEXTURE_SPARKLE_SHEET_H
#define PETRICHOR_CLI_TEXTURE_SPARKLE_SHEET_H

#include <filesystem>
#include <string>

#include "base/image.h"

namespace petrichor::cli {

/// What a person should see of a material's mips.
struct SparkleSheet {
    std::string title;
    Image normal;     ///< 3 channels, green up
    Image roughness;  ///< 1 channel, perceptual
    Image albedo;     ///< 3 channels, linear; may be empty
    std::string rule = "picture";
    bool quick = true;
    float light = 0.0f;
    int frames = 48;  ///< of a film: it goes on by one repeat of the material in so many
    int threads = 0;
};

/// Draws a PNG: balls at growing distance and a floor to the horizon, shaded with plain mips, with
/// prefiltered ones, and as the mean of all texels would look, each with the share of its light
/// that is misplaced. Throws Error when the maps do not fit together.
void write_sparkle_sheet(const SparkleSheet& sheet, const std::filesystem::path& path);

}  // namespace petrichor::cli

#endif
