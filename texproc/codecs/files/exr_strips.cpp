#include "texproc/codecs/files/exr_strips.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cerrno>
#include <cstddef>
#include <optional>

#include "base/error.h"
#include "base/output_file.h"

namespace petrichor::texproc {

struct ExrStrips::Impl {
    Impl(const std::filesystem::path& path, int wide, int high) : file(path), width(wide), height(high) {}

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw Error("output: cannot write " + file.destination().string() + ": " + why,
                    "Check that the folder is writable and the disk is not full.");
    }

    OutputFile file;
    int width, height;
    int written = 0;
    std::vector<std::pair<std::string, bool>> channels = {};
    std::optional<Imf::OutputFile> out = {};
};

ExrStrips::ExrStrips(const std::filesystem::path& path, int width, int height,
                     const std::vector<std::pair<std::string, bool>>& channels,
                     const std::vector<std::pair<std::string, std::string>>& metadata)
    : impl_(std::make_unique<Impl>(path, width, height))
{
    impl_->channels = channels;
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = 1;
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    for (const auto& [name, half] : channels) header.channels().insert(name, Imf::Channel(half ? Imf::HALF : Imf::FLOAT));
    errno = 0;
    try {
        impl_->out.emplace(impl_->file.temporary().c_str(), header, 0);
    } catch (const std::exception& failed) {
        impl_->refuse(failed.what());
    }
}

ExrStrips::~ExrStrips() = default;

void ExrStrips::write(int rows, const std::vector<ExrChannel>& channels)
{
    const auto columns = static_cast<std::size_t>(impl_->width);
    const std::size_t pixels = columns * static_cast<std::size_t>(rows);
    bool fits = channels.size() == impl_->channels.size() && impl_->written + rows <= impl_->height;
    for (std::size_t i = 0; fits && i < channels.size(); ++i) {
        fits = channels[i].name == impl_->channels[i].first &&
               (impl_->channels[i].second ? channels[i].half_bits.size() : channels[i].floats.size()) == pixels;
    }
    if (!fits) impl_->refuse("a strip has other channels or pixels than the picture");
    Imf::FrameBuffer frame;
    for (const ExrChannel& channel : channels) {
        const bool half = !channel.half_bits.empty();
        const std::size_t size = half ? 2 : 4;
        const std::size_t row = size * columns;
        const void* data = half ? static_cast<const void*>(channel.half_bits.data())
                                : static_cast<const void*>(channel.floats.data());
        // The library counts from the picture's first row.
        char* first = static_cast<char*>(const_cast<void*>(data)) -
                      static_cast<std::ptrdiff_t>(row) * impl_->written;
        frame.insert(channel.name, Imf::Slice(half ? Imf::HALF : Imf::FLOAT, first, size, row));
    }
    errno = 0;
    try {
        impl_->out->setFrameBuffer(frame);
        impl_->out->writePixels(rows);
    } catch (const std::exception& failed) {
        impl_->refuse(failed.what());
    }
    impl_->written += rows;
}

void ExrStrips::finish()
{
    if (impl_->written != impl_->height) impl_->refuse("rows are missing");
    errno = 0;
    try {
        impl_->out.reset();
    } catch (const std::exception& failed) {
        impl_->refuse(failed.what());
    }
    impl_->file.commit();
}

}  // namespace petrichor::texproc
