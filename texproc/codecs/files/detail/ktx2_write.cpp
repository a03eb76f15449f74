#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

#include "base/error.h"
#include "texproc/codecs/files/detail/ktx2.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kIndexBytes = 24;  // of one level

// ---- the data format descriptor: what the bits of a texel (block) mean -------------------------

struct Sample {
    int bit = 0, bits = 8;
    int channel = 0;
    std::uint32_t lower = 0, upper = 0;
};

constexpr int kLinear = 0x10, kSigned = 0x40, kFloat = 0x80, kAlphaChannel = 15;

std::vector<Sample> plain_samples(const TextureFormat& format, bool srgb)
{
    const int bits = 8 * static_cast<int>(size_of(format.type));
    const bool is_float = format.type == PixelType::F16 || format.type == PixelType::F32;
    std::vector<Sample> samples;
    for (int c = 0; c < format.channels; ++c) {
        Sample s{c * bits, bits, c == 3 ? kAlphaChannel : c, 0, (1u << std::min(bits, 31)) - 1};
        if (is_float) {
            s.channel |= kFloat | kSigned;
            s.lower = 0xbf800000u;  // -1 and 1 as floats
            s.upper = 0x3f800000u;
        } else if (srgb && c == 3) {
            s.channel |= kLinear;
        }
        samples.push_back(s);
    }
    return samples;
}

// Vulkan has no name for it; its samples name sets of channels, not one.
bool is_basis(const TextureFormat& format)
{
    return format.block == Block::Uastc;
}

std::vector<Sample> block_samples(const TextureFormat& format, bool srgb)
{
    const BlockLabel* label = label_of(format);
    if (!label) return {};
    const int bits = static_cast<int>(8 * block_bytes(*format.block) / label->parts.size());
    std::vector<Sample> samples;
    for (const int channel : label->parts) {
        const bool linear = channel == kAlphaChannel && srgb && !is_basis(format);
        Sample s{static_cast<int>(samples.size()) * bits, bits, channel | (linear ? kLinear : 0), 0,
                 0xffffffffu};
        if (*format.block == Block::Bc6h) {
            s.channel |= kFloat | (format.is_signed ? kSigned : 0);
            s.lower = format.is_signed ? 0xbf800000u : 0;  // -1 and 1 as floats
            s.upper = 0x3f800000u;
        }
        samples.push_back(s);
    }
    return samples;
}

int color_model(const TextureFormat& format)
{
    return format.block ? row_of(*format.block).color_model : 1;
}

std::size_t texel_bytes(const TextureFormat& format)
{
    return format.block ? block_bytes(*format.block)
                        : static_cast<std::size_t>(format.channels) * size_of(format.type);
}

std::vector<std::byte> descriptor(const MipTexture& texture)
{
    const TextureFormat& format = texture.format;
    const auto samples =
        format.block ? block_samples(format, texture.srgb) : plain_samples(format, texture.srgb);
    const std::size_t block_size = 24 + 16 * samples.size();
    std::vector<std::byte> dfd;
    put_u32(dfd, block_size + 4);
    put_u32(dfd, 0);        // Khronos, basic descriptor
    put_little(dfd, 2, 2);  // version 1.3
    put_little(dfd, block_size, 2);
    put_little(dfd, static_cast<std::uint64_t>(color_model(format)), 1);
    // Rec.709 primaries; KHR_texture_basisu wants none for data.
    put_little(dfd, is_basis(format) && !texture.srgb ? 0 : 1, 1);
    put_little(dfd, texture.srgb ? 2 : 1, 1);
    put_little(dfd, 0, 1);                          // straight alpha
    const int beyond = format.block ? block_side(*format.block) - 1 : 0;
    put_little(dfd, static_cast<std::uint64_t>(beyond << 8 | beyond), 4);  // texel block, less 1 x 1
    put_little(dfd, texel_bytes(format), 8);
    for (const Sample& s : samples) {
        put_little(dfd, static_cast<std::uint64_t>(s.bit), 2);
        put_little(dfd, static_cast<std::uint64_t>(s.bits - 1), 1);
        put_little(dfd, static_cast<std::uint64_t>(s.channel), 1);
        put_u32(dfd, 0);  // position
        put_u32(dfd, s.lower);
        put_u32(dfd, s.upper);
    }
    return dfd;
}

// ---- key and value pairs, sorted by key --------------------------------------------------------

std::vector<std::byte> key_values()
{
    std::vector<std::byte> to;
    const auto add = [&](const std::string& key, const std::string& value) {
        const std::string text = key + '\0' + value + '\0';
        put_u32(to, text.size());
        for (const char c : text) to.push_back(static_cast<std::byte>(c));
        while (to.size() % 4) to.push_back(std::byte{0});
    };
    add("KTXorientation", "rd");
    add("KTXwriter", "petrichor");
    return to;
}

std::vector<std::byte> compressed(std::span<const std::byte> level, int quality)
{
    std::vector<std::byte> to(ZSTD_compressBound(level.size()));
    const std::size_t size =
        ZSTD_compress(to.data(), to.size(), level.data(), level.size(), quality);
    if (ZSTD_isError(size)) throw Error("ktx2: zstd failed", "Free some memory, or use --zstd 0.");
    to.resize(size);
    return to;
}

}  // namespace

Ktx2Parts ktx2_parts(const MipTexture& texture, const LevelBytes& levels, int zstd)
{
    const std::uint32_t vulkan = vulkan_code(texture.format, texture.srgb);
    if (vulkan == 0 && !is_basis(texture.format)) {
        throw Error("ktx2: there is no " + std::string(texture.srgb ? "sRGB " : "") +
                        name_of(texture.format),
                    "Use 8 bits, bc1, bc3 or bc7 for sRGB, or leave --srgb out.");
    }
    if (zstd < 0 || zstd > 22) {
        throw Error("ktx2: zstd level " + std::to_string(zstd) + " is outside 0..22",
                    "Use 0 (none) or a level such as 5 or 18.");
    }
    const std::size_t count = levels.size();
    Ktx2Parts file;
    file.own.resize(2 * count + 1);  // header; packed levels; padding
    LevelBytes stored = levels;
    for (std::size_t k = 0; zstd && k < count; ++k) {
        stored[k] = file.own[1 + k] = compressed(levels[k], zstd);
    }

    const auto dfd = descriptor(texture);
    const auto pairs = key_values();
    const std::size_t dfd_at = kHeaderBytes + kIndexBytes * count;
    const std::size_t pairs_at = dfd_at + dfd.size();
    const std::size_t align = zstd ? 1 : std::lcm(texel_bytes(texture.format), std::size_t{4});
    std::vector<std::size_t> at(count);
    std::size_t end = pairs_at + pairs.size();
    for (std::size_t k = count; k-- > 0;) {
        at[k] = (end + align - 1) / align * align;
        file.own[1 + count + k].resize(at[k] - end);
        end = at[k] + stored[k].size();
    }

    static constexpr unsigned char kIdentifier[12] = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                                      '0',  0xbb, '\r', '\n', 0x1a, '\n'};
    std::vector<std::byte>& head = file.own[0];
    for (const unsigned char c : kIdentifier) head.push_back(static_cast<std::byte>(c));
    put_u32(head, vulkan);
    put_u32(head, texture.format.block ? 1 : size_of(texture.format.type));
    put_u32(head, static_cast<std::uint32_t>(texture.width));
    put_u32(head, static_cast<std::uint32_t>(texture.height));
    put_u32(head, 0);  // depth
    put_u32(head, 0);  // layers
    put_u32(head, 1);  // faces
    put_u32(head, count);
    put_u32(head, zstd ? 2 : 0);
    put_u32(head, dfd_at);
    put_u32(head, dfd.size());
    put_u32(head, pairs_at);
    put_u32(head, pairs.size());
    put_little(head, 0, 8);  // no global data
    put_little(head, 0, 8);
    for (std::size_t k = 0; k < count; ++k) {
        put_little(head, at[k], 8);
        put_little(head, stored[k].size(), 8);
        put_little(head, levels[k].size(), 8);
    }
    head.insert(head.end(), dfd.begin(), dfd.end());
    head.insert(head.end(), pairs.begin(), pairs.end());
    file.parts.emplace_back(head);
    for (std::size_t k = count; k-- > 0;) {
        file.parts.emplace_back(file.own[1 + count + k]);
        file.parts.emplace_back(stored[k]);
    }
    return file;
}

std::vector<std::byte> ktx2_file(const MipTexture& texture, int zstd)
{
    const Ktx2Parts file = ktx2_parts(texture, level_bytes_of(texture), zstd);
    std::vector<std::byte> whole;
    for (const std::span<const std::byte> bytes : file.parts) {
        whole.insert(whole.end(), bytes.begin(), bytes.end());
    }
    return whole;
}

}  // namespace petrichor::texproc::detail
