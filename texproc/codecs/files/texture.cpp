#include "texproc/codecs/files/texture.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "texproc/codecs/files/detail/texture_codes.h"
#include "texproc/codecs/files/detail/texture_shape.h"

namespace petrichor::texproc {

namespace {

struct Named {
    const char* name;
    TextureFormat format;
    bool writable = true;
};

// Those that can be written first.
const std::vector<Named>& block_names()
{
    static const std::vector<Named> names = [] {
        std::vector<Named> all;
        for (const bool writable : {true, false}) {
            for (const detail::BlockRow& row : detail::block_table()) {
                for (const detail::BlockLabel& label : row.labels) {
                    const bool written = label.is_signed ? row.encode_halves != nullptr
                                                         : row.encode || row.encode_halves || (row.astc && has_astc());
                    if (written == writable)
                        all.push_back({label.name, detail::format_of(row, label), writable});
                }
            }
        }
        return all;
    }();
    return names;
}

constexpr const char* kBlueFirst = "bgra8";
constexpr const char* kChannels[] = {"r", "rg", "rgb", "rgba"};
constexpr PixelType kTypes[] = {PixelType::U8, PixelType::U16, PixelType::F16, PixelType::F32};
constexpr const char* kDepths[] = {"8", "16", "16f", "32f"};

// Channels of another number: one stands for red, green and blue; missing ones are 0, alpha is 1.
Image with_channels(const Image& image, int channels)
{
    Image to(image.width, image.height, channels, image.space);
    const std::size_t from_step = static_cast<std::size_t>(image.channels);
    const std::size_t to_step = static_cast<std::size_t>(channels);
    const std::size_t pixels = image.pixels.size() / from_step;
    for (std::size_t p = 0; p < pixels; ++p) {
        const float* from = &image.pixels[p * from_step];
        for (std::size_t c = 0; c < to_step; ++c) {
            const bool grey = from_step == 1 && c < 3 && to_step >= 3;
            to.pixels[p * to_step + c] = c < from_step ? from[c]
                                         : grey        ? from[0]
                                         : c == 3      ? 1.0f
                                                       : 0.0f;
        }
    }
    return to;
}

// The same on codes of one byte, without the way through floats.
RawImage with_channels8(const RawImage& image, int channels)
{
    RawImage to{image.width, image.height, channels, PixelType::U8, {}, {}};
    to.bytes.resize(to.values());
    const std::size_t from_step = static_cast<std::size_t>(image.channels);
    const std::size_t to_step = static_cast<std::size_t>(channels);
    const std::size_t pixels = image.bytes.size() / from_step;
    for (std::size_t p = 0; p < pixels; ++p) {
        const std::byte* from = &image.bytes[p * from_step];
        for (std::size_t c = 0; c < to_step; ++c) {
            const bool grey = from_step == 1 && c < 3 && to_step >= 3;
            to.bytes[p * to_step + c] = c < from_step ? from[c]
                                        : grey        ? from[0]
                                        : c == 3      ? std::byte{255}
                                                      : std::byte{0};
        }
    }
    return to;
}

RawImage converted(const RawImage& image, PixelType type, int channels,
                   const TextureWriteOptions& options)
{
    if (image.type == type && image.channels == channels) return image;
    if (image.type == type && type == PixelType::U8) return with_channels8(image, channels);
    // In bands, so that no level stands in memory as floats; the pattern of the dither repeats every
    // eight rows.
    constexpr int kRows = 64;
    const std::size_t row = image.bytes.size() / static_cast<std::size_t>(image.height);
    RawImage to{image.width, image.height, channels, type, {}, {}};
    to.bytes.reserve(to.values() * size_of(type));
    for (int y = 0; y < image.height; y += kRows) {
        RawImage band{image.width, std::min(kRows, image.height - y), image.channels, image.type,
                      {}, {}};
        const auto from = image.bytes.begin() +
                          static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y));
        band.bytes.assign(from, from + static_cast<std::ptrdiff_t>(
                                           row * static_cast<std::size_t>(band.height)));
        const Image values = to_image(band, options.srgb ? ColorSpace::Linear : ColorSpace::Data);
        const RawImage codes = to_raw(with_channels(values, channels), type,
                                      options.dither ? Rounding::Ordered : Rounding::Nearest);
        to.bytes.insert(to.bytes.end(), codes.bytes.begin(), codes.bytes.end());
    }
    return to;
}

void check_level(const RawImage& level, const RawImage& first, int k)
{
    const int w = level_extent(first.width, k), h = level_extent(first.height, k);
    if (level.width == w && level.height == h && level.channels == first.channels &&
        level.type == first.type && level.channels >= 1 &&
        level.bytes.size() == level.values() * size_of(level.type)) {
        return;
    }
    throw Error("texture: level " + std::to_string(k) + " is " + std::to_string(level.width) +
                    " x " + std::to_string(level.height) + " x " + std::to_string(level.channels) +
                    ", it must be " + std::to_string(w) + " x " + std::to_string(h) + " x " +
                    std::to_string(first.channels) + " in the numbers of level 0",
                "Give each level half the size of the one before, rounded down, at least 1.");
}

TextureFormat own_format(const RawImage& first)
{
    const int channels = std::min(first.channels == 3 ? 4 : first.channels, 4);
    return {{}, first.type, channels, false};
}

void check_writable(const TextureFormat& format)
{
    // ASTC says itself what is missing.
    if (format.block && detail::row_of(*format.block).astc) return;
    for (const Named& named : block_names()) {
        if (format == named.format && !named.writable) {
            throw Error(std::string("texture: ") + named.name + " can be read, not written",
                        "Use bc7, or bc6h for what is beyond 0..1.");
        }
    }
}

}  // namespace

TextureFormat texture_format(const std::string& name)
{
    if (name == kBlueFirst) return {{}, PixelType::U8, 4, false};
    for (const Named& named : block_names()) {
        if (name == named.name) return named.format;
    }
    for (int c = 0; c < 4; ++c) {
        for (int d = 0; d < 4; ++d) {
            if (name == std::string(kChannels[c]) + kDepths[d])
                return {{}, kTypes[d], c + 1, false};
        }
    }
    std::string all;
    for (const std::string& known : texture_format_names())
        all += (all.empty() ? "" : ", ") + known;
    throw Error("texture: there is no format '" + name + "'", "Use one of " + all + ".");
}

std::string name_of(const TextureFormat& format)
{
    for (const Named& named : block_names()) {
        if (format == named.format) return named.name;
    }
    return std::string(kChannels[format.channels - 1]) + kDepths[static_cast<int>(format.type)];
}

std::vector<std::string> texture_format_names()
{
    std::vector<std::string> names;
    for (const char* depth : kDepths) {
        for (const char* channels : kChannels) names.push_back(std::string(channels) + depth);
    }
    for (const Named& named : block_names()) {
        if (named.writable) names.push_back(named.name);
    }
    names.push_back(kBlueFirst);
    return names;
}

std::size_t level_bytes(const TextureFormat& format, int width, int height)
{
    if (format.block) return blocks_size(*format.block, width, height);
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(format.channels) * size_of(format.type);
}

MipTexture detail::texture_shape(std::span<const RawImage> levels,
                                 const TextureWriteOptions& options)
{
    if (levels.empty() || levels[0].width < 1 || levels[0].height < 1) {
        throw Error("texture: it has no levels", "Give at least level 0, with at least one pixel.");
    }
    const RawImage& first = levels[0];
    int most = 1;
    while (std::max(first.width, first.height) >> most) ++most;
    if (levels.size() > static_cast<std::size_t>(most)) {
        throw Error("texture: " + std::to_string(levels.size()) + " levels for " +
                        std::to_string(first.width) + " x " + std::to_string(first.height) +
                        ", which has " + std::to_string(most),
                    "Stop at 1 x 1.");
    }
    for (std::size_t k = 0; k < levels.size(); ++k)
        check_level(levels[k], first, static_cast<int>(k));
    if (options.format.empty() && first.channels > 4) {
        throw Error(
            "texture: " + std::to_string(first.channels) + " channels, a texture has up to 4",
            "Choose channels (FILE:r), or name a format to keep the first ones.");
    }
    const TextureFormat format =
        options.format.empty() ? own_format(first) : texture_format(options.format);
    check_writable(format);
    // Halves and floats hold linear light: only integers can be marked.
    const bool srgb = options.srgb && format.type == PixelType::U8;
    return {first.width, first.height, format, srgb, {}, options.format == kBlueFirst};
}

detail::LevelBytes detail::level_bytes_of(const MipTexture& texture)
{
    return {texture.levels.begin(), texture.levels.end()};
}

MipTexture make_texture(std::span<const RawImage> levels, const TextureWriteOptions& options)
{
    MipTexture texture = detail::texture_shape(levels, options);
    const TextureFormat& format = texture.format;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const RawImage& level = levels[k];
        if (format.block && k < options.texel_weights.size() && !options.texel_weights[k].empty()) {
            texture.levels.push_back(encode_blocks_weighted(to_image(level, ColorSpace::Data),
                                                            options.texel_weights[k], *format.block,
                                                            options.threads));
            continue;
        }
        if (!format.block) {
            texture.levels.push_back(converted(level, format.type, format.channels, options).bytes);
            continue;
        }
        const BlockOptions blocks{
            .quality = options.quality,
            .weights = options.weights,
            .punch_through = *format.block == Block::Bc1 && format.channels == 4,
            .srgb = texture.srgb,
            .is_signed = format.is_signed,
            .repeat = options.repeat,
            .repeat_most = options.repeat_most,
            .threads = options.threads};
        const int channels = std::min(level.channels, 4);
        const PixelType type = *format.block == Block::Bc6h ? PixelType::F16 : PixelType::U8;
        texture.levels.push_back(
            level.type == type && level.channels == channels
                ? encode_blocks(level, *format.block, blocks)
                : encode_blocks(converted(level, type, channels, options), *format.block,
                                blocks));
    }
    return texture;
}

RawImage decode_level(const MipTexture& texture, int level, int threads, bool exact)
{
    if (level < 0 || static_cast<std::size_t>(level) >= texture.levels.size()) {
        throw Error("texture: there is no level " + std::to_string(level) + ", it has " +
                        std::to_string(texture.levels.size()),
                    "Count from 0.");
    }
    const int w = level_extent(texture.width, level), h = level_extent(texture.height, level);
    const std::vector<std::byte>& bytes = texture.levels[static_cast<std::size_t>(level)];
    const TextureFormat& format = texture.format;
    if (!format.block) return {w, h, format.channels, format.type, {}, bytes};
    const BlockSign sign = format.is_signed ? BlockSign::Signed
                           : exact          ? BlockSign::Exact
                                            : BlockSign::Unsigned;
    RawImage image = decode_blocks(bytes, *format.block, w, h, sign, threads, texture.srgb);
    if (format.channels == image.channels) return image;
    return with_channels8(image, format.channels);  // opaque BC1
}

}  // namespace petrichor::texproc
