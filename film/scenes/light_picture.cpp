#include "film/scenes/light_picture.h"

#include <string>

#include "base/error.h"
#include "base/portable_math.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr float kGamma = 2.2f;
constexpr float kRgbmRange = 34.493242f;  // 5^2.2
constexpr float kDldrRange = 4.5947934f;  // 2^2.2

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what,
                         const std::string& fix)
{
    throw Error("environment: " + file.string() + " " + what, fix);
}

}  // namespace

gpu::EnvironmentMap read_light_picture(const std::filesystem::path& file, LightCode code)
{
    const texproc::RawImage raw = texproc::read_raw(file);
    const bool whole =
        raw.type == texproc::PixelType::U8 || raw.type == texproc::PixelType::U16;
    if (code == LightCode::Float && whole)
        refuse(file, "holds whole numbers, not float",
               "Give an .exr or .hdr, or say how it is coded: \"rgbm\", \"dldr\" or \"auto\".");
    if ((code == LightCode::Rgbm || code == LightCode::Dldr) && !whole)
        refuse(file, "holds float numbers, which need no decoding", "Say \"auto\" or \"float\".");
    if (code == LightCode::Rgbm && raw.channels != 4)
        refuse(file, "has no alpha, which RGBM keeps its multiplier in",
               "Save it with alpha, or say \"dldr\" or \"auto\".");
    const Image image = texproc::to_image(raw, ColorSpace::Linear);
    if (image.width != 2 * image.height) {
        refuse(file,
               "is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                   ", not twice as wide as high",
               "Use a lat-long (equirectangular) picture.");
    }
    gpu::EnvironmentMap map;
    map.width = image.width;
    map.height = image.height;
    map.rgb.reserve(image.pixels.size() / static_cast<std::size_t>(image.channels) * 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float scale = code == LightCode::Dldr ? kDldrRange : 1.0f;
            if (code == LightCode::Rgbm) {
                const float alpha = image.at(x, y, 3);
                scale = alpha > 0.0f ? kRgbmRange * portable_pow(alpha, kGamma) : 0.0f;
            }
            for (int c = 0; c < 3; ++c)
                map.rgb.push_back(scale * image.at(x, y, image.channels >= 3 ? c : 0));
        }
    }
    return map;
}

}  // namespace petrichor::film
