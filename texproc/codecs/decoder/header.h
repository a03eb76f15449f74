#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_HEADER_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_HEADER_H

#include <cstddef>
#include <cstdint>
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

/// Takes what a reader finds. Each call that has a header sees it before anything is made room for,
/// and may throw.
class Accept {
public:
    virtual ~Accept() = default;
    /// Where all pixels go at once.
    virtual std::byte* operator()(const Header&) const = 0;
    /// True: the image is larger than what is wanted of it, so hand it over row by row from the top
    /// (memory for a few rows is enough). False: call the above.
    virtual bool by_rows(const Header&) const = 0;
    virtual void row(const std::byte*) const = 0;
};

}  // namespace petrichor::texproc::decoder

#endif
