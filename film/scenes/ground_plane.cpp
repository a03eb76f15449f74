#include "film/scenes/ground_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "formulas/color/srgb.h"
#include "formulas/noise/noise.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kCells = 64;         // a side, of the look from above
constexpr double kFilled = 0.8;    // of them, of a scene with ground
constexpr int kGrain = 512;        // texels a side
constexpr int kStones = 110;       // across a tile
constexpr float kTile_m = 2.4f;
constexpr float kAlbedo = 0.27f;
constexpr int kSegments = 96;

float grain(vec2 uv)
{
    return shared::tileable_fbm(uv, kStones, 2, 401u);
}

float stains(vec2 uv)
{
    return shared::tileable_fbm(uv, 7, 4, 411u);
}

// Marks the cells that a triangle covers when seen from above.
void mark(std::vector<bool>& cells, const std::array<vec2, 3>& t)
{
    const vec2 low = glm::min(glm::min(t[0], t[1]), t[2]);
    const vec2 high = glm::max(glm::max(t[0], t[1]), t[2]);
    const auto clamped = [](float v) {
        return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(kCells - 1)));
    };
    const auto cross = [](vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; };
    for (int z = clamped(low.y); z <= clamped(high.y); ++z) {
        for (int x = clamped(low.x); x <= clamped(high.x); ++x) {
            const vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f);
            const float a = cross(t[1] - t[0], p - t[0]);
            const float b = cross(t[2] - t[1], p - t[1]);
            const float c = cross(t[0] - t[2], p - t[2]);
            if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
                cells[static_cast<std::size_t>(z * kCells + x)] = true;
        }
    }
    // Triangles smaller than a cell may miss all centres.
    const vec2 middle = (t[0] + t[1] + t[2]) / 3.0f;
    cells[static_cast<std::size_t>(clamped(middle.y) * kCells + clamped(middle.x))] = true;
}

scene::EncodedImage image_of(const char* name, const std::vector<std::uint8_t>& rgb)
{
    scene::EncodedImage image;
    image.name = name;
    image.bytes = texproc::encode_png8(kGrain, kGrain, 3, rgb);
    return image;
}

std::uint8_t byte_of(float value)
{
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

void add_grain(scene::Scene& scene, scene::Material& material)
{
    std::vector<float> height(static_cast<std::size_t>(kGrain * kGrain));
    const auto at = [&](int x, int y) -> float& {
        const auto index = [](int i) { return static_cast<std::size_t>((i + kGrain) % kGrain); };
        return height[index(y) * kGrain + index(x)];
    };
    for (int y = 0; y < kGrain; ++y) {
        for (int x = 0; x < kGrain; ++x) {
            at(x, y) = grain((vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) /
                             static_cast<float>(kGrain));
        }
    }
    std::vector<std::uint8_t> color;
    std::vector<std::uint8_t> normal;
    for (int y = 0; y < kGrain; ++y) {
        for (int x = 0; x < kGrain; ++x) {
            const vec2 uv(static_cast<float>(x) / kGrain, static_cast<float>(y) / kGrain);
            const float albedo = kAlbedo * (0.55f + 0.5f * at(x, y) + 0.4f * stains(uv));
            const vec3 tint(1.0f, 0.975f, 0.94f);
            for (int c = 0; c < 3; ++c)
                color.push_back(byte_of(shared::srgb_from_linear(albedo * tint[c])));
            const float steep = 0.8f;
            const vec3 n = glm::normalize(vec3(steep * (at(x - 1, y) - at(x + 1, y)) * 0.5f,
                                               steep * (at(x, y + 1) - at(x, y - 1)) * 0.5f, 1.0f));
            for (int c = 0; c < 3; ++c) normal.push_back(byte_of(0.5f + 0.5f * n[c]));
        }
    }
    material.base_color_texture.texture = static_cast<scene::TextureIndex>(scene.textures.size());
    scene.textures.push_back(image_of("grain of the ground", color));
    material.normal_texture.texture = static_cast<scene::TextureIndex>(scene.textures.size());
    scene.textures.push_back(image_of("relief of the ground", normal));
}

}  // namespace

bool brings_ground(const scene::Scene& scene, const scene::Bounds& content)
{
    const vec3 size = content.high - content.low;
    const float width = std::max(size.x, size.z);
    if (!(width > 0.0f) || size.y > 0.5f * width) return false;
    std::vector<bool> cells(static_cast<std::size_t>(kCells * kCells), false);
    const vec2 low(content.low.x, content.low.z);
    const vec2 scale = static_cast<float>(kCells) /
                       glm::max(vec2(size.x, size.z), vec2(1e-6f * width));
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            std::vector<vec3> world;
            world.reserve(primitive.positions.size());
            for (const vec3& p : primitive.positions)
                world.emplace_back(instance.to_world * glm::vec4(p, 1.0f));
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                const vec3& a = world[primitive.indices[i]];
                const vec3& b = world[primitive.indices[i + 1]];
                const vec3& c = world[primitive.indices[i + 2]];
                const vec3 face = glm::cross(b - a, c - a);
                // Either way up: what winding says is often wrong.
                if (!(std::abs(face.y) > 0.6f * glm::length(face))) continue;
                const auto cell = [&](const vec3& p) { return (vec2(p.x, p.z) - low) * scale; };
                const std::array<vec2, 3> t{cell(a), cell(b), cell(c)};
                const auto outside = [&](int k) {
                    return (t[0][k] < 0 && t[1][k] < 0 && t[2][k] < 0) ||
                           (t[0][k] > kCells && t[1][k] > kCells && t[2][k] > kCells);
                };
                if (!outside(0) && !outside(1)) mark(cells, t);
            }
        }
    }
    const auto filled = std::count(cells.begin(), cells.end(), true);
    return static_cast<double>(filled) >= kFilled * static_cast<double>(cells.size());
}

void add_ground(scene::Scene& scene, const scene::Bounds& content)
{
    const vec3 size = content.high - content.low;
    const float around = std::max(0.5f * glm::length(size), 1e-3f);
    const vec3 centre(0.5f * (content.low.x + content.high.x),
                      content.low.y - 0.0005f * around,
                      0.5f * (content.low.z + content.high.z));
    scene::Material material;
    material.name = "default ground";
    material.metallic = 0.0f;
    material.roughness = 0.9f;
    material.weather.beads = 0.0f;
    add_grain(scene, material);

    scene::Primitive disc;
    disc.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    const auto add = [&](const vec2& offset) {
        disc.positions.push_back(centre + vec3(offset.x, 0.0f, offset.y));
        disc.normals.emplace_back(0.0f, 1.0f, 0.0f);
        disc.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        // v runs towards +z below: the bitangent of +x and +y up is -z.
        disc.uv0.push_back(vec2(offset.x, offset.y) / kTile_m);
    };
    add(vec2(0.0f));
    const float rings[] = {0.5f, 1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 40.0f, 100.0f, 300.0f};
    for (const float ring : rings) {
        for (int s = 0; s < kSegments; ++s) {
            const float angle = 6.2831853f * static_cast<float>(s) / kSegments;
            add(ring * around * vec2(std::cos(angle), std::sin(angle)));
        }
    }
    const auto at = [](std::size_t ring, int s) {
        return static_cast<std::uint32_t>(1 + ring * kSegments +
                                          static_cast<std::size_t>(s % kSegments));
    };
    for (int s = 0; s < kSegments; ++s) {
        disc.indices.insert(disc.indices.end(), {0u, at(0, s + 1), at(0, s)});
        for (std::size_t ring = 0; ring + 1 < std::size(rings); ++ring) {
            disc.indices.insert(disc.indices.end(),
                                {at(ring, s), at(ring, s + 1), at(ring + 1, s),
                                 at(ring, s + 1), at(ring + 1, s + 1), at(ring + 1, s)});
        }
    }
    scene::Instance instance;
    instance.name = "default ground";
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.backdrop = true;
    scene.meshes.push_back({"default ground", {std::move(disc)}});
    scene.instances.push_back(std::move(instance));
}

}  // namespace petrichor::film
