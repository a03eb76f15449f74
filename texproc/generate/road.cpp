// Roads: asphalt with its cracks, its patches and its markings.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/colonies.h"
#include "texproc/generate/detail/loose_stones.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

// A place that was dug up and filled again, or that had asphalt thrown on it.
struct Patch {
    enum class Make { Cut, Trench, Thrown };
    Make make;
    float x_m, y_m, half_x_m, half_y_m;
    float cosine, sine;
    float tone;    ///< -1 black and new .. 1 bleached
    float sealed;  ///< 0, or 1 with a band of bitumen at its edge
    std::uint32_t id;
};

float wrapped(float offset, float tile_m)
{
    return offset - tile_m * std::round(offset / tile_m);
}

std::vector<Patch> make_patches(const MaterialSurface& surface, std::uint32_t seed)
{
    std::vector<Patch> patches;
    const float tile_m = surface.tile_m;
    for (int p = 0; p < surface.count("patches"); ++p) {
        const std::uint32_t h = hash_cell(p, 3, seed);
        const float largest = 0.38f * tile_m;
        Patch patch{};
        const float make = hash_unit(h, 6);
        patch.make = make < 0.45f ? Patch::Make::Cut : make < 0.80f ? Patch::Make::Thrown : Patch::Make::Trench;
        patch.x_m = tile_m * hash_unit(h, 1);
        patch.y_m = tile_m * hash_unit(h, 2);
        patch.half_x_m = std::min(0.18f + 0.50f * hash_unit(h, 3) * hash_unit(h, 8), largest);
        patch.half_y_m = std::min(0.25f + 0.60f * hash_unit(h, 4), largest);
        float turn = 0.09f * hash_signed(h, 7);
        if (patch.make == Patch::Make::Thrown) {
            patch.half_x_m = std::min(0.14f + 0.30f * hash_unit(h, 3), largest);
            patch.half_y_m = patch.half_x_m * (0.7f + 0.9f * hash_unit(h, 4));
            turn = 3.1415927f * hash_unit(h, 7);
        } else if (patch.make == Patch::Make::Trench) {  // right across, so it repeats unturned
            patch.half_x_m = std::min(0.16f + 0.16f * hash_unit(h, 3), largest);
            patch.half_y_m = tile_m;
            turn = 0.0f;
        }
        patch.cosine = portable_cos(turn);
        patch.sine = portable_sin(turn);
        patch.tone = hash_signed(h, 5);
        patch.sealed = patch.make != Patch::Make::Thrown && hash_unit(h, 9) < 0.6f ? 1.0f : 0.0f;
        patch.id = h;
        patches.push_back(patch);
    }
    return patches;
}

// Metres from its edge, positive within.
float inside_of(const Patch& p, float x, float y, float tile_m, float wander, float fray)
{
    const float dx = wrapped(x - p.x_m, tile_m), dy = wrapped(y - p.y_m, tile_m);
    const float u = p.cosine * dx + p.sine * dy, v = p.cosine * dy - p.sine * dx;
    switch (p.make) {
        case Patch::Make::Trench: return p.half_x_m - std::abs(u) + 0.012f * wander + 0.004f * fray;
        case Patch::Make::Cut:
            return rounded_inside(p.half_x_m - std::abs(u), p.half_y_m - std::abs(v), 0.02f + 0.05f * hash_unit(p.id, 12)) +
                   0.008f * wander + 0.005f * fray;
        case Patch::Make::Thrown: break;
    }
    const float r = std::sqrt(u * u / (p.half_x_m * p.half_x_m) + v * v / (p.half_y_m * p.half_y_m));
    return std::min(p.half_x_m, p.half_y_m) * (1.0f - r) + 0.055f * wander + 0.012f * fray;
}

void make_asphalt(MaterialSurface& surface)
{
    const float stone_m = surface.value("stone_m");
    const float wear = surface.value("wear");
    const float cracked = surface.value("cracks");
    const float line_m = surface.value("marking_m");
    const float stained = surface.value("stains");
    const float tile_m = surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 41u);

    const std::vector<Patch> patches = make_patches(surface, seed);
    const auto stones = [&](float size, float sunk, float share, std::uint32_t salt) {
        return StoneLayer(surface, {.size_m = size * stone_m, .roundness = 0.12f, .flatness = 0.75f,
                                    .spread_m = 0.04f * stone_m, .sunk_m = sunk * stone_m, .share = share,
                                    .salt = salt});
    };
    const std::array<StoneLayer, 3> layers = {stones(1.0f, 0.03f, 0.85f, 1), stones(0.65f, -0.03f, 0.95f, 2),
                                              stones(0.40f, -0.07f, 1.0f, 3)};
    const std::array<StoneLayer, 2> fill_layers = {stones(0.70f, -0.02f, 0.9f, 4), stones(0.45f, -0.06f, 1.0f, 5)};
    const bool from_afar = layers[0].left_out();  // texels wider than stones
    const auto bitumen = noise_layer(surface, {0.010f, 0.010f, 4, 0.55f, 1});
    const auto worn = noise_layer(surface, {0.40f, 0.40f, 5, 0.5f, 2});
    // The path of a crack bends at all scales, and at none so much that it turns back.
    const auto warp_x = noise_layer(surface, {0.30f, 0.30f, 6, 0.46f, 3});
    const auto warp_y = noise_layer(surface, {0.30f, 0.30f, 6, 0.46f, 4});
    const auto fine = noise_layer(surface, {0.0035f, 0.0035f, 3, 0.6f, 5});
    const auto oil = noise_layer(surface, {0.25f, 0.60f, 4, 0.55f, 6});
    const auto zone = noise_layer(surface, {0.60f, 0.60f, 3, 0.5f, 7});
    const auto paint_loss = noise_layer(surface, {0.050f, 0.050f, 4, 0.6f, 8});
    const auto tint = noise_layer(surface, {0.090f, 0.090f, 4, 0.6f, 9});
    const Colonies drops(surface, 0.22f, 1);
    struct Grid {
        int cells;
        float to_cells;
    };
    const auto grid = [&](float size_m) {
        const int cells = surface.cells(size_m);
        return Grid{cells, static_cast<float>(cells) / tile_m};
    };
    const Grid slabs = grid(0.85f), scales = grid(0.15f);
    // A seam is open, or not, along its whole side of a cell: how weak the ground is in its middle decides, or nets
    // would end in forks of which nothing goes on.
    struct Seam {
        float distance_m, weak;
    };
    const auto seam = [&](const Grid& g, float x, float y, float wander_m, std::uint32_t salt, std::size_t k) {
        const CellBorder c = cell_border((x + wander_m * warp_x[k]) * g.to_cells, (y + wander_m * warp_y[k]) * g.to_cells,
                                       g.cells, g.cells, seed + salt, 0.95f);
        const auto texel = [&](float cells) {
            const int at = static_cast<int>(std::floor(cells / g.to_cells / surface.texel_m()));
            return static_cast<std::size_t>(wrap_index(at, surface.size));
        };
        const std::size_t middle = texel(c.middle_y) * static_cast<std::size_t>(surface.size) + texel(c.middle_x);
        return Seam{c.distance / g.to_cells, zone[middle] + 0.25f * worn[middle]};
    };

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Inside which patch: metres to its edge, positive within. The later lies on the earlier.
        float inside_m = -1.0f, tone = 0.0f, sealed = 0.0f;
        Patch::Make make = Patch::Make::Cut;
        for (const Patch& p : patches) {
            const float to_edge = inside_of(p, x, y, tile_m, warp_x[k], bitumen[k] + warp_y[k]);
            if (p.sealed > 0.0f)
                sealed = std::max(sealed, 1.0f - smooth_step(0.011f + 0.007f * warp_y[k], 0.024f + 0.007f * warp_y[k],
                                                             std::abs(to_edge - 0.003f)));
            if (to_edge > std::min(inside_m, 0.0f)) {
                if (to_edge > 0.03f && p.sealed <= 0.0f) sealed = 0.0f;
                inside_m = to_edge;
                tone = p.tone;
                make = p.make;
            }
        }
        sealed *= smooth_step(-1.1f, -0.2f, zone[k] + 0.5f * warp_x[k]);
        const bool thrown = make == Patch::Make::Thrown;
        const float fill = thrown ? smooth_step(-0.004f, 0.028f, inside_m + 0.006f * bitumen[k]) : smooth_step(-0.003f, 0.004f, inside_m);
        const float edge = fill > 0.0f ? 1.0f - smooth_step(0.0f, 0.03f, std::abs(inside_m)) : 0.0f;
        // The joint of a cut, where it has opened.
        const float joint = thrown || fill <= 0.0f ? 0.0f
                                : (1.0f - smooth_step(0.0012f, 0.0042f, std::abs(inside_m))) * smooth_step(-0.5f, 0.4f, warp_x[k] + zone[k]);
        const float fresh = fill * saturate(0.62f - 0.42f * tone);

        StoneAt stone;
        const float sx = x + 0.0007f * bitumen[k], sy = y - 0.0007f * bitumen[k];
        const auto pick_from = [&](const auto& from) {
            for (const StoneLayer& layer : from) {
                const StoneAt here = layer.at(sx, sy);
                if (here.height_m > stone.height_m) stone = here;
            }
        };
        if (fill > 0.5f && !fill_layers[0].left_out()) pick_from(fill_layers);
        else pick_from(layers);
        // Bitumen between the stones; a roller pressed their tops level, wheels take it off them.
        const float mortar = (0.165f + 0.045f * worn[k] - 0.10f * wear + 0.05f * fresh) * stone_m + 0.00025f * bitumen[k];
        const float cap = (0.27f + 0.035f * hash_signed(stone.id, 44)) * stone_m;
        const float top = std::min(stone.height_m, cap + 0.10f * std::max(stone.height_m - cap, 0.0f)) + 0.00012f * fine[k];
        const float above = top - mortar;
        float bare = smooth_step(0.0f, 0.10f * stone_m, above) *
                     smooth_step(0.80f - 1.1f * wear, 1.35f - 1.1f * wear, hash_unit(stone.id, 45) + 0.25f * worn[k] + 0.30f * tint[k] + 0.35f);
        if (from_afar) bare = 0.45f * wear;
        bare *= 1.0f - 0.85f * fresh;

        // Cracks: long ones between slabs that move, a net of scales where the ground below is weak.
        float crack_m = 1.0f, gape_m = 0.001f;
        if (cracked > 0.0f) {
            const Seam slab = seam(slabs, x, y, 0.055f, 11u, k);
            const float open = smooth_step(0.75f - 1.5f * cracked, 1.2f - 1.5f * cracked, slab.weak + 0.2f);
            gape_m = 0.0060f * cracked * open;
            crack_m = slab.distance_m;
            // The ground half a scale away may be weaker than here.
            if (zone[k] + 0.25f * worn[k] > 0.75f - 1.3f * cracked) {
                const Seam scale = seam(scales, x, y, 0.040f, 12u, k);
                const float weak_net = smooth_step(1.15f - 1.3f * cracked, 1.55f - 1.3f * cracked, scale.weak);
                if (scale.distance_m - 0.0036f * weak_net * cracked < crack_m - gape_m) {
                    crack_m = scale.distance_m;
                    gape_m = 0.0036f * weak_net * cracked;
                }
            }
        }
        // It goes round the stones: where one is whole the gap is narrow.
        gape_m *= (1.0f + 0.45f * bitumen[k] + 0.35f * hash_signed(stone.id, 48)) * (1.0f - fill * (thrown ? 0.97f : 0.9f));
        const float crack = gape_m > 0.0003f ? 1.0f - smooth_step(0.35f * gape_m, gape_m + 0.0008f, crack_m) : 0.0f;
        const float crumbled = gape_m > 0.0003f ? 1.0f - smooth_step(gape_m, 3.0f * gape_m + 0.006f, crack_m + 0.0015f * bitumen[k]) : 0.0f;

        MaterialTexel texel;
        const float lost = crumbled * smooth_step(0.1f, 0.9f, hash_signed(stone.id, 49) + 0.6f * tint[k]);
        texel.height_m = std::max(mix(top, mortar - 0.0012f, lost), mortar - 0.0012f * lost) + 0.0016f * worn[k] + 0.00007f * fine[k] -
                         0.0020f * smooth_step(0.2f, 1.2f, zone[k]) - 0.010f * crack - 0.0010f * crumbled +
                         (thrown ? 0.0075f * smooth_step(-0.004f, 0.10f, inside_m) * fill
                                 : fill * (0.0012f + 0.0035f * tone - 0.0022f * edge)) + sealed * 0.0020f -
                         0.0030f * joint * (1.0f - sealed);
        const float shade = hash_unit(stone.id, 46);
        vec3 rock = mix(vec3(0.074f, 0.075f, 0.077f), vec3(0.235f, 0.222f, 0.202f), shade * shade);
        if (hash_unit(stone.id, 47) > 0.86f) rock = mix(rock, vec3(0.150f, 0.112f, 0.088f), 0.7f);
        rock *= 1.0f + 0.14f * fine[k];
        if (from_afar) rock = vec3(0.125f, 0.120f, 0.112f);
        // Bitumen bleaches; fresh fill is black.
        vec3 tar = mix(vec3(0.026f, 0.026f, 0.027f), vec3(0.066f, 0.064f, 0.061f), saturate(0.22f + 0.9f * wear + 0.22f * worn[k] + 0.12f * tint[k])) *
                   (1.0f + 0.14f * bitumen[k] + 0.07f * fine[k]);
        tar = mix(tar, vec3(0.024f, 0.024f, 0.026f) * (1.0f + 0.15f * bitumen[k]), 0.85f * fresh);
        vec3 color = mix(tar, rock, 0.85f * bare);
        // Dust and sand in what lies low, and where no wheel goes.
        const float dust = wear * (0.30f * smooth_step(0.02f * stone_m, -0.08f * stone_m, above) + 0.16f * smooth_step(0.1f, 1.0f, -zone[k])) +
                           0.35f * wear * lost;
        color = mix(color, vec3(0.128f, 0.113f, 0.094f), saturate(dust * (1.0f - 0.7f * fresh)));
        color *= 1.0f + 0.07f * zone[k] + 0.05f * tint[k];
        const float film = stained * smooth_step(0.6f, 1.3f, oil[k]);
        const ColonyAt drop = drops.at(x, y, 0.22f * wear);
        const float spot = stained * smooth_step(-0.05f, 0.55f, drop.inside + 0.25f * tint[k] + 0.1f * bitumen[k]) * (1.0f - fill);
        color *= (1.0f - 0.28f * film) * (1.0f - 0.42f * spot);
        float rough = mix(0.90f, 0.72f, bare) + 0.05f * bitumen[k] + 0.05f * hash_signed(stone.id, 50) - 0.16f * fresh * (1.0f - bare) -
                      0.13f * film - 0.20f * spot + 0.05f * dust;
        // A line of thick paint along v. Wheels take it off the stones first, cracks break it.
        if (line_m > 0.0f) {
            const float across = 0.5f * line_m - std::abs(x - 0.5f * tile_m) + 0.0016f * bitumen[k];
            const float raised = smooth_step(-0.02f, 0.10f, above / stone_m);
            const float kept = smooth_step(-0.30f, 0.30f, 1.30f - 1.55f * wear + 0.55f * paint_loss[k] * (0.3f + wear) -
                                                              1.0f * wear * wear * raised * (0.6f + 0.6f * hash_unit(stone.id, 51)) - 1.3f * crumbled);
            const float paint = smooth_step(-0.001f, 0.0012f, across) * kept * (1.0f - crack) * (1.0f - fill);
            const vec3 line = mix(vec3(0.64f, 0.635f, 0.61f), vec3(0.40f, 0.39f, 0.365f), saturate(0.75f * wear * (0.5f + 0.5f * worn[k] + 0.4f * tint[k]))) *
                              (1.0f - 0.16f * saturate(oil[k]) + 0.03f * fine[k]);
            color = mix(color, line, 0.96f * paint);
            texel.height_m += paint * (0.0010f - 0.30f * std::max(above, 0.0f));
            rough = mix(rough, 0.60f + 0.08f * fine[k] + 0.12f * wear, paint);
        }
        color = mix(color, vec3(0.019f, 0.019f, 0.020f) * (1.0f + 0.3f * bitumen[k]) * (1.0f + 0.8f * wear), sealed * 0.88f);
        rough = mix(rough, 0.50f + 0.10f * bitumen[k] + 0.12f * wear, sealed);
        color = mix(color, vec3(0.022f, 0.020f, 0.018f), 0.88f * crack);
        color *= (1.0f - 0.16f * crumbled * (1.0f - lost)) * (1.0f - 0.55f * joint * (1.0f - sealed));
        texel.albedo = color;
        texel.roughness = rough + 0.05f * crack;
        return texel;
    });
}

}  // namespace

std::vector<KindRow> road_kinds()
{
    return {{MaterialKind::Asphalt, "asphalt", "stone chippings in bitumen: cracks, patches, markings", 1.6f,
             {{"stone_m", "m", 0.0105f, 0.003f, 0.05f, "of the largest chippings"},
              {"wear", "share", 0.5f, 0.0f, 1.0f, "bare stones, bleached bitumen, worn paint"},
              {"cracks", "share", 0.35f, 0.0f, 1.0f, "long cracks, then a net of scales"},
              {"patches", "count", 0.0f, 0.0f, 12.0f, "places dug up and filled, trenches, asphalt thrown on"},
              {"marking_m", "m", 0.0f, 0.0f, 1.0f, "width of a painted line along v; 0 none"},
              {"stains", "share", 1.0f, 0.0f, 1.0f, "drops and film of oil"}},
             make_asphalt}};
}

}  // namespace petrichor::texproc::detail
