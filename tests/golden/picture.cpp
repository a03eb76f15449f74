#include "tests/golden/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <map>

#include "texproc/codecs/files/io.h"

namespace petrichor::golden {
namespace {

namespace fs = std::filesystem;

float rounded_to_half(float value)
{
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

// Distances over the range of a street do not fit into halves.
bool needs_float(const std::string& aov)
{
    for (const gpu::AovInfo& info : gpu::aov_table()) {
        if (info.name == aov) return info.precision == gpu::AovPrecision::FLOAT;
    }
    return false;  // radiance and display
}

std::string suffixes_of(const std::string& aov)
{
    for (const gpu::AovInfo& info : gpu::aov_table()) {
        if (info.name == aov) return info.channels;
    }
    return "XYZW";
}

void append(Picture& to, Picture from)
{
    std::move(from.channels.begin(), from.channels.end(), std::back_inserter(to.channels));
}

// The channels of an image file, named; `scale` multiplies them.
Picture read_channels(const fs::path& file, const std::string& group, float scale)
{
    const texproc::RawImage raw = texproc::read_raw(file);
    const Image image = texproc::to_image(raw, ColorSpace::Data);
    Picture picture{image.width, image.height, {}};
    const auto pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto count = static_cast<std::size_t>(image.channels);
    for (std::size_t c = 0; c < count; ++c) {
        Channel channel;
        channel.name =
            group.empty() ? raw.channel_names.at(c) : group + "." + std::string("RGBA").at(c);
        channel.half = !needs_float(group_of(channel.name));
        for (std::size_t i = 0; i < pixels; ++i) {
            channel.values.push_back(image.pixels[i * count + c] * scale);
        }
        picture.channels.push_back(std::move(channel));
    }
    return picture;
}

std::vector<std::uint8_t> stretched(const std::vector<const Channel*>& channels)
{
    float largest = 1e-6f;
    bool is_signed = false;
    for (const Channel* channel : channels) {
        for (const float v : channel->values) {
            if (!std::isfinite(v)) continue;
            largest = std::max(largest, std::abs(v));
            is_signed = is_signed || v < 0.0f;
        }
    }
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < channels[0]->values.size(); ++i) {
        for (const Channel* channel : channels) {
            const float v = std::isfinite(channel->values[i]) ? channel->values[i] / largest : 1.0f;
            const float shown = is_signed ? 0.5f + 0.5f * v : v;
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * shown)));
        }
    }
    return bytes;
}

}  // namespace

std::string group_of(const std::string& channel)
{
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

Picture picture_of(const gpu::RenderResult& result)
{
    Picture picture{result.width, result.height, {}};
    const std::size_t pixels =
        static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    const std::string colors = "RGBA";
    for (std::size_t c = 0; c < 4; ++c) {
        Channel channel{colors.substr(c, 1), true, {}};
        for (std::size_t i = 0; i < pixels; ++i) {
            channel.values.push_back(glm::unpackHalf1x16(result.beauty[i * 4 + c]));
        }
        picture.channels.push_back(std::move(channel));
    }
    for (std::size_t c = 0; c < 3; ++c) {
        Channel channel{"display." + colors.substr(c, 1), true, {}};
        for (std::size_t i = 0; i < pixels; ++i) {
            channel.values.push_back(static_cast<float>(result.display[i * 4 + c]));
        }
        picture.channels.push_back(std::move(channel));
    }
    for (const gpu::AovImage& aov : result.aovs) {
        const std::string suffixes = suffixes_of(aov.name);
        const auto count = static_cast<std::size_t>(aov.channels);
        for (std::size_t c = 0; c < count; ++c) {
            Channel channel{aov.name + "." + suffixes.at(c), !needs_float(aov.name), {}};
            for (std::size_t i = 0; i < pixels; ++i) {
                const float v = aov.pixels[i * count + c];
                channel.values.push_back(channel.half ? rounded_to_half(v) : v);
            }
            picture.channels.push_back(std::move(channel));
        }
    }
    return picture;
}

Picture read_frame(const fs::path& exr, const fs::path& png)
{
    Picture picture = read_channels(exr, "", 1.0f);
    Picture display = read_channels(png, "display", 255.0f);
    // 1/255 is not a float: back to the byte that it came from.
    for (Channel& channel : display.channels) {
        for (float& v : channel.values) v = std::round(v);
    }
    append(picture, std::move(display));
    return picture;
}

void write_picture(const fs::path& exr, const Picture& picture)
{
    std::vector<texproc::ExrChannel> channels;
    for (const Channel& channel : picture.channels) {
        texproc::ExrChannel out{channel.name, {}, {}};
        if (channel.half) {
            for (const float v : channel.values) out.half_bits.push_back(glm::packHalf1x16(v));
        } else {
            out.floats = channel.values;
        }
        channels.push_back(std::move(out));
    }
    texproc::write_exr(exr, picture.width, picture.height, channels, {});
}

Picture read_picture(const fs::path& exr)
{
    return read_channels(exr, "", 1.0f);
}

void write_pngs(const fs::path& folder, const std::string& stem, const Picture& picture)
{
    std::map<std::string, std::vector<const Channel*>> groups;
    for (const char* wanted : {"X", "Y", "Z", "R", "G", "B"}) {  // files hold them in another order
        for (const Channel& channel : picture.channels) {
            const std::string group = group_of(channel.name);
            const std::string last =
                group.empty() ? channel.name : channel.name.substr(group.size() + 1);
            if (last == wanted) groups[group].push_back(&channel);
        }
    }
    const bool has_display = groups.contains("display");
    for (const auto& [group, channels] : groups) {
        if (group.empty() && has_display) continue;
        std::vector<std::uint8_t> bytes;
        if (group == "display") {
            for (std::size_t i = 0; i < channels[0]->values.size(); ++i) {
                for (const Channel* channel : channels) {
                    bytes.push_back(static_cast<std::uint8_t>(channel->values[i]));
                }
            }
        } else {
            bytes = stretched(channels);
        }
        const std::string name = group.empty() || group == "display" ? "" : "." + group;
        texproc::write_png8(folder / (stem + name + ".png"), picture.width, picture.height,
                            static_cast<int>(channels.size()), bytes);
    }
}

}  // namespace petrichor::golden
