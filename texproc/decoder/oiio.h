#ifndef PETRICHOR_TEXPROC_DECODER_OIIO_H
#define PETRICHOR_TEXPROC_DECODER_OIIO_H

#include <cstdint>
#include <functional>
#include <string>

#include "texproc/files/raw_image.h"

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

/// Reads the first image of `path` with the image library. `accept` sees the header, may throw, and
/// returns where the pixels go. Throws std::runtime_error with the library's reason.
void read_with_oiio(const std::string& path, const std::string& format,
                    const std::function<std::byte*(const Header&)>& accept);

/// Writes pixels with the image library; the format comes from the extension of `path`.
void write_with_oiio(const std::string& path, const Header& header, const std::byte* pixels,
                     int quality);

}  // namespace petrichor::texproc::decoder

#endif
