#ifndef PETRICHOR_TEXPROC_IO_H
#define PETRICHOR_TEXPROC_IO_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"

namespace petrichor::texproc {

/// What to make of the numbers in a file.
struct ReadOptions {
    ColorSpace space = ColorSpace::Data;  ///< Linear: sRGB files are decoded to linear on the way in
    std::int64_t max_pixels = 1 << 28;    ///< larger images are refused before they are decoded
};

/// Reads the first image of a file (any format of the image library, DDS, KTX2).
/// Throws Error for a missing, damaged, unsupported or too large file; never crashes on one.
Image read_image(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory. `name` is for messages; the format comes from the content.
Image decode_image(std::span<const std::byte> bytes, const std::string& name,
                   const ReadOptions& options = {});

struct WriteOptions {
    int bits = 8;  ///< 8 or 16 for PNG and TIFF; EXR is always half, unless 32
};

/// Writes an image, whole or not at all; the format comes from the extension. Linear colour is
/// sRGB-encoded in integer formats, data never.
void write_image(const std::filesystem::path& path, const Image& image,
                 const WriteOptions& options = {});

/// One named EXR channel, width * height values, either float or half bits.
struct ExrChannel {
    std::string name;  ///< "R", "depth.Z", "normal.X"
    std::vector<std::uint16_t> half_bits;
    std::vector<float> floats;  ///< used when half_bits is empty
};

/// Writes a multi-channel EXR (half or float by channel), whole or not at all.
void write_exr(const std::filesystem::path& path, int width, int height,
               const std::vector<ExrChannel>& channels,
               const std::vector<std::pair<std::string, std::string>>& metadata);

/// Writes interleaved 8-bit sRGB bytes as PNG, whole or not at all. channels 1..4.
void write_png8(const std::filesystem::path& path, int width, int height, int channels,
                std::span<const std::uint8_t> pixels,
                const std::vector<std::pair<std::string, std::string>>& metadata = {});

}  // namespace petrichor::texproc

#endif
