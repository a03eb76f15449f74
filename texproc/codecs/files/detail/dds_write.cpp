#include "base/error.h"
#include "texproc/codecs/files/detail/dds.h"
#include "texproc/codecs/files/detail/little_endian.h"
#include "texproc/codecs/files/detail/texture_codes.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::uint32_t code_of(const char* text)
{
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i) {
        code |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << (8 * i);
    }
    return code;
}

// The first version of the container: a four-letter code or bit masks.
struct OldFormat {
    std::uint32_t flags = 0, four_letters = 0, bits = 0, masks[4] = {};
};

OldFormat old_format(const TextureFormat& format)
{
    constexpr std::uint32_t kAlpha = 1, kCode = 4, kRgb = 0x40, kGrey = 0x20000;
    if (format.block) {
        const BlockLabel* label = label_of(format);
        if (!label || label->four_letters[0] == 0) return {};
        return {kCode, code_of(label->four_letters)};
    }
    if (format.type != PixelType::U8) return {};
    if (format.channels == 1) return {kGrey, 0, 8, {0xff}};
    if (format.channels == 3) return {kRgb, 0, 24, {0xff, 0xff00, 0xff0000}};
    if (format.channels == 4) {
        return {kRgb | kAlpha, 0, 32, {0xff, 0xff00, 0xff0000, 0xff000000u}};
    }
    return {};
}

}  // namespace

std::vector<std::byte> dds_header(const MipTexture& texture, std::size_t levels)
{
    const TextureFormat& format = texture.format;
    OldFormat old = texture.srgb || format.is_signed || texture.blue_first ? OldFormat{}
                                                                           : old_format(format);
    const bool extended = old.flags == 0;
    constexpr std::uint32_t kBgra = 87, kBgraSrgb = 91;  // B8G8R8A8_UNORM, _UNORM_SRGB
    const std::uint32_t dxgi = !texture.blue_first ? dxgi_code(format, texture.srgb)
                               : texture.srgb      ? kBgraSrgb
                                                   : kBgra;
    if (extended && dxgi == 0) {
        throw Error("dds: the container has no " + std::string(texture.srgb ? "sRGB " : "") +
                        name_of(format),
                    texture.srgb ? "Use rgba8, bc1, bc3 or bc7 for sRGB, or leave --srgb out."
                                 : "Use four channels.");
    }
    if (extended) old = {4, code_of("DX10")};

    const bool many = levels > 1;
    std::uint32_t flags = 0x1007, caps = 0x1000;  // size, format; texture
    if (many) {
        flags |= 0x20000;
        caps |= 0x400008;
    }
    std::size_t pitch = level_bytes(format, texture.width, texture.height);
    if (format.block) {
        flags |= 0x80000;  // bytes of level 0
    } else {
        flags |= 8;  // bytes of a row
        pitch /= static_cast<std::size_t>(texture.height);
    }
    std::vector<std::byte> file;
    put_u32(file, code_of("DDS "));
    put_u32(file, 124);
    put_u32(file, flags);
    put_u32(file, static_cast<std::uint32_t>(texture.height));
    put_u32(file, static_cast<std::uint32_t>(texture.width));
    put_u32(file, pitch);
    put_u32(file, 0);  // depth
    put_u32(file, levels);
    for (int i = 0; i < 11; ++i) put_u32(file, 0);
    put_u32(file, 32);
    put_u32(file, old.flags);
    put_u32(file, old.four_letters);
    put_u32(file, old.bits);
    for (const std::uint32_t mask : old.masks) put_u32(file, mask);
    put_u32(file, caps);
    for (int i = 0; i < 4; ++i) put_u32(file, 0);
    if (extended) {
        put_u32(file, dxgi);
        put_u32(file, 3);  // two-dimensional
        put_u32(file, 0);
        put_u32(file, 1);                             // images
        put_u32(file, format.channels == 4 ? 1 : 0);  // straight alpha
    }
    return file;
}

}  // namespace petrichor::texproc::detail
