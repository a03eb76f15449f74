// Soft ground: moss, mud, snow.
#include <array>

#include "texproc/generate/detail/loose_stones.h"
#include "texproc/generate/detail/strokes.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

// Cushions and mats of shoots; each shoot is a star of small leaves, seen from above, over the fuzz of older ones.
void make_moss(MaterialSurface& surface)
{
    const float cushion_m = surface.value("cushion_m");
    const float shoot_m = surface.value("shoot_m");
    const float dry = surface.value("dryness");
    const auto mounds = noise_layer(surface, {0.22f, 0.22f, 3, 0.5f, 1});
    const auto warp_x = noise_layer(surface, {0.4f * cushion_m, 0.4f * cushion_m, 4, 0.50f, 2});
    const auto warp_y = noise_layer(surface, {0.4f * cushion_m, 0.4f * cushion_m, 4, 0.50f, 3});
    const auto tone = noise_layer(surface, {0.12f, 0.12f, 4, 0.6f, 4});
    const auto fine = noise_layer(surface, {0.003f, 0.003f, 2, 0.6f, 5});
    const auto zone = noise_layer(surface, {0.20f, 0.20f, 3, 0.5f, 6});
    const int cells = surface.cells(cushion_m);
    const float to_cells = static_cast<float>(cells) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 81u);
    const auto n = static_cast<std::size_t>(surface.size);
    std::vector<float> crown(n * n);  // 1 on top of a cushion
    std::vector<float> kin(n * n);    // of a cushion: -1 deep green .. 1 yellow
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const CellPoint c = cell_noise((x + 0.22f * cushion_m * warp_x[k]) * to_cells,
                                       (y + 0.22f * cushion_m * warp_y[k]) * to_cells, cells, cells, seed);
        // Some cushions have grown into each other, others stand alone.
        const float apart = smooth_step(-0.7f, 0.7f, zone[k] + 0.5f * hash_signed(c.id, 2));
        const float gap = smooth_step(0.0f, 0.30f + 0.45f * hash_unit(c.id, 3), c.second - c.nearest + 0.06f * warp_x[k] + 0.16f * (1.0f - apart));
        const float dome = std::sqrt(gap * (2.0f - gap));
        crown[k] = dome;
        kin[k] = 0.75f * hash_signed(c.id, 4) * (0.4f + 0.6f * gap) + 0.5f * zone[k];
        MaterialTexel texel;
        texel.height_m = 0.26f * cushion_m * dome * (0.55f + 0.6f * hash_unit(c.id, 1)) * (0.45f + 0.55f * apart) + 0.014f * mounds[k] + 0.0008f * fine[k];
        texel.albedo = vec3(0.020f, 0.021f, 0.008f) * (0.7f + 0.7f * dome) * (1.0f + 0.3f * fine[k]);
        texel.roughness = 0.96f;
        return texel;
    });
    const float to_texels = static_cast<float>(surface.size) / surface.tile_m;
    const vec3 kYoung(0.185f, 0.205f, 0.036f), kGreen(0.064f, 0.098f, 0.017f), kDeep(0.026f, 0.048f, 0.012f),
        kBrown(0.150f, 0.098f, 0.036f);
    // Fuzz first, then three sizes of shoots over it, in an order without rows: neighbours lie over each other by chance.
    struct Layer {
        float size, closer;
        int leaves;
        float lift;
    };
    static const std::array<Layer, 4> kLayers = {{{0.8f, 1.5f, 4, 0.05f}, {0.75f, 1.05f, 8, 0.25f}, {1.0f, 1.15f, 10, 0.5f}, {1.35f, 0.55f, 12, 0.75f}}};
    for (std::size_t layer = 0; layer < kLayers.size(); ++layer) {
        const Layer& rule = kLayers[layer];
        const bool fuzz = layer == 0;
        const int side = std::min(static_cast<int>(static_cast<float>(surface.cells(shoot_m)) * rule.closer), 480);
        const float spacing = static_cast<float>(surface.size) / static_cast<float>(std::max(side, 1));
        for (int s = 0; s < side * side; ++s) {
            const std::uint32_t h = hash_cell(s % side, s / side, seed + 5u + 31u * static_cast<std::uint32_t>(layer));
            const float x0 = (static_cast<float>(s % side) + 0.5f + 0.6f * hash_signed(h, 1)) * spacing;
            const float y0 = (static_cast<float>(s / side) + 0.5f + 0.6f * hash_signed(h, 2)) * spacing;
            const std::size_t k = static_cast<std::size_t>(wrap_index(static_cast<int>(std::floor(y0)), surface.size)) * n +
                                  static_cast<std::size_t>(wrap_index(static_cast<int>(std::floor(x0)), surface.size));
            const float high = crown[k];
            // In the gaps few shoots reach the light.
            if (!fuzz && hash_unit(h, 9) > 0.35f + 0.8f * high) continue;
            const float size = rule.size * (0.75f + 0.5f * hash_unit(h, 10));
            const float foot = surface.texels[k].height_m;
            const float tall = shoot_m * (fuzz ? 0.12f : rule.lift * 0.25f + 0.40f * hash_unit(h, 3) * (0.4f + 0.6f * high));
            const float old = saturate(dry + 0.45f * tone[k] + 0.22f * hash_signed(h, 4) - 0.18f * high);
            vec3 tip = mix(kGreen, kYoung, saturate(0.10f + 0.45f * high + 0.35f * kin[k] + 0.30f * hash_signed(h, 5) - 0.3f * tone[k] + 0.15f * rule.lift));
            tip = mix(tip, kDeep, saturate(0.55f - 0.55f * high - 0.40f * kin[k] + 0.2f * hash_signed(h, 11)));
            tip = mix(tip, kBrown * (0.75f + 0.5f * hash_unit(h, 6)), 0.9f * smooth_step(0.42f, 0.95f, old));
            if (fuzz) tip = mix(tip, kDeep, 0.7f) * (0.6f + 0.3f * high);
            const float turn = 6.2831853f * hash_unit(h, 8);
            for (int l = 0; l < rule.leaves; ++l) {
                const std::uint32_t g = hash_cell(l, s, seed + 9u + 31u * static_cast<std::uint32_t>(layer));
                const float length = size * shoot_m * (0.38f + 0.34f * hash_unit(g, 1)) * to_texels;
                const Stroke leaf{x0, y0, turn + 6.2831853f * (static_cast<float>(l) + 0.6f * hash_signed(g, 2)) / static_cast<float>(rule.leaves),
                                  length, 0.062f * size * shoot_m * to_texels, 0.8f * hash_signed(g, 3) / std::max(length, 1.0f)};
                const float light = 0.85f + 0.3f * hash_unit(g, 4);
                draw_stroke(surface, leaf, [&](MaterialTexel& texel, float t, float across) {
                    const float height = foot + tall * (1.0f - 0.7f * t * t) - 0.0003f * across * across;
                    if (height < texel.height_m) return;
                    // Leaves of one shoot part: the lower stay in the shade of the upper.
                    texel.height_m = height;
                    texel.albedo = tip * light * mix(0.95f, 0.60f, t) * (0.62f + 0.38f * high) * (1.0f - 0.18f * across * across);
                    texel.roughness = 0.76f + 0.10f * (1.0f - high);
                });
            }
        }
    }
}

// Earth that was wet: pressed by wheels, or dried and cracked.
void make_mud(MaterialSurface& surface)
{
    const float dry = surface.value("dryness");
    const float cracked = surface.value("cracks");
    const float plate_m = surface.value("plate_m");
    const float stony = surface.value("stones");
    const int ruts = surface.count("ruts");
    const auto waves = noise_layer(surface, {0.50f, 0.50f, 4, 0.48f, 1});
    const auto lumps = noise_layer(surface, {0.10f, 0.10f, 5, 0.52f, 2});
    const auto warp_x = noise_layer(surface, {0.06f, 0.06f, 5, 0.58f, 3});
    const auto warp_y = noise_layer(surface, {0.06f, 0.06f, 5, 0.58f, 4});
    const auto fine = noise_layer(surface, {0.006f, 0.006f, 3, 0.6f, 5});
    const auto silt = noise_layer(surface, {0.30f, 0.30f, 5, 0.6f, 6});
    const auto grit = noise_layer(surface, {0.0060f, 0.0060f, 2, 0.8f, 8});
    const auto crumbs = noise_layer(surface, {0.028f, 0.028f, 4, 0.62f, 9});
    const auto sway = noise_layer(surface, {1.0f * surface.tile_m, 0.5f * surface.tile_m, 2, 0.5f, 7});
    const StoneLayer pebbles(surface, {.size_m = 0.030f, .roundness = 0.65f, .flatness = 0.55f, .spread_m = 0.004f,
                                       .sunk_m = 0.007f, .share = 0.55f * stony, .salt = 5});
    const int cells = surface.cells(plate_m), small_cells = surface.cells(0.38f * plate_m);
    const float to_cells = static_cast<float>(cells) / surface.tile_m;
    const float to_small = static_cast<float>(small_cells) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 91u);
    const vec3 kWet(0.058f, 0.041f, 0.027f), kDry(0.225f, 0.180f, 0.130f);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        MaterialTexel texel;
        float height = 0.010f * waves[k] + 0.0045f * lumps[k] + 0.0004f * fine[k];
        // Pools leave it smooth, what stands higher is crumbly.
        const float rough_ground = smooth_step(-0.006f, 0.008f, height);
        height += rough_ground * (0.0022f * crumbs[k] + 0.0005f * grit[k]);
        // Ruts: the earth is pressed down and out, lugs of the tyre stand in rows of chevrons.
        float lowest = 1.0f;
        for (int r = 0; r < ruts; ++r) {
            const float middle = surface.tile_m * (static_cast<float>(r) + 0.5f) / static_cast<float>(ruts);
            const float across = x - middle + 0.02f * sway[k] + 0.006f * warp_x[k];
            const float a = std::abs(across);
            if (a > 0.30f) continue;
            const float bed = 1.0f - smooth_step(0.085f, 0.13f, a);
            const float wall = std::max(0.0f, 1.0f - (a - 0.155f) * (a - 0.155f) / 0.0030f);
            const float lugs = surface.tile_m / std::max(1.0f, std::round(surface.tile_m / 0.065f));
            const float along = (y + 0.55f * a) / lugs;
            const float phase = along - std::floor(along);
            const float lug = smooth_step(0.08f, 0.20f, phase) * (1.0f - smooth_step(0.52f, 0.66f, phase)) *
                              smooth_step(0.006f, 0.014f, a) * (1.0f - smooth_step(0.085f, 0.11f, a));
            const float clear = smooth_step(-0.9f, 0.2f, silt[k] + 0.4f * lumps[k]);
            height = mix(height, 0.25f * height - 0.034f - 0.011f * lug * clear, bed) + 0.013f * wall * (0.8f + 0.5f * lumps[k]);
            lowest = std::min(lowest, 1.0f - bed);
        }
        // Shrinkage: plates that curl up at their edges, split again into smaller ones.
        float crack = 0.0f, curl = 0.0f;
        if (cracked > 0.0f) {
            const CellBorder plate = cell_border((x + 0.10f * plate_m * warp_x[k]) * to_cells, (y + 0.10f * plate_m * warp_y[k]) * to_cells,
                                               cells, cells, seed, 0.9f);
            const CellBorder piece = cell_border((x + 0.07f * plate_m * warp_x[k]) * to_small, (y + 0.07f * plate_m * warp_y[k]) * to_small,
                                               small_cells, small_cells, seed + 1u, 0.9f);
            const float dryness = smooth_step(1.0f - 1.7f * cracked, 1.7f - 1.7f * cracked, 0.75f + 0.45f * silt[k]);
            const float gape_m = 0.075f * plate_m * dryness * (0.7f + 0.6f * hash_unit(plate.id, 2));
            const float seam_m = plate.distance / to_cells;
            const float small_gape_m = 0.022f * plate_m * dryness * (hash_unit(plate.id, 3) < 0.6f ? 1.0f : 0.0f);
            const float small_seam_m = piece.distance / to_small;
            crack = dryness * std::max(1.0f - smooth_step(0.45f * gape_m, gape_m + 0.0005f, seam_m),
                                       small_gape_m > 0.0f ? 0.7f * (1.0f - smooth_step(0.4f * small_gape_m, small_gape_m + 0.0004f, small_seam_m)) : 0.0f);
            curl = dryness * (1.0f - smooth_step(gape_m, 0.30f * plate_m, seam_m));
            height += 0.05f * plate_m * curl * curl + 0.02f * plate_m * dryness * hash_signed(plate.id, 4) - 0.22f * plate_m * crack;
        }
        texel.height_m = height;
        const float moist = saturate(1.15f - 1.3f * dry - 0.35f * silt[k] - 0.25f * smooth_step(-0.01f, 0.02f, height) + 0.35f * crack);
        vec3 color = mix(kDry, kWet, moist) * (1.0f + 0.09f * fine[k] + 0.10f * silt[k] + 0.06f * lumps[k] + rough_ground * (0.10f * grit[k] + 0.10f * crumbs[k]));
        color = mix(color, 1.18f * color, 0.5f * curl);
        color *= 1.0f - 0.72f * crack;
        // Wet mud is glossy where water stands just below its skin.
        const float skin = moist * smooth_step(0.004f, -0.012f, height + 0.003f * lumps[k]);
        texel.roughness = mix(0.93f, mix(0.62f, 0.22f, skin), smooth_step(0.35f, 0.9f, moist)) + 0.03f * fine[k];
        const StoneAt stone = pebbles.at(x + 0.002f * warp_x[k], y + 0.002f * warp_y[k]);
        if (stone.height_m > -1.0f) {
            const float top = stone.height_m + 0.8f * (0.010f * waves[k]) - 0.034f * (1.0f - lowest);
            const float cover = smooth_step(-0.0008f, 0.0010f, top - texel.height_m);
            const vec3 rock = mix(vec3(0.105f, 0.098f, 0.088f), vec3(0.235f, 0.210f, 0.170f), hash_unit(stone.id, 41));
            color = mix(color, mix(color, rock, 0.65f), cover);
            texel.height_m = std::max(texel.height_m, top);
            texel.roughness = mix(texel.roughness, 0.62f, cover);
        }
        texel.albedo = color;
        return texel;
    });
    draw_fibres(surface, {.count_m2 = 90.0f * surface.value("litter"), .length_m = 0.08f, .width_m = 0.0018f,
                          .rise_m = 0.0013f, .color = vec3(0.200f, 0.155f, 0.090f), .salt = 7});
}

// A print of a boot in snow, metres about its middle, v towards the toe: how deep the snow is pressed down (0..1), and
// how far a place is from its outline (positive within).
struct Boot {
    float outline_m;
    float tread;  ///< 0..1, the bars of the sole
};

Boot boot_at(float u, float v)
{
    const auto ellipse = [&](float cu, float cv, float ru, float rv) {
        const float a = (u - cu) / ru, b = (v - cv) / rv;
        return (1.0f - std::sqrt(a * a + b * b)) * std::min(ru, rv);
    };
    // Ball, heel, and the waist that joins them.
    const float ball = ellipse(0.004f, 0.052f, 0.052f, 0.103f), heel = ellipse(0.0f, -0.100f, 0.040f, 0.056f),
                waist = ellipse(0.006f, -0.030f, 0.034f, 0.085f);
    Boot boot{};
    boot.outline_m = std::max(std::max(ball, heel), waist);
    const float bar = (v + 0.35f * std::abs(u)) / 0.021f;
    const float phase = bar - std::floor(bar);
    const float arch = smooth_step(0.012f, 0.030f, std::abs(v + 0.040f));
    boot.tread = smooth_step(0.10f, 0.30f, phase) * (1.0f - smooth_step(0.60f, 0.80f, phase)) * arch *
                 smooth_step(0.004f, 0.010f, boot.outline_m);
    return boot;
}

struct Print {
    float x_m, y_m, cosine, sine, side, depth_m;
};

// Trails along v: left and right by turns, a step of about 0.36 m, toes a little out.
std::vector<Print> make_prints(const MaterialSurface& surface, int trails, std::uint32_t seed)
{
    std::vector<Print> prints;
    const int steps = 2 * std::max(1, static_cast<int>(std::lround(surface.tile_m / 0.72f)));
    for (int trail = 0; trail < trails; ++trail) {
        const std::uint32_t h = hash_cell(trail, 7, seed);
        const float middle = surface.tile_m * (static_cast<float>(trail) + 0.5f + 0.25f * hash_signed(h, 1)) / static_cast<float>(trails);
        const bool back = hash_unit(h, 2) < 0.5f;
        for (int step = 0; step < steps; ++step) {
            const std::uint32_t g = hash_cell(step, trail, seed + 3u);
            const float side = (step & 1) != 0 ? 1.0f : -1.0f;
            const float sway = 0.05f * portable_sin(6.2831853f * (static_cast<float>(step) / static_cast<float>(steps) + hash_unit(h, 3)));
            float turn = side * (0.10f + 0.08f * hash_signed(g, 1)) + 0.06f * hash_signed(g, 2);
            if (back) turn += 3.1415927f;
            prints.push_back({middle + sway + side * (0.085f + 0.02f * hash_signed(g, 3)),
                              surface.tile_m * (static_cast<float>(step) + 0.5f + 0.14f * hash_signed(g, 4)) / static_cast<float>(steps),
                              portable_cos(turn), portable_sin(turn), side, 0.034f + 0.012f * hash_unit(g, 5)});
        }
    }
    return prints;
}

// Wind-packed: drifts, ripples across the wind, a crust of grains; trodden where people went.
void make_snow(MaterialSurface& surface)
{
    const float drift_m = surface.value("drift_m");
    const float ripple_m = surface.value("ripples");
    const float dirt = surface.value("dirt");
    const float crust = surface.value("crust");
    const auto drifts = noise_layer(surface, {0.9f, 0.55f, 3, 0.42f, 1});
    const auto bend = noise_layer(surface, {0.45f, 0.60f, 4, 0.5f, 2});
    const auto scour = noise_layer(surface, {0.06f, 0.20f, 4, 0.55f, 3});
    const auto lumps = noise_layer(surface, {0.035f, 0.035f, 4, 0.6f, 4});
    const auto grain = noise_layer(surface, {0.0060f, 0.0060f, 3, 0.8f, 5});
    const auto specks = noise_layer(surface, {0.016f, 0.016f, 4, 0.7f, 6});
    const StoneLayer clumps(surface, {.size_m = 0.022f, .roundness = 0.6f, .flatness = 0.5f, .spread_m = 0.002f,
                                      .sunk_m = 0.003f, .share = 0.75f, .salt = 3});
    const std::vector<Print> prints = make_prints(surface, surface.count("footprints"), hash_u32(surface.seed + 83u));
    const int waves = std::max(1, surface.cells(0.16f));
    const float to_turns = 6.2831853f * static_cast<float>(waves) / surface.tile_m;
    const auto around = [&](float d) { return d - surface.tile_m * std::round(d / surface.tile_m); };
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Ripples: gentle to windward, steep to lee.
        const float turn = to_turns * x + 3.0f * bend[k] + 1.2f * drifts[k];
        const float wave = portable_sin(turn + 0.55f * portable_sin(turn));
        const float strong = smooth_step(-0.5f, 0.8f, drifts[k] + 0.5f * bend[k]);
        // The print that lies deepest here, and the rim that it pushed up.
        float pressed = 0.0f, depth_m = 0.0f, rim = 0.0f, tread = 0.0f;
        for (const Print& p : prints) {
            const float dx = around(x - p.x_m), dy = around(y - p.y_m);
            if (std::abs(dx) > 0.30f || std::abs(dy) > 0.30f) continue;
            const float u = p.side * (p.cosine * dx - p.sine * dy), v = -(p.sine * dx + p.cosine * dy);
            const Boot boot = boot_at(u, v);
            const float outline_m = boot.outline_m + 0.0035f * lumps[k] + 0.0012f * grain[k];
            const float down = smooth_step(-0.006f, 0.007f, outline_m);
            if (down * p.depth_m > pressed * depth_m) {
                pressed = down;
                depth_m = p.depth_m * (1.0f + 0.5f * v);  // the toe goes deeper
                tread = boot.tread;
            }
            // Snow heaved up about it, most behind the toe's push, in crumbs.
            const float out = -outline_m;
            rim = std::max(rim, smooth_step(-0.004f, 0.006f, out) * (1.0f - smooth_step(0.010f, 0.060f, out + 0.012f * lumps[k])));
        }
        rim *= 1.0f - pressed;
        const float open = 1.0f - pressed;
        const StoneAt clump = rim > 0.0f ? clumps.at(x, y) : StoneAt{};
        const float crumb = rim > 0.0f && clump.height_m > -1.0f ? std::max(clump.height_m + 0.003f, 0.0f) * smooth_step(0.15f, 0.8f, rim * (0.55f + hash_unit(clump.id, 40))) : 0.0f;
        MaterialTexel texel;
        texel.height_m = drift_m * (0.5f * drifts[k] + 0.12f * bend[k]) +
                         open * (0.010f * ripple_m * strong * wave + 0.0045f * ripple_m * scour[k] + 0.0022f * lumps[k] * (1.0f - 0.6f * crust) +
                                 0.00060f * grain[k] * (1.0f - 0.55f * crust)) +
                         0.005f * rim + crumb - pressed * depth_m + pressed * (0.0045f * tread + 0.0006f * lumps[k] + 0.00025f * grain[k]);
        // Old snow is darker in its hollows: dust, and grains that have grown.
        const float hollow = smooth_step(0.3f, -0.8f, 0.6f * drifts[k] + 0.5f * wave * ripple_m);
        vec3 color = vec3(0.868f, 0.880f, 0.896f) - 0.028f * hollow * vec3(1.0f, 0.92f, 0.75f) + 0.016f * grain[k] + 0.008f * lumps[k];
        color = mix(color, vec3(0.775f, 0.798f, 0.825f), 0.8f * pressed * (1.0f - 0.5f * tread));  // packed: light goes deeper in
        const float soil = smooth_step(0.95f - 0.75f * dirt, 1.55f - 0.75f * dirt, specks[k] + 0.5f * hollow + 0.35f * pressed);
        color = mix(color, vec3(0.115f, 0.098f, 0.078f), dirt > 0.0f ? 0.75f * soil : 0.0f);
        color = mix(color, vec3(0.62f, 0.59f, 0.55f), 0.35f * dirt * std::max(hollow, 0.8f * pressed));
        texel.albedo = color;
        const float smooth_crust = crust * smooth_step(-0.6f, 0.5f, bend[k] - 0.3f * wave) * open * (1.0f - rim);
        texel.roughness = mix(mix(0.78f, 0.46f, smooth_crust), 0.56f, pressed) + 0.09f * grain[k];
        return texel;
    });
}

}  // namespace

std::vector<KindRow> soft_kinds()
{
    return {{MaterialKind::Moss, "moss", "cushions of small shoots", 0.4f,
             {{"cushion_m", "m", 0.055f, 0.01f, 0.4f, "of a cushion"},
              {"shoot_m", "m", 0.0045f, 0.001f, 0.03f, "width of a shoot's star of leaves"},
              {"dryness", "share", 0.35f, 0.0f, 1.0f, "brown shoots"}},
             make_moss},
            {MaterialKind::Mud, "mud", "wet or dried earth: wheel ruts, shrinkage cracks", 1.6f,
             {{"dryness", "share", 0.25f, 0.0f, 1.0f, "0 dark and glossy, 1 pale and matt"},
              {"cracks", "share", 0.0f, 0.0f, 1.0f, "of shrinkage, where it has dried"},
              {"plate_m", "m", 0.16f, 0.03f, 1.0f, "between large cracks"},
              {"ruts", "count", 0.0f, 0.0f, 8.0f, "of wheels along v"},
              {"stones", "share", 0.25f, 0.0f, 1.0f, "pebbles"},
              {"litter", "share", 0.3f, 0.0f, 1.0f, "dry stalks"}},
             make_mud},
            {MaterialKind::Snow, "snow", "wind-packed snow", 2.0f,
             {{"drift_m", "m", 0.05f, 0.0f, 0.4f, "height of its drifts"},
              {"ripples", "share", 0.5f, 0.0f, 1.0f, "ripples and furrows of the wind"},
              {"crust", "share", 0.2f, 0.0f, 1.0f, "smooth ice of thaw and frost"},
              {"footprints", "count", 0.0f, 0.0f, 6.0f, "trails of boots along v"},
              {"dirt", "share", 0.0f, 0.0f, 1.0f, "dust and specks"}},
             make_snow}};
}

}  // namespace petrichor::texproc::detail
