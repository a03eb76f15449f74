// Wood and metal.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/colonies.h"

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

// Rust on a sheet: where it is, how old, and what it leaves below itself. Its edge is a crowd of spots that have grown
// together, old rust is thick, dark and scales off.
struct RustAt {
    float cover = 0.0f;    ///< of the metal, 0..1
    float height_m = 0.0f; ///< it swells
    float roughness = 0.9f;
    vec3 color{0.15f, 0.06f, 0.03f};
};

class Rust {
public:
    Rust(const MaterialSurface& surface, std::uint32_t salt)
        : spots_(surface, 0.013f, salt), specks_(surface, 0.005f, salt + 1u),
          coarse_(noise_layer(surface, {0.045f, 0.045f, 4, 0.55f, 800u + salt})),
          grain_(noise_layer(surface, {0.0045f, 0.0045f, 2, 0.7f, 801u + salt})),
          hue_(noise_layer(surface, {0.075f, 0.075f, 5, 0.6f, 802u + salt})),
          scale_x_(noise_layer(surface, {0.016f, 0.016f, 3, 0.55f, 803u + salt})),
          scale_cells_(surface.cells(0.016f)), to_scales_(static_cast<float>(scale_cells_) / surface.tile_m),
          seed_(hash_u32(surface.seed + 411u * salt))
    {
    }

    /// `level` is 0 where rust begins, 1 where it is old; below 0 there are spots, further down a few specks.
    RustAt at(float x, float y, std::size_t k, float level) const
    {
        RustAt rust;
        const float body = smooth_step(-0.06f, 0.22f, level + 0.10f * coarse_[k] + 0.09f * grain_[k]);
        const ColonyAt spot = spots_.at(x, y, saturate(0.55f + 0.95f * level));
        const ColonyAt speck = specks_.at(x, y, saturate(0.34f + 0.62f * level));
        const float spotted = std::max(smooth_step(-0.05f, 0.55f, spot.inside + 0.42f * grain_[k] + 0.35f * scale_x_[k]),
                                       0.85f * smooth_step(0.0f, 0.50f, speck.inside + 0.25f * grain_[k]));
        rust.cover = std::max(body, spotted);
        if (rust.cover <= 0.0f) return rust;
        const float old = smooth_step(0.15f, 0.95f, level + 0.30f * hue_[k] + 0.12f * coarse_[k]);
        // Scales: plates a few millimetres wide that lift at their edges; some have fallen.
        const CellBorder scale = cell_border((x + 0.006f * scale_x_[k]) * to_scales_, (y - 0.006f * coarse_[k]) * to_scales_,
                                             scale_cells_, scale_cells_, seed_, 0.95f);
        const float edge_m = scale.distance / to_scales_;
        const float fallen = old * (hash_unit(scale.id, 1) < 0.35f ? 1.0f : 0.0f) * smooth_step(0.0f, 0.0012f, edge_m);
        const float lip = old * (1.0f - smooth_step(0.0f, 0.0022f, edge_m));
        rust.height_m = rust.cover * (0.00022f + 0.00030f * body + 0.00035f * old + 0.00013f * grain_[k] + 0.00010f * coarse_[k] +
                                      0.00016f * lip - 0.00034f * fallen);
        const vec3 kOchre(0.270f, 0.132f, 0.052f), kOrange(0.172f, 0.066f, 0.027f), kRed(0.098f, 0.038f, 0.021f),
            kDark(0.046f, 0.025f, 0.019f);
        const float tone = 0.10f + 0.38f * saturate(level) + 0.34f * hue_[k] + 0.24f * grain_[k] + 0.24f * body + 0.14f * hash_signed(spot.id, 5);
        vec3 color = mix(kOchre, kOrange, smooth_step(-0.15f, 0.30f, tone));
        color = mix(color, kRed, smooth_step(0.25f, 0.65f, tone));
        color = mix(color, kDark, 0.9f * smooth_step(0.55f, 1.05f, tone));
        color = mix(color, kOrange * 1.15f, 0.65f * fallen);
        color *= (1.0f + 0.16f * grain_[k]) * (1.0f - 0.35f * lip) * (1.0f + 0.14f * hash_signed(scale.id, 2) * old);
        rust.color = color;
        rust.roughness = 0.90f - 0.09f * old * (1.0f - fallen) + 0.05f * grain_[k];
        return rust;
    }

private:
    Colonies spots_, specks_;
    std::vector<float> coarse_, grain_, hue_, scale_x_;
    int scale_cells_;
    float to_scales_;
    std::uint32_t seed_;
};

// What rain carries down from a source: each texel keeps a share of the one above. Twice round, so that it repeats.
std::vector<float> run_down(const MaterialSurface& surface, const std::vector<float>& source, const std::vector<float>& streak,
                            float length_m)
{
    const auto n = static_cast<std::size_t>(surface.size);
    std::vector<float> run(source.size(), 0.0f);
    for_rows(surface.size, surface.threads, [&](int first, int last) {
        for (int i = first; i < last; ++i) {
            float carried = 0.0f;
            for (std::size_t j = 0; j < 2 * n; ++j) {
                const std::size_t k = (j % n) * n + static_cast<std::size_t>(i);
                const float kept = 1.0f - surface.texel_m() / (length_m * std::clamp(1.0f + 1.1f * streak[k], 0.15f, 2.5f));
                carried = std::max(source[k], carried * std::max(kept, 0.0f));
                run[k] = carried;
            }
        }
    });
    return run;
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
    const auto run = noise_layer(surface, {0.014f, 0.40f, 4, 0.6f, 7});
    const auto scratches = scratch_layer(surface, static_cast<int>(110.0f * scratched), 0.24f, 6);
    const float spangle_m = surface.value("spangle_m");
    const std::uint32_t seed = hash_u32(surface.seed + 21u);
    const Rust rust(surface, 3);
    // Where the zinc is gone, and the stain that rain washes down from there.
    std::vector<float> level(dull.size()), stain(dull.size());
    if (rusty > 0.0f) {
        // No part of the tile is much worse off than another: a blotch that stands out would be seen in every repeat.
        const auto eaten = noise_layer(surface, {0.085f, 0.085f, 5, 0.62f, 8});
        for (std::size_t k = 0; k < level.size(); ++k) level[k] = 0.30f * dull[k] + 0.55f * eaten[k];
        const int quarter = std::min(static_cast<int>(0.10f / surface.texel_m()), surface.size / 4);
        std::vector<float> broad = level;
        for (int pass = 0; pass < 2; ++pass) broad = box_blur(broad, surface.size, quarter, surface.threads);
        for (std::size_t k = 0; k < level.size(); ++k)
            level[k] += 0.16f * run[k] + 0.14f * warp_x[k] + 2.1f * rusty - 1.30f - broad[k];
        for (std::size_t k = 0; k < level.size(); ++k) stain[k] = smooth_step(-0.25f, 0.25f, level[k]);
        stain = run_down(surface, stain, run, 0.16f);
        stain = box_blur(stain, surface.size, static_cast<int>(0.0015f / surface.texel_m()), surface.threads);
    }
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
            const float wander = 0.16f * spangle_m;
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
        // Arms of a fir branch: ribs that lean away from its axis, finer in some crystals, unseen in others.
        const float rib = portable_sin(mix(38.0f, 75.0f, hash_unit(crystal.id, 7)) * (along + 0.75f * std::abs(across)) + 1.5f * warp_x[k]);
        const float feather = rib * smooth_step(0.02f, 0.25f, crystal.second - crystal.nearest) * smooth_step(0.35f, 0.9f, hash_unit(crystal.id, 8));
        const float border = 1.0f - smooth_step(0.01f, 0.07f, crystal.second - crystal.nearest);
        // Zinc goes dull and chalky with the years, in clouds; below its bloom the crystals fade.
        const float aged = smooth_step(-0.5f, 0.9f, dull[k] + 0.25f * run[k] + 0.5f * rusty);
        const float white_rust = smooth_step(0.45f, 1.05f, dull[k] + 0.16f * warp_y[k] + 0.12f * fine[k]) * (0.6f + 0.4f * smooth_step(-0.2f, 0.6f, fine[k] + warp_x[k]));
        const float shown = 1.0f - 0.55f * aged;
        MaterialTexel texel;
        // Each crystal is a facet: a degree or so out of the sheet's plane.
        const float tilt = 0.010f * size_m * (along * hash_signed(crystal.id, 5) + across * hash_signed(crystal.id, 6));
        texel.height_m = 0.00050f * waves[k] + tilt * shown - 0.00001f * border + 0.000004f * feather +
                         0.000006f * fine[k] - 0.00012f * scratches[k] + 0.00003f * white_rust;
        vec3 color = vec3(0.530f, 0.540f, 0.548f) * (1.0f + shown * (0.13f * tone + 0.045f * feather - 0.06f * border));
        color *= 1.0f - 0.16f * aged + 0.02f * fine[k];
        color = mix(color, vec3(0.68f, 0.69f, 0.70f), 0.75f * saturate(4.0f * scratches[k]));
        color = mix(color, vec3(0.50f, 0.50f, 0.485f) * (1.0f + 0.06f * fine[k]), 0.65f * white_rust);
        texel.metallic = (1.0f - 0.20f * aged) * (1.0f - 0.60f * white_rust);
        texel.roughness = 0.34f + 0.08f * shown * tone + 0.03f * feather + 0.05f * border + 0.14f * aged +
                          0.22f * white_rust - 0.22f * scratches[k] + 0.03f * fine[k];
        if (rusty > 0.0f) {
            const float washed = 0.85f * stain[k] * (0.6f + 0.4f * smooth_step(-0.6f, 0.6f, run[k]));
            color = mix(color, vec3(0.235f, 0.128f, 0.066f) * (1.0f + 0.10f * run[k]), 0.80f * washed);
            texel.metallic *= 1.0f - 0.75f * washed;
            texel.roughness = mix(texel.roughness, 0.72f, washed);
            const RustAt red = rust.at(x, y, k, level[k]);
            // Round every spot the zinc is eaten: a dark, dull halo.
            color = mix(color, red.color, red.cover);
            texel.metallic *= 1.0f - red.cover;
            texel.roughness = mix(texel.roughness, red.roughness, red.cover);
            texel.height_m += red.height_m;
        }
        texel.albedo = color;
        return texel;
    });
}

// Oil paint on a casting: chalked where the sun reaches it, blistered and chipped where rust lifts it.
void make_painted_iron(MaterialSurface& surface)
{
    const float chipped = surface.value("wear");
    const auto cast = noise_layer(surface, {0.012f, 0.012f, 3, 0.55f, 1});
    const auto waves = noise_layer(surface, {0.13f, 0.13f, 4, 0.45f, 2});
    const auto wear = noise_layer(surface, {0.10f, 0.10f, 4, 0.50f, 3});
    const auto fine = noise_layer(surface, {0.005f, 0.005f, 2, 0.6f, 4});
    const auto run = noise_layer(surface, {0.012f, 0.30f, 4, 0.6f, 5});
    const Colonies chips(surface, 0.040f, 6);
    const Rust rust(surface, 7);
    // Old paint breaks into plates, and comes off plate by plate: the upper coats first, then the primer.
    const int plates = surface.cells(0.0075f);
    const float to_plates = static_cast<float>(plates) / surface.tile_m;
    const std::uint32_t seed = hash_u32(surface.seed + 61u);
    const auto plate_at = [&](float x, float y, std::size_t k) {
        return cell_border((x + 0.0016f * cast[k]) * to_plates, (y + 0.0016f * fine[k]) * to_plates, plates, plates, seed, 0.95f).id;
    };
    // How deep in a chip: > -0.3 where the upper coats are off, > 0 where the primer is.
    std::vector<float> depth(wear.size()), stain(wear.size());
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const ColonyAt chip = chips.at(x, y, saturate(0.7f * chipped * smooth_step(0.2f, 1.2f, wear[k] + 0.7f * chipped)));
        const float lost = wear[k] + 0.10f * cast[k] - 1.18f + 0.75f * (chipped - 0.5f);
        depth[k] = std::max(1.6f * lost, chip.inside > -1.0f ? 0.7f * (chip.inside - 0.25f) + 0.34f * cast[k] + 0.30f * wear[k] : -1.0f);
        if (depth[k] > -0.9f) depth[k] += 0.24f * hash_signed(plate_at(x, y, k), 1);
        stain[k] = smooth_step(0.05f, 0.35f, depth[k]);
        return MaterialTexel{};
    });
    stain = run_down(surface, stain, run, 0.022f);
    stain = box_blur(stain, surface.size, static_cast<int>(0.0022f / surface.texel_m()), surface.threads);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const float bare = smooth_step(0.0f, 0.10f, depth[k]);
        const float primer = smooth_step(-0.32f, -0.28f, depth[k] + 0.03f * fine[k]) * (1.0f - bare);
        const float lifted = smooth_step(-0.70f, -0.30f, depth[k]) * (1.0f - bare) * (1.0f - primer);
        const float chalk = smooth_step(-0.5f, 0.9f, waves[k] - 0.3f * wear[k]);
        MaterialTexel texel;
        texel.height_m = 0.00022f * cast[k] + 0.0004f * waves[k] + 0.00012f * lifted - 0.00016f * primer - 0.00030f * bare;
        vec3 color = vec3(0.0165f, 0.0205f, 0.0195f) * (1.0f + 0.25f * waves[k] + 0.06f * fine[k]);
        color = mix(color, vec3(0.040f, 0.044f, 0.042f), 0.28f * chalk);
        color = mix(color, vec3(0.062f, 0.036f, 0.022f), 0.30f * lifted);
        // Red oxide, dull and dirty.
        color = mix(color, vec3(0.088f, 0.034f, 0.024f) * (1.0f + 0.18f * fine[k] + 0.12f * waves[k]), 0.92f * primer);
        color = mix(color, vec3(0.100f, 0.052f, 0.027f), 0.38f * stain[k] * (1.0f - bare));
        texel.roughness = 0.38f + 0.05f * waves[k] + 0.04f * fine[k] + 0.16f * chalk + 0.12f * lifted + 0.14f * stain[k];
        texel.roughness = mix(texel.roughness, 0.78f + 0.04f * fine[k], primer);
        if (bare > 0.0f) {
            // What came off last shows the dark skin of the casting, with the first spots of rust.
            const std::uint32_t plate = plate_at(x, y, k);
            const float age = 0.9f * (hash_unit(plate, 2) - 0.45f) + 0.9f * depth[k];
            const RustAt red = rust.at(x, y, k, age);
            const vec3 skin = vec3(0.030f, 0.027f, 0.026f) * (1.0f + 0.3f * cast[k] + 0.2f * fine[k]);
            color = mix(color, mix(skin, red.color, red.cover), bare);
            texel.roughness = mix(texel.roughness, mix(0.66f, red.roughness, red.cover), bare);
            texel.height_m += 0.6f * red.height_m * bare;
        }
        texel.albedo = color;
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
