#include "cli/texture/contact_sheet.h"

#include <algorithm>
#include <utility>

#include "texproc/image/raw_image.h"

namespace petrichor::cli {

ContactSheet::ContactSheet(int width, int height)
{
    drawing_.width = width;
    drawing_.height = height;
}

void ContactSheet::place(const Image& image, int x, int y)
{
    placed_.push_back({image, x, y});
}

void ContactSheet::text(int x, int y, const std::string& words, double size, bool bold,
                        Anchor anchor, const std::string& color)
{
    drawing_.shapes.push_back(DrawnText{
        {static_cast<double>(x), static_cast<double>(y)}, words, color, size, anchor, bold});
}

Pixels ContactSheet::pixels() const
{
    Pixels sheet = to_pixels(drawing_, 1.0);
    for (const Placed& placed : placed_) {
        const texproc::RawImage codes = texproc::to_raw(placed.image, texproc::PixelType::U8);
        for (int y = std::max(0, -placed.y); y < codes.height && placed.y + y < sheet.height; ++y) {
            for (int x = std::max(0, -placed.x); x < codes.width && placed.x + x < sheet.width;
                 ++x) {
                const std::size_t from =
                    (static_cast<std::size_t>(y) * static_cast<std::size_t>(codes.width) +
                     static_cast<std::size_t>(x)) *
                    static_cast<std::size_t>(codes.channels);
                const std::size_t to = 3 * (static_cast<std::size_t>(placed.y + y) *
                                                static_cast<std::size_t>(sheet.width) +
                                            static_cast<std::size_t>(placed.x + x));
                for (std::size_t c = 0; c < 3; ++c) {
                    sheet.rgb[to + c] = static_cast<std::uint8_t>(
                        codes.bytes[from + (codes.channels >= 3 ? c : 0)]);
                }
            }
        }
    }
    return sheet;
}

}  // namespace petrichor::cli
