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
#include "texproc/generate/generate.h"

namespace petrichor::film {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kCells = 64;         // a side, of the look from above
constexpr double kFilled = 0.8;    // of them, of a scene with ground
constexpr int kTexels = 1024;      // a side, of the asphalt
constexpr int kSegments = 128;
constexpr float kNextRing = 1.09f;  // the radius of a ring of vertices over that of the one inside
constexpr float kInnerRing = 0.06f, kFineRings = 40.0f, kOutermostRing = 300.0f;  // times the scene's size
const vec3 kColor(0.222f, 0.224f, 0.226f);

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

scene::TextureIndex add_texture(scene::Scene& scene, const char* name, const Image& image)
{
    std::vector<std::uint8_t> bytes(image.pixels.size());
    const bool color = image.space == ColorSpace::Linear;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        const float v = std::clamp(image.pixels[k], 0.0f, 1.0f);
        bytes[k] = static_cast<std::uint8_t>(
            std::lround(255.0f * (color ? shared::srgb_from_linear(v) : v)));
    }
    scene.textures.push_back(
        {.name = name,
         .bytes = texproc::encode_png8(image.width, image.height, image.channels, bytes)});
    return static_cast<scene::TextureIndex>(scene.textures.size() - 1);
}

// Occlusion, roughness and metallic in one picture, as glTF reads them.
Image packed(const texproc::MaterialMaps& maps)
{
    Image image(maps.roughness.width, maps.roughness.height, 3, ColorSpace::Data);
    for (std::size_t k = 0; k < maps.roughness.pixels.size(); ++k) {
        image.pixels[3 * k] = maps.occlusion.pixels[k];
        image.pixels[3 * k + 1] = maps.roughness.pixels[k];
    }
    return image;
}

// Mean of a square of 2 * half + 1 texels around each, over the edges of the tile.
std::vector<float> blurred(const std::vector<float>& pixels, int size, int channels, int half)
{
    const auto at = [&](int i) { return (i % size + size) % size; };
    const float share = 1.0f / static_cast<float>(2 * half + 1);
    std::vector<float> from = pixels, to(pixels.size());
    for (const bool down : {false, true}) {
        const auto texel = [&](int line, int i, int c) -> std::size_t {
            const int x = down ? line : at(i), y = down ? at(i) : line;
            return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(x)) * static_cast<std::size_t>(channels) +
                   static_cast<std::size_t>(c);
        };
        for (int line = 0; line < size; ++line) {
            for (int c = 0; c < channels; ++c) {
                double sum = 0.0;
                for (int i = -half; i <= half; ++i) sum += static_cast<double>(from[texel(line, i, c)]);
                for (int i = 0; i < size; ++i) {
                    to[texel(line, i, c)] = static_cast<float>(sum) * share;
                    sum += static_cast<double>(from[texel(line, i + half + 1, c)]) -
                           static_cast<double>(from[texel(line, i - half, c)]);
                }
            }
        }
        std::swap(from, to);
    }
    return from;
}

// Takes out what is wider than an eighth of the tile: where the tile is small in the picture that would be
// a lattice.
void level(Image& image)
{
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::vector<float> wide =
        blurred(blurred(image.pixels, image.width, image.channels, image.width / 16), image.width,
                image.channels, image.width / 16);
    std::vector<double> mean(channels);
    for (std::size_t k = 0; k < wide.size(); ++k)
        mean[k % channels] += static_cast<double>(wide[k]) *
                              (static_cast<double>(channels) / static_cast<double>(wide.size()));
    for (std::size_t k = 0; k < wide.size(); ++k)
        image.pixels[k] *= static_cast<float>(mean[k % channels]) / std::max(wide[k], 1e-4f);
}

// Asphalt of some years, bleached: grey enough to show what stands on it and its shadow. Returns the
// edge of its square.
float lay_asphalt(scene::Scene& scene, scene::Material& material)
{
    texproc::MaterialRecipe recipe;
    recipe.kind = texproc::MaterialKind::Asphalt;
    recipe.size = kTexels;
    recipe.seed = 11;
    recipe.values = {{"tile_m", 1.6f}, {"stone_m", 0.009f}, {"wear", 0.7f}, {"cracks", 0.0f},
                     {"stains", 0.0f}};
    recipe.color = kColor;
    texproc::MaterialMaps maps = texproc::generate_material(recipe);
    level(maps.albedo);
    level(maps.roughness);
    material.base_color_texture.texture = add_texture(scene, "colour of the ground", maps.albedo);
    material.normal_texture.texture = add_texture(scene, "relief of the ground", maps.normal);
    material.metallic_roughness_texture.texture =
        add_texture(scene, "gloss of the ground", packed(maps));
    material.occlusion_texture.texture = material.metallic_roughness_texture.texture;
    return maps.tile_m;
}

// Where on the square of asphalt a point lies: shifted by up to two squares from place to place, so that no
// lattice of squares is seen. No stretch is above one part in six.
vec2 place_on_square(const vec2& at, float tile_m)
{
    const auto shift = [&](std::uint32_t salt) {
        return 2.0f * shared::tileable_noise(at / (24.0f * tile_m) + 11.3f, 1024, salt);
    };
    return at / tile_m + vec2(shift(521), shift(522));
}

// Stains of all sizes that vertices can carry: on ground of one grain a wide view would be flat.
float stains(const vec2& at, float around)
{
    const float between = (kNextRing - 1.0f) * glm::length(at);
    float tone = 1.0f;
    float wide = 0.15f * around;
    for (std::uint32_t octave = 0; octave < 9; ++octave, wide *= 2.0f) {
        const float shows = glm::smoothstep(2.0f * between, 5.0f * between, wide);
        const float noise = shared::tileable_noise(at / wide + 37.7f, 1024, 401u + octave);
        tone += 0.16f * shows * (noise - 0.5f);
    }
    return std::clamp(tone, 0.6f, 1.4f);
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
    material.weather.beads = 0.0f;
    const float tile_m = lay_asphalt(scene, material);

    scene::Primitive disc;
    disc.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    const auto add = [&](const vec2& offset) {
        disc.positions.push_back(centre + vec3(offset.x, 0.0f, offset.y));
        disc.normals.emplace_back(0.0f, 1.0f, 0.0f);
        disc.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        // v runs towards +z below: the bitangent of +x and +y up is -z.
        disc.uv0.push_back(place_on_square(offset, tile_m));
        disc.colors.emplace_back(vec3(stains(offset, around)), 1.0f);
    };
    add(vec2(0.0f));
    std::vector<float> rings;
    for (float ring = kInnerRing; ring < kFineRings; ring *= kNextRing) rings.push_back(ring);
    rings.insert(rings.end(), {kFineRings, 100.0f, kOutermostRing});
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
