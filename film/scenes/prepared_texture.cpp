#include "film/scenes/prepared_texture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
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

// Blocks that the device reads as they are; all others are decoded. Signed BC4 and BC5 hold -1..1,
// the shaders read 0..1.
struct DeviceBlock {
    Block block;
    int channels;
    bool is_signed;
    TexelFormat plain;
    std::optional<TexelFormat> srgb;
    bool slow = false;  ///< on a CPU device
};
constexpr DeviceBlock kDeviceBlocks[] = {
    {Block::Bc1, 3, false, TexelFormat::Bc1OpaqueUnorm, TexelFormat::Bc1OpaqueSrgb},
    {Block::Bc1, 4, false, TexelFormat::Bc1Unorm, TexelFormat::Bc1Srgb},
    {Block::Bc2, 4, false, TexelFormat::Bc2Unorm, TexelFormat::Bc2Srgb},
    {Block::Bc3, 4, false, TexelFormat::Bc3Unorm, TexelFormat::Bc3Srgb},
    {Block::Bc4, 1, false, TexelFormat::Bc4Unorm, {}},
    {Block::Bc5, 2, false, TexelFormat::Bc5Unorm, {}},
    {Block::Bc6h, 3, false, TexelFormat::Bc6hUfloat, TexelFormat::Bc6hUfloat, true},
    {Block::Bc6h, 3, true, TexelFormat::Bc6hSfloat, TexelFormat::Bc6hSfloat, true},
    {Block::Bc7, 4, false, TexelFormat::Bc7Unorm, TexelFormat::Bc7Srgb, true},
};

// How the device names a format; `color`: 8-bit codes and blocks are sRGB.
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
    for (const DeviceBlock& row : kDeviceBlocks) {
        if (row.block != *format.block || row.channels != format.channels ||
            row.is_signed != format.is_signed || (row.slow && blocks == BlockSupport::Fast))
            continue;
        if (color && !row.srgb) break;
        return color ? *row.srgb : row.plain;
    }
    return std::nullopt;
}

bool decodes_to_halves(const texproc::TextureFormat& format)
{
    return format.block && texproc::decoded_type(*format.block) == PixelType::F16;
}

// Numbers in plain texels: what the device reads instead of a format that it does not.
struct Plain {
    std::string name;  // of texproc
    TexelFormat format;
};
Plain plain_for(const texproc::TextureFormat& format, bool color)
{
    const bool wide = !format.block && format.type != PixelType::U8;
    const bool halves = wide || decodes_to_halves(format);
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

// A level of colours in blocks for the CPU: the first of 64 texels a side, or the last.
std::shared_ptr<const gpu::Texture> plain_level(const MipTexture& file, int threads)
{
    int level = 0;
    int width = file.width;
    int height = file.height;
    while (level + 1 < static_cast<int>(file.levels.size()) && std::max(width, height) > 64) {
        ++level;
        width = texproc::level_extent(file.width, level);
        height = texproc::level_extent(file.height, level);
    }
    const Plain plain = plain_for(file.format, true);
    gpu::Texture made;
    made.format = plain.format;
    made.width = width;
    made.height = height;
    const RawImage texels = texproc::decode_level(file, level, threads);
    made.mips = texproc::make_texture({&texels, 1}, {.format = plain.name, .threads = threads}).levels;
    return std::make_shared<const gpu::Texture>(std::move(made));
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
    const bool codes = format.block ? !decodes_to_halves(format) : format.type == PixelType::U8;
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
        if (color && format.block) out.plain = plain_level(file, threads);
        return loaded;
    }
    loaded.as_stored = false;
    const Plain plain = plain_for(format, color);
    out.format = plain.format;
    std::vector<RawImage> levels;
    for (std::size_t k = 0; k < file.levels.size(); ++k) {
        RawImage level = texproc::decode_level(file, static_cast<int>(k), threads);
        const bool signed_codes = format.is_signed && !decodes_to_halves(format);
        levels.push_back(signed_codes ? unsigned_numbers(level) : std::move(level));
    }
    out.mips = texproc::make_texture(levels, {.format = plain.name, .threads = threads}).levels;
    const bool by_choice = std::any_of(
        std::begin(kDeviceBlocks), std::end(kDeviceBlocks),
        [&](const DeviceBlock& row) { return row.slow && row.block == format.block; });
    const bool made_to_be_decoded = format.block == Block::Uastc;
    const bool only_widened = !format.block && format.type == PixelType::U8;  // nothing is lost
    if (!only_widened && !(by_choice && blocks == BlockSupport::Fast) && !made_to_be_decoded) {
        loaded.notes.push_back("is stored as " + name + ", which this device does not sample for " +
                               (color ? "colour" : "data") + ": read as " + plain.name);
    }
    return loaded;
}

}  // namespace petrichor::film
