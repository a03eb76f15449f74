#include "texproc/codecs/decoder/texture.h"

#include <algorithm>
#include <cstring>

#include "texproc/codecs/files/detail/dds.h"
#include "texproc/codecs/files/detail/ktx2.h"

namespace petrichor::texproc::decoder {

void read_gpu_texture(std::span<const std::byte> file, const std::string& format,
                      const ReadOptions& limits, const Accept& accept)
{
    const MipTexture texture =
        format == "dds" ? detail::parse_dds(file, limits) : detail::parse_ktx2(file, limits);
    // A smaller level of the file's own is better than one that is made here.
    int level = 0;
    while (limits.max_side > 0 && level + 1 < static_cast<int>(texture.levels.size()) &&
           std::max(texture.width >> level, texture.height >> level) > limits.max_side) {
        ++level;
    }
    const RawImage image = decode_level(texture, level, 1);
    static const char* const kNames[4] = {"R", "G", "B", "A"};
    Header header{image.width, image.height, image.channels, image.type, {}};
    for (int c = 0; c < image.channels; ++c) header.channel_names.push_back(kNames[c]);
    std::memcpy(accept(header), image.bytes.data(), image.bytes.size());
}

}  // namespace petrichor::texproc::decoder
