// Wood and metal.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

using glm::vec3;

namespace {

// Draws straight scratches into a layer, wrapping round the edges. Serial: cheap, and the order of
// the strokes is part of the result.
std::vector<float> scratch_layer(const MaterialSurface& surface, int count, float longest_m,
                                 std::uint32_t salt)
{
    const int size = surface.size;
    const auto n = static_cast<std::size_t>(size);
    std::vector<float> layer(n * n, 0.0f);
    const std::uint32_t seed = hash_u32(surface.seed + salt);
    for (int s = 0; s < count; ++s) {
        const std::uint32_t h = hash_cell(s, 3, seed);
        const float angle = 6.2831853f * hash_unit(h, 1);
        const float length = longest_m * (0.15f + 0.85f * hash_unit(h, 2) * hash_unit(h, 3));
        const float depth = 0.25f + 0.75f * hash_unit(h, 4);
        const int steps = std::max(2, static_cast<int>(length / surface.texel_m()));
        const float dx = portable_cos(angle);
        const float dy = portable_sin(angle);
        const float bend = 0.4f * hash_signed(h, 5) / static_cast<float>(steps);
        const float x0 = hash_unit(h, 6) * static_cast<float>(size);
        const float y0 = hash_unit(h, 7) * static_cast<float>(size);
        for (int i = 0; i < steps; ++i) {
            const float t = static_cast<float>(i);
            const float fade = 1.0f - std::abs(2.0f * t / static_cast<float>(steps) - 1.0f);
            const float x = x0 + dx * t - dy * bend * t * t;
            const float y = y0 + dy * t + dx * bend * t * t;
            const int px = wrap_index(static_cast<int>(std::floor(x)), size);
            const int py = wrap_index(static_cast<int>(std::floor(y)), size);
            float& value = layer[static_cast<std::size_t>(py) * n + static_cast<std::size_t>(px)];
            value = std::max(value, depth * std::sqrt(fade));
        }
    }
    return box_blur(layer, size, size >= 1024 ? 1 : 0, surface.threads);
}

void make_plank(MaterialSurface& surface)
{
    const int boards = surface.cells(surface.value("board_m"));
    const float board_m = surface.tile_m / static_cast<float>(boards);
    const float gap_m = surface.value("gap_m");
    const float knots = 0.9f * (1.0f - surface.value("knots"));
    const float grey = 2.0f * surface.value("wear");
    const auto bend = noise_layer(surface, {0.15f, 0.60f, 4, 0.45f, 1});
    const auto fibre = noise_layer(surface, {0.006f, 0.24f, 3, 0.7f, 2});
    const auto pore = noise_layer(surface, {0.0028f, 0.06f, 1, 0.7f, 3});
    const auto weather = noise_layer(surface, {0.24f, 0.60f, 5, 0.55f, 4});
    const auto edge_noise = noise_layer(surface, {0.03f, 0.12f, 3, 0.6f, 5});
    static const std::array<vec3, 5> kWood = {
        vec3(0.185f, 0.122f, 0.072f), vec3(0.150f, 0.102f, 0.064f), vec3(0.215f, 0.150f, 0.092f),
        vec3(0.165f, 0.125f, 0.088f), vec3(0.128f, 0.086f, 0.054f)};
    const vec3 kGrey(0.205f, 0.190f, 0.168f);
    const std::uint32_t seed = hash_u32(surface.seed + 5u);

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const int board = std::min(static_cast<int>(x / board_m), boards - 1);
        const std::uint32_t h = hash_cell(board, 0, seed);
        const float middle = (static_cast<float>(board) + 0.5f) * board_m;
        const float lx = x - middle;
        // One butt joint a board, at its own height.
        const float joint_y = surface.tile_m * hash_unit(h, 1);
        float from_joint = y - joint_y;
        from_joint -= surface.tile_m * std::round(from_joint / surface.tile_m);
        const float side = 0.5f * board_m - std::abs(lx) - 0.5f * gap_m + 0.0005f * edge_noise[k];
        const float d = std::min(side, std::abs(from_joint) - 0.0009f);

        // Year rings cut lengthwise: lines along the board that part and flow round its knots.
        float line_x = lx + 0.018f * bend[k] + 0.03f * hash_signed(h, 2);
        float knot = 0.0f;  // 1 in its middle, 0 at its rim
        float knot_ring = 0.0f;
        for (std::uint32_t s = 0; s < 2; ++s) {
            if (hash_unit(h, 20 + s) < knots) continue;
            const float radius = 0.007f + 0.006f * hash_unit(h, 32 + s);
            const float kx = lx - 0.30f * board_m * hash_signed(h, 24 + s) + 0.004f * bend[k];
            float ky = y - surface.tile_m * hash_unit(h, 28 + s);
            ky -= surface.tile_m * std::round(ky / surface.tile_m);
            const float reach = ky / (4.2f * radius);
            if (std::abs(reach) > 4.0f) continue;
            const float push = 1.5f * radius * portable_exp(-reach * reach);
            line_x -= std::copysign(
                std::min(push, std::abs(kx)) * portable_exp(-std::abs(kx) / (4.0f * radius)), kx);
            const float r = std::sqrt(kx * kx + 0.30f * ky * ky) / radius + 0.06f * edge_noise[k];
            knot = std::max(knot, saturate(1.0f - r));
            if (r < 1.0f) knot_ring = 0.5f + 0.5f * portable_sin(24.0f * r);
        }
        const float rings = line_x * (150.0f + 70.0f * hash_signed(h, 3));
        const float ring = rings - std::floor(rings);
        const float in_knot = smooth_step(0.0f, 0.12f, knot);
        const float late =
            mix(smooth_step(0.35f, 0.92f, ring) * (1.0f - smooth_step(0.94f, 1.0f, ring)),
                knot_ring, in_knot);
        const float knot_shade = in_knot * (0.45f + 0.55f * smooth_step(0.25f, 0.02f, knot) +
                                            0.35f * smooth_step(0.7f, 1.0f, knot));

        const float edge = saturate(d / 0.0028f);
        const float round = d <= 0.0f ? 0.0f : std::sqrt(edge * (2.0f - edge));
        float nail = 8.0f;
        for (const float across : {-0.33f, 0.33f}) {
            const float nx = lx - across * board_m;
            const float ny = std::abs(from_joint) - 0.024f;
            nail = std::min(nail, std::sqrt(nx * nx + ny * ny));
        }
        const float head = 1.0f - smooth_step(0.0030f, 0.0042f, nail);

        MaterialTexel texel;
        const float cup = 1.0f - 4.0f * lx * lx / (board_m * board_m);
        texel.height_m =
            0.0042f * round + 0.00075f * hash_signed(h, 4) * round +
            round * (0.0007f * cup * hash_signed(h, 5) + 0.00030f * late + 0.00032f * fibre[k] +
                     0.00010f * pore[k] + 0.0004f * bend[k] -
                     0.0008f * smooth_step(0.75f, 1.15f, fibre[k] + 0.3f * edge_noise[k])) -
            0.0006f * head;
        const std::size_t pick = static_cast<std::size_t>(hash_unit(h, 6) * 5.0f) % 5u;
        vec3 color = kWood[pick] * (1.0f + 0.10f * hash_signed(h, 7));
        color = mix(color, vec3(0.60f, 0.52f, 0.46f) * color, 0.75f * late);
        color *= 1.0f + 0.12f * fibre[k] + 0.07f * pore[k];
        color = mix(color, kGrey * (1.0f + 0.12f * fibre[k] - 0.2f * late),
                    std::min(grey * 0.55f * smooth_step(-0.6f, 0.9f, weather[k] + 0.3f * hash_signed(h, 8)), 1.0f));
        color = mix(color, vec3(0.30f, 0.24f, 0.20f) * color, 0.85f * saturate(knot_shade));
        color *= 0.35f + 0.65f * smooth_step(0.0f, 0.0035f, d);
        color = mix(color, vec3(0.060f, 0.044f, 0.036f), head);
        // Rust runs down from the nails.
        const float run =
            (1.0f - smooth_step(0.002f, 0.007f, std::abs(std::abs(lx) - 0.33f * board_m))) *
            smooth_step(0.0f, 0.01f, from_joint) * smooth_step(0.12f, 0.02f, from_joint);
        color = mix(color, vec3(0.075f, 0.045f, 0.03f), 0.4f * run);
        texel.albedo = color;
        texel.roughness =
            0.76f + 0.06f * fibre[k] - 0.08f * late + 0.1f * (1.0f - round) - 0.25f * head;
        return texel;
    });
}

void make_metal_plate(MaterialSurface& surface)
{
    const float scratched = 2.0f * surface.value("scratches");
    const float rusty = surface.value("rust");
    const auto waves = noise_layer(surface, {0.20f, 0.20f, 3, 0.4f, 1});
    const auto warp_x = noise_layer(surface, {0.030f, 0.030f, 4, 0.6f, 2});
    const auto warp_y = noise_layer(surface, {0.030f, 0.030f, 4, 0.6f, 3});
    const auto fine = noise_layer(surface, {0.005f, 0.005f, 2, 0.6f, 4});
    const auto dull = noise_layer(surface, {0.20f, 0.20f, 5, 0.55f, 5});
    const auto run = noise_layer(surface, {0.020f, 0.40f, 4, 0.6f, 7});
    const auto scratches = scratch_layer(surface, static_cast<int>(110.0f * scratched), 0.24f, 6);
    const float spangle_m = surface.value("spangle_m");
    const std::uint32_t seed = hash_u32(surface.seed + 21u);
    // Large crystals first, small ones where those left room.
    struct Grid {
        int cells;
        float to_cells;
    };
    const auto grid = [&](float size_m) {
        const int cells = surface.cells(size_m);
        return Grid{cells, static_cast<float>(cells) / surface.tile_m};
    };
    const Grid large = grid(1.35f * spangle_m), small = grid(0.55f * spangle_m);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Spangle: zinc crystals grow from a seed in arms, each reflecting a little differently.
        const auto crystal_at = [&](const Grid& g, std::uint32_t salt) {
            const float wander = 0.22f * spangle_m;
            return cell_noise((x + wander * warp_x[k]) * g.to_cells, (y + wander * warp_y[k]) * g.to_cells,
                              g.cells, g.cells, seed + salt);
        };
        CellPoint crystal = crystal_at(large, 0u);
        float size_m = 1.35f * spangle_m;
        if (hash_unit(crystal.id, 4) < 0.45f) {
            crystal = crystal_at(small, 1u);
            size_m = 0.55f * spangle_m;
        }
        const float tone = hash_signed(crystal.id, 1);
        const float angle = 6.2831853f * hash_unit(crystal.id, 2);
        const float along = crystal.dx * portable_cos(angle) + crystal.dy * portable_sin(angle);
        const float across = crystal.dy * portable_cos(angle) - crystal.dx * portable_sin(angle);
        // Arms of a fir branch: ribs that lean away from two axes.
        const float rib = portable_sin(58.0f * (std::abs(along) + 0.8f * std::abs(across)) + 2.0f * warp_x[k]);
        const float feather = rib * smooth_step(0.02f, 0.25f, crystal.second - crystal.nearest);
        const float border = 1.0f - smooth_step(0.01f, 0.07f, crystal.second - crystal.nearest);
        const float white_rust = smooth_step(0.50f, 1.0f, dull[k] + 0.05f * fine[k]);
        // Red rust comes through from below in spots that run down.
        const float spot = dull[k] + 0.55f * warp_x[k] + 0.30f * run[k] + 0.18f * fine[k];
        const float red = rusty > 0.0f ? smooth_step(1.15f - 1.9f * rusty, 1.45f - 1.9f * rusty, spot) : 0.0f;
        const float stain = rusty > 0.0f ? smooth_step(1.0f - 1.6f * rusty, 1.9f - 1.6f * rusty,
                                                       dull[k] + 0.7f * run[k]) : 0.0f;
        MaterialTexel texel;
        // Each crystal is a facet: a degree or so out of the sheet's plane.
        const float tilt = 0.010f * size_m * (along * hash_signed(crystal.id, 5) + across * hash_signed(crystal.id, 6));
        texel.height_m = 0.00050f * waves[k] + tilt - 0.00001f * border + 0.000004f * feather +
                         0.000006f * fine[k] - 0.00012f * scratches[k] + 0.00003f * white_rust +
                         red * (0.00025f + 0.00022f * fine[k]);
        vec3 color = vec3(0.545f, 0.560f, 0.575f) * (1.0f + 0.17f * tone + 0.05f * feather - 0.08f * border);
        color *= 1.0f - 0.14f * smooth_step(-0.2f, 0.9f, dull[k]);
        color = mix(color, vec3(0.70f, 0.71f, 0.72f), 0.75f * saturate(4.0f * scratches[k]));
        color = mix(color, vec3(0.47f, 0.47f, 0.46f), 0.6f * white_rust);
        color = mix(color, vec3(0.26f, 0.15f, 0.085f), 0.45f * stain);
        color = mix(color, mix(vec3(0.085f, 0.030f, 0.016f), vec3(0.250f, 0.105f, 0.038f),
                               saturate(0.45f + 0.35f * fine[k] + 0.35f * warp_y[k] + 0.25f * dull[k])), red);
        texel.albedo = color;
        texel.metallic = (1.0f - 0.55f * white_rust) * (1.0f - 0.4f * stain) * (1.0f - red);
        texel.roughness = mix(0.36f + 0.09f * tone + 0.03f * feather + 0.05f * border +
                              0.10f * smooth_step(-0.2f, 0.9f, dull[k]) + 0.25f * white_rust -
                              0.30f * scratches[k] + 0.02f * fine[k] + 0.15f * stain, 0.92f, red);
        return texel;
    });
}

void make_painted_iron(MaterialSurface& surface)
{
    const float chipped = 0.16f * (surface.value("wear") - 0.5f);
    const auto cast = noise_layer(surface, {0.012f, 0.012f, 3, 0.55f, 1});
    const auto waves = noise_layer(surface, {0.13f, 0.13f, 4, 0.45f, 2});
    const auto wear = noise_layer(surface, {0.10f, 0.10f, 6, 0.62f, 3});
    const auto fine = noise_layer(surface, {0.005f, 0.005f, 2, 0.6f, 4});
    shade_texels(surface, [&](float, float, std::size_t k) {
        const float chip = smooth_step(0.86f, 0.93f, wear[k] + 0.2f * cast[k] + 4.0f * chipped);
        const float rust_halo = smooth_step(0.58f, 0.92f, wear[k] + 0.2f * cast[k] + 4.0f * chipped);
        MaterialTexel texel;
        texel.height_m =
            0.00022f * cast[k] + 0.0004f * waves[k] - 0.00035f * chip + chip * 0.00015f * fine[k];
        vec3 color = vec3(0.0165f, 0.0205f, 0.0195f) * (1.0f + 0.2f * waves[k]);
        color = mix(color, vec3(0.040f, 0.029f, 0.022f), 0.45f * rust_halo);
        color = mix(color, vec3(0.150f, 0.062f, 0.028f) * (1.0f + 0.35f * fine[k]), chip);
        texel.albedo = color;
        texel.roughness =
            mix(0.40f + 0.05f * waves[k] + 0.04f * fine[k] + 0.18f * rust_halo, 0.88f, chip);
        texel.metallic = 0.0f;
        return texel;
    });
}

}  // namespace

std::vector<KindRow> wood_and_metal_kinds()
{
    return {{MaterialKind::Plank, "plank", "weathered boards, grain along v", 1.2f,
             {{"board_m", "m", 0.15f, 0.03f, 1.0f, "width of a board"},
              {"gap_m", "m", 0.0026f, 0.0f, 0.02f, "between boards"},
              {"knots", "share", 0.5f, 0.0f, 1.0f, "how knotty the wood is"},
              {"wear", "share", 0.5f, 0.0f, 1.0f, "grey of sun and rain"}},
             make_plank},
            {MaterialKind::MetalPlate, "metal_plate", "galvanised sheet with spangle and scratches", 0.8f,
             {{"spangle_m", "m", 0.020f, 0.003f, 0.1f, "size of the zinc's crystals"},
              {"scratches", "share", 0.5f, 0.0f, 1.0f, "of use"},
              {"rust", "share", 0.0f, 0.0f, 1.0f, "red rust where the zinc is gone"}},
             make_metal_plate},
            {MaterialKind::PaintedIron, "painted_iron", "dark paint on cast iron, chipped and rusty", 0.8f,
             {{"wear", "share", 0.5f, 0.0f, 1.0f, "chips of the paint, rust about them"}},
             make_painted_iron}};
}

}  // namespace petrichor::texproc::detail
