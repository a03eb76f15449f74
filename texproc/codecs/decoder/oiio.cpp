#include "texproc/codecs/decoder/oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <stdexcept>

#include "texproc/codecs/decoder/image_library.h"

namespace petrichor::texproc::decoder {

namespace {

OIIO::TypeDesc type_desc(PixelType type)
{
    switch (type) {
        case PixelType::U8:
            return OIIO::TypeDesc::UINT8;
        case PixelType::U16:
            return OIIO::TypeDesc::UINT16;
        case PixelType::F16:
            return OIIO::TypeDesc::HALF;
        case PixelType::F32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

PixelType stored_type(const OIIO::ImageSpec& spec)
{
    switch (spec.format.basetype) {
        case OIIO::TypeDesc::UINT8:
            return PixelType::U8;
        case OIIO::TypeDesc::UINT16:
            return PixelType::U16;
        case OIIO::TypeDesc::HALF:
            return PixelType::F16;
        default:
            return PixelType::F32;
    }
}

}  // namespace

// Threads would only help one file; several files at a time are read, each in a process of its own.
void warm_up_oiio()
{
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    const OIIO::ImageSpec plain;
    for (const char* format :
         {"openexr", "tiff", "jpeg", "webp", "bmp", "hdr", "psd", "gif", "pnm", "targa"}) {
        OIIO::ImageInput::create(format, false, &plain);
    }
    for (const char* name : {"a.tif", "a.tga", "a.jpg"}) OIIO::ImageOutput::create(name);
}

namespace {

// A row of tiles, or some scanlines, at a time.
void read_by_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, const Header& header,
                  const Accept& accept)
{
    const bool tiled = spec.tile_width > 0;
    const int rows = tiled ? spec.tile_height : 64;
    const std::size_t row_bytes = static_cast<std::size_t>(header.width) *
                                  static_cast<std::size_t>(header.channels) * size_of(header.type);
    std::vector<std::byte> some(row_bytes * static_cast<std::size_t>(rows));
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(y + rows, spec.height);
        const int from = spec.y + y, to = spec.y + end;
        const bool good = tiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, from, to,
                                                   spec.z, spec.z + 1, 0, spec.nchannels,
                                                   type_desc(header.type), some.data())
                                : input.read_scanlines(0, 0, from, to, spec.z, 0, spec.nchannels,
                                                       type_desc(header.type), some.data());
        if (!good) {
            const std::string why = input.geterror();
            throw std::runtime_error(why.empty() ? "its pixels cannot be decoded" : why);
        }
        for (int i = 0; i < end - y; ++i)
            accept.row(some.data() + row_bytes * static_cast<std::size_t>(i));
    }
}

// True when the scans of a JPEG end with its end marker. Without it the library fills what is
// missing with grey and says nothing.
bool jpeg_is_whole(std::span<const std::byte> file)
{
    const auto byte = [&](std::size_t at) { return std::to_integer<int>(file[at]); };
    std::size_t at = 2;
    while (at + 4 <= file.size()) {
        if (byte(at) != 0xff) return false;
        const int marker = byte(at + 1);
        if (marker == 0xff) {  // padding
            ++at;
            continue;
        }
        if (marker == 0xd9) return true;
        at += 2 + static_cast<std::size_t>(byte(at + 2) << 8 | byte(at + 3));
        if (marker != 0xda) continue;
        // Coded data: up to the next marker that is neither a stuffed byte nor a restart.
        while (at + 1 < file.size()) {
            const int next = byte(at + 1);
            const bool restart = next >= 0xd0 && next <= 0xd7;
            if (byte(at) == 0xff && next != 0 && next != 0xff && !restart) break;
            ++at;
        }
    }
    return at + 2 <= file.size() && byte(at) == 0xff && byte(at + 1) == 0xd9;
}

}  // namespace

void read_with_oiio(std::span<const std::byte> file, const std::string& format,
                    const Accept& accept)
{
    if ((format == "jpeg" || format == "jpg") && !jpeg_is_whole(file))
        throw std::runtime_error("it is cut short: its end marker is missing");
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(file.data()), file.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);  // alpha is data here: RGB stays as stored
    wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    auto input = OIIO::ImageInput::create(format, false, &wish);
    if (!input || !input->supports("ioproxy"))
        throw std::runtime_error("this build cannot read " + format + " files");
    OIIO::ImageSpec spec;
    // The name is not opened; some formats go by its extension.
    if (!input->open("image." + format, spec, wish)) throw std::runtime_error(input->geterror());
    if (spec.deep) throw std::runtime_error("it holds deep samples, not one value a pixel");
    if (spec.depth > 1) throw std::runtime_error("it is a volume, not an image");
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) {
        throw std::runtime_error("it has no pixels");
    }
    Header header{spec.width, spec.height, spec.nchannels, stored_type(spec), spec.channelnames};
    if (accept.by_rows(header)) {
        read_by_rows(*input, spec, header, accept);
        return;
    }
    std::byte* pixels = accept(header);
    if (!input->read_image(0, 0, 0, spec.nchannels, type_desc(header.type), pixels)) {
        const std::string why = input->geterror();
        throw std::runtime_error(why.empty() ? "its pixels cannot be decoded" : why);
    }
}

std::vector<unsigned char> write_with_oiio(const std::string& name, const Header& header,
                                           const std::byte* pixels, int quality)
{
    auto output = OIIO::ImageOutput::create(name);
    if (!output || !output->supports("ioproxy")) throw std::runtime_error("no writer for " + name);
    OIIO::ImageSpec spec(header.width, header.height, header.channels, type_desc(header.type));
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", quality);
    if (name.size() > 4 && name.find(".tif", name.size() - 5) != std::string::npos) {
        spec.attribute("compression", "zip");
    }
    if (!output->open(name, spec) || !output->write_image(spec.format, pixels) ||
        !output->close()) {
        throw std::runtime_error(output->geterror());
    }
    return file;
}

}  // namespace petrichor::texproc::decoder

// What the program asks this module for.
extern "C" __attribute__((visibility("default")))
const petrichor::texproc::decoder::ImageLibrary petrichor_images{
    petrichor::texproc::decoder::warm_up_oiio, petrichor::texproc::decoder::read_with_oiio,
    petrichor::texproc::decoder::write_with_oiio};
