#ifndef PETRICHOR_TEXPROC_IMAGE_RAW_IMAGE_H
#define PETRICHOR_TEXPROC_IMAGE_RAW_IMAGE_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

/// How one number of a file is stored.
enum class PixelType : std::uint32_t {
    U8 = 0,   ///< 0..255 means 0..1
    U16 = 1,  ///< 0..65535 means 0..1
    F16 = 2,  ///< IEEE half
    F32 = 3,  ///< IEEE single
};

/// Bytes of one number.
constexpr std::size_t size_of(PixelType type)
{
    return type == PixelType::U8 ? 1 : type == PixelType::F32 ? 4 : 2;
}

/// An image in the numbers of its file: interleaved, row 0 at the top, alpha not premultiplied.
/// Packing copies these numbers, so that what is not computed stays bit-exact.
///
/// Invariant: bytes.size() == width * height * channels * size_of(type).
struct RawImage {
    int width = 0;
    int height = 0;
    int channels = 0;
    PixelType type = PixelType::U8;
    std::vector<std::string> channel_names;  ///< as the file names them; may be empty
    std::vector<std::byte> bytes;

    std::size_t values() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
               static_cast<std::size_t>(channels);
    }
};

/// Converts stored numbers to float. space Linear: integers are sRGB codes and are decoded, except
/// alpha (channel 1 of 2, channel 3 of 4 or more); halves and floats are taken as they are.
void to_float(const std::byte* from, PixelType type, std::size_t values, int channels,
              ColorSpace space, float* to);
Image to_image(const RawImage& raw, ColorSpace space);

/// How a number becomes a code of 8 bits.
enum class Rounding {
    Nearest,
    Ordered,  ///< up or down by an 8 x 8 pattern that tiles, so that the mean of a region is kept:
              ///< slow ramps do not band. Each channel has the pattern at another place. Images of fewer
              ///< than 64 texels have no mean to keep, and are rounded as by Nearest.
};

/// Rounds to the nearest code (U8, U16) or the nearest half. space Linear: integers are
/// sRGB-encoded, except alpha. Values outside 0..1 and not-a-number become the nearest code, 0.
/// `rounding` is for U8 only. Codes themselves (k / 255) come back exactly either way.
RawImage to_raw(const Image& image, PixelType type, Rounding rounding = Rounding::Nearest);

/// Data as a file of 8 bits holds it: each number the nearest code. U8 stays as it is.
RawImage in_8_bits(RawImage data);

/// The sRGB curve and its inverse, one value.
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

}  // namespace petrichor::texproc

#endif
