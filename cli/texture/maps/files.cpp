#include "cli/texture/maps/files.h"

#include <cctype>
#include <future>

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
        throw Error("output: '" + pattern + "' has no place for the number of the level",
                    "Write one %d into the name, such as 'out_%d.png'.");
    }
    std::string number = std::to_string(level);
    if (number.size() < width) number.insert(0, width - number.size(), '0');
    return pattern.substr(0, percent) + number + pattern.substr(end + 1);
}

}  // namespace petrichor::cli
