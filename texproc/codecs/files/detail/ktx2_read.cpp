#include <zlib.h>
#include <zstd.h>

#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "texproc/codecs/files/detail/basis_lz.h"
#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"

namespace petrichor::texproc::detail {

namespace {

using Bytes = std::span<const std::byte>;

constexpr std::uint32_t kBasisLz = 1;  // a supercompression
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

Bytes descriptor(Bytes bytes)
{
    const Bytes dfd = part(bytes, read_u32(bytes, 48), read_u32(bytes, 52), "the descriptor");
    if (dfd.size() < 44) throw std::runtime_error("its data format descriptor is damaged");
    return dfd;
}

bool is_srgb(Bytes descriptor)
{
    return std::to_integer<int>(descriptor[14]) == 2;
}

// What the first (second) plane of a file stands for.
int channel(Bytes descriptor, std::size_t plane)
{
    return std::to_integer<int>(descriptor[31 + 16 * plane]) & 15;
}

// The format of a file for which Vulkan has no name, by its descriptor.
std::optional<LabelledFormat> from_descriptor(Bytes bytes)
{
    const Bytes dfd = descriptor(bytes);
    const BlockRow& row = row_of(Block::Uastc);
    if (std::to_integer<int>(dfd[12]) != row.color_model) return std::nullopt;
    return LabelledFormat{format_of(row, row.labels[channel(dfd, 0) == 0 ? 0 : 1]), is_srgb(dfd),
                          false};
}

// What a file of ETC1S holds, 8 bits a channel: one plane is red alone or three channels, another one is alpha or
// green.
LabelledFormat from_basis_lz(Bytes bytes)
{
    constexpr int kEtc1s = 163, kRed = 3, kGreen = 4, kAlpha = 15;
    const Bytes dfd = descriptor(bytes);
    if (std::to_integer<int>(dfd[12]) != kEtc1s)
        throw std::runtime_error("its BasisLZ data is not ETC1S, which is not supported");
    const bool two = dfd.size() >= 60;
    const bool single = channel(dfd, 0) == kRed;
    if (two && channel(dfd, 1) != (single ? kGreen : kAlpha))
        throw std::runtime_error("its two planes of ETC1S mean channel " +
                                 std::to_string(channel(dfd, 0)) + " and " +
                                 std::to_string(channel(dfd, 1)) +
                                 ", which is neither colour with alpha nor red with green");
    LabelledFormat out;
    out.format = {std::nullopt, PixelType::U8, (single ? 1 : 3) + (two ? 1 : 0), false};
    out.srgb = is_srgb(dfd);
    return out;
}

// The texels of an image in ETC1S.
std::vector<std::byte> texels(const BasisLz& shared, const BasisLzImage& image, Bytes level,
                              int channels, int width, int height)
{
    if (image.follows_another)
        throw std::runtime_error("its first image is told by one before it, which there is not");
    const bool two = channels % 2 == 0;
    if (two && image.alpha_size == 0)
        throw std::runtime_error("its descriptor tells of two planes, and an image has one");
    const auto color = shared.slice(part(level, image.color_at, image.color_size, "an image"),
                                    width, height);
    std::vector<std::array<std::uint8_t, 3>> second;
    if (two) {
        second = shared.slice(part(level, image.alpha_at, image.alpha_size, "an image's alpha"),
                              width, height);
    }
    const std::size_t first = static_cast<std::size_t>(channels) - (two ? 1 : 0);
    std::vector<std::byte> out;
    out.reserve(color.size() * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < color.size(); ++i) {
        for (std::size_t c = 0; c < first; ++c) out.push_back(static_cast<std::byte>(color[i][c]));
        if (two) out.push_back(static_cast<std::byte>(second[i][1]));
    }
    return out;
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
    if (scheme > 3) {
        throw std::runtime_error("its supercompression " + std::to_string(scheme) +
                                 " is not supported");
    }
    const auto label = scheme == kBasisLz ? from_basis_lz(bytes)
                       : vulkan           ? from_vulkan(vulkan)
                                          : from_descriptor(bytes);
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
    std::optional<BasisLz> shared;
    if (scheme == kBasisLz) {
        if (images > bytes.size()) throw std::runtime_error("it lists more images than it holds");
        shared.emplace(part(bytes, read_u64(bytes, 64), read_u64(bytes, 72), "what images share"),
                       images * levels);
    }
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
        if (shared) {
            const BasisLzImage first = shared->image(static_cast<std::uint64_t>(k) * images);
            texture.levels.push_back(texels(*shared, first, stored, texture.format.channels,
                                            level_extent(texture.width, k),
                                            level_extent(texture.height, k)));
            continue;
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
