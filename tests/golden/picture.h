#ifndef PETRICHOR_TESTS_GOLDEN_PICTURE_H
#define PETRICHOR_TESTS_GOLDEN_PICTURE_H

#include <filesystem>
#include <string>
#include <vector>

#include "gpu/renderer.h"

namespace petrichor::golden {

/// One channel of a picture. Names are those of a rendered EXR: R, G, B, A for the radiance,
/// "depth.Z" for an AOV, and "display.R", "display.G", "display.B" for the bytes of the PNG,
/// 0..255.
struct Channel {
    std::string name;
    bool half = true;           ///< stored as half, and rounded to it here already
    std::vector<float> values;  ///< width * height, row 0 at the top
};

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Channel> channels;
};

/// What belongs together: "display" of "display.R", nothing for R, G, B and A.
std::string group_of(const std::string& channel);

/// Radiance, the bytes on the display, and all AOVs of a frame. Depth and position stay floats.
Picture picture_of(const gpu::RenderResult& result);

/// The same of two files that the program wrote.
Picture read_frame(const std::filesystem::path& exr, const std::filesystem::path& png);

/// Every channel in one EXR. Throws Error when it cannot be written or read.
void write_picture(const std::filesystem::path& exr, const Picture& picture);
Picture read_picture(const std::filesystem::path& exr);

/// To look at: `folder`/`stem`.png as the display shows it, and `stem`.NAME.png for each AOV (its
/// range stretched to black and white; signed values around grey).
void write_pngs(const std::filesystem::path& folder, const std::string& stem,
                const Picture& picture);

}  // namespace petrichor::golden

#endif
