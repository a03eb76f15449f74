#ifndef PETRICHOR_TEXPROC_STUDY_COMPARE_SHADING_H
#define PETRICHOR_TEXPROC_STUDY_COMPARE_SHADING_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

/// The maps of one material with all their levels, level 0 first, as a renderer would sample them.
struct ShadedMaps {
    std::vector<Image>
        albedo;  ///< 3 channels, linear; empty: dark grey (0.05), where gloss shows best
    std::vector<Image> normal;     ///< 3 channels, 0.5 + 0.5 n, green up
    std::vector<Image> roughness;  ///< 1 channel, perceptual
    std::vector<Image> metallic;   ///< 1 channel; empty: no metal
};

struct ShadingOptions {
    float light = 0.0f;  ///< alpha of the light: 0 the sun, 0.1 a window
    float exposure = 1.0f;
    int samples = 64;  ///< of a reference pixel
    int threads = 0;
};

/// A ball under one light, size x size, linear colour (black outside). The texture lies on it as a
/// slide is thrown on a screen, so that a pixel covers one texel of `level` everywhere.
///
///   reference  true: every pixel is the mean of shaded texels of level 0 instead, as infinitely
///   many
///              samples a pixel would give; false: one shading of the texel of the level
Image shaded_ball(const ShadedMaps& maps, int level, int size, bool reference,
                  const ShadingOptions& options);

/// A floor that runs to the horizon against a low light, width x height, linear colour. Levels are
/// chosen and mixed as a GPU does (trilinear); the reference takes options.samples of level 0 a
/// pixel.
Image shaded_floor(const ShadedMaps& maps, int width, int height, bool reference,
                   const ShadingOptions& options);

/// Mean over the pixels of |a - b| / mean of b, luminance: how wrong the light of a picture is.
double light_error(const Image& picture, const Image& reference);

}  // namespace petrichor::texproc

#endif
