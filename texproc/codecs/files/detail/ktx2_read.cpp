#include <zlib.h>
#include <zstd.h>

#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"

namespace petrichor::texproc::detail {

namespace {

using Bytes = std::span<const std::byte>;

constexpr unsigned char kIdentifier[12] = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                           '0',  0xbb, '\r', '\n', 0x1a, '\n'};

// Inflates a level to exactly `size` bytes; more, fewer or damaged ones are errors.
std::vector<std::byte> inflated(Bytes stored, std::size_t size, std::uint32_t scheme)
{
    std::vector<std::byte> level(size);
    bool whole = false;
    if (scheme == 2) {
        whole = ZSTD_decompress(level.data(), size, stored.data(), stored.size()) == size;
    } else {
        uLongf got = static_cast<uLongf>(size);
        whole = uncompress(reinterpret_cast<Bytef*>(level.data()), &got,
                           reinterpret_cast<const Bytef*>(stored.data()),
                           static_cast<uLong>(stored.size())) == Z_OK &&
                got == size;
    }
    if (!whole) {
        throw std::runtime_error(std::string("its ") + (scheme == 2 ? "zstd" : "zlib") +
                                 " data is damaged or of another size than the level");
    }
    return level;
}

// The format of a file for which Vulkan has no name, by its descriptor.
std::optional<LabelledFormat> from_descriptor(Bytes bytes)
{
    const Bytes dfd = part(bytes, read_u32(bytes, 48), read_u32(bytes, 52), "the descriptor");
    if (dfd.size() < 44) throw std::runtime_error("its data format descriptor is damaged");
    const BlockRow& row = row_of(Block::Uastc);
    if (std::to_integer<int>(dfd[12]) != row.color_model) return std::nullopt;
    const bool opaque = (std::to_integer<int>(dfd[31]) & 15) == 0;
    return LabelledFormat{format_of(row, row.labels[opaque ? 0 : 1]),
                          std::to_integer<int>(dfd[14]) == 2, false};
}

}  // namespace

MipTexture parse_ktx2(std::span<const std::byte> bytes, const ReadOptions& limits)
{
    if (bytes.size() < sizeof kIdentifier ||
        std::memcmp(bytes.data(), kIdentifier, sizeof kIdentifier) != 0) {
        throw std::runtime_error("its KTX2 identifier is damaged");
    }
    const std::uint32_t vulkan = read_u32(bytes, 12);
    const std::uint32_t width = read_u32(bytes, 20), height = std::max(1u, read_u32(bytes, 24));
    const std::uint32_t depth = read_u32(bytes, 28), layers = read_u32(bytes, 32);
    const std::uint32_t faces = read_u32(bytes, 36), scheme = read_u32(bytes, 44);
    const std::uint32_t levels = std::max(1u, read_u32(bytes, 40));
    if (scheme == 1) {
        throw std::runtime_error(
            "it is supercompressed with Basis Universal's ETC1S, which is not supported");
    }
    if (scheme > 3) {
        throw std::runtime_error("its supercompression " + std::to_string(scheme) +
                                 " is not supported");
    }
    const auto label = vulkan ? from_vulkan(vulkan) : from_descriptor(bytes);
    if (!label) {
        throw std::runtime_error("its texel format (Vulkan " + std::to_string(vulkan) +
                                 ") is not supported");
    }
    check_texture_size(width, height, label->format.channels, limits);
    if (depth > 1) throw std::runtime_error("it is a volume, not an image");
    if ((faces != 1 && faces != 6) ||
        levels > static_cast<std::uint32_t>(std::bit_width(std::max(width, height)))) {
        throw std::runtime_error("its header is damaged: " + std::to_string(faces) + " faces, " +
                                 std::to_string(levels) + " levels");
    }
    MipTexture texture{
        static_cast<int>(width), static_cast<int>(height), label->format, label->srgb, {}};
    const std::uint64_t images = static_cast<std::uint64_t>(std::max(1u, layers)) * faces;
    for (int k = 0; k < static_cast<int>(levels); ++k) {
        const std::size_t entry = 80 + 24 * static_cast<std::size_t>(k);
        const std::uint64_t at = read_u64(bytes, entry), size = read_u64(bytes, entry + 8);
        const std::size_t image = level_bytes(texture.format, level_extent(texture.width, k),
                                              level_extent(texture.height, k));
        const std::string name = "mip level " + std::to_string(k);
        const Bytes stored = part(bytes, at, size, name);
        if (images > (limits.max_bytes + image) / image) {
            throw std::runtime_error("its " + std::to_string(images) +
                                     " images are more than the limit of " +
                                     std::to_string(limits.max_bytes >> 20) + " MiB decoded");
        }
        const std::uint64_t whole = image * images;
        if (read_u64(bytes, entry + 16) != whole || (scheme == 0 && size != whole)) {
            throw std::runtime_error("its header is damaged: " + name + " of " +
                                     std::to_string(size) + " bytes must have " +
                                     std::to_string(whole));
        }
        std::vector<std::byte> level =
            scheme ? inflated(stored, static_cast<std::size_t>(whole), scheme)
                   : std::vector<std::byte>(stored.begin(), stored.end());
        level.resize(image);
        if (label->swap_red_blue) swap_red_blue(level, texture.format.channels);
        texture.levels.push_back(std::move(level));
    }
    return texture;
}

}  // namespace petrichor::texproc::detail
