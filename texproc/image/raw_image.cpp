#include "texproc/image/raw_image.h"

#include <Imath/half.h>

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "formulas/color/srgb.h"

namespace petrichor::texproc {

namespace {

bool is_alpha(int channel, int channels)
{
    return (channels == 2 && channel == 1) || (channels >= 4 && channel == 3);
}

template <class Code>
const std::vector<float>& srgb_table()
{
    static const std::vector<float> table = [] {
        constexpr int kCodes = 1 << (8 * sizeof(Code));
        std::vector<float> values(kCodes);
        for (int i = 0; i < kCodes; ++i) {
            values[static_cast<std::size_t>(i)] =
                srgb_to_linear(static_cast<float>(i) / static_cast<float>(kCodes - 1));
        }
        return values;
    }();
    return table;
}

template <class Code>
void codes_to_float(const std::byte* from, std::size_t values, int channels, ColorSpace space,
                    float* to)
{
    constexpr float kTop = static_cast<float>((1 << (8 * sizeof(Code))) - 1);
    if (space == ColorSpace::Data) {
        for (std::size_t i = 0; i < values; ++i) {
            Code code;
            std::memcpy(&code, from + i * sizeof(Code), sizeof(Code));
            to[i] = static_cast<float>(code) / kTop;
        }
        return;
    }
    const std::vector<float>& table = srgb_table<Code>();
    int channel = 0;
    for (std::size_t i = 0; i < values; ++i) {
        Code code;
        std::memcpy(&code, from + i * sizeof(Code), sizeof(Code));
        to[i] = is_alpha(channel, channels) ? static_cast<float>(code) / kTop : table[code];
        if (++channel == channels) channel = 0;
    }
}

// Thresholds of ordered dithering: Bayer's recursive pattern, the bits of x ^ y and y interleaved
// from the lowest up. Within 1/128 .. 127/128, so that a code that is exact (to rounding) stays.
float threshold(int x, int y, int channel)
{
    x += 3 * channel;  // the pattern of each channel lies elsewhere: no common grain
    y += 5 * channel;
    int rank = 0;
    for (int bit = 0; bit < 3; ++bit) {
        rank = 4 * rank + 2 * (((x ^ y) >> bit) & 1) + ((y >> bit) & 1);
    }
    return (static_cast<float>(rank) + 0.5f) / 64.0f;
}

template <class Code>
void float_to_codes(const Image& image, Rounding rounding, std::byte* to)
{
    constexpr float kTop = static_cast<float>((1 << (8 * sizeof(Code))) - 1);
    const bool encode = image.space == ColorSpace::Linear;
    // A texel of the pattern is off by up to a whole code; only over all of it the mean is right.
    constexpr std::size_t kWholePattern = 64;
    const bool ordered =
        rounding == Rounding::Ordered && sizeof(Code) == 1 && static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) >= kWholePattern;
    float thresholds[8][8][4];
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            for (int c = 0; c < 4; ++c) thresholds[y][x][c] = threshold(x, y, c);
        }
    }
    int channel = 0, x = 0, y = 0;
    for (const float value : image.pixels) {
        float v = value >= 0.0f ? value : 0.0f;  // written so that not-a-number becomes 0
        if (v > 1.0f) v = 1.0f;
        if (encode && !is_alpha(channel, image.channels)) v = linear_to_srgb(v);
        const Code code =
            static_cast<Code>(v * kTop + (ordered ? thresholds[y & 7][x & 7][channel & 3] : 0.5f));
        std::memcpy(to, &code, sizeof(Code));
        to += sizeof(Code);
        if (++channel == image.channels) {
            channel = 0;
            if (++x == image.width) x = 0, ++y;
        }
    }
}

}  // namespace

RawImage in_8_bits(RawImage data)
{
    return data.type == PixelType::U8 ? std::move(data) : to_raw(to_image(data, ColorSpace::Data), PixelType::U8);
}

float srgb_to_linear(float encoded)
{
    return shared::linear_from_srgb(encoded);
}

float linear_to_srgb(float linear)
{
    return shared::srgb_from_linear(linear);
}

void to_float(const std::byte* from, PixelType type, std::size_t values, int channels,
              ColorSpace space, float* to)
{
    switch (type) {
        case PixelType::U8:
            codes_to_float<std::uint8_t>(from, values, channels, space, to);
            break;
        case PixelType::U16:
            codes_to_float<std::uint16_t>(from, values, channels, space, to);
            break;
        case PixelType::F16:
            for (std::size_t i = 0; i < values; ++i) {
                std::uint16_t bits;
                std::memcpy(&bits, from + 2 * i, 2);
                to[i] = imath_half_to_float(bits);
            }
            break;
        case PixelType::F32:
            std::memcpy(to, from, 4 * values);
            break;
    }
}

Image to_image(const RawImage& raw, ColorSpace space)
{
    Image image(raw.width, raw.height, raw.channels, space);
    to_float(raw.bytes.data(), raw.type, raw.values(), raw.channels, space, image.pixels.data());
    return image;
}

RawImage to_raw(const Image& image, PixelType type, Rounding rounding)
{
    RawImage raw{image.width, image.height, image.channels, type, {}, {}};
    raw.bytes.resize(image.pixels.size() * size_of(type));
    switch (type) {
        case PixelType::U8:
            float_to_codes<std::uint8_t>(image, rounding, raw.bytes.data());
            break;
        case PixelType::U16:
            float_to_codes<std::uint16_t>(image, rounding, raw.bytes.data());
            break;
        case PixelType::F16:
            for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                const std::uint16_t bits = imath_float_to_half(image.pixels[i]);
                std::memcpy(raw.bytes.data() + 2 * i, &bits, 2);
            }
            break;
        case PixelType::F32:
            std::memcpy(raw.bytes.data(), image.pixels.data(), raw.bytes.size());
            break;
    }
    return raw;
}

}  // namespace petrichor::texproc
