#ifndef PETRICHOR_TEXPROC_CODECS_FILES_TEXTURE_H
#define PETRICHOR_TEXPROC_CODECS_FILES_TEXTURE_H

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/files/io.h"
#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// How the texels of a GPU texture are stored.
struct TextureFormat {
    std::optional<Block> block;      ///< none: plain numbers
    PixelType type = PixelType::U8;  ///< of a plain number
    int channels = 4;                ///< 1..4; Bc1: 4 with alpha, 3 without
    bool is_signed = false;          ///< Bc4, Bc5, Bc6h
    bool operator==(const TextureFormat&) const = default;
};

/// By name: r8 rg8 rgb8 rgba8, r16 .., r16f .., r32f .., bc1, bc1a (alpha 0 or 1), bc3, bc4, bc5,
/// bc6h, bc6h-signed, bc7, uastc, uastca, astc-4x4, -5x5, -6x6, -8x8 (ktx2), bgra8 (dds: rgba8, stored blue first); bc2,
/// bc4 and bc5 signed: read only. Throws Error that lists the names.
TextureFormat texture_format(const std::string& name);
std::string name_of(const TextureFormat& format);
std::vector<std::string> texture_format_names();  ///< those that can be written

/// A texture as an engine loads it: level k has max(1, width >> k) x max(1, height >> k) texels,
/// rows or rows of blocks from the top, without padding; numbers in the byte order of this machine.
struct MipTexture {
    int width = 0;
    int height = 0;
    TextureFormat format;
    bool srgb = false;  ///< integer codes of red, green and blue are sRGB; alpha is linear
    std::vector<std::vector<std::byte>> levels;
    bool blue_first = false;  ///< written as B8G8R8A8; here red comes first all the same
};

/// Texels of level k along a side of `size` texels.
constexpr int level_extent(int size, int level)
{
    return (size >> level) > 0 ? size >> level : 1;
}
/// Bytes of a level.
std::size_t level_bytes(const TextureFormat& format, int width, int height);

struct TextureWriteOptions {
    std::string
        format{};  ///< a name above; "": the numbers of the levels, three channels widened to four
    bool srgb = false;    ///< colour: label it so, and encode linear floats to sRGB integers
    bool dither = false;  ///< to 8 bits: ordered 8 x 8 pattern in place of rounding
    BlockQuality quality = BlockQuality::Normal;
    std::array<float, 4> weights{1.0f, 1.0f, 1.0f, 1.0f};  ///< of the channels, for block formats
    /// BC4 and BC5: what an error of each texel costs, by level; empty (or an empty level): all
    /// alike.
    std::vector<Image> texel_weights{};
    float repeat = 0.0f;  ///< BlockOptions::repeat
    float repeat_most = std::numeric_limits<float>::infinity();
    int zstd = 0;     ///< KTX2: 0 stored plain, 1..22 compressed
    int threads = 0;  ///< 0: all cores; the bytes do not depend on it
};

/// Builds a texture from a chain of levels, level 0 first; numbers and channels are converted to
/// the format (one channel stands for red, green and blue where three are needed; missing alpha is
/// 1). Levels may be fewer than down to 1 x 1. Throws Error when a level has the wrong size.
MipTexture make_texture(std::span<const RawImage> levels, const TextureWriteOptions& options = {});

/// One level in plain numbers; `exact`: BC4 and BC5 as a shader reads them (BlockSign::Exact), else
/// in 8 bits. Throws Error when there is no such level.
RawImage decode_level(const MipTexture& texture, int level, int threads = 0, bool exact = false);

/// Writes a whole chain into one file, whole or not at all; the extension decides: .dds, .ktx2, or
/// .exr (tiled with mip levels, half or float: what texture systems of film renderers read; needs
/// all levels down to 1 x 1). Other extensions hold no levels: throws Error that says to write
/// '%d'.
void write_mip_chain(const std::filesystem::path& path, std::span<const RawImage> levels,
                     const TextureWriteOptions& options = {});
void write_mip_chain(const std::filesystem::path& path, const std::vector<RawImage>& levels,
                     const TextureWriteOptions& options = {});

/// Levels of bump_slopes(), all down to 1 x 1, as an .exr of floats in the channels of maketx
/// --bumpslopes (b0_h, b1_dhds, b2_dhdt, b3_dhds2, b4_dhdt2, b5_dh2dsdt).
void write_bump_slopes(const std::filesystem::path& path, const std::vector<Image>& levels);

/// write_mip_chain() for images: linear colour is stored as sRGB in integer formats (options.srgb is
/// implied); without a format: 8 bits for dds and ktx2, half for exr.
void write_mip_chain(const std::filesystem::path& path, const std::vector<Image>& levels,
                     const TextureWriteOptions& options = {});

/// The bytes of a file: "dds" or "ktx2", whose levels zstd compresses from 1 to 22. Throws Error
/// when the container does not have the format.
std::vector<std::byte> texture_bytes(const MipTexture& texture, const std::string& container,
                                     int zstd = 0);

/// True when write_mip_chain() knows the extension.
bool holds_mip_chain(const std::filesystem::path& path);

/// How many images a DDS or KTX2 file holds beside the levels of each: layers of an array (frames of a film) times
/// faces of a cube; 1 for an image alone, and for all other files. What is read of it is the first. Looks at the head of
/// the file alone; throws nothing.
std::uint64_t images_of_texture(const std::filesystem::path& path);

/// Reads a DDS or KTX2 file as it is stored, with all its levels (of the first face and layer).
/// Throws Error for a missing, damaged, truncated, unsupported or too large file.
MipTexture read_texture(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory. `name` is for messages.
MipTexture decode_texture(std::span<const std::byte> bytes, const std::string& name,
                          const ReadOptions& options = {});

}  // namespace petrichor::texproc

#endif
