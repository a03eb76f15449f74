#include "texproc/codecs/files/detail/exr_mips.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "base/output_file.h"
#include "texproc/codecs/files/detail/sha1.h"

namespace petrichor::texproc::detail {

namespace {

constexpr unsigned kTile = 64;

std::string channel_name(int c, int channels)
{
    if (channels == 1) return "Y";
    if (channels == 6) {  // slopes of bumps, as maketx names them
        constexpr const char* kSlopes[] = {"b0_h",     "b1_dhds",  "b2_dhdt",
                                           "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};
        return kSlopes[c];
    }
    return std::string(1, "RGBA"[c]);
}

// What texture systems look for in the header: the mean, whether all texels are alike, and a name
// of the content, by which one that is there twice is loaded once.
void describe(const MipTexture& texture, Imf::Header& header)
{
    const std::vector<std::byte>& bytes = texture.levels.front();
    const std::size_t channels = static_cast<std::size_t>(texture.format.channels);
    const Image level = to_image(
        {texture.width, texture.height, texture.format.channels, texture.format.type, {}, bytes},
        ColorSpace::Data);
    const std::size_t pixels = level.pixels.size() / channels;
    const auto listed = [&](const auto& number_of) {
        std::string text;
        for (std::size_t c = 0; c < channels; ++c) {
            char digits[32];
            std::snprintf(digits, sizeof digits, "%.9g", number_of(c));
            text += (c ? "," : "") + std::string(digits);
        }
        return text;
    };
    header.insert("oiio:AverageColor", Imf::StringAttribute(listed([&](std::size_t c) {
                      double sum = 0.0;
                      for (std::size_t p = 0; p < pixels; ++p)
                          sum += static_cast<double>(level.pixels[p * channels + c]);
                      return sum / static_cast<double>(pixels);
                  })));
    const std::size_t pixel = bytes.size() / pixels;
    bool constant = true;
    for (std::size_t at = pixel; constant && at < bytes.size(); at += pixel)
        constant = std::memcmp(bytes.data(), bytes.data() + at, pixel) == 0;
    if (constant)
        header.insert("oiio:ConstantColor", Imf::StringAttribute(listed([&](std::size_t c) {
                          return static_cast<double>(level.pixels[c]);
                      })));
    // The shape counts: the same numbers in other rows are another texture.
    std::vector<std::byte> content = bytes;
    const std::string shape = std::to_string(texture.width) + " x " +
                              std::to_string(texture.height) + " x " + std::to_string(channels) +
                              " x " + std::to_string(size_of(texture.format.type));
    const auto words = std::as_bytes(std::span(shape));
    content.insert(content.end(), words.begin(), words.end());
    header.insert("oiio:SHA-1", Imf::StringAttribute(sha1(content)));
}

}  // namespace

void write_exr_mips(const std::filesystem::path& path, const MipTexture& texture)
{
    int all = 1;
    while (std::max(texture.width, texture.height) >> all) ++all;
    if (texture.levels.size() != static_cast<std::size_t>(all)) {
        throw Error("output " + path.string() + ": EXR with mip levels needs all " +
                        std::to_string(all) + " levels, got " +
                        std::to_string(texture.levels.size()),
                    "Make the whole chain down to 1 x 1 (convert: add --mips).");
    }
    const int channels = texture.format.channels;
    const bool half = texture.format.type == PixelType::F16;
    const std::size_t size = size_of(texture.format.type);
    Imf::Header header(texture.width, texture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = 1;
    header.setTileDescription(
        Imf::TileDescription(kTile, kTile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
    header.insert("textureformat", Imf::StringAttribute("Plain Texture"));
    header.insert("wrapmodes", Imf::StringAttribute("periodic,periodic"));
    describe(texture, header);
    for (int c = 0; c < channels; ++c) {
        header.channels().insert(channel_name(c, channels),
                                 Imf::Channel(half ? Imf::HALF : Imf::FLOAT));
    }
    OutputFile file(path);
    try {
        Imf::TiledOutputFile out(file.temporary().c_str(), header, 0);
        for (int k = 0; k < all; ++k) {
            const std::vector<std::byte>& bytes = texture.levels[static_cast<std::size_t>(k)];
            char* data = reinterpret_cast<char*>(const_cast<std::byte*>(bytes.data()));
            const std::size_t pixel = size * static_cast<std::size_t>(channels);
            const std::size_t row =
                pixel * static_cast<std::size_t>(level_extent(texture.width, k));
            Imf::FrameBuffer frame;
            for (int c = 0; c < channels; ++c) {
                frame.insert(channel_name(c, channels),
                             Imf::Slice(half ? Imf::HALF : Imf::FLOAT,
                                        data + size * static_cast<std::size_t>(c), pixel, row));
            }
            out.setFrameBuffer(frame);
            out.writeTiles(0, out.numXTiles(k) - 1, 0, out.numYTiles(k) - 1, k);
        }
    } catch (const std::exception& failed) {
        throw Error("output: cannot write " + path.string() + ": " + failed.what(),
                    "Check that the folder is writable and the disk is not full.");
    }
    file.commit();
}

}  // namespace petrichor::texproc::detail
