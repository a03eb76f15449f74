#include "tests/golden/stage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace petrichor::golden {
namespace {

int channels_of(gpu::TexelFormat format)
{
    switch (format) {
        case gpu::TexelFormat::R8Unorm:
            return 1;
        case gpu::TexelFormat::Rg8Unorm:
            return 2;
        default:
            return 4;
    }
}

std::vector<std::byte> texels(const std::vector<glm::vec4>& codes, gpu::TexelFormat format)
{
    std::vector<std::byte> bytes;
    for (const glm::vec4& code : codes) {
        for (int c = 0; c < channels_of(format); ++c) {
            if (format == gpu::TexelFormat::Rgba16Float) {
                const std::uint16_t half = glm::packHalf1x16(code[c]);
                std::byte pair[2];
                std::memcpy(pair, &half, 2);
                bytes.insert(bytes.end(), {pair[0], pair[1]});
            } else {
                const float level = std::clamp(code[c], 0.0f, 1.0f) * 255.0f;
                bytes.push_back(static_cast<std::byte>(std::lround(level)));
            }
        }
    }
    return bytes;
}

// Rounded stones with gaps between them; every second row is shifted by half a stone.
float stone_height(float u, float v, float stones)
{
    const float row = std::floor(v * stones);
    const float shift = std::fmod(row, 2.0f) * 0.5f;
    const float x = u * stones + shift;
    const float across = 2.0f * (x - std::floor(x)) - 1.0f;
    const float along = 2.0f * (v * stones - row) - 1.0f;
    const float x4 = across * across * across * across;
    const float y4 = along * along * along * along;
    return std::sqrt(std::max(0.0f, 1.0f - x4) * std::max(0.0f, 1.0f - y4));
}

}  // namespace

gpu::Texture make_texture(const std::string& name, gpu::TexelFormat format, int size,
                          const std::function<glm::vec4(float u, float v)>& texel)
{
    gpu::Texture texture;
    texture.name = name;
    texture.format = format;
    texture.width = size;
    texture.height = size;
    std::vector<glm::vec4> codes;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            codes.push_back(texel((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                                  (static_cast<float>(y) + 0.5f) / static_cast<float>(size)));
        }
    }
    texture.mips.push_back(texels(codes, format));
    for (int side = size / 2; side >= 1; side /= 2) {
        std::vector<glm::vec4> smaller;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const auto at = [&](int dx, int dy) {
                    return codes[static_cast<std::size_t>((2 * y + dy) * 2 * side + 2 * x + dx)];
                };
                smaller.push_back(0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)));
            }
        }
        codes = std::move(smaller);
        texture.mips.push_back(texels(codes, format));
    }
    return texture;
}

gpu::Texture chequers(const glm::vec3& a, const glm::vec3& b, int squares)
{
    return make_texture("chequers", gpu::TexelFormat::Rgba8Srgb, 64, [=](float u, float v) {
        const auto cell = [squares](float t) {
            return static_cast<int>(t * static_cast<float>(squares));
        };
        return glm::vec4((cell(u) + cell(v)) % 2 == 0 ? a : b, 1.0f);
    });
}

gpu::Texture stone_heights(int stones)
{
    return make_texture("heights", gpu::TexelFormat::R8Unorm, 64, [=](float u, float v) {
        return glm::vec4(stone_height(u, v, static_cast<float>(stones)));
    });
}

gpu::Texture stone_normals(int stones, float steepness)
{
    return make_texture("normals", gpu::TexelFormat::Rg8Unorm, 64, [=](float u, float v) {
        constexpr float kStep = 1.0f / 256.0f;
        const auto n = static_cast<float>(stones);
        const float du = stone_height(u + kStep, v, n) - stone_height(u - kStep, v, n);
        const float dv = stone_height(u, v + kStep, n) - stone_height(u, v - kStep, n);
        // v runs down the picture, +y of a normal map up.
        const glm::vec3 normal =
            glm::normalize(glm::vec3(-du * steepness, dv * steepness, 2.0f * kStep * n));
        return glm::vec4(0.5f * normal.x + 0.5f, 0.5f * normal.y + 0.5f, 0.0f, 0.0f);
    });
}

gpu::Texture blot()
{
    return make_texture("blot", gpu::TexelFormat::R8Unorm, 64, [](float u, float v) {
        const float r = glm::length(glm::vec2(u - 0.5f, v - 0.5f));
        return glm::vec4(1.0f - glm::smoothstep(0.25f, 0.42f, r));
    });
}

gpu::Primitive box(const glm::vec3& low, const glm::vec3& high, std::uint32_t material)
{
    const glm::vec3 x(high.x - low.x, 0, 0);
    const glm::vec3 y(0, high.y - low.y, 0);
    const glm::vec3 z(0, 0, high.z - low.z);
    const gpu::Primitive faces[] = {
        gpu::quad(low + z, x, y, material),      gpu::quad(low + x, -x, y, material),
        gpu::quad(low + x + z, -z, y, material), gpu::quad(low, z, y, material),
        gpu::quad(low + y + z, x, -z, material), gpu::quad(low, x, z, material)};
    gpu::Primitive all;
    all.material = material;
    for (const gpu::Primitive& face : faces) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t i = 0; i < 4; ++i) {
            all.positions.push_back(face.positions[i]);
            all.normals.push_back(face.normals[i]);
            all.tangents.push_back(face.tangents[i]);
            all.uv0.push_back(face.uv0[i]);
        }
        for (const std::uint32_t i : face.indices) all.indices.push_back(first + i);
    }
    return all;
}

gpu::Primitive sphere(const glm::vec3& centre, float radius_m, std::uint32_t material)
{
    constexpr int kColumns = 48;
    constexpr int kRows = 24;
    constexpr float kPi = 3.14159265f;
    gpu::Primitive p;
    p.material = material;
    for (int j = 0; j <= kRows; ++j) {
        for (int i = 0; i <= kColumns; ++i) {
            const float u = static_cast<float>(i) / kColumns;
            const float v = static_cast<float>(j) / kRows;
            const float theta = kPi * v;
            const float phi = 2.0f * kPi * u;
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta),
                              std::sin(theta) * std::cos(phi));
            p.positions.push_back(centre + radius_m * n);
            p.normals.push_back(n);
            p.tangents.emplace_back(std::cos(phi), 0.0f, -std::sin(phi), 1.0f);
            p.uv0.emplace_back(u, v);
        }
    }
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (kColumns + 1) + i);
            const std::uint32_t b = a + kColumns + 1;
            p.indices.insert(p.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    return p;
}

gpu::Primitive scaled_uv(gpu::Primitive primitive, float repeats)
{
    for (glm::vec2& uv : primitive.uv0) uv *= repeats;
    return primitive;
}

gpu::Primitive ground(float half_m, std::uint32_t material, float repeats)
{
    return scaled_uv(
        gpu::quad({-half_m, 0, half_m}, {2 * half_m, 0, 0}, {0, 0, -2 * half_m}, material),
        repeats);
}

std::uint32_t Shot::add(const gpu::Material& material)
{
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

gpu::TextureUse Shot::add(gpu::Texture texture)
{
    // Only the pixels are read: scene.textures, the encoded images, stay empty.
    textures.push_back(std::move(texture));
    gpu::TextureUse use;
    use.texture = static_cast<gpu::TextureIndex>(textures.size() - 1);
    return use;
}

void Shot::add(gpu::Primitive primitive, const glm::mat4& to_world)
{
    const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({"mesh", {std::move(primitive)}});
    scene.instances.push_back({"instance", mesh, to_world});
}

Shot plain_day(const gpu::Camera& camera)
{
    Shot shot;
    gpu::Frame& frame = shot.frame;
    frame.camera = camera;
    frame.settings.width = 128;
    frame.settings.height = 72;
    frame.settings.samples = 2;
    frame.sky.sun_elevation_rad = 0.7f;
    frame.sky.sun_azimuth_rad = 2.4f;
    return shot;
}

}  // namespace petrichor::golden
