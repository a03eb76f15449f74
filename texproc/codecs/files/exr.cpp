#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::texproc {

void write_exr(const std::filesystem::path& path, int width, int height,
               const std::vector<ExrChannel>& channels,
               const std::vector<std::pair<std::string, std::string>>& metadata)
{
    if (width < 1 || height < 1 || channels.empty()) {
        throw Error("output " + path.string() + ": an EXR of " + std::to_string(width) + " x " +
                        std::to_string(height) + " with " + std::to_string(channels.size()) +
                        " channels cannot be written",
                    "Give it at least one pixel and one channel.");
    }
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = 1;
    for (const auto& [key, value] : metadata) {
        header.insert(key, Imf::StringAttribute(value));
    }
    Imf::FrameBuffer frame;
    for (const ExrChannel& channel : channels) {
        const bool half = !channel.half_bits.empty();
        const std::size_t found = half ? channel.half_bits.size() : channel.floats.size();
        if (found != pixels) {
            throw Error("output " + path.string() + ": channel " + channel.name + " has " +
                            std::to_string(found) + " values, the image " + std::to_string(pixels),
                        "Pass one value a pixel.");
        }
        const Imf::PixelType type = half ? Imf::HALF : Imf::FLOAT;
        const std::size_t size = half ? 2 : 4;
        const void* data = half ? static_cast<const void*>(channel.half_bits.data())
                                : static_cast<const void*>(channel.floats.data());
        header.channels().insert(channel.name, Imf::Channel(type));
        frame.insert(channel.name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(data)),
                                              size, size * static_cast<std::size_t>(width)));
    }
    OutputFile file(path);
    errno = 0;
    try {
        Imf::OutputFile out(file.temporary().c_str(), header, 0);
        out.setFrameBuffer(frame);
        out.writePixels(height);
    } catch (const std::exception& failed) {
        throw Error("output: cannot write " + path.string() + ": " + failed.what(),
                    "Check that the folder is writable and the disk is not full.");
    }
    file.commit();
}

}  // namespace petrichor::texproc
