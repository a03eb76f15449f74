#ifndef PETRICHOR_TEXPROC_FILTER_DETAIL_FFT_H
#define PETRICHOR_TEXPROC_FILTER_DETAIL_FFT_H

#include <complex>
#include <vector>

namespace petrichor::texproc::detail {

/// Discrete Fourier transform of any length, in place; the inverse divides by the length.
void fft(std::vector<std::complex<double>>& values, bool inverse);
/// Rows, then columns, of a width x height grid.
void fft_2d(std::vector<std::complex<double>>& values, int width, int height, bool inverse);

}  // namespace petrichor::texproc::detail

#endif
