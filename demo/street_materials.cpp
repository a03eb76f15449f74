#include "demo/street_materials.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "formulas/color/srgb.h"
#include "texproc/codecs/files/io.h"
#include "texproc/generate/generate.h"
#include "texproc/generate/noise.h"

namespace petrichor::demo {

namespace {

using texproc::MaterialKind;
using texproc::MaterialMaps;

// Linear 0..1 to sRGB bytes through a table: exact to the byte, and millions of times.
std::vector<std::uint8_t> srgb_table()
{
    std::vector<std::uint8_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float code = shared::srgb_from_linear(static_cast<float>(i) / 65535.0f);
        table[i] = static_cast<std::uint8_t>(std::lround(255.0f * code));
    }
    return table;
}

std::uint8_t to_byte(float x)
{
    return static_cast<std::uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f);
}

std::vector<std::byte> encode_data(const Image& image)
{
    std::vector<std::uint8_t> bytes(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), bytes.begin(), to_byte);
    return texproc::encode_png8(image.width, image.height, image.channels, bytes);
}

std::vector<std::byte> encode_color(const Image& image, const std::vector<std::uint8_t>& table)
{
    std::vector<std::uint8_t> bytes(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), bytes.begin(), [&](float x) {
        return table[static_cast<std::size_t>(std::clamp(x, 0.0f, 1.0f) * 65535.0f + 0.5f)];
    });
    return texproc::encode_png8(image.width, image.height, image.channels, bytes);
}

// A multiple of `step`: noise below what can be seen costs a third of a PNG.
std::uint8_t to_step(float x, int step)
{
    const int steps = 255 / step;
    const int k = static_cast<int>(std::clamp(x, 0.0f, 1.0f) * static_cast<float>(steps) + 0.5f);
    return static_cast<std::uint8_t>((510 * k + steps) / (2 * steps));
}

// The third component of a unit normal follows from the others; it is kept in coarser steps.
std::vector<std::byte> encode_normal(const Image& image)
{
    std::vector<std::uint8_t> bytes(image.pixels.size());
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        bytes[k] = k % 3 == 2 ? to_step(image.pixels[k], 3) : to_byte(image.pixels[k]);
    }
    return texproc::encode_png8(image.width, image.height, image.channels, bytes);
}

// Occlusion, roughness and metallic in one picture, as glTF reads them.
std::vector<std::byte> encode_orm(const MaterialMaps& maps)
{
    const std::size_t count = maps.roughness.pixels.size();
    std::vector<std::uint8_t> bytes(3 * count);
    for (std::size_t k = 0; k < count; ++k) {
        bytes[3 * k] = to_step(maps.occlusion.pixels[k], 5);
        bytes[3 * k + 1] = to_step(maps.roughness.pixels[k], 3);
        bytes[3 * k + 2] = to_byte(maps.metallic.pixels[k]);
    }
    return texproc::encode_png8(maps.roughness.width, maps.roughness.height, 3, bytes);
}

// Share of a rectangle of half sizes around a middle, soft by half a texel or two.
float within(const glm::vec2& at, const glm::vec2& middle, const glm::vec2& half)
{
    const glm::vec2 out = glm::abs(at - middle) - half;
    return texproc::smooth_step(0.006f, -0.006f, std::max(out.x, out.y));
}

// The room behind a window, from 0 to 1 over it: a lamp hangs before the far wall, on which is a picture; a chair, a dresser.
glm::vec3 room_light(const glm::vec2& at, std::uint32_t seed)
{
    const glm::vec2 lamp(0.42f, 0.30f);
    const glm::vec2 off = at - lamp;
    float wall = 0.05f + 0.40f * std::exp(-9.0f * glm::dot(off, off));
    wall *= 1.0f + 0.05f * texproc::gradient_noise(6.0f * at.x, 6.0f * at.y, 6, 6, seed);
    if (at.y < 0.13f) wall *= 0.62f;  // the ceiling
    glm::vec3 color = wall * glm::vec3(1.0f, 0.60f, 0.26f);
    color *= 1.0f - 0.45f * texproc::smooth_step(0.66f, 0.67f, at.y) * glm::vec3(0.90f, 1.05f, 1.15f);  // panels below
    const glm::vec2 picture(0.64f, 0.40f);
    color *= 1.0f - 0.75f * within(at, picture, {0.065f, 0.085f});
    color = glm::mix(color, wall * glm::vec3(0.42f, 0.34f, 0.20f), within(at, picture, {0.050f, 0.070f}));
    color *= 1.0f - 0.78f * within(at, {0.60f, 0.86f}, {0.17f, 0.17f});
    const float chair = std::max({within(at, {0.31f, 0.80f}, {0.008f, 0.20f}), within(at, {0.41f, 0.80f}, {0.008f, 0.20f}),
                                  within(at, {0.36f, 0.66f}, {0.050f, 0.020f}), within(at, {0.36f, 0.76f}, {0.050f, 0.012f})});
    color *= 1.0f - 0.85f * chair;
    color *= 1.0f - 0.70f * within(at, {lamp.x, 0.12f}, {0.002f, 0.12f});
    const float down = (off.y + 0.07f) / 0.12f;  // along the shade
    if (down >= 0.0f && down <= 1.0f) {
        const float shade = texproc::smooth_step(0.004f, -0.004f, std::abs(off.x) - 0.025f - 0.065f * down);
        color = glm::mix(color, (0.75f + 0.25f * down) * glm::vec3(1.0f, 0.66f, 0.32f), shade);
    }
    const float bulb = std::hypot(off.x, 1.6f * (off.y - 0.055f)) - 0.03f;
    return glm::mix(color, glm::vec3(1.0f, 0.80f, 0.50f), texproc::smooth_step(0.006f, -0.006f, bulb));
}

// What shines out of a window at dusk, u and v from 0 to 1 over it: a warm room, curtains drawn to the sides, a few pots on
// the sill.
std::vector<std::byte> encode_window_light(std::uint32_t seed,
                                           const std::vector<std::uint8_t>& table)
{
    constexpr int kSize = 256;
    Image image(kSize, kSize, 3, ColorSpace::Linear);
    for (int j = 0; j < kSize; ++j) {
        for (int i = 0; i < kSize; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / kSize;
            const float v = (static_cast<float>(j) + 0.5f) / kSize;
            glm::vec3 color = room_light({u, v}, seed);
            const float hem = 0.20f + 0.05f * std::sin(2.6f * v) - 0.07f * (1.0f - v) * (1.0f - v);
            const float from_side = std::min(u, 1.0f - u);
            const float curtain = texproc::smooth_step(hem + 0.012f, hem - 0.012f, from_side);
            const float fold = 0.62f + 0.38f * std::sin(150.0f * from_side + 5.0f * v);
            // Cloth is lit from behind by all of the room.
            const glm::vec2 off(u - 0.42f, v - 0.30f);
            const float behind = 0.10f + 0.50f * std::exp(-5.0f * (off.x * off.x + 0.8f * off.y * off.y));
            color = glm::mix(color, behind * fold * glm::vec3(0.62f, 0.252f, 0.078f), curtain);
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t h = texproc::hash_cell(k, 3, seed);
                const float at =
                    0.28f + 0.15f * static_cast<float>(k) + 0.04f * texproc::hash_signed(h, 1);
                const float tall = 0.10f + 0.10f * texproc::hash_unit(h, 2);
                const float wide = 0.025f + 0.02f * texproc::hash_unit(h, 3);
                const float body =
                    std::abs(u - at) / wide + std::max(0.0f, (1.0f - v) - tall) / 0.03f;
                color *= 0.18f + 0.82f * texproc::smooth_step(0.85f, 1.1f, body);
            }
            for (int c = 0; c < 3; ++c) image.at(i, j, c) = color[c];
        }
    }
    return encode_color(image, table);
}

struct Source {
    MaterialKind kind;
    std::string name;
    bool height;        ///< the height map goes into the file: water and snow settle in this relief
    float size = 1.0f;  ///< times DemoOptions::texture_size
};

const std::vector<Source>& sources()
{
    static const std::vector<Source> list = {
        {MaterialKind::Cobble, "cobble", true, 2.0f}, {MaterialKind::Brick, "brick", true},
        {MaterialKind::Paving, "paving", true},       {MaterialKind::RoofTile, "roof_tile", true},
        {MaterialKind::Plank, "plank", true},         {MaterialKind::Plaster, "plaster", false},
        {MaterialKind::Granite, "granite", true},     {MaterialKind::MetalPlate, "zinc", false},
        {MaterialKind::PaintedIron, "iron", false},   {MaterialKind::StandingSeam, "seam", true},
        {MaterialKind::GrassGround, "grass", true},
    };
    return list;
}

struct Baked {
    std::vector<std::byte> albedo, normal, orm, height;
    float tile_m = 1.0f;
    float height_scale_m = 0.0f;
};

std::vector<Baked> bake(const DemoOptions& options, Kit& kit)
{
    std::vector<Baked> baked(sources().size());
    const std::vector<std::uint8_t> table = srgb_table();
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex guard;
    const auto work = [&] {
        for (std::size_t k = next++; k < baked.size(); k = next++) {
            try {
                const bool cobble = sources()[k].kind == MaterialKind::Cobble;
                const int size = std::max(
                    16,
                    static_cast<int>(sources()[k].size * static_cast<float>(options.texture_size)));
                MaterialMaps maps =
                    texproc::generate_material(sources()[k].kind, size, options.seed, 1);
                Baked& out = baked[k];
                out.tile_m = maps.tile_m;
                out.height_scale_m = maps.height_scale_m;
                out.albedo = encode_color(maps.albedo, table);
                out.normal = encode_normal(maps.normal);
                out.orm = encode_orm(maps);
                if (sources()[k].height) out.height = encode_data(maps.height);
                if (cobble) {
                    kit.cobble_height = std::move(maps.height);
                    kit.cobble_tile_m = maps.tile_m;
                    kit.cobble_scale_m = maps.height_scale_m;
                }
            } catch (...) {
                const std::lock_guard lock(guard);
                failure = std::current_exception();
            }
        }
    };
    const int threads = options.threads > 0
                            ? options.threads
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> workers;
        const std::size_t wanted = std::min(static_cast<std::size_t>(threads), baked.size());
        for (std::size_t i = 1; i < wanted; ++i) workers.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
    return baked;
}

struct Recipe {
    Slot slot;
    const char* name;
    const char* source;         ///< empty: no textures
    bool color_texture = true;  ///< false: the vertices carry the colour
    glm::vec4 color{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
    float porosity = -1.0f;
    glm::vec4 water{0.0f, 1.0f, 0.0f, 1.0f};
    float specular = 1.0f;
    float snow_influence = 1.0f;
    float diffuse_transmission = 0.0f;
    bool double_sided = false;
};

}  // namespace

void add_street_materials(const DemoOptions& options, scene::Scene& scene, Kit& kit)
{
    const std::vector<Baked> baked = bake(options, kit);
    // Cracks fill to about half of the relief; puddles drown the stones.
    const glm::vec4 kStoneWater(0.0f, 0.55f, 0.0f, 1.45f);
    const glm::vec4 kDenseWater(0.0f, 0.45f, 0.0f, 1.3f);
    const Recipe recipes[kSlots] = {
        {.slot = Slot::Cobble,
         .name = "cobble",
         .source = "cobble",
         .porosity = 0.45f,
         .water = kStoneWater},
        {.slot = Slot::Paving,
         .name = "paving",
         .source = "paving",
         .porosity = 0.55f,
         .water = kStoneWater},
        {.slot = Slot::Granite,
         .name = "granite",
         .source = "granite",
         .porosity = 0.40f,
         .water = kStoneWater},
        {.slot = Slot::Brick,
         .name = "brick",
         .source = "brick",
         .porosity = 0.75f,
         .water = kStoneWater},
        {.slot = Slot::Plaster,
         .name = "plaster",
         .source = "plaster",
         .porosity = 0.70f,
         .water = kDenseWater},
        {.slot = Slot::Timber,
         .name = "timber",
         .source = "plank",
         .porosity = 0.55f,
         .water = kStoneWater},
        {.slot = Slot::Painted,
         .name = "painted wood",
         .source = "plank",
         .color_texture = false,
         .roughness = 0.75f,
         .porosity = 0.05f,
         .water = kDenseWater},
        {.slot = Slot::RoofTile,
         .name = "roof tile",
         .source = "roof_tile",
         .porosity = 0.65f,
         .water = kDenseWater},
        {.slot = Slot::Zinc,
         .name = "galvanised zinc",
         .source = "zinc",
         .porosity = 0.0f,
         .water = kDenseWater},
        {.slot = Slot::Iron,
         .name = "cast iron",
         .source = "iron",
         .porosity = 0.0f,
         .water = kDenseWater},
        {.slot = Slot::Awning,
         .name = "copper sheet",
         .source = "seam",
         .porosity = 0.10f,
         .water = kDenseWater},
        {.slot = Slot::Grass,
         .name = "grass ground",
         .source = "grass",
         .porosity = 0.90f,
         .water = {0.0f, 0.15f, 0.0f, 0.3f}},
        {.slot = Slot::Blades,
         .name = "plants",
         .source = "",
         .metallic = 0.0f,
         .roughness = 0.70f,
         .porosity = 0.20f,
         .water = {0.0f, 0.0f, 0.0f, 0.0f},
         .specular = 0.4f,
         .snow_influence = 0.8f,
         .diffuse_transmission = 0.35f,
         .double_sided = true},
        {.slot = Slot::Glass,
         .name = "window glass",
         .source = "",
         .color = {0.016f, 0.020f, 0.024f, 1.0f},
         .metallic = 0.0f,
         .roughness = 0.06f,
         .porosity = 0.0f,
         .water = {0.0f, 0.0f, 0.0f, 0.0f}},
        {.slot = Slot::LitGlass,
         .name = "lit window",
         .source = "",
         .color = {0.022f, 0.021f, 0.020f, 1.0f},
         .metallic = 0.0f,
         .roughness = 0.10f,
         .porosity = 0.0f,
         .water = {0.0f, 0.0f, 0.0f, 0.0f}},
        {.slot = Slot::LampGlass,
         .name = "lantern glass",
         .source = "",
         .color = {0.45f, 0.42f, 0.36f, 1.0f},
         .metallic = 0.0f,
         .roughness = 0.25f,
         .porosity = 0.0f,
         .water = {0.0f, 0.0f, 0.0f, 0.0f}},
    };

    // Each image of a source once; materials share them.
    struct Indices {
        scene::TextureIndex albedo, normal, orm, height;
    };
    std::vector<Indices> indices;
    for (std::size_t k = 0; k < baked.size(); ++k) {
        const auto add = [&](const char* what, const std::vector<std::byte>& bytes) {
            if (bytes.empty()) return scene::kNoTexture;
            scene.textures.push_back({.name = sources()[k].name + "_" + what, .bytes = bytes});
            return static_cast<scene::TextureIndex>(scene.textures.size() - 1);
        };
        indices.push_back({add("albedo", baked[k].albedo), add("normal", baked[k].normal),
                           add("orm", baked[k].orm), add("height", baked[k].height)});
    }
    scene.textures.push_back({.name = "window_light",
                              .bytes = encode_window_light(options.seed, srgb_table()),
                              .wrap_u = scene::Wrap::Clamp,
                              .wrap_v = scene::Wrap::Clamp});
    const auto window_light = static_cast<scene::TextureIndex>(scene.textures.size() - 1);
    for (const Recipe& recipe : recipes) {
        scene::Material material;
        material.name = recipe.name;
        material.base_color = recipe.color;
        material.metallic = recipe.metallic;
        material.roughness = recipe.roughness;
        material.specular = recipe.specular;
        material.double_sided = recipe.double_sided;
        material.diffuse_transmission = recipe.diffuse_transmission;
        material.diffuse_transmission_of_base = recipe.diffuse_transmission > 0.0f;
        material.weather.porosity = recipe.porosity;
        material.weather.water_accumulation = recipe.water;
        material.weather.snow_accumulation = glm::vec2(0.0f, recipe.snow_influence);
        float tile_m = 1.0f;
        for (std::size_t k = 0; k < baked.size(); ++k) {
            if (sources()[k].name != recipe.source) continue;
            tile_m = baked[k].tile_m;
            if (recipe.color_texture) material.base_color_texture.texture = indices[k].albedo;
            material.normal_texture.texture = indices[k].normal;
            material.metallic_roughness_texture.texture = indices[k].orm;
            material.occlusion_texture.texture = indices[k].orm;
            material.weather.height.texture = indices[k].height;
            material.weather.height_scale_m = baked[k].height_scale_m;
        }
        if (recipe.slot == Slot::LitGlass) {
            // The mean of what shines out of a window is 26.1, 14.9 and 6.3, whatever is drawn in it (encode_window_light).
            material.emissive = glm::vec3(174.1f, 179.4f, 180.4f);
            material.emissive_texture.texture = window_light;
        }
        if (recipe.slot == Slot::LampGlass) material.emissive = glm::vec3(1600.0f, 960.0f, 420.0f);
        scene.materials.push_back(std::move(material));
        kit.builders.emplace_back(tile_m);
    }
}

}  // namespace petrichor::demo
