#ifndef PETRICHOR_TEXPROC_CODECS_FILES_IO_H
#define PETRICHOR_TEXPROC_CODECS_FILES_IO_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "base/interrupted.h"
#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

// Files of others are decoded in a process of their own (petrichor-decode) with limits on memory
// and CPU time, and without the right to open files, sockets or programs (base/confine.h); the
// processes are kept and reused, and several threads may read at once. Alpha is
// never multiplied into colour, in either direction.

/// What to make of the numbers in a file.
struct ReadOptions {
    ColorSpace space = ColorSpace::Data;   ///< Linear: 8- and 16-bit colour is decoded from sRGB
    std::int64_t max_pixels = 1 << 28;     ///< larger images are refused before they are decoded
    std::uint64_t max_bytes = 2ull << 30;  ///< the same for width x height x channels x 4 bytes
    /// Larger images are made smaller while they are decoded, row by row where the format allows it
    /// (PNG, EXR, TIFF, JPEG, ...), so that the whole is never in memory: halved until both sides
    /// are at most this, a texel the mean of its area. max_bytes is then about what is left. 0:
    /// never.
    int max_side = 0;
    StopRequest stop = {};  ///< asked every 50 ms; decoding then ends with Interrupted
};

/// Reads the first image of a file: PNG, TGA, TIFF, PSD, EXR, HDR, JPEG, WebP, BMP, DDS, KTX2 and
/// more; the content decides, not the extension. Throws Error for a missing, damaged, unsupported
/// or too large file; never crashes on one.
Image read_image(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory. `name` is for messages.
Image decode_image(std::span<const std::byte> bytes, const std::string& name,
                   const ReadOptions& options = {});

/// The same in the numbers of the file; options.space has no effect.
RawImage read_raw(const std::filesystem::path& path, const ReadOptions& options = {});
/// Width, height, channels and type that decode_image() with these options would give, without
/// pixels: only the head of the file is looked at (of DDS and KTX2 all of it).
RawImage image_shape(std::span<const std::byte> bytes, const std::string& name,
                     const ReadOptions& options = {});

RawImage decode_raw(std::span<const std::byte> bytes, const std::string& name,
                    const ReadOptions& options = {});

struct WriteOptions {
    int bits = 8;      ///< 8 or 16 for PNG and TIFF; EXR is always half, unless 32
    int quality = 95;  ///< of JPEG, 1..100
    int threads = 0;   ///< 0: all cores; the bytes do not depend on it
    Rounding rounding = Rounding::Nearest;  ///< to 8 bits; Ordered: dithered
};

/// Writes an image, whole or not at all; the format comes from the extension: png, tga, tif, tiff,
/// exr, jpg, jpeg, and dds and ktx2 with one level in plain numbers (write_mip_chain() in
/// texproc/codecs/files/texture.h writes levels and blocks). Linear colour is sRGB-encoded in
/// integer formats, data never.
void write_image(const std::filesystem::path& path, const Image& image,
                 const WriteOptions& options = {});

/// Writes the numbers as they are (png, tga, tif: U8 or U16; exr: F16 or F32; dds, ktx2: all).
void write_raw(const std::filesystem::path& path, const RawImage& image,
               const WriteOptions& options = {});

/// One named EXR channel, width * height values, either float or half bits.
struct ExrChannel {
    std::string name;  ///< "R", "depth.Z", "normal.X"
    std::vector<std::uint16_t> half_bits;
    std::vector<float> floats;  ///< used when half_bits is empty
};

/// Writes a multi-channel EXR (half or float by channel, zip), whole or not at all.
void write_exr(const std::filesystem::path& path, int width, int height,
               const std::vector<ExrChannel>& channels,
               const std::vector<std::pair<std::string, std::string>>& metadata);

/// A PNG file in memory from interleaved bytes, row 0 at the top; fast rather than small.
///
///   channels  1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
///   throws    Error when the bytes do not fit width * height * channels.
std::vector<std::byte> encode_png8(
    int width, int height, int channels, std::span<const std::uint8_t> pixels,
    const std::vector<std::pair<std::string, std::string>>& metadata = {});

/// Writes interleaved 8-bit sRGB bytes as PNG, whole or not at all. channels 1..4.
void write_png8(const std::filesystem::path& path, int width, int height, int channels,
                std::span<const std::uint8_t> pixels,
                const std::vector<std::pair<std::string, std::string>>& metadata = {});

/// The same of rows that are made as they are asked for: first .. end - 1, by several threads at once, some rows twice; each
/// time the same bytes. At no time is more than some 64 MiB of it in memory.
void write_png8(const std::filesystem::path& path, int width, int height, int channels,
                const std::function<std::vector<std::byte>(std::size_t first, std::size_t end)>& rows,
                const std::vector<std::pair<std::string, std::string>>& metadata);

/// How well the decoder processes are locked in on this machine: "seccomp: no files, ...". Starts
/// one.
std::string decoder_confinement();

/// Writes bytes under a temporary name and renames. Throws Error (disk full, read-only folder).
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes);
/// The same for parts that follow each other.
void write_bytes(const std::filesystem::path& path,
                 const std::vector<std::span<const std::byte>>& parts);

}  // namespace petrichor::texproc

#endif
