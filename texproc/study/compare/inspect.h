#ifndef PETRICHOR_TEXPROC_STUDY_COMPARE_INSPECT_H
#define PETRICHOR_TEXPROC_STUDY_COMPARE_INSPECT_H

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "texproc/filter/normal.h"
#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// What one channel holds, as 0..1 for integers and as it is for floats.
struct ChannelFacts {
    std::string name;  ///< "R", or as the file names it
    double low = 0.0, p5 = 0.0, median = 0.0, p95 = 0.0, high = 0.0, mean = 0.0, deviation = 0.0;
    std::array<double, 16> histogram{};  ///< shares of 16 equal bins of 0..1; outside: the end bins
    std::size_t not_finite = 0;          ///< NaN or infinite values, which count nowhere else
    int codes = 0;                       ///< different values of an 8-bit channel; 0 for others
};

enum class Meaning { Normal, NormalTwoChannel, Color, Grey, Data, Constant };

/// What an image seems to be, from its numbers alone.
struct ImageFacts {
    std::vector<ChannelFacts> channels;
    Meaning meaning = Meaning::Data;
    double meaning_confidence = 0.0;      ///< 0 guess .. 1 certain
    std::optional<GreenDirection> green;  ///< of normal maps
    double mean_length = 0.0;             ///< of normals
    /// Step across the seam over the usual step inside: about 1 where it tiles. 0: too small to
    /// tell.
    double seam_u = 0.0, seam_v = 0.0;
    bool tiles_u = false, tiles_v = false;
};

/// Looks at an image. Throws Error when it is empty.
ImageFacts inspect(const RawImage& image);

/// "normal map", "colour (sRGB)", ...
std::string to_text(Meaning meaning);

}  // namespace petrichor::texproc

#endif
