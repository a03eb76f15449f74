#ifndef PETRICHOR_BASE_IMAGE_H
#define PETRICHOR_BASE_IMAGE_H

#include <cstddef>
#include <vector>

namespace petrichor {

/// What the numbers of an image mean; decides how they are filtered and how they are stored.
enum class ColorSpace {
    Linear,  ///< linear Rec.709 colour, scene-referred
    Data,    ///< not colour: normals, heights, roughness, masks; never gamma-encoded
};

/// Pixels in flight: float, interleaved, row 0 at the top, any number of channels.
///
/// Invariant: pixels.size() == width * height * channels. Alpha is never premultiplied.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    ColorSpace space = ColorSpace::Data;
    std::vector<float> pixels;

    Image() = default;
    Image(int w, int h, int c, ColorSpace s, float fill = 0.0f)
        : width(w),
          height(h),
          channels(c),
          space(s),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) *
                     static_cast<std::size_t>(c),
                 fill)
    {
    }

    std::size_t index(int x, int y, int c) const
    {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(c);
    }
    float& at(int x, int y, int c) { return pixels[index(x, y, c)]; }
    float at(int x, int y, int c) const { return pixels[index(x, y, c)]; }
    bool empty() const { return pixels.empty(); }
};

}  // namespace petrichor

#endif
