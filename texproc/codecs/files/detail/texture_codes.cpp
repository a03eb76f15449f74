#include "texproc/codecs/files/detail/texture_codes.h"

#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace petrichor::texproc::detail {

namespace {

struct Row {
    TextureFormat format;
    std::uint32_t dxgi, dxgi_srgb, vulkan, vulkan_srgb;  // 0: there is none
};

constexpr TextureFormat plain(PixelType type, int channels)
{
    return {{}, type, channels, false};
}
constexpr Row kPlainRows[] = {
    {plain(PixelType::U8, 1), 61, 0, 9, 15},   {plain(PixelType::U8, 2), 49, 0, 16, 22},
    {plain(PixelType::U8, 3), 0, 0, 23, 29},   {plain(PixelType::U8, 4), 28, 29, 37, 43},
    {plain(PixelType::U16, 1), 56, 0, 70, 0},  {plain(PixelType::U16, 2), 35, 0, 77, 0},
    {plain(PixelType::U16, 3), 0, 0, 84, 0},   {plain(PixelType::U16, 4), 11, 0, 91, 0},
    {plain(PixelType::F16, 1), 54, 0, 76, 0},  {plain(PixelType::F16, 2), 34, 0, 83, 0},
    {plain(PixelType::F16, 3), 0, 0, 90, 0},   {plain(PixelType::F16, 4), 10, 0, 97, 0},
    {plain(PixelType::F32, 1), 41, 0, 100, 0}, {plain(PixelType::F32, 2), 16, 0, 103, 0},
    {plain(PixelType::F32, 3), 6, 0, 106, 0},  {plain(PixelType::F32, 4), 2, 0, 109, 0},
};

const std::vector<Row>& rows()
{
    static const std::vector<Row> all = [] {
        std::vector<Row> found(std::begin(kPlainRows), std::end(kPlainRows));
        for (const BlockRow& block : block_table()) {
            // The wider form first: DXGI does not tell BC1 with alpha from BC1 without.
            for (auto label = block.labels.rbegin(); label != block.labels.rend(); ++label) {
                found.push_back({format_of(block, *label), label->dxgi, label->dxgi_srgb,
                                 label->vulkan, label->vulkan_srgb});
            }
        }
        return found;
    }();
    return all;
}

// The untyped form of a DXGI format precedes its typed ones.
std::uint32_t typed(std::uint32_t dxgi)
{
    switch (dxgi) {
        case 27:
        case 48:
        case 60:
        case 70:
        case 73:
        case 76:
        case 79:
        case 82:
        case 97:
            return dxgi + 1;
        case 94:
            return 95;
        case 1:
            return 2;
        case 9:
            return 10;
        case 15:
            return 16;
        case 33:
            return 34;
        case 39:
            return 41;
        case 53:
            return 54;
        case 90:
            return 87;
        case 92:
            return 88;
        default:
            return dxgi;
    }
}

}  // namespace

TextureFormat format_of(const BlockRow& block, const BlockLabel& label)
{
    return {block.block, decoded_type(block.block, label.is_signed), label.channels,
            label.is_signed};
}

const BlockLabel* label_of(const TextureFormat& format)
{
    if (!format.block) return nullptr;
    const BlockRow& row = row_of(*format.block);
    for (const BlockLabel& label : row.labels) {
        if (format_of(row, label) == format) return &label;
    }
    return nullptr;
}

std::uint32_t dxgi_code(const TextureFormat& format, bool srgb)
{
    for (const Row& row : rows()) {
        if (row.format == format) return srgb ? row.dxgi_srgb : row.dxgi;
    }
    return 0;
}

std::uint32_t vulkan_code(const TextureFormat& format, bool srgb)
{
    for (const Row& row : rows()) {
        if (row.format == format) return srgb ? row.vulkan_srgb : row.vulkan;
    }
    return 0;
}

std::optional<LabelledFormat> from_dxgi(std::uint32_t code)
{
    const std::uint32_t wanted = typed(code);
    if (wanted == 87 || wanted == 91)
        return LabelledFormat{plain(PixelType::U8, 4), wanted == 91, true};
    for (const Row& row : rows()) {
        if (row.dxgi && row.dxgi == wanted) return LabelledFormat{row.format, false, false};
        if (row.dxgi_srgb && row.dxgi_srgb == wanted)
            return LabelledFormat{row.format, true, false};
    }
    return std::nullopt;
}

std::optional<LabelledFormat> from_vulkan(std::uint32_t code)
{
    if (code == 44 || code == 50) return LabelledFormat{plain(PixelType::U8, 4), code == 50, true};
    if (code == 30 || code == 36) return LabelledFormat{plain(PixelType::U8, 3), code == 36, true};
    for (const Row& row : rows()) {
        if (row.vulkan == code && code) return LabelledFormat{row.format, false, false};
        if (row.vulkan_srgb == code && code) return LabelledFormat{row.format, true, false};
    }
    return std::nullopt;
}

void swap_red_blue(std::vector<std::byte>& texels, int channels)
{
    const std::size_t step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i + 2 < texels.size(); i += step) std::swap(texels[i], texels[i + 2]);
}

void check_texture_size(std::uint64_t width, std::uint64_t height, int channels,
                        const ReadOptions& limits)
{
    constexpr std::uint64_t kMost = 1 << 20;
    const std::string shape = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1) throw std::runtime_error("it is " + shape + ": it has no pixels");
    if (width > kMost || height > kMost ||
        width * height > static_cast<std::uint64_t>(limits.max_pixels)) {
        throw std::runtime_error("it is " + shape + ", more than the limit of " +
                                 std::to_string(limits.max_pixels) + " pixels");
    }
    if (width * height * static_cast<std::uint64_t>(channels) * 4 > limits.max_bytes) {
        throw std::runtime_error("it is " + shape + " with " + std::to_string(channels) +
                                 " channels, more than the limit of " +
                                 std::to_string(limits.max_bytes >> 20) + " MiB decoded");
    }
}

}  // namespace petrichor::texproc::detail
