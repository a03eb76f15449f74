#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_PIXELS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_PIXELS_H

#include <array>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/detail/chain_fit_kernel.h"
#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// How the pixels lie. Views that are one picture have one exposure, so what counts of its error is where
/// a highlight lies in it.
struct FitLayout {
    std::size_t views;        ///< of a picture
    int places;               ///< of a view, each seen kFitFrames times
    std::size_t least_views;  ///< of a level
    float wide = 0.0f, tall = 0.0f;  ///< how far they look past its middle, degrees

    std::size_t pixels() const { return static_cast<std::size_t>(places) * kFitFrames; }  ///< of a view
};
FitLayout fit_layout(SurfaceClass surface);

/// Errors of a picture, a number a light: mean squares, and of what changes between two moments.
struct FitErrors {
    std::array<float, kFitLights> squares{}, changes{};
};
/// Views of one picture, and the errors of plain mips in it.
struct FitPicture {
    std::vector<std::size_t> views;
    FitErrors plain;
};
/// Pixels whose finer level is the same.
struct FitPool {
    std::size_t fine = 0;
    std::vector<FitView> views;
    std::vector<FitPixel> pixels;  ///< view by view
    std::vector<FitPicture> pictures;
};

/// Draws pixels, and what they should show: their truth, exposed. The weights of the views and the errors
/// of plain mips are left to whoever fits.
///
///   plain   plain_levels() of the maps
///   number  of the pool: it is the seed
///   fine    the finer level of its pixels
///   enough  pixels at least
FitPool draw_fit_pixels(const Levels& plain, const PrefilterOptions& options, std::size_t number,
                        std::size_t fine, std::size_t enough);

}  // namespace petrichor::texproc::detail

#endif
