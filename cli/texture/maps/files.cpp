#include "cli/texture/maps/files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <future>
#include <iostream>

#include "base/error.h"
#include "texproc/material/pack.h"

namespace petrichor::cli {

MapFile parse_map_file(const std::string& text)
{
    const std::size_t colon = text.rfind(':');
    if (colon != std::string::npos && text.size() == colon + 2 && colon > 0) {
        const std::size_t letter = std::string("rgba").find(text.back());
        if (letter != std::string::npos) return {text.substr(0, colon), static_cast<int>(letter)};
        if (std::isdigit(static_cast<unsigned char>(text.back()))) {
            return {text.substr(0, colon), text.back() - '0'};
        }
    }
    return {text, -1};
}

texproc::RawImage read_map(const std::string& text, const texproc::ReadOptions& options)
{
    const MapFile file = parse_map_file(text);
    texproc::RawImage image = texproc::read_raw(file.path, options);
    if (file.channel < 0) return image;
    if (file.channel >= image.channels) {
        throw Error("image " + file.path.string() + ": it has " + std::to_string(image.channels) +
                        " channels, '" + text.substr(text.size() - 1) + "' is not one of them",
                    "Choose a channel that is there, or leave ':" + text.substr(text.size() - 1) +
                        "' out.");
    }
    return texproc::channel_of(image, file.channel);
}

namespace {

// Some thousand texels of an image, in a row.
Image sample_of(const texproc::RawImage& image)
{
    constexpr std::size_t kLooks = 4096;
    const std::size_t texels = image.values() / static_cast<std::size_t>(image.channels);
    const std::size_t texel_bytes = image.bytes.size() / texels;
    const std::size_t looks = std::min(kLooks, texels);
    texproc::RawImage seen{static_cast<int>(looks), 1, image.channels, image.type, {}, {}};
    for (std::size_t i = 0; i < looks; ++i) {
        const std::byte* texel = image.bytes.data() + i * texels / looks * texel_bytes;
        seen.bytes.insert(seen.bytes.end(), texel, texel + texel_bytes);
    }
    return texproc::to_image(seen, ColorSpace::Data);
}

}  // namespace

bool is_colored(const texproc::RawImage& image)
{
    if (image.channels < 3) return false;
    constexpr double kNoise = 0.02;
    const Image seen = sample_of(image);
    double apart = 0.0;
    for (std::size_t i = 0; i < seen.pixels.size(); i += static_cast<std::size_t>(image.channels))
        apart += static_cast<double>(std::abs(seen.pixels[i] - seen.pixels[i + 1]) +
                                     std::abs(seen.pixels[i] - seen.pixels[i + 2]));
    return apart > kNoise * static_cast<double>(seen.width);
}

void tell_if_no_normals(const std::string& text, const texproc::RawImage& image)
{
    if (image.channels < 3) return;
    const Image seen = sample_of(image);
    int down = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); i += static_cast<std::size_t>(image.channels))
        down += seen.pixels[i + 2] < 0.5f;
    if (4 * down > seen.width)
        std::cerr << "note: " << text << " is hardly a normal map: " << 100 * down / seen.width
                  << " % of its normals point into the surface\n";
}

void tell_red_taken(const std::string& text, const texproc::RawImage& image, const std::string& role)
{
    if (parse_map_file(text).channel >= 0 || !is_colored(image)) return;
    std::cerr << "note: " << text << " is coloured, its red is taken for the " << role << " (" << text
              << ":g takes green)\n";
}

void tell_cut_numbers(const Image& values)
{
    constexpr float kHalfCode = 0.5f / 255.0f;  // less is rounding
    std::size_t above = 0, below = 0, none = 0;
    for (const float v : values.pixels) {
        above += v > 1.0f + kHalfCode;
        below += v < -kHalfCode;
        none += std::isnan(v);
    }
    const auto tell = [&](std::size_t count, const char* what) {
        if (count > 0)
            std::cerr << "note: " << count << " of " << values.pixels.size() << " numbers " << what
                      << " (floats keep them: .exr, or --format rgba16f in .dds and .ktx2)\n";
    };
    tell(above, "are above 1 and become 1");
    tell(below, "are below 0 and become 0");
    tell(none, "are not numbers and become 0");
}

std::vector<texproc::RawImage> read_maps(const std::vector<std::string>& texts,
                                         const texproc::ReadOptions& options, int threads)
{
    std::vector<texproc::RawImage> maps(texts.size());
    const auto read_from = [&](std::size_t first, std::size_t step) {
        for (std::size_t i = first; i < texts.size(); i += step)
            maps[i] = read_map(texts[i], options);
    };
    if (threads == 1 || texts.size() < 2) {
        read_from(0, 1);
        return maps;
    }
    std::future<void> other = std::async(std::launch::async, read_from, 1, 2);
    read_from(0, 2);
    other.get();
    return maps;
}

std::string level_name(const std::string& pattern, int level)
{
    const std::size_t percent = pattern.find('%');
    std::size_t end = percent == std::string::npos ? percent : percent + 1;
    std::size_t width = 0;
    while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end]))) {
        width = 10 * width + static_cast<std::size_t>(pattern[end++] - '0');
    }
    if (percent == std::string::npos || end >= pattern.size() || pattern[end] != 'd' || width > 9 ||
        pattern.find('%', end) != std::string::npos) {
        throw Error("output: '" + pattern + "' has no %d, where files of one command differ (by level, map or channel)",
                    "Write one %d into the name, such as 'out_%d.png'.");
    }
    std::string number = std::to_string(level);
    if (number.size() < width) number.insert(0, width - number.size(), '0');
    return pattern.substr(0, percent) + number + pattern.substr(end + 1);
}

}  // namespace petrichor::cli
