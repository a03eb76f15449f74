#include "texproc/material/normal_channels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/filter/normal.h"

namespace petrichor::texproc {

Image lay_out_normals(Image normals, const PrefilterOptions& o, int channels)
{
    if (channels == 3 && o.normal_x == 0 && !o.rebuild_z) return normals;
    Image to(normals.width, normals.height, channels, ColorSpace::Data, 1.0f);
    const std::size_t step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; 3 * i < normals.pixels.size(); ++i) {
        const float* from = &normals.pixels[3 * i];
        float* texel = &to.pixels[step * i];
        if (channels >= 3) texel[2] = from[2];
        texel[o.normal_x] = from[0];
        texel[o.normal_y] = from[1];
    }
    return to;
}

Image read_out_normals(const Image& level, const PrefilterOptions& o, int number)
{
    // BC5 holds x and y whatever the layout of the map was.
    const bool rebuild_z = o.rebuild_z || (level.channels == 2 && o.normal_x == 0);
    const int needed = std::max({o.normal_x, o.normal_y, rebuild_z ? 0 : 2}) + 1;
    if (level.channels < needed) {
        throw Error("score: level " + std::to_string(number) + " of the normals has " +
                        std::to_string(level.channels) + " channels, " + std::to_string(needed) +
                        " are needed",
                    "Name a chain of normal maps laid out as --normal-layout says.");
    }
    Image to(level.width, level.height, 3, ColorSpace::Data);
    for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) {
            const float cx = level.at(x, y, o.normal_x), cy = level.at(x, y, o.normal_y);
            const float nx = 2.0f * cx - 1.0f, ny = 2.0f * cy - 1.0f;
            to.at(x, y, 0) = cx;
            to.at(x, y, 1) = cy;
            to.at(x, y, 2) = rebuild_z
                                 ? 0.5f + 0.5f * std::sqrt(std::max(0.0f, 1.0f - nx * nx - ny * ny))
                                 : level.at(x, y, 2);
        }
    }
    return to;
}

RawImage unit_normals(const RawImage& normal, PixelType type)
{
    Image xyz = to_image(normal, ColorSpace::Data);
    if (xyz.channels > 3) xyz = from_layout(xyz, NormalLayout::Rgb);
    renormalize(xyz, kUnitRounding);
    return to_raw(xyz, type);
}

bool drops_z(const std::string& format)
{
    if (format.empty()) return false;
    const TextureFormat known = texture_format(format);
    return known.block ? known.block == Block::Bc5 : known.channels == 2;
}

}  // namespace petrichor::texproc
