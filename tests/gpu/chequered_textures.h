// Textures for materials that use every slot.
#ifndef PETRICHOR_TESTS_GPU_CHEQUERED_TEXTURES_H
#define PETRICHOR_TESTS_GPU_CHEQUERED_TEXTURES_H

#include <array>

#include "scene/material_table.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {

inline Texture chequers(const char* name, TexelFormat format, std::array<int, 4> low,
                 std::array<int, 4> high)
{
    Texture texture;
    texture.name = name;
    texture.format = format;
    texture.width = texture.height = 8;
    texture.mips.emplace_back();
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            const auto& texel = (x / 2 + y / 2) % 2 == 0 ? low : high;
            for (const int byte : texel) texture.mips[0].push_back(static_cast<std::byte>(byte));
        }
    }
    if (texture.name != "height_texture" && texture.name != "normal_texture") return texture;
    for (int side = 4; side > 0; side /= 2) {
        texture.mips.emplace_back();
        for (int i = 0; i < side * side; ++i) {
            for (std::size_t c = 0; c < 4; ++c)
                texture.mips.back().push_back(static_cast<std::byte>((low[c] + high[c]) / 2));
        }
    }
    return texture;
}

// One texture a slot, in the order of scene::material_textures(). Every channel of the weather's
// masks says something else.
inline std::vector<Texture> chequered_textures()
{
    std::vector<Texture> all;
    for (const scene::MaterialTexture& row : scene::material_textures()) {
        const std::string name(row.name);
        const bool color = name.find("base_color") != name.npos || name.starts_with("emissive") ||
                           name.find("_color_texture") != name.npos ||
                           name == "specular_glossiness_texture";
        const bool normal = name.find("normal_") != name.npos;
        all.push_back(
            chequers(row.name.data(), color ? TexelFormat::Rgba8Srgb : TexelFormat::Rgba8Unorm,
                     normal ? std::array{90, 128, 250, 255} : std::array{120, 60, 200, 90},
                     normal ? std::array{150, 170, 250, 255} : std::array{200, 140, 80, 255}));
    }
    return all;
}

// Texture t of the scene: white stands in for the encoded bytes, which the renderer never reads.
inline scene::TextureUse use_of(std::string_view name)
{
    scene::TextureUse use;
    const auto& rows = scene::material_textures();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].name == name) use.texture = static_cast<int>(i);
    }
    use.scale = glm::vec2(2.0f);
    return use;
}

}  // namespace petrichor::gpu

#endif
