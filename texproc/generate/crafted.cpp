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

}  // namespace

void make_plank(MaterialSurface& surface)
{
    surface.tile_m = 1.2f;
    constexpr int kBoards = 8;
    const float board_m = surface.tile_m / kBoards;
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
        const int board = std::min(static_cast<int>(x / board_m), kBoards - 1);
        const std::uint32_t h = hash_cell(board, 0, seed);
        const float middle = (static_cast<float>(board) + 0.5f) * board_m;
        const float lx = x - middle;
        // One butt joint a board, at its own height.
        const float joint_y = surface.tile_m * hash_unit(h, 1);
        float from_joint = y - joint_y;
        from_joint -= surface.tile_m * std::round(from_joint / surface.tile_m);
        const float side = 0.5f * board_m - std::abs(lx) - 0.0013f + 0.0005f * edge_noise[k];
        const float d = std::min(side, std::abs(from_joint) - 0.0009f);

        // Year rings cut lengthwise: lines along the board that part and flow round its knots.
        float line_x = lx + 0.018f * bend[k] + 0.03f * hash_signed(h, 2);
        float knot = 0.0f;  // 1 in its middle, 0 at its rim
        float knot_ring = 0.0f;
        for (std::uint32_t s = 0; s < 2; ++s) {
            if (hash_unit(h, 20 + s) < 0.45f) continue;
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
                    0.55f * smooth_step(-0.6f, 0.9f, weather[k] + 0.3f * hash_signed(h, 8)));
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
    surface.tile_m = 0.8f;
    const auto waves = noise_layer(surface, {0.20f, 0.20f, 3, 0.4f, 1});
    const auto warp_x = noise_layer(surface, {0.030f, 0.030f, 3, 0.6f, 2});
    const auto warp_y = noise_layer(surface, {0.030f, 0.030f, 3, 0.6f, 3});
    const auto fine = noise_layer(surface, {0.005f, 0.005f, 2, 0.6f, 4});
    const auto dull = noise_layer(surface, {0.20f, 0.20f, 5, 0.55f, 5});
    const auto scratches = scratch_layer(surface, 220, 0.24f, 6);
    const int cells = surface.cells(0.020f);
    const float to_cells = static_cast<float>(cells) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 21u);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Spangle: zinc crystals, each reflecting a little differently, with feathered edges.
        const CellPoint crystal = cell_noise(x * to_cells + 0.35f * warp_x[k],
                                             y * to_cells + 0.35f * warp_y[k], cells, cells, seed);
        const float tone = hash_signed(crystal.id, 1);
        const float angle = 6.2831853f * hash_unit(crystal.id, 2);
        const float feather = portable_sin(
            55.0f * (crystal.dx * portable_cos(angle) + crystal.dy * portable_sin(angle)) +
            3.0f * warp_x[k]);
        const float white_rust = smooth_step(0.50f, 1.0f, dull[k] + 0.05f * fine[k]);
        MaterialTexel texel;
        texel.height_m = 0.00050f * waves[k] + 0.000010f * tone + 0.000008f * fine[k] -
                         0.00020f * scratches[k] + 0.00003f * white_rust;
        vec3 color = vec3(0.545f, 0.560f, 0.575f) * (1.0f + 0.11f * tone + 0.025f * feather);
        color *= 1.0f - 0.14f * smooth_step(-0.2f, 0.9f, dull[k]);
        color = mix(color, vec3(0.70f, 0.71f, 0.72f), 0.75f * saturate(4.0f * scratches[k]));
        color = mix(color, vec3(0.47f, 0.47f, 0.46f), 0.6f * white_rust);
        texel.albedo = color;
        texel.metallic = 1.0f - 0.55f * white_rust;
        texel.roughness = 0.36f + 0.07f * tone + 0.015f * feather +
                          0.10f * smooth_step(-0.2f, 0.9f, dull[k]) + 0.25f * white_rust -
                          0.30f * scratches[k] + 0.02f * fine[k];
        return texel;
    });
}

void make_painted_iron(MaterialSurface& surface)
{
    surface.tile_m = 0.8f;
    const auto cast = noise_layer(surface, {0.012f, 0.012f, 3, 0.55f, 1});
    const auto waves = noise_layer(surface, {0.13f, 0.13f, 4, 0.45f, 2});
    const auto wear = noise_layer(surface, {0.10f, 0.10f, 6, 0.62f, 3});
    const auto fine = noise_layer(surface, {0.005f, 0.005f, 2, 0.6f, 4});
    shade_texels(surface, [&](float, float, std::size_t k) {
        const float chip = smooth_step(0.86f, 0.93f, wear[k] + 0.2f * cast[k]);
        const float rust_halo = smooth_step(0.58f, 0.92f, wear[k] + 0.2f * cast[k]);
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

void make_standing_seam(MaterialSurface& surface)
{
    surface.tile_m = 1.6f;
    constexpr int kSheets = 4;
    const float sheet_m = surface.tile_m / kSheets;
    const auto can = noise_layer(surface, {0.20f, 0.53f, 3, 0.45f, 1});
    const auto streak = noise_layer(surface, {0.032f, 0.53f, 5, 0.6f, 2});
    const auto patch = noise_layer(surface, {0.27f, 0.40f, 6, 0.58f, 3});
    const auto fine = noise_layer(surface, {0.008f, 0.008f, 2, 0.6f, 4});
    const std::uint32_t seed = hash_u32(surface.seed + 31u);
    const vec3 kVerdigris(0.190f, 0.345f, 0.285f);
    const vec3 kPale(0.330f, 0.475f, 0.405f);
    const vec3 kBronze(0.120f, 0.078f, 0.050f);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const int sheet = std::min(static_cast<int>(x / sheet_m), kSheets - 1);
        const std::uint32_t h = hash_cell(sheet, 0, seed);
        const float to_seam = std::min(x - static_cast<float>(sheet) * sheet_m,
                                       static_cast<float>(sheet + 1) * sheet_m - x);
        const float seam = 1.0f - smooth_step(0.006f, 0.011f, to_seam);
        const float foot = 1.0f - smooth_step(0.008f, 0.035f, to_seam);
        // Flat cross welts where two sheets meet down the slope.
        float welt_y = y - surface.tile_m * hash_unit(h, 1);
        welt_y -= surface.tile_m * std::round(welt_y / surface.tile_m);
        const float welt =
            smooth_step(-0.012f, -0.010f, welt_y) * smooth_step(0.010f, 0.007f, welt_y);
        MaterialTexel texel;
        texel.height_m = 0.0140f * seam + 0.0013f * can[k] * (1.0f - foot) +
                         0.0016f * welt * (1.0f - seam) + 0.00005f * fine[k] + 0.0008f * foot;
        const float run = smooth_step(0.0f, 1.1f, streak[k] + 0.4f * patch[k]);
        vec3 color = mix(kVerdigris, kPale, smooth_step(-0.2f, 1.1f, streak[k] - 0.6f * patch[k]));
        const float bare = saturate(smooth_step(0.25f, 0.95f, patch[k] + 0.25f * streak[k]) +
                                    0.55f * seam * smooth_step(-0.4f, 0.5f, patch[k]));
        color = mix(color, kBronze, 0.78f * bare);
        color = mix(color, 0.62f * color, 0.35f * run + 0.4f * foot * (1.0f - seam));
        color *= 1.0f + 0.05f * fine[k] + 0.05f * hash_signed(h, 2);
        texel.albedo = color;
        texel.metallic = 0.55f * bare;
        texel.roughness = mix(0.68f, 0.46f, bare) + 0.04f * fine[k] + 0.06f * run;
        return texel;
    });
}

}  // namespace petrichor::texproc::detail
