// Frames and sizes as they are written in commands.
#include <charconv>
#include <optional>

#include "base/error.h"
#include "film/jobs/sequence.h"

namespace petrichor::film {
namespace {

constexpr int kLargestSide = 16384;

std::optional<int> whole_number(std::string_view text)
{
    int value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || value < 0)
        return std::nullopt;
    return value;
}

}  // namespace

FrameRange parse_frame_range(std::string_view text, int count)
{
    const std::size_t colon = text.find(':');
    FrameRange range{0, count - 1};
    bool good = !text.empty() && text != ":";
    const std::string_view first = text.substr(0, colon);
    if (!first.empty()) {
        const auto number = whole_number(first);
        good = good && number.has_value();
        range.first = number.value_or(0);
    }
    if (colon == std::string_view::npos) {
        range.last = range.first;
    } else if (const std::string_view last = text.substr(colon + 1); !last.empty()) {
        const auto number = whole_number(last);
        good = good && number.has_value();
        range.last = number.value_or(0);
    }
    if (!good || range.first > range.last) {
        throw Error("frames: expected FIRST:LAST (both are rendered) or one number, got \"" +
                        std::string(text) + "\"",
                    "For example --frames 0:9 for the first ten, --frames 30 for one.");
    }
    if (range.last >= count) {
        throw Error("frames: the sequence has frames 0 to " + std::to_string(count - 1) +
                        ", got \"" + std::string(text) + "\"",
                    "Ask for frames it has, or make it longer with --count or output.frames.");
    }
    return range;
}

void check_size(const ImageSize& size)
{
    const bool sides = size.width >= 1 && size.height >= 1 && size.width <= kLargestSide &&
                       size.height <= kLargestSide;
    if (!sides) {
        throw Error("size: width and height must be 1 to " + std::to_string(kLargestSide) + " pixels, got " +
                        std::to_string(size.width) + "x" + std::to_string(size.height),
                    "For example --size 1280x720.");
    }
}

ImageSize parse_size(std::string_view text)
{
    const std::size_t x = text.find_first_of("xX");
    if (x != std::string_view::npos) {
        const auto width = whole_number(text.substr(0, x));
        const auto height = whole_number(text.substr(x + 1));
        if (width && height) {
            const ImageSize size{*width, *height};
            check_size(size);
            return size;
        }
    }
    throw Error("size: expected WIDTHxHEIGHT in pixels, got \"" + std::string(text) + "\"",
                "For example --size 1280x720.");
}

}  // namespace petrichor::film
