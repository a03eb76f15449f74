#ifndef PETRICHOR_TEXPROC_STUDY_COMPARE_DETAIL_SEPARABLE_H
#define PETRICHOR_TEXPROC_STUDY_COMPARE_DETAIL_SEPARABLE_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc::detail {

/// exp(-x^2 / (2 sigma^2)) at -radius .. radius, sum 1.
std::vector<float> gaussian_weights(double sigma, int radius);

/// One row kernel, then one column kernel, over every channel; edges repeat. Both have an odd
/// length.
Image filtered(const Image& image, const std::vector<float>& along_x,
               const std::vector<float>& along_y, int threads);

/// Throws Error unless both images have pixels, the same size and the same channels.
void check_comparable(const Image& a, const Image& b);

}  // namespace petrichor::texproc::detail

#endif
