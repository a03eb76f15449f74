// Ground and cast surfaces: asphalt, concrete, soil, grass.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

using glm::vec3;

void make_asphalt(MaterialSurface& surface)
{
    surface.tile_m = 1.2f;
    const auto bitumen = noise_layer(surface, {0.010f, 0.010f, 2, 0.6f, 1});
    const auto worn = noise_layer(surface, {0.40f, 0.40f, 5, 0.5f, 2});
    const auto warp_x = noise_layer(surface, {0.20f, 0.20f, 6, 0.58f, 3});
    const auto warp_y = noise_layer(surface, {0.20f, 0.20f, 6, 0.58f, 4});
    const int stone_cells = surface.cells(0.0105f);
    const int crack_cells = surface.cells(0.6f);
    const float to_stones = static_cast<float>(stone_cells) / surface.tile_m;
    const float to_cracks = static_cast<float>(crack_cells) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 41u);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const CellPoint stone =
            cell_noise(x * to_stones + 0.10f * bitumen[k], y * to_stones - 0.10f * bitumen[k],
                       stone_cells, stone_cells, seed);
        const float gap = stone.second - stone.nearest;
        const float round = smooth_step(0.02f, 0.40f, gap);
        const float bare = smooth_step(0.35f, 0.85f, hash_unit(stone.id, 1) + 0.22f * worn[k]) *
                           smooth_step(0.12f, 0.30f, gap);
        const CellPoint slab =
            cell_noise(x * to_cracks + 0.20f * warp_x[k], y * to_cracks + 0.20f * warp_y[k],
                       crack_cells, crack_cells, seed + 1u);
        const float crack = (1.0f - smooth_step(0.002f, 0.010f, slab.second - slab.nearest)) *
                            smooth_step(0.0f, 0.5f, worn[k]);
        MaterialTexel texel;
        texel.height_m = 0.0026f * round * (0.6f + 0.4f * hash_unit(stone.id, 2)) +
                         0.0010f * worn[k] + 0.0003f * bitumen[k] - 0.005f * crack;
        const float tone = hash_unit(stone.id, 3);
        vec3 rock = mix(vec3(0.075f, 0.077f, 0.080f), vec3(0.215f, 0.200f, 0.182f), tone * tone);
        rock =
            mix(rock, vec3(0.150f, 0.115f, 0.092f), hash_unit(stone.id, 4) > 0.85f ? 0.7f : 0.0f);
        const vec3 tar =
            vec3(0.034f, 0.034f, 0.035f) * (1.0f + 0.2f * bitumen[k] + 0.25f * worn[k]);
        texel.albedo = mix(mix(tar, rock, 0.85f * bare), vec3(0.018f), 0.8f * crack);
        texel.roughness = mix(0.86f, 0.72f, bare) + 0.04f * bitumen[k] + 0.05f * crack;
        return texel;
    });
}

void make_concrete(MaterialSurface& surface)
{
    surface.tile_m = 2.0f;
    const auto waves = noise_layer(surface, {0.50f, 0.33f, 4, 0.5f, 1});
    const auto cloud = noise_layer(surface, {0.40f, 0.40f, 6, 0.55f, 2});
    const auto fine = noise_layer(surface, {0.010f, 0.010f, 2, 0.65f, 3});
    const auto drip = noise_layer(surface, {0.05f, 0.66f, 4, 0.6f, 4});
    const int pore_cells = surface.cells(0.030f);
    const float to_pores = static_cast<float>(pore_cells) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 51u);
    const float board_m = surface.tile_m / 10.0f;
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const CellPoint pore = cell_noise(x * to_pores, y * to_pores, pore_cells, pore_cells, seed);
        const float size = hash_unit(pore.id, 1);
        const float radius = 0.02f + 0.13f * size * size * size;
        const float hole = (hash_unit(pore.id, 2) > 0.45f ? 1.0f : 0.0f) *
                           smooth_step(radius, 0.55f * radius, pore.nearest);
        // The boards it was cast against.
        const float board_y = y / board_m;
        const float board = std::floor(board_y);
        const std::uint32_t h = hash_cell(static_cast<int>(board) % 10, 1, seed);
        const float seam =
            1.0f - smooth_step(0.0015f, 0.0045f,
                               board_m * std::min(board_y - board, board + 1.0f - board_y));
        MaterialTexel texel;
        texel.height_m = 0.0009f * waves[k] + 0.0006f * hash_signed(h, 1) + 0.0007f * seam -
                         0.0035f * hole * (0.3f + size) + 0.00012f * fine[k];
        vec3 color = vec3(0.365f, 0.355f, 0.335f) *
                     (1.0f + 0.10f * cloud[k] + 0.05f * fine[k] + 0.05f * hash_signed(h, 2));
        color = mix(color, vec3(0.175f, 0.166f, 0.150f),
                    0.40f * smooth_step(0.2f, 1.2f, drip[k] + 0.5f * cloud[k]));
        color *= 1.0f - 0.6f * hole - 0.10f * seam;
        texel.albedo = color;
        texel.roughness = 0.78f + 0.05f * cloud[k] + 0.10f * hole;
        return texel;
    });
}

namespace {

// Earth: clods, crumbs and a few pebbles. Shared by bare soil and the ground under grass.
struct Earth {
    std::vector<float> mounds, clods, crumbs, tone;
    int pebble_cells = 1;
    float to_pebbles = 1.0f;
    std::uint32_t seed = 0;
};

Earth make_earth(const MaterialSurface& surface)
{
    Earth earth;
    earth.mounds = noise_layer(surface, {0.36f, 0.36f, 4, 0.5f, 61});
    earth.clods = noise_layer(surface, {0.045f, 0.045f, 4, 0.62f, 62});
    earth.crumbs = noise_layer(surface, {0.010f, 0.010f, 3, 0.7f, 63});
    earth.tone = noise_layer(surface, {0.30f, 0.30f, 5, 0.55f, 64});
    earth.pebble_cells = surface.cells(0.045f);
    earth.to_pebbles = static_cast<float>(earth.pebble_cells) / surface.tile_m;
    earth.seed = hash_u32(surface.seed + 65u);
    return earth;
}

MaterialTexel earth_texel(const Earth& earth, float x, float y, std::size_t k)
{
    MaterialTexel texel;
    const float clod = 1.0f - std::abs(earth.clods[k]);
    texel.height_m = 0.0075f * earth.mounds[k] + 0.0065f * clod + 0.0015f * earth.crumbs[k];
    vec3 color = mix(vec3(0.085f, 0.058f, 0.036f), vec3(0.150f, 0.108f, 0.068f),
                     smooth_step(-0.9f, 0.9f, earth.tone[k] + 0.3f * earth.crumbs[k]));
    color *= 0.80f + 0.25f * clod + 0.14f * earth.crumbs[k];
    texel.roughness = 0.94f;
    const CellPoint pebble =
        cell_noise(x * earth.to_pebbles + 0.08f * earth.clods[k], y * earth.to_pebbles,
                   earth.pebble_cells, earth.pebble_cells, earth.seed);
    if (hash_unit(pebble.id, 1) > 0.70f) {
        const float radius = 0.10f + 0.20f * hash_unit(pebble.id, 2);
        const float inside = 1.0f - pebble.nearest / radius;
        const float round =
            inside > 0.0f ? std::sqrt(std::min(1.0f, inside * (2.0f - inside))) : 0.0f;
        const float cover = smooth_step(0.0f, 0.35f, round);
        texel.height_m += 0.022f * radius * round;
        const vec3 rock =
            mix(vec3(0.16f, 0.15f, 0.14f), vec3(0.27f, 0.235f, 0.19f), hash_unit(pebble.id, 3)) *
            (1.0f + 0.12f * earth.crumbs[k]);
        color = mix(color, rock, 0.9f * cover);
        texel.roughness = 0.94f - 0.22f * cover;
    }
    texel.albedo = color;
    return texel;
}

}  // namespace

void make_soil(MaterialSurface& surface)
{
    surface.tile_m = 1.5f;
    const Earth earth = make_earth(surface);
    shade_texels(surface,
                 [&](float x, float y, std::size_t k) { return earth_texel(earth, x, y, k); });
}

void make_grass_ground(MaterialSurface& surface)
{
    surface.tile_m = 1.0f;
    const Earth earth = make_earth(surface);
    shade_texels(surface,
                 [&](float x, float y, std::size_t k) { return earth_texel(earth, x, y, k); });

    // Blades lie over one another: strokes drawn in one fixed order, each a little higher.
    const int size = surface.size;
    const auto n = static_cast<std::size_t>(size);
    const std::uint32_t seed = hash_u32(surface.seed + 71u);
    constexpr int kBlades = 15000;
    const float to_texels = static_cast<float>(size) / surface.tile_m;
    for (int b = 0; b < kBlades; ++b) {
        const std::uint32_t h = hash_cell(b, 5, seed);
        const float x0 = hash_unit(h, 1) * static_cast<float>(size);
        const float y0 = hash_unit(h, 2) * static_cast<float>(size);
        const float angle = 6.2831853f * hash_unit(h, 3);
        const float length = (0.020f + 0.045f * hash_unit(h, 4)) * to_texels;
        const float width = (0.0010f + 0.0012f * hash_unit(h, 5)) * to_texels;
        const float curl = 1.4f * hash_signed(h, 6) / length;
        const float order = static_cast<float>(b) / static_cast<float>(kBlades);
        const float dryness = hash_unit(h, 7);
        vec3 color =
            mix(vec3(0.040f, 0.078f, 0.014f), vec3(0.105f, 0.150f, 0.035f), hash_unit(h, 8));
        if (dryness > 0.88f) color = vec3(0.230f, 0.190f, 0.095f);
        color *= 0.45f + 0.6f * order;
        const int steps = std::max(2, static_cast<int>(length * 1.2f));
        float x = x0;
        float y = y0;
        float heading = angle;
        for (int s = 0; s <= steps; ++s) {
            const float t = static_cast<float>(s) / static_cast<float>(steps);
            const float half = std::max(0.5f, width * (1.0f - t * t));
            const float nx = -portable_sin(heading);
            const float ny = portable_cos(heading);
            const int reach = static_cast<int>(half + 0.5f);
            for (int w = -reach; w <= reach; ++w) {
                const float across = static_cast<float>(w) / (half + 0.5f);
                if (std::abs(across) > 1.0f) continue;
                const float offset = static_cast<float>(w);
                const int px = wrap_index(static_cast<int>(std::floor(x + nx * offset)), size);
                const int py = wrap_index(static_cast<int>(std::floor(y + ny * offset)), size);
                MaterialTexel& texel =
                    surface.texels[static_cast<std::size_t>(py) * n + static_cast<std::size_t>(px)];
                const float height = 0.010f + 0.016f * order + 0.010f * portable_sin(3.0f * t) -
                                     0.0015f * across * across;
                if (height < texel.height_m) continue;
                texel.height_m = height;
                texel.albedo = color * (0.75f + 0.45f * t) * (1.0f - 0.25f * across * across);
                texel.roughness = 0.62f;
            }
            heading += curl * length / static_cast<float>(steps);
            x += portable_cos(heading) * length / static_cast<float>(steps);
            y += portable_sin(heading) * length / static_cast<float>(steps);
        }
    }
}

}  // namespace petrichor::texproc::detail
