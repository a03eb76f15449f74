#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_HEADER_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_HEADER_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"

namespace petrichor::texproc::decoder {

/// What a file says about itself before its pixels are touched.
struct Header {
    int width = 0, height = 0, channels = 0;
    PixelType type = PixelType::U8;
    std::vector<std::string> channel_names;

    std::uint64_t bytes() const
    {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
               static_cast<std::uint64_t>(channels) * size_of(type);
    }
};

/// Sees the header, may throw, and returns where the pixels go.
using Accept = std::function<std::byte*(const Header&)>;

}  // namespace petrichor::texproc::decoder

#endif
