// Roads: asphalt with its cracks, its patches and its markings.
#include <array>

#include "texproc/generate/detail/loose_stones.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

// A square cut out of the road and filled again.
struct Patch {
    float x_m, y_m, half_x_m, half_y_m;
    float tone;
};

float wrapped(float offset, float tile_m)
{
    return offset - tile_m * std::round(offset / tile_m);
}

void make_asphalt(MaterialSurface& surface)
{
    const float stone_m = surface.value("stone_m");
    const float wear = surface.value("wear");
    const float cracked = surface.value("cracks");
    const float line_m = surface.value("marking_m");
    const float tile_m = surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 41u);

    std::vector<Patch> patches;
    for (int p = 0; p < surface.count("patches"); ++p) {
        const std::uint32_t h = hash_cell(p, 3, seed);
        const float largest = 0.38f * tile_m;
        patches.push_back({tile_m * hash_unit(h, 1), tile_m * hash_unit(h, 2),
                           std::min(0.20f + 0.55f * hash_unit(h, 3), largest),
                           std::min(0.25f + 0.70f * hash_unit(h, 4), largest), hash_signed(h, 5)});
    }
    const auto stones = [&](float size, float sunk, float share, std::uint32_t salt) {
        return StoneLayer(surface, {.size_m = size * stone_m, .roundness = 0.25f, .flatness = 0.75f,
                                    .spread_m = 0.05f * stone_m, .sunk_m = sunk * stone_m, .share = share,
                                    .salt = salt});
    };
    const std::array<StoneLayer, 3> layers = {stones(1.0f, 0.10f, 0.8f, 1), stones(0.65f, 0.06f, 0.9f, 2),
                                              stones(0.40f, 0.05f, 1.0f, 3)};
    const auto bitumen = noise_layer(surface, {0.010f, 0.010f, 2, 0.6f, 1});
    const auto worn = noise_layer(surface, {0.40f, 0.40f, 5, 0.5f, 2});
    const auto warp_x = noise_layer(surface, {0.20f, 0.20f, 7, 0.62f, 3});
    const auto warp_y = noise_layer(surface, {0.20f, 0.20f, 7, 0.62f, 4});
    const auto fine = noise_layer(surface, {0.0035f, 0.0035f, 1, 0.6f, 5});
    const auto oil = noise_layer(surface, {0.25f, 0.60f, 4, 0.55f, 6});
    const auto zone = noise_layer(surface, {0.60f, 0.60f, 3, 0.5f, 7});
    const auto paint_loss = noise_layer(surface, {0.060f, 0.060f, 5, 0.68f, 8});
    struct Grid {
        int cells;
        float to_cells;
    };
    const auto grid = [&](float size_m) {
        const int cells = surface.cells(size_m);
        return Grid{cells, static_cast<float>(cells) / tile_m};
    };
    const Grid slabs = grid(0.85f), scales = grid(0.16f);
    const auto seam_m = [&](const Grid& g, float x, float y, float wander_m, std::uint32_t salt, std::size_t k) {
        const CellBorder c = cell_border((x + wander_m * warp_x[k]) * g.to_cells, (y + wander_m * warp_y[k]) * g.to_cells,
                                       g.cells, g.cells, seed + salt, 0.95f);
        return c.distance / g.to_cells;
    };

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Inside which patch: metres to its edge, positive within.
        float inside_m = -1.0f, tone = 0.0f;
        for (const Patch& p : patches) {
            const float to_edge = std::min(p.half_x_m - std::abs(wrapped(x - p.x_m, tile_m)),
                                           p.half_y_m - std::abs(wrapped(y - p.y_m, tile_m))) +
                                  0.006f * warp_x[k];
            if (to_edge > inside_m) {
                inside_m = to_edge;
                tone = p.tone;
            }
        }
        const float fill = smooth_step(-0.004f, 0.004f, inside_m);
        const float sealed = patches.empty() ? 0.0f : 1.0f - smooth_step(0.012f, 0.022f, std::abs(inside_m - 0.003f));

        StoneAt stone;
        for (const StoneLayer& layer : layers) {
            const StoneAt here = layer.at(x + 0.0007f * bitumen[k], y - 0.0007f * bitumen[k]);
            if (here.height_m > stone.height_m) stone = here;
        }
        // Bitumen between the stones; wheels take it off their tops, and press them in.
        const float mortar = (0.10f + 0.08f * worn[k] - 0.16f * wear) * stone_m + 0.00025f * bitumen[k];
        const float top = std::min(stone.height_m, (0.42f + 0.08f * hash_signed(stone.id, 44)) * stone_m);
        const float above = top - mortar;
        float bare = smooth_step(0.0f, 0.14f * stone_m, above) *
                     smooth_step(0.75f - 1.1f * wear, 1.25f - 1.1f * wear, hash_unit(stone.id, 45) + 0.3f * worn[k] + 0.35f);
        bare *= 1.0f - 0.75f * fill;

        // Cracks: long ones between slabs that move, a net of scales where the ground below is weak.
        float crack_m = 1.0f, gape_m = 0.001f;
        if (cracked > 0.0f) {
            const float weak = zone[k] + 0.25f * worn[k];
            const float long_m = seam_m(slabs, x, y, 0.15f, 11u, k);
            const float open = smooth_step(0.75f - 1.5f * cracked, 1.2f - 1.5f * cracked, weak + 0.2f);
            gape_m = 0.0055f * cracked * open;
            crack_m = long_m;
            const float net = smooth_step(1.15f - 1.3f * cracked, 1.55f - 1.3f * cracked, weak);
            if (net > 0.0f) {
                const float scale_m = seam_m(scales, x, y, 0.035f, 12u, k);
                if (scale_m - 0.0038f * net * cracked < crack_m - gape_m) {
                    crack_m = scale_m;
                    gape_m = 0.0038f * net * cracked;
                }
            }
        }
        gape_m *= (1.0f + 0.35f * bitumen[k]) * (1.0f - 0.92f * fill);
        const float crack = gape_m > 0.0002f ? 1.0f - smooth_step(0.45f * gape_m, gape_m + 0.0006f, crack_m) : 0.0f;
        const float crumbled = gape_m > 0.0002f ? 1.0f - smooth_step(gape_m, 3.0f * gape_m + 0.004f, crack_m) : 0.0f;

        MaterialTexel texel;
        texel.height_m = std::max(top, mortar) + 0.0014f * worn[k] + 0.00010f * fine[k] -
                         0.0016f * smooth_step(0.2f, 1.2f, zone[k]) - 0.010f * crack - 0.0012f * crumbled +
                         fill * (0.0030f + 0.0012f * tone) + sealed * 0.0022f;
        const float shade = hash_unit(stone.id, 46);
        vec3 rock = mix(vec3(0.070f, 0.072f, 0.075f), vec3(0.215f, 0.202f, 0.185f), shade * shade);
        if (hash_unit(stone.id, 47) > 0.86f) rock = mix(rock, vec3(0.150f, 0.112f, 0.088f), 0.7f);
        rock *= 1.0f + 0.10f * fine[k];
        // Bitumen bleaches; fresh fill is black.
        vec3 tar = mix(vec3(0.030f, 0.030f, 0.031f), vec3(0.068f, 0.066f, 0.063f), saturate(0.25f + 0.9f * wear + 0.25f * worn[k])) *
                   (1.0f + 0.14f * bitumen[k] + 0.06f * fine[k]);
        tar = mix(tar, vec3(0.027f, 0.027f, 0.029f) * (1.0f + 0.3f * tone), 0.8f * fill);
        vec3 color = mix(tar, rock, 0.85f * bare);
        color = mix(color, vec3(0.110f, 0.098f, 0.082f), 0.30f * wear * smooth_step(0.0f, -0.2f * stone_m, above));  // dust
        color *= 1.0f - 0.30f * smooth_step(0.55f, 1.2f, oil[k]);
        float rough = mix(0.88f, 0.74f, bare) + 0.04f * bitumen[k] - 0.14f * fill * (1.0f - bare) -
                      0.12f * smooth_step(0.7f, 1.2f, oil[k]);
        // A line of thick paint along v. Wheels take it off the stones first, cracks break it.
        if (line_m > 0.0f) {
            const float across = 0.5f * line_m - std::abs(x - 0.5f * tile_m) + 0.0016f * bitumen[k];
            const float kept = smooth_step(-0.25f, 0.30f, paint_loss[k] + 1.25f - 2.1f * wear * (0.75f + 0.5f * bare) - 1.2f * crumbled);
            const float paint = smooth_step(-0.001f, 0.0012f, across) * kept * (1.0f - crack) * (1.0f - fill);
            color = mix(color, vec3(0.62f, 0.615f, 0.59f) * (1.0f - 0.10f * worn[k] - 0.16f * saturate(oil[k]) + 0.03f * fine[k]), 0.96f * paint);
            texel.height_m += paint * (0.0012f - 0.35f * std::max(above, 0.0f));
            rough = mix(rough, 0.62f + 0.08f * fine[k], paint);
        }
        color = mix(color, vec3(0.019f, 0.019f, 0.020f), sealed * 0.85f);
        rough = mix(rough, 0.52f + 0.06f * bitumen[k], sealed);
        color = mix(color, vec3(0.020f, 0.019f, 0.018f), 0.85f * crack);
        color *= 1.0f - 0.18f * crumbled;
        texel.albedo = color;
        texel.roughness = rough + 0.05f * crack;
        return texel;
    });
}

}  // namespace

std::vector<KindRow> road_kinds()
{
    return {{MaterialKind::Asphalt, "asphalt", "stone chippings in bitumen: cracks, patches, markings", 1.2f,
             {{"stone_m", "m", 0.0105f, 0.003f, 0.05f, "of the largest chippings"},
              {"wear", "share", 0.5f, 0.0f, 1.0f, "bare stones, bleached bitumen, worn paint"},
              {"cracks", "share", 0.35f, 0.0f, 1.0f, "long cracks, then a net of scales"},
              {"patches", "count", 0.0f, 0.0f, 12.0f, "squares that were cut out and filled, sealed at their edges"},
              {"marking_m", "m", 0.0f, 0.0f, 1.0f, "width of a painted line along v; 0 none"}},
             make_asphalt}};
}

}  // namespace petrichor::texproc::detail
