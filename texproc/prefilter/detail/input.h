#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_INPUT_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_INPUT_H

#include "texproc/prefilter/detail/map_surface.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

/// An image of either kind, seen as planes.
struct ImageRef {
    int width = 0, height = 0, channels = 0;
    PixelType type = PixelType::F32;
    const std::byte* data = nullptr;
};
ImageRef ref(const Image& image);
ImageRef ref(const RawImage& image);

/// Checks a pair of maps and sets up how they are decoded. Throws Error for sizes that differ,
/// missing channels and values that are not numbers. The images must outlive the result.
MapSurface make_surface(const ImageRef& normal, const ImageRef& rough,
                        const PrefilterOptions& options);

}  // namespace petrichor::texproc::detail

#endif
