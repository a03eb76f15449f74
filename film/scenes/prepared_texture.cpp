#include "film/scenes/prepared_texture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "base/error.h"

namespace petrichor::film {
namespace {

using gpu::TexelFormat;
using texproc::Block;
using texproc::MipTexture;
using texproc::PixelType;
using texproc::RawImage;

constexpr unsigned char kKtx2[12] = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                     '0',  0xbb, '\r', '\n', 0x1a, '\n'};

std::uint32_t number_at(std::span<const std::byte> bytes, std::size_t at)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

bool is_ktx2(std::span<const std::byte> bytes)
{
    return bytes.size() >= 80 && std::memcmp(bytes.data(), kKtx2, 12) == 0;
}

bool is_dds(std::span<const std::byte> bytes)
{
    return bytes.size() >= 128 && std::memcmp(bytes.data(), "DDS ", 4) == 0;
}

// How the device names a format; `color`: 8-bit codes and blocks are sRGB. Signed BC4 and BC5 hold
// -1..1, the shaders read 0..1.
std::optional<TexelFormat> format_of(const texproc::TextureFormat& format, bool color,
                                     BlockSupport blocks)
{
    if (!format.block) {
        if (format.type == PixelType::F16) {
            if (format.channels == 1 && !color) return TexelFormat::R16Float;
            if (format.channels == 2 && !color) return TexelFormat::Rg16Float;
            if (format.channels == 4) return TexelFormat::Rgba16Float;
        }
        if (format.type == PixelType::U8) {
            if (format.channels == 1 && !color) return TexelFormat::R8Unorm;
            if (format.channels == 2 && !color) return TexelFormat::Rg8Unorm;
            if (format.channels == 4) {
                return color ? TexelFormat::Rgba8Srgb : TexelFormat::Rgba8Unorm;
            }
        }
        return std::nullopt;
    }
    if (blocks == BlockSupport::None) return std::nullopt;
    const bool fast = blocks == BlockSupport::Fast;
    switch (*format.block) {
        case Block::Bc1:
            if (format.channels == 3) {
                return color ? TexelFormat::Bc1OpaqueSrgb : TexelFormat::Bc1OpaqueUnorm;
            }
            return color ? TexelFormat::Bc1Srgb : TexelFormat::Bc1Unorm;
        case Block::Bc2:
            return color ? TexelFormat::Bc2Srgb : TexelFormat::Bc2Unorm;
        case Block::Bc3:
            return color ? TexelFormat::Bc3Srgb : TexelFormat::Bc3Unorm;
        case Block::Bc4:
            if (!color && !format.is_signed) return TexelFormat::Bc4Unorm;
            break;
        case Block::Bc5:
            if (!color && !format.is_signed) return TexelFormat::Bc5Unorm;
            break;
        case Block::Bc6h:
            if (!fast) return format.is_signed ? TexelFormat::Bc6hSfloat : TexelFormat::Bc6hUfloat;
            break;
        case Block::Bc7:
            if (!fast) return color ? TexelFormat::Bc7Srgb : TexelFormat::Bc7Unorm;
            break;
    }
    return std::nullopt;
}

// Numbers in plain texels: what the device reads instead of a format that it does not.
struct Plain {
    std::string name;  // of texproc
    TexelFormat format;
};
Plain plain_for(const texproc::TextureFormat& format, bool color)
{
    const bool wide = !format.block && format.type != PixelType::U8;
    const bool halves = wide || format.block == Block::Bc6h;
    if (color) {
        return halves && format.type != PixelType::U16 ? Plain{"rgba16f", TexelFormat::Rgba16Float}
                                                       : Plain{"rgba8", TexelFormat::Rgba8Srgb};
    }
    const int channels = format.block ? texproc::channels_of(*format.block) : format.channels;
    if (channels == 1) {
        return halves ? Plain{"r16f", TexelFormat::R16Float} : Plain{"r8", TexelFormat::R8Unorm};
    }
    if (channels == 2) {
        return halves ? Plain{"rg16f", TexelFormat::Rg16Float}
                      : Plain{"rg8", TexelFormat::Rg8Unorm};
    }
    return halves ? Plain{"rgba16f", TexelFormat::Rgba16Float}
                  : Plain{"rgba8", TexelFormat::Rgba8Unorm};
}

// -1..1 to the 0..1 that normal maps are read in.
RawImage unsigned_numbers(const RawImage& level)
{
    Image numbers = texproc::to_image(level, ColorSpace::Data);
    for (float& v : numbers.pixels) v = 0.5f + 0.5f * v;
    return texproc::to_raw(numbers, PixelType::U8);
}

}  // namespace

bool has_own_levels(std::span<const std::byte> bytes)
{
    const bool ktx2 = is_ktx2(bytes);
    if (!ktx2 && !is_dds(bytes)) return false;
    const std::uint32_t width = number_at(bytes, ktx2 ? 20 : 16);
    const std::uint32_t height = number_at(bytes, ktx2 ? 24 : 12);
    const std::uint32_t levels = number_at(bytes, ktx2 ? 40 : 28);
    return levels > 1 || (width == 1 && height == 1);
}

bool says_color_space(std::span<const std::byte> bytes)
{
    return is_ktx2(bytes) || (is_dds(bytes) && std::memcmp(bytes.data() + 84, "DX10", 4) == 0);
}

BlockSupport block_support(const gpu::DeviceInfo& device)
{
    if (!device.block_textures) return BlockSupport::None;
    return device.kind == "cpu" ? BlockSupport::Fast : BlockSupport::All;
}

LoadedTexture load_prepared(const MipTexture& file, TextureMeaning meaning, BlockSupport blocks,
                            bool labelled, int threads)
{
    LoadedTexture loaded;
    const bool color = meaning == TextureMeaning::Color;
    const texproc::TextureFormat& format = file.format;
    const std::string name = texproc::name_of(format);
    const int channels = format.block ? texproc::channels_of(*format.block) : format.channels;
    if (meaning == TextureMeaning::Normal && channels < 2) {
        throw Error("its format " + name + " has one channel, a normal map needs two",
                    "Write it as bc5, rg8 or rgba8.");
    }
    const bool codes = format.block ? *format.block != Block::Bc6h : format.type == PixelType::U8;
    if (labelled && codes && color && !file.srgb) {
        loaded.notes.push_back("is labelled linear; glTF defines it as sRGB, and so it is read");
    }
    if (!color && file.srgb) {
        loaded.notes.push_back("is labelled sRGB; glTF defines it as linear, and so it is read");
    }
    gpu::Texture& out = loaded.texture;
    out.width = file.width;
    out.height = file.height;
    if (const auto same = format_of(format, color, blocks)) {
        out.format = *same;
        out.mips = file.levels;
        return loaded;
    }
    loaded.as_stored = false;
    const Plain plain = plain_for(format, color);
    out.format = plain.format;
    std::vector<RawImage> levels;
    for (std::size_t k = 0; k < file.levels.size(); ++k) {
        RawImage level = texproc::decode_level(file, static_cast<int>(k), threads);
        const bool signed_codes = format.is_signed && format.block != Block::Bc6h;
        levels.push_back(signed_codes ? unsigned_numbers(level) : std::move(level));
    }
    out.mips = texproc::make_texture(levels, {.format = plain.name, .threads = threads}).levels;
    const bool slow = format.block == Block::Bc7 || format.block == Block::Bc6h;
    if (!(slow && blocks == BlockSupport::Fast)) {
        loaded.notes.push_back("is stored as " + name + ", which this device does not sample for " +
                               (color ? "colour" : "data") + ": read as " + plain.name);
    }
    return loaded;
}

}  // namespace petrichor::film
