#include "film/scenes/weather_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "film/scenes/scene_file.h"
#include "formulas/weather/weather_maps.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

Image read_map(const char* key, const fs::path& file, bool grey)
{
    Image image = texproc::read_image(file, {.space = ColorSpace::Data});
    const std::string name = std::string("[render] ") + key + ": " + file.string() + " ";
    const bool power = std::has_single_bit(static_cast<unsigned>(std::max(image.width, 1)));
    if (image.width != image.height || !power || image.width < 16 || image.width > 4096) {
        throw Error(name + "is " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) +
                        "; it must be square, with a power of two from 16 to 4096 a side",
                    "`petrichor texture generate` writes such maps with --size.");
    }
    if (image.channels < 4 && !(grey && image.channels == 1)) {
        throw Error(name + "has " + std::to_string(image.channels) + " channels, not 4",
                    "Its layout is that of `petrichor texture generate`.");
    }
    return image;
}

std::byte code(float value)
{
    return static_cast<std::byte>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

template <class Texel>
gpu::WeatherMap map_of(int size, const Texel& texel)
{
    gpu::WeatherMap map;
    map.size = size;
    map.rgba.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec4 value = texel(x, y);
            for (int c = 0; c < 4; ++c) map.rgba.push_back(code(value[c]));
        }
    }
    return map;
}

}  // namespace

gpu::WeatherMaps read_weather_textures(const WeatherTextures& files, const fs::path& folder)
{
    gpu::WeatherMaps maps;
    if (!files.ripple.empty()) {
        const Image drops = read_map("ripple_texture", folder / files.ripple, false);
        maps.drops = map_of(drops.width, [&](int x, int y) {
            return glm::vec4(drops.at(x, y, 0), drops.at(x, y, 1), drops.at(x, y, 2),
                             drops.at(x, y, 3));
        });
    }
    if (files.snow_mask.empty() && files.snow_water_bump.empty()) return maps;
    Image mask;
    Image bump;
    if (!files.snow_mask.empty())
        mask = read_map("snow_mask_texture", folder / files.snow_mask, true);
    if (!files.snow_water_bump.empty())
        bump = read_map("snow_water_bump_texture", folder / files.snow_water_bump, false);
    const int size = std::max(mask.width, bump.width);
    if (mask.width != 0 && bump.width != 0 && mask.width != bump.width) {
        throw Error("[render] snow_mask_texture has " + std::to_string(mask.width) +
                        " texels a side, snow_water_bump_texture " + std::to_string(bump.width),
                    "Give both the same size: they are one map of the renderer.");
    }
    // Files hold normals with +y up the picture, the renderer's with +y along v.
    maps.snow = map_of(size, [&](int x, int y) {
        const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
        glm::vec4 texel = shared::snow_texel(uv, 1.0f / static_cast<float>(size));
        if (mask.width != 0) texel.z = mask.at(x, y, mask.channels == 1 ? 0 : 2);
        if (bump.width != 0) {
            texel.x = bump.at(x, y, 3);
            texel.y = 1.0f - bump.at(x, y, 1);
            texel.w = bump.at(x, y, 2);
        }
        return texel;
    });
    if (bump.width != 0) {
        maps.water = map_of(size, [&](int x, int y) {
            const glm::vec2 n(2.0f * bump.at(x, y, 3) - 1.0f, 1.0f - 2.0f * bump.at(x, y, 1));
            const float up = std::sqrt(std::max(1.0f - glm::dot(n, n), 0.0f));
            return glm::vec4(0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * up, 1.0f);
        });
    }
    return maps;
}

std::string weather_textures_fingerprint(const WeatherTextures& files, const fs::path& folder)
{
    if (files == WeatherTextures{}) return "";
    Hasher hasher;
    for (const std::string& file : {files.ripple, files.snow_mask, files.snow_water_bump}) {
        hasher.add(file.empty() ? std::string("drawn") : file_fingerprint(folder / file));
    }
    return hasher.text();
}

}  // namespace petrichor::film
