#include <bit>
#include <stdexcept>

#include "texproc/codecs/files/detail/dds.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"

namespace petrichor::texproc::detail {

namespace {

using Bytes = std::span<const std::byte>;

// Where the texels of a file lie and how.
struct Layout {
    LabelledFormat label;
    std::uint32_t bits = 0;        // of a texel with masks; 0: as label says
    std::uint32_t masks[4] = {};   // red, green, blue, alpha
    bool normal_in_alpha = false;  // 'RXGB': red lies in alpha
    std::size_t start = 128;
};

std::string four_letters(std::uint32_t code)
{
    std::string text;
    for (int i = 0; i < 4; ++i) {
        const char c = static_cast<char>(code >> (8 * i));
        text += c >= 32 && c < 127 ? c : '?';
    }
    return text;
}

LabelledFormat by_code(std::uint32_t code)
{
    struct Old {
        const char* name;
        std::uint32_t dxgi;
    };
    static constexpr Old kOld[] = {{"DXT1", 71}, {"DXT2", 74}, {"DXT3", 74}, {"DXT4", 77},
                                   {"DXT5", 77}, {"RXGB", 77}, {"ATI1", 80}, {"BC4U", 80},
                                   {"BC4S", 81}, {"ATI2", 83}, {"BC5U", 83}, {"BC5S", 84}};
    const std::string letters = four_letters(code);
    for (const Old& old : kOld) {
        if (letters == old.name) return *from_dxgi(old.dxgi);
    }
    // Numbers of Direct3D 9 for wide texels.
    static constexpr std::uint32_t kNumbers[][2] = {{36, 11},  {111, 54}, {112, 34}, {113, 10},
                                                    {114, 41}, {115, 16}, {116, 2}};
    for (const auto& number : kNumbers) {
        if (number[0] == code) return *from_dxgi(number[1]);
    }
    throw std::runtime_error("its texel format '" + letters + "' is not supported");
}

void set_masks(Layout& layout, std::uint32_t bits, std::uint32_t r, std::uint32_t g,
               std::uint32_t b, std::uint32_t a)
{
    layout.bits = bits;
    const std::uint32_t masks[4] = {r, g, b, a};
    int widest = 0, channels = 0;
    for (int c = 0; c < 4; ++c) {
        layout.masks[c] = masks[c];
        widest = std::max(widest, std::popcount(masks[c]));
        if (masks[c]) channels = c + 1;
    }
    if (bits < 8 || bits > 32 || bits % 8 || channels == 0 || widest > 16) {
        throw std::runtime_error("its texels of " + std::to_string(bits) +
                                 " bits with these masks are not supported");
    }
    layout.label.format = {{}, widest > 8 ? PixelType::U16 : PixelType::U8, channels, false};
}

Layout extended_layout(Bytes bytes)
{
    const std::uint32_t code = read_u32(bytes, 128);
    if (read_u32(bytes, 132) != 3) throw std::runtime_error("it is no two-dimensional texture");
    if (read_u32(bytes, 140) < 1) throw std::runtime_error("it holds no image");
    (void)read_u32(bytes, 144);
    Layout layout;
    layout.start = 148;
    switch (code) {  // packed texels, as masks
        case 24:
            set_masks(layout, 32, 0x3ff, 0xffc00, 0x3ff00000, 0xc0000000u);
            return layout;
        case 85:
            set_masks(layout, 16, 0xf800, 0x7e0, 0x1f, 0);
            return layout;
        case 86:
            set_masks(layout, 16, 0x7c00, 0x3e0, 0x1f, 0x8000);
            return layout;
        case 88:
            set_masks(layout, 32, 0xff0000, 0xff00, 0xff, 0);
            return layout;
        case 93:
            set_masks(layout, 32, 0xff0000, 0xff00, 0xff, 0);
            layout.label.srgb = true;
            return layout;
        case 115:
            set_masks(layout, 16, 0xf00, 0xf0, 0xf, 0xf000);
            return layout;
        default:
            break;
    }
    const auto label = from_dxgi(code);
    if (!label) {
        throw std::runtime_error("its texel format (DXGI " + std::to_string(code) +
                                 ") is not supported");
    }
    layout.label = *label;
    return layout;
}

Layout layout_of(Bytes bytes)
{
    constexpr std::uint32_t kAlphaPixels = 1, kAlphaOnly = 2, kCode = 4, kRgb = 0x40,
                            kGrey = 0x20000;
    const std::uint32_t flags = read_u32(bytes, 80);
    if (flags & kCode) {
        const std::uint32_t code = read_u32(bytes, 84);
        if (four_letters(code) == "DX10") return extended_layout(bytes);
        Layout layout{.label = by_code(code)};
        layout.normal_in_alpha = four_letters(code) == "RXGB";
        return layout;
    }
    Layout layout;
    const std::uint32_t bits = read_u32(bytes, 88), alpha = read_u32(bytes, 104);
    if (flags & kRgb) {
        set_masks(layout, bits, read_u32(bytes, 92), read_u32(bytes, 96), read_u32(bytes, 100),
                  flags & kAlphaPixels ? alpha : 0);
    } else if (flags & kGrey) {
        set_masks(layout, bits, read_u32(bytes, 92), flags & kAlphaPixels ? alpha : 0, 0, 0);
    } else if (flags & kAlphaOnly) {
        set_masks(layout, bits, alpha, 0, 0, 0);
    } else {
        throw std::runtime_error("its texels are neither RGB, grey, alpha nor a named format");
    }
    return layout;
}

// Code of a masked field, widened to 8 or 16 bits (nearest).
std::uint32_t field(std::uint32_t texel, std::uint32_t mask, std::uint32_t top)
{
    const int shift = std::countr_zero(mask);
    const std::uint64_t most = mask >> shift;
    const std::uint64_t value = (texel & mask) >> shift;
    return static_cast<std::uint32_t>((value * top + most / 2) / most);
}

std::vector<std::byte> unmasked(Bytes from, const Layout& layout)
{
    const TextureFormat& format = layout.label.format;
    const std::size_t step = layout.bits / 8;
    const std::size_t texels = from.size() / step;
    const bool wide = format.type == PixelType::U16;
    std::vector<std::byte> to;
    to.reserve(texels * static_cast<std::size_t>(format.channels) * (wide ? 2 : 1));
    for (std::size_t t = 0; t < texels; ++t) {
        const auto texel =
            static_cast<std::uint32_t>(read_little(from, t * step, static_cast<int>(step)));
        for (int c = 0; c < format.channels; ++c) {
            const std::uint32_t mask = layout.masks[c];
            put_little(to, mask ? field(texel, mask, wide ? 65535 : 255) : 0, wide ? 2 : 1);
        }
    }
    return to;
}

}  // namespace

MipTexture parse_dds(std::span<const std::byte> bytes, const ReadOptions& limits)
{
    if (read_u32(bytes, 0) != 0x20534444 || read_u32(bytes, 4) != 124 ||
        read_u32(bytes, 76) != 32) {
        throw std::runtime_error("its DDS header is damaged");
    }
    const Layout layout = layout_of(bytes);
    const std::uint32_t height = read_u32(bytes, 12), width = read_u32(bytes, 16);
    const TextureFormat& format = layout.label.format;
    check_texture_size(width, height, format.channels, limits);
    if (read_u32(bytes, 112) & 0x200000) throw std::runtime_error("it is a volume, not an image");

    MipTexture texture{
        static_cast<int>(width), static_cast<int>(height), format, layout.label.srgb, {}};
    const bool says = read_u32(bytes, 8) & 0x20000;
    const std::uint32_t levels = says ? std::max(1u, read_u32(bytes, 28)) : 1;
    if (levels > static_cast<std::uint32_t>(std::bit_width(std::max(width, height)))) {
        throw std::runtime_error("it claims " + std::to_string(levels) + " mip levels");
    }
    std::uint64_t at = layout.start;
    for (int k = 0; k < static_cast<int>(levels); ++k) {
        const int w = level_extent(texture.width, k), h = level_extent(texture.height, k);
        const std::uint64_t size =
            layout.bits
                ? static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h) * (layout.bits / 8)
                : level_bytes(format, w, h);
        const Bytes stored = part(bytes, at, size, "mip level " + std::to_string(k));
        at += size;
        texture.levels.push_back(layout.bits
                                     ? unmasked(stored, layout)
                                     : std::vector<std::byte>(stored.begin(), stored.end()));
        if (layout.label.swap_red_blue) swap_red_blue(texture.levels.back(), format.channels);
    }
    if (layout.normal_in_alpha) {  // no program but games writes it; the swizzle is undone on plain
                                   // texels
        for (int k = 0; k < static_cast<int>(levels); ++k) {
            RawImage image = decode_level(texture, k, 1);
            for (std::size_t i = 0; i + 3 < image.bytes.size(); i += 4) {
                image.bytes[i] = image.bytes[i + 3];
                image.bytes[i + 3] = std::byte{255};
            }
            texture.levels[static_cast<std::size_t>(k)] = std::move(image.bytes);
        }
        texture.format = {{}, PixelType::U8, 4, false};
    }
    return texture;
}

}  // namespace petrichor::texproc::detail
