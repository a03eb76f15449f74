#include "texproc/material/surface_class.h"

#include <algorithm>

namespace petrichor::texproc {

SurfaceClass surface_class(const Image& metallic)
{
    double sum = 0.0;
    for (const float m : metallic.pixels) sum += static_cast<double>(std::clamp(m, 0.0f, 1.0f));
    const double mean = sum / static_cast<double>(metallic.pixels.size());
    constexpr double kFew = 0.02;
    return mean < kFew         ? SurfaceClass::Paint
           : mean > 1.0 - kFew ? SurfaceClass::Metal
                               : SurfaceClass::Both;
}

}  // namespace petrichor::texproc
