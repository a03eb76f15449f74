// Cast ground and lawn: concrete, grass.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/strokes.h"

namespace petrichor::texproc::detail {

using glm::vec3;

namespace {

void make_concrete(MaterialSurface& surface)
{
    const float pored = 2.0f * surface.value("pores");
    const float stained = 2.0f * surface.value("stains");
    const bool boarded = surface.value("board_m") >= 0.03f;
    const int boards = boarded ? surface.cells(surface.value("board_m")) : 1;
    const int ties = surface.count("ties");
    const float board_m = surface.tile_m / static_cast<float>(boards);
    const auto waves = noise_layer(surface, {0.50f, 0.33f, 4, 0.5f, 1});
    const auto cloud = noise_layer(surface, {0.40f, 0.40f, 6, 0.55f, 2});
    const auto fine = noise_layer(surface, {0.010f, 0.010f, 2, 0.65f, 3});
    // Rain streaks a wall; on a floor it dries where it stood.
    const auto drip = boarded ? noise_layer(surface, {0.05f, 0.66f, 4, 0.6f, 4}) : noise_layer(surface, {0.42f, 0.42f, 6, 0.5f, 4});
    const auto fibre = noise_layer(surface, {0.40f, 0.007f, 3, 0.65f, 5});
    const auto bend = noise_layer(surface, {0.50f, 0.10f, 3, 0.5f, 6});
    const auto patch = noise_layer(surface, {0.22f, 0.16f, 4, 0.55f, 7});
    const auto sand = noise_layer(surface, {0.0048f, 0.0048f, 4, 0.75f, 8});
    const auto skin = noise_layer(surface, {0.060f, 0.060f, 5, 0.6f, 9});
    const auto bend_x = noise_layer(surface, {0.30f, 0.30f, 6, 0.46f, 10});
    const auto bend_y = noise_layer(surface, {0.30f, 0.30f, 6, 0.46f, 11});
    struct Grid {
        int cells;
        float to_cells;
    };
    const auto grid = [&](float size_m) {
        const int cells = surface.cells(size_m);
        return Grid{cells, static_cast<float>(cells) / surface.tile_m};
    };
    const Grid small = grid(0.011f), large = grid(0.045f), cracks = grid(0.70f);
    const std::uint32_t seed = hash_u32(surface.seed + 51u);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Air that stayed at the mould: round holes, in swarms.
        const auto hole_at = [&](const Grid& g, float most, float rarer, std::uint32_t salt) {
            const CellPoint pore = cell_noise(x * g.to_cells, y * g.to_cells, g.cells, g.cells, seed + salt);
            const float size = hash_unit(pore.id, 1);
            const float radius = most * (0.15f + 0.85f * size * size * size);
            const float swarm = smooth_step(-0.3f, 0.9f, patch[k]);
            return hash_unit(pore.id, 2) < rarer * pored * swarm
                       ? smooth_step(radius, 0.62f * radius, pore.nearest + 0.02f * fine[k]) * (0.3f + size)
                       : 0.0f;
        };
        const float hole = std::max(hole_at(small, 0.42f, 0.28f, 0u), hole_at(large, 0.17f, 0.45f, 7u));
        // The boards it was cast against: their grain, and a fin of mortar that ran between two.
        const float board_y = (y + 0.0012f * bend[k]) / board_m;
        const float board = std::floor(board_y);
        const std::uint32_t h = hash_cell(wrap_index(static_cast<int>(board), boards), 1, seed);
        const float to_seam = board_m * std::min(board_y - board, board + 1.0f - board_y);
        const float fin = !boarded ? 0.0f : (1.0f - smooth_step(0.0008f, 0.0030f, to_seam)) * smooth_step(-0.7f, 0.4f, patch[k]);
        float butt_x = x - surface.tile_m * hash_unit(h, 5);
        butt_x -= surface.tile_m * std::round(butt_x / surface.tile_m);
        const float butt = !boarded ? 0.0f : 1.0f - smooth_step(0.0008f, 0.0025f, std::abs(butt_x));
        const float grain = !boarded ? 0.0f : fibre[k] * (0.35f + 0.65f * hash_unit(h, 4));
        // Cones of the ties, plugged with mortar a little below the face.
        float cone = 0.0f, rim = 0.0f;
        if (ties > 0) {
            const float step_m = surface.tile_m / static_cast<float>(ties);
            const float cx = x - (std::floor(x / step_m) + 0.5f) * step_m;
            const float cy = y - (std::floor(y / step_m) + 0.5f) * step_m;
            const float r = std::sqrt(cx * cx + cy * cy) + 0.0007f * fine[k];
            cone = 1.0f - smooth_step(0.0120f, 0.0150f, r);
            rim = smooth_step(0.0115f, 0.0140f, r) * (1.0f - smooth_step(0.0140f, 0.0175f, r));
        }
        // Hair cracks of shrinkage, no wider than a hair, lime and dirt along them.
        const CellBorder shrunk = cell_border((x + 0.055f * bend_x[k]) * cracks.to_cells, (y + 0.055f * bend_y[k]) * cracks.to_cells,
                                              cracks.cells, cracks.cells, seed + 9u, 0.95f);
        const float crack_m = shrunk.distance / cracks.to_cells;
        const float opened = smooth_step(0.25f, 0.9f, cloud[k] + 0.4f * skin[k]) * std::min(stained, 1.0f);
        const float crack = opened * (1.0f - smooth_step(0.0002f, 0.0004f + 0.0006f * opened, crack_m));
        const float beside = opened * (1.0f - smooth_step(0.0f, 0.010f + 0.006f * skin[k], crack_m));
        // Where the skin of cement is off, the sand below shows.
        const float bare = smooth_step(0.20f, 1.0f, skin[k] + 0.45f * cloud[k] + (boarded ? -0.1f : 0.25f));
        MaterialTexel texel;
        texel.height_m = 0.0009f * waves[k] + 0.00010f * sand[k] * (0.35f + bare) - 0.00035f * bare * smooth_step(-0.3f, 0.8f, sand[k] + skin[k]) - 0.0012f * crack + 0.0005f * hash_signed(h, 1) + 0.00016f * grain + 0.0010f * fin +
                         0.0006f * butt - 0.0032f * hole + 0.00008f * fine[k] - 0.0060f * cone;
        vec3 color = vec3(0.345f, 0.335f, 0.315f) *
                     (1.0f + 0.13f * cloud[k] + 0.05f * fine[k] + 0.045f * hash_signed(h, 2) + 0.05f * grain + 0.05f * skin[k]);
        float trowelled = 0.0f;
        if (!boarded) {
            // Edges of pools that dried, and the sheen that the trowel left.
            const float tide = 1.0f - smooth_step(0.0f, 0.05f + 0.03f * skin[k], std::abs(drip[k] - 0.35f));
            color *= 1.0f - 0.10f * stained * tide * smooth_step(-0.5f, 0.5f, patch[k]);
            trowelled = smooth_step(-0.4f, 0.9f, cloud[k] - 0.5f * skin[k]);
            texel.height_m += 0.00025f * patch[k];
            // Grains of stone where feet have worn the skin.
            color *= 1.0f + (0.08f + 0.25f * bare) * smooth_step(0.35f, 0.9f, fine[k]) - (0.12f + 0.30f * bare) * smooth_step(0.35f, 0.9f, -fine[k]);
        }
        color *= 1.0f + sand[k] * (boarded ? 0.045f + 0.16f * bare : 0.10f + 0.20f * bare);
        color = mix(color, color * vec3(0.97f, 0.93f, 0.86f), 0.8f * smooth_step(0.0f, 1.0f, skin[k] - cloud[k]));
        // Where the mould sucked water it is darker, at seams that leaked paler.
        color *= 1.0f - 0.16f * smooth_step(0.1f, 1.0f, patch[k] + 0.4f * cloud[k]);
        color = mix(color, vec3(0.150f, 0.142f, 0.126f),
                    std::min(stained * 0.42f * smooth_step(0.1f, 1.1f, drip[k] + 0.5f * cloud[k]), 1.0f));
        color = mix(color, vec3(0.520f, 0.510f, 0.490f),
                    std::min(stained * 0.35f * smooth_step(0.45f, 1.2f, -drip[k] + 0.3f * patch[k]), 1.0f));
        color = mix(color, vec3(0.43f, 0.42f, 0.40f), 0.22f * beside);
        color *= (1.0f - 0.62f * saturate(hole) - 0.10f * fin - 0.25f * rim - 0.10f * cone) * (1.0f - 0.6f * crack);
        texel.albedo = color;
        texel.roughness = 0.74f + 0.05f * cloud[k] + 0.10f * saturate(hole) - 0.10f * smooth_step(0.0f, 1.0f, -patch[k]) + 0.13f * bare + 0.03f * sand[k] - 0.16f * trowelled * (1.0f - bare);
        return texel;
    });
}

// Earth below grass: clods, crumbs and a few pebbles.
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

void make_grass_ground(MaterialSurface& surface)
{
    const float dry = 1.0f - 0.24f * surface.value("dryness");
    const float blade_m = surface.value("blade_m");
    const float cover = surface.value("cover");
    const Earth earth = make_earth(surface);
    shade_texels(surface,
                 [&](float x, float y, std::size_t k) { return earth_texel(earth, x, y, k); });

    // Blades lie over one another: strokes drawn in one fixed order, each a little higher.
    const int size = surface.size;
    const std::uint32_t seed = hash_u32(surface.seed + 71u);
    const int blades = static_cast<int>(std::min(15000.0f * cover * surface.tile_m * surface.tile_m, 400000.0f));
    const float to_texels = static_cast<float>(size) / surface.tile_m;
    const float longer = blade_m / 0.0425f;
    for (int b = 0; b < blades; ++b) {
        const std::uint32_t h = hash_cell(b, 5, seed);
        const float length = longer * (0.020f + 0.045f * hash_unit(h, 4)) * to_texels;
        const Stroke blade{hash_unit(h, 1) * static_cast<float>(size),
                           hash_unit(h, 2) * static_cast<float>(size),
                           6.2831853f * hash_unit(h, 3),
                           length,
                           (0.0010f + 0.0012f * hash_unit(h, 5)) * to_texels,
                           1.4f * hash_signed(h, 6) / length};
        const float order = static_cast<float>(b) / static_cast<float>(blades);
        const float dryness = hash_unit(h, 7);
        vec3 color =
            mix(vec3(0.040f, 0.078f, 0.014f), vec3(0.105f, 0.150f, 0.035f), hash_unit(h, 8));
        if (dryness > dry) color = vec3(0.230f, 0.190f, 0.095f);
        color *= 0.45f + 0.6f * order;
        draw_stroke(surface, blade, [&](MaterialTexel& texel, float t, float across) {
            const float height = 0.010f + 0.016f * order + 0.010f * portable_sin(3.0f * t) -
                                 0.0015f * across * across;
            if (height < texel.height_m) return;
            texel.height_m = height;
            texel.albedo = color * (0.75f + 0.45f * t) * (1.0f - 0.25f * across * across);
            texel.roughness = 0.62f;
        });
    }
}

}  // namespace

std::vector<KindRow> ground_kinds()
{
    return {{MaterialKind::Concrete, "concrete", "concrete cast against boards: pores, ties, stains", 2.0f,
             {{"board_m", "m", 0.20f, 0.0f, 4.0f, "width of the boards of its mould; below 0.03 none: a floor, trowelled"},
              {"pores", "share", 0.5f, 0.0f, 1.0f, "air holes"},
              {"stains", "share", 0.5f, 0.0f, 1.0f, "streaks of rain and lime"},
              {"ties", "count", 2.0f, 0.0f, 8.0f, "cones of the mould's ties, a side of the tile"}},
             make_concrete},
            {MaterialKind::GrassGround, "grass_ground", "short grass over soil", 1.0f,
             {{"blade_m", "m", 0.0425f, 0.01f, 0.3f, "mean length of a blade"},
              {"cover", "factor", 1.0f, 0.0f, 3.0f, "of the number of blades"},
              {"dryness", "share", 0.5f, 0.0f, 1.0f, "yellow blades"}},
             make_grass_ground}};
}

}  // namespace petrichor::texproc::detail
