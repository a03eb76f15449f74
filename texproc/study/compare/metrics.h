#ifndef PETRICHOR_TEXPROC_STUDY_COMPARE_METRICS_H
#define PETRICHOR_TEXPROC_STUDY_COMPARE_METRICS_H

#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

// How far two pictures of one size are apart. All functions throw Error when their sizes or
// channels differ; results are the same at any thread count.

/// Peak signal over noise in dB for values whose peak is 1: 10 log10(1 / mean squared difference);
/// infinite for equal images. One value a channel, and all channels together last.
std::vector<double> psnr(const Image& a, const Image& b);

/// Largest difference of a value.
double largest_difference(const Image& a, const Image& b);

/// Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004): Gaussian window of sigma 1.5
/// (11 texels), K1 0.01, K2 0.03, peak 1; edges repeat. Mean over texels and channels, 1 for equal
/// images.
double ssim(const Image& a, const Image& b, int threads = 0);

/// Angles between two normal maps (3 channels, 0.5 + 0.5 n, any length but 0).
struct AngularError {
    double mean_degrees = 0.0, p95_degrees = 0.0, max_degrees = 0.0;
    Image degrees;  ///< 1 channel
};
AngularError angular_error(const Image& a, const Image& b);

/// LDR-FLIP (Andersson et al. 2020): the difference that a person sees when flipping between two
/// pictures at a distance.
///
///   reference, test     3 channels of sRGB codes, 0..1
///   pixels_per_degree   67.02: 0.7 m from a screen 0.7 m wide with 3840 pixels
struct Flip {
    double mean = 0.0, p95 = 0.0, max = 0.0;  ///< 0 equal .. 1
    Image error;                              ///< 1 channel
};
Flip flip(const Image& reference, const Image& test, double pixels_per_degree = 67.0206,
          int threads = 0);

/// A map of 0..1 as sRGB codes from black over violet and orange to light yellow.
Image error_colors(const Image& error);

}  // namespace petrichor::texproc

#endif
