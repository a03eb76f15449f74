#include "texproc/codecs/files/io.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/error.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "texproc/codecs/files/detail/decoder_pool.h"
#include "texproc/codecs/files/detail/png.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunkValues = 1 << 18;

Image to_image(const detail::Decoded& decoded, ColorSpace space)
{
    const RawImage& shape = decoded.shape();
    Image image(shape.width, shape.height, shape.channels, space);
    const std::size_t channels = static_cast<std::size_t>(shape.channels);
    const std::size_t step = std::max<std::size_t>(1, kChunkValues / channels) * channels;
    const std::size_t size = size_of(shape.type);
    std::vector<std::byte> chunk;
    for (std::size_t at = 0; at < image.pixels.size(); at += step) {
        const std::size_t values = std::min(step, image.pixels.size() - at);
        chunk.resize(values * size);
        decoded.read(at * size, chunk);
        to_float(chunk.data(), shape.type, values, shape.channels, space, &image.pixels[at]);
    }
    return image;
}

RawImage to_raw(const detail::Decoded& decoded)
{
    RawImage raw = decoded.shape();
    raw.bytes.resize(raw.values() * size_of(raw.type));
    decoded.read(0, raw.bytes);
    return raw;
}

void check_not_empty(std::span<const std::byte> bytes, const std::string& name)
{
    if (bytes.empty()) {
        throw Error("image " + name + ": it is empty", "Export the file again.");
    }
}

std::string lower_extension(const fs::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void check_shape(const fs::path& path, int width, int height, int channels)
{
    if (width < 1 || height < 1 || channels < 1) {
        throw Error("output " + path.string() + ": an image of " + std::to_string(width) + " x " +
                        std::to_string(height) + " x " + std::to_string(channels) +
                        " cannot be written",
                    "Give it at least one pixel and one channel.");
    }
}

// A file, whole or not at all, from the pieces that `produce` hands on.
void write_pieces(const fs::path& path, const std::function<void(const detail::ByteSink&)>& produce)
{
    OutputFile file(path);
    produce([&](std::span<const std::byte> bytes) {
        file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    });
    file.commit();
}

void write_exr_raw(const fs::path& path, const RawImage& image)
{
    static const char* const kNames[4] = {"R", "G", "B", "A"};
    std::vector<ExrChannel> channels;
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    for (int c = 0; c < image.channels; ++c) {
        ExrChannel channel;
        const std::size_t at = static_cast<std::size_t>(c);
        if (at < image.channel_names.size()) {
            channel.name = image.channel_names[at];
        } else if (image.channels <= 2) {
            channel.name = c == 0 ? "Y" : "A";
        } else {
            channel.name = c < 4 ? kNames[c] : "channel" + std::to_string(c);
        }
        const std::size_t stride = static_cast<std::size_t>(image.channels);
        if (image.type == PixelType::F16) {
            channel.half_bits.resize(pixels);
            for (std::size_t i = 0; i < pixels; ++i) {
                std::memcpy(&channel.half_bits[i], &image.bytes[2 * (i * stride + at)], 2);
            }
        } else {
            channel.floats.resize(pixels);
            for (std::size_t i = 0; i < pixels; ++i) {
                std::memcpy(&channel.floats[i], &image.bytes[4 * (i * stride + at)], 4);
            }
        }
        channels.push_back(std::move(channel));
    }
    write_exr(path, image.width, image.height, channels, {});
}

}  // namespace

Image read_image(const fs::path& path, const ReadOptions& options)
{
    const InputFile file = open_regular_file(path, "image");
    return to_image(detail::decode_in_child(path.string(), file.fd(), options), options.space);
}

Image decode_image(std::span<const std::byte> bytes, const std::string& name,
                   const ReadOptions& options)
{
    check_not_empty(bytes, name);
    return to_image(detail::decode_in_child(name, bytes, options), options.space);
}

RawImage read_raw(const fs::path& path, const ReadOptions& options)
{
    const InputFile file = open_regular_file(path, "image");
    return to_raw(detail::decode_in_child(path.string(), file.fd(), options));
}

RawImage decode_raw(std::span<const std::byte> bytes, const std::string& name,
                    const ReadOptions& options)
{
    check_not_empty(bytes, name);
    return to_raw(detail::decode_in_child(name, bytes, options));
}

std::string decoder_confinement()
{
    return detail::decoder_confinement();
}

RawImage image_shape(std::span<const std::byte> bytes, const std::string& name,
                     const ReadOptions& options)
{
    check_not_empty(bytes, name);
    return detail::shape_in_child(name, bytes, options);
}

void write_bytes(const fs::path& path, std::span<const std::byte> bytes)
{
    write_bytes(path, std::vector<std::span<const std::byte>>{bytes});
}

void write_bytes(const fs::path& path, const std::vector<std::span<const std::byte>>& parts)
{
    write_pieces(path, [&](const detail::ByteSink& sink) {
        for (const std::span<const std::byte> bytes : parts) sink(bytes);
    });
}

void write_raw(const fs::path& path, const RawImage& image, const WriteOptions& options)
{
    check_shape(path, image.width, image.height, image.channels);
    const std::string extension = lower_extension(path);
    const bool integers = image.type == PixelType::U8 || image.type == PixelType::U16;
    if (extension == ".exr" && !integers) {
        write_exr_raw(path, image);
        return;
    }
    if (extension == ".dds" || extension == ".ktx2") {
        write_mip_chain(path, std::span(&image, 1), {.threads = options.threads});
        return;
    }
    const bool jpeg = extension == ".jpg" || extension == ".jpeg";
    const bool tiff = extension == ".tif" || extension == ".tiff";
    const bool png = extension == ".png";
    const bool tga = extension == ".tga";
    if (!png && !tga && !tiff && !jpeg) {
        throw Error("output " + path.string() + ": cannot write " +
                        (integers ? "integers" : "floats") + " as '" + extension + "'",
                    "Use one of png, tga, tif, jpg, dds, ktx2 for integers, exr, dds, ktx2 for "
                    "halves and floats.");
    }
    const int most = jpeg ? 3 : tiff ? 1024 : 4;
    if (image.channels > most) {
        throw Error("output " + path.string() + ": " + std::to_string(image.channels) +
                        " channels do not fit into '" + extension + "', which holds up to " +
                        std::to_string(most),
                    "Write EXR, or pack fewer channels.");
    }
    if (!integers || ((jpeg || tga) && image.type == PixelType::U16)) {
        throw Error("output " + path.string() + ": '" + extension + "' cannot hold these numbers",
                    "Write 8 bits, or choose png or tif (16 bits) or exr (half, float).");
    }
    if (png) {
        const int bits = image.type == PixelType::U8 ? 8 : 16;
        const detail::PngImage png_image{image.width, image.height, image.channels, bits,
                                         image.bytes.data()};
        write_pieces(path, [&](const detail::ByteSink& sink) {
            detail::encode_png(png_image, {}, 1, options.threads, sink);
        });
        return;
    }
    write_bytes(path, detail::encode_in_child(path, image, options.quality));
}

void write_image(const fs::path& path, const Image& image, const WriteOptions& options)
{
    const bool exr = lower_extension(path) == ".exr";
    if (options.bits != 8 && options.bits != 16 && options.bits != 32) {
        throw Error("output " + path.string() + ": bits must be 8, 16 or 32, got " +
                        std::to_string(options.bits),
                    "Use 8 or 16 for png and tif, 16 or 32 for exr.");
    }
    const PixelType type = exr ? (options.bits == 32 ? PixelType::F32 : PixelType::F16)
                           : options.bits == 8  ? PixelType::U8
                           : options.bits == 16 ? PixelType::U16
                                                : PixelType::F32;
    const RawImage raw = texproc::to_raw(image, type, options.rounding);
    const std::string extension = lower_extension(path);
    if (extension == ".dds" || extension == ".ktx2") {  // which say that they hold colour
        write_mip_chain(path, std::span(&raw, 1),
                        {.srgb = image.space == ColorSpace::Linear && options.bits == 8,
                         .threads = options.threads});
        return;
    }
    write_raw(path, raw, options);
}

std::vector<std::byte> encode_png8(int width, int height, int channels,
                                   std::span<const std::uint8_t> pixels,
                                   const std::vector<std::pair<std::string, std::string>>& metadata)
{
    const std::string shape =
        std::to_string(width) + " x " + std::to_string(height) + " x " + std::to_string(channels);
    if (width < 1 || height < 1 || channels < 1 || channels > 4) {
        throw Error("png: a picture of " + shape + " is not possible",
                    "Give sides of at least 1 and 1 to 4 channels.");
    }
    const std::size_t needed = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                               static_cast<std::size_t>(channels);
    if (pixels.size() != needed) {
        throw Error("png: a picture of " + shape + " needs " + std::to_string(needed) +
                        " bytes, got " + std::to_string(pixels.size()),
                    "Pass one byte a channel of every pixel.");
    }
    return detail::encode_png(
        {width, height, channels, 8, reinterpret_cast<const std::byte*>(pixels.data())}, metadata);
}

void write_png8(const fs::path& path, int width, int height, int channels,
                std::span<const std::uint8_t> pixels,
                const std::vector<std::pair<std::string, std::string>>& metadata)
{
    check_shape(path, width, height, channels);
    write_bytes(path, encode_png8(width, height, channels, pixels, metadata));
}

void write_png8(const fs::path& path, int width, int height, int channels,
                const std::function<std::vector<std::byte>(std::size_t, std::size_t)>& rows,
                const std::vector<std::pair<std::string, std::string>>& metadata)
{
    check_shape(path, width, height, channels);
    write_pieces(path, [&](const detail::ByteSink& sink) {
        detail::encode_png({.width = width, .height = height, .channels = channels, .rows = rows}, metadata, 1, 0, sink);
    });
}

}  // namespace petrichor::texproc
