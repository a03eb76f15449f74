#include "texproc/filter/detail/fft.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petrichor::texproc::detail {

namespace {

using Complex = std::complex<double>;
constexpr double kPi = 3.141592653589793;

// Powers of two: bit reversal and butterflies.
void fft_power_of_two(std::vector<Complex>& a, double sign)
{
    const std::size_t n = a.size();
    for (std::size_t i = 1, j = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(a[i], a[j]);
    }
    for (std::size_t length = 2; length <= n; length *= 2) {
        for (std::size_t k = 0; k < length / 2; ++k) {
            const Complex w = std::polar(
                1.0, sign * 2.0 * kPi * static_cast<double>(k) / static_cast<double>(length));
            for (std::size_t i = k; i < n; i += length) {
                const Complex t = w * a[i + length / 2];
                a[i + length / 2] = a[i] - t;
                a[i] += t;
            }
        }
    }
}

// Any other length as a convolution of a power of two (Bluestein 1970).
void fft_any(std::vector<Complex>& a, double sign)
{
    const std::size_t n = a.size();
    std::size_t m = 1;
    while (m < 2 * n) m *= 2;
    std::vector<Complex> chirp(n), x(m), y(m);
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint64_t square = static_cast<std::uint64_t>(k) * k % (2 * n);
        chirp[k] =
            std::polar(1.0, sign * kPi * static_cast<double>(square) / static_cast<double>(n));
        x[k] = a[k] * chirp[k];
        y[k] = std::conj(chirp[k]);
        if (k) y[m - k] = y[k];
    }
    fft_power_of_two(x, -1.0);
    fft_power_of_two(y, -1.0);
    for (std::size_t i = 0; i < m; ++i) x[i] *= y[i];
    fft_power_of_two(x, 1.0);
    for (std::size_t k = 0; k < n; ++k) a[k] = x[k] / static_cast<double>(m) * chirp[k];
}

}  // namespace

void fft(std::vector<Complex>& values, bool inverse)
{
    const double sign = inverse ? 1.0 : -1.0;
    if ((values.size() & (values.size() - 1)) == 0) {
        fft_power_of_two(values, sign);
    } else {
        fft_any(values, sign);
    }
    if (inverse) {
        for (Complex& v : values) v /= static_cast<double>(values.size());
    }
}

void fft_2d(std::vector<Complex>& values, int width, int height, bool inverse)
{
    const std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    std::vector<Complex> line(w);
    for (std::size_t y = 0; y < h; ++y) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(y * w), w, line.begin());
        fft(line, inverse);
        std::copy_n(line.begin(), w, values.begin() + static_cast<std::ptrdiff_t>(y * w));
    }
    line.resize(h);
    for (std::size_t x = 0; x < w; ++x) {
        for (std::size_t y = 0; y < h; ++y) line[y] = values[y * w + x];
        fft(line, inverse);
        for (std::size_t y = 0; y < h; ++y) values[y * w + x] = line[y];
    }
}

}  // namespace petrichor::texproc::detail
