#include "texproc/prefilter/detail/input.h"

#include "base/error.h"

namespace petrichor::texproc::detail {

ImageRef ref(const Image& image)
{
    return {image.width, image.height, image.channels, PixelType::F32,
            reinterpret_cast<const std::byte*>(image.pixels.data())};
}

ImageRef ref(const RawImage& image)
{
    return {image.width, image.height, image.channels, image.type, image.bytes.data()};
}

namespace {

std::string size_text(const ImageRef& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

}  // namespace

MapSurface make_surface(const ImageRef& normal, const ImageRef& rough,
                        const PrefilterOptions& options)
{
    if (normal.width < 1 || normal.height < 1 || rough.width < 1 || rough.height < 1) {
        throw Error("prefilter: an input is empty", "Pass a normal map and a roughness map.");
    }
    if (normal.width != rough.width || normal.height != rough.height) {
        throw Error("prefilter: the normal map is " + size_text(normal) + ", the roughness map " +
                        size_text(rough),
                    "Resample one of them: both must have the same size.");
    }
    const int needed =
        std::max({options.normal_x, options.normal_y, options.rebuild_z ? 0 : 2}) + 1;
    if (normal.channels < needed) {
        throw Error("prefilter: the normal map has " + std::to_string(normal.channels) +
                        " channels, " + std::to_string(needed) + " are needed",
                    "Give a three-channel normal map, or name the layout of a two-channel one "
                    "(--normal-layout rg).");
    }
    if (options.channel < 0 || rough.channels <= options.channel) {
        throw Error("prefilter: the roughness map has " + std::to_string(rough.channels) +
                        " channels, channel " + std::to_string(options.channel) + " is needed",
                    "Choose the channel that holds it.");
    }
    MapSurface s;
    s.width = normal.width;
    s.height = normal.height;
    s.x = {normal.data, normal.type, normal.channels, options.normal_x};
    s.y = {normal.data, normal.type, normal.channels, options.normal_y};
    if (!options.rebuild_z) s.z = {normal.data, normal.type, normal.channels, 2};
    s.rough = {rough.data, rough.type, rough.channels, options.channel};
    s.smoothness = options.smoothness;
    s.alpha = options.alpha;
    s.green_down = options.green_down;
    const std::size_t texels =
        static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
    for (const MapPlane& plane : {s.x, s.y, s.z, s.rough}) {
        if (all_finite(plane, texels)) continue;
        throw Error("prefilter: an input holds values that are not numbers",
                    "Repair the NaN or infinite pixels first.");
    }
    return s;
}

}  // namespace petrichor::texproc::detail
