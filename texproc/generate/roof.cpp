// Roofs: clay tiles, slates, sheet with seams.
#include <array>

#include "texproc/generate/detail/colonies.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

void make_roof_tile(MaterialSurface& surface)
{
    surface.occlusion_strength = 0.6f;
    // Courses are laid in halves: an even number of them repeats.
    const int columns = surface.cells(surface.value("tile_width_m"));
    const int courses = 2 * std::max(1, static_cast<int>(std::lround(0.5f * surface.tile_m / surface.value("course_m"))));
    const float grown = 2.0f * surface.value("moss");
    const float width_m = surface.tile_m / static_cast<float>(columns);
    const float course_m = surface.tile_m / static_cast<float>(courses);
    const auto warp = noise_layer(surface, {0.24f, 0.24f, 4, 0.5f, 1});
    const auto rough = noise_layer(surface, {0.020f, 0.020f, 4, 0.6f, 2});
    const auto fine = noise_layer(surface, {0.007f, 0.007f, 2, 0.6f, 3});
    const auto lichen = noise_layer(surface, {0.09f, 0.09f, 4, 0.6f, 4});
    const auto sand = noise_layer(surface, {0.0035f, 0.0035f, 1, 0.6f, 6});
    const auto wash = noise_layer(surface, {0.022f, 0.20f, 4, 0.6f, 7});
    const Lichen crusts(surface, 11);
    const auto stain = noise_layer(surface, {0.36f, 0.72f, 4, 0.55f, 5});
    static const std::array<vec3, 6> kTiles = {
        vec3(0.290f, 0.108f, 0.062f), vec3(0.235f, 0.085f, 0.052f), vec3(0.330f, 0.140f, 0.082f),
        vec3(0.185f, 0.078f, 0.056f), vec3(0.255f, 0.120f, 0.080f), vec3(0.135f, 0.078f, 0.062f)};
    const std::uint32_t seed = surface.seed;

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        struct Hit {
            float below;   ///< metres up from the tail
            float across;  ///< -1 .. 1
            std::uint32_t id;
        };
        // Tail of the tile of row j at this x: an arc that hangs lowest in the middle.
        const auto tile_at = [&](int j) {
            const float shift = (j & 1) != 0 ? 0.5f : 0.0f;
            const float column = (x + 0.0010f * warp[k]) / width_m + shift;
            const float i = std::floor(column);
            const float across = 2.0f * (column - i) - 1.0f;
            const std::uint32_t id =
                hash_cell(wrap_index(static_cast<int>(i), columns), wrap_index(j, courses), seed);
            const float arc =
                0.042f * (1.0f - std::sqrt(std::max(0.0f, 1.0f - 0.93f * across * across)));
            const float tail = static_cast<float>(j + 1) * course_m - arc +
                               0.004f * hash_signed(id, 1) + 0.003f * hash_signed(id, 2) * across +
                               0.0008f * rough[k];
            return Hit{tail - y, across, id};
        };
        // Rows lie like scales, the upper over the lower: the first tail below y is the one seen.
        int j = static_cast<int>(std::floor(y / course_m)) - 1;
        Hit hit = tile_at(j);
        while (hit.below < 0.0f) hit = tile_at(++j);

        const std::uint32_t id = hit.id;
        const float gap = smooth_step(0.985f, 0.999f, std::abs(hit.across));
        const float up = hit.below / course_m;
        const float lip = saturate(hit.below / 0.006f);
        MaterialTexel texel;
        texel.height_m = 0.013f * std::sqrt(lip * (2.0f - lip)) - 0.0115f * std::min(up, 1.35f) +
                         0.0022f * (1.0f - hit.across * hit.across) + 0.0015f * hash_signed(id, 3) +
                         0.0012f * hash_signed(id, 4) * hit.across + 0.0006f * rough[k] +
                         0.00022f * fine[k] + 0.00010f * sand[k] - 0.0010f * smooth_step(0.75f, 1.25f, fine[k] + 0.4f * rough[k]) - 0.005f * gap;
        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 5) * 6.0f) % 6u;
        vec3 color = kTiles[pick] * (1.0f + 0.16f * hash_signed(id, 6));
        color *= 1.0f + 0.13f * rough[k] + 0.09f * fine[k] + 0.08f * sand[k];
        // Fired unevenly: a cloud on some, a dark end on others; then soot and algae, most where rain stays.
        color = mix(color, 0.45f * color + vec3(0.010f), saturate(1.3f * smooth_step(0.1f, 1.0f, hash_signed(id, 7) * hit.across + 0.6f * warp[k] + 0.5f * hash_signed(id, 8))) * 0.55f);
        const float soiled = smooth_step(-0.5f, 1.0f, stain[k] + 0.35f * wash[k] + 0.35f * hash_signed(id, 9));
        color = mix(color, 0.38f * color + vec3(0.012f, 0.012f, 0.010f), (0.30f + 0.35f * grown) * soiled);
        color = mix(color, 0.5f * color, smooth_step(0.5f, 1.1f, up) * 0.6f + 0.6f * gap);
        // The tail is chipped and paler, where frost took it.
        color = mix(color, 1.25f * color + vec3(0.02f, 0.010f, 0.006f), 0.6f * (1.0f - smooth_step(0.0f, 0.006f, hit.below + 0.003f * rough[k])));
        const LichenAt crust = crusts.at(x, y, k, 0.55f * std::min(grown, 1.6f) * (0.35f + 0.65f * smooth_step(1.1f, 0.3f, up)));
        color = mix(color, crust.color, 0.78f * crust.cover);
        // Moss fills the laps from above, in pads that thin out downwards.
        const float green = grown * smooth_step(-0.1f, 0.9f, stain[k] + 0.35f * lichen[k]);
        const float moss = std::min(smooth_step(0.05f, 0.45f, green * smooth_step(0.50f, 1.05f, up) + 0.16f * rough[k] + 0.14f * fine[k] - 0.05f) *
                                        smooth_step(0.0f, 0.2f, green), 1.0f);
        color = mix(color, mix(vec3(0.040f, 0.054f, 0.014f), vec3(0.115f, 0.125f, 0.030f), saturate(0.45f + 0.4f * fine[k] + 0.3f * sand[k])), 0.92f * moss);
        texel.height_m += crust.thick_m + moss * (0.0032f + 0.0009f * fine[k] + 0.0005f * sand[k]);
        texel.albedo = color;
        texel.roughness = mix(0.76f + 0.05f * rough[k] + 0.04f * sand[k] + 0.08f * hash_signed(id, 10) - 0.06f * soiled, 0.93f, std::max(moss, 0.8f * crust.cover));
        return texel;
    });
}

void make_standing_seam(MaterialSurface& surface)
{
    const int sheets = surface.cells(surface.value("sheet_m"));
    const float sheet_m = surface.tile_m / static_cast<float>(sheets);
    const float worn = 2.0f * surface.value("wear");
    const auto can = noise_layer(surface, {0.20f, 0.53f, 3, 0.45f, 1});
    const auto streak = noise_layer(surface, {0.032f, 0.53f, 5, 0.6f, 2});
    const auto patch = noise_layer(surface, {0.27f, 0.40f, 6, 0.58f, 3});
    const auto fine = noise_layer(surface, {0.008f, 0.008f, 2, 0.6f, 4});
    const std::uint32_t seed = hash_u32(surface.seed + 31u);
    const vec3 kVerdigris(0.190f, 0.345f, 0.285f);
    const vec3 kPale(0.330f, 0.475f, 0.405f);
    const vec3 kBronze(0.120f, 0.078f, 0.050f);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const int sheet = std::min(static_cast<int>(x / sheet_m), sheets - 1);
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
        const float bare = saturate(worn * (smooth_step(0.25f, 0.95f, patch[k] + 0.25f * streak[k]) +
                                    0.55f * seam * smooth_step(-0.4f, 0.5f, patch[k])));
        color = mix(color, kBronze, 0.78f * bare);
        color = mix(color, 0.62f * color, 0.35f * run + 0.4f * foot * (1.0f - seam));
        color *= 1.0f + 0.05f * fine[k] + 0.05f * hash_signed(h, 2);
        texel.albedo = color;
        texel.metallic = 0.55f * bare;
        texel.roughness = mix(0.68f, 0.46f, bare) + 0.04f * fine[k] + 0.06f * run;
        return texel;
    });
}

// Riven slates: thin, square, each split along its own planes; the row above covers two thirds of the one below.
void make_slate(MaterialSurface& surface)
{
    surface.occlusion_strength = 0.7f;
    const int columns = surface.cells(surface.value("slate_width_m"));
    const int courses = 2 * std::max(1, static_cast<int>(std::lround(0.5f * surface.tile_m / surface.value("course_m"))));
    const float grown = surface.value("moss");
    const float broken = surface.value("wear");
    const float thick_m = surface.value("thickness_m");
    const float width_m = surface.tile_m / static_cast<float>(columns);
    const float course_m = surface.tile_m / static_cast<float>(courses);
    const auto warp = noise_layer(surface, {0.05f, 0.05f, 5, 0.6f, 1});
    const auto riven = noise_layer(surface, {0.10f, 0.22f, 6, 0.55f, 2});
    const auto cleft = noise_layer(surface, {0.035f, 0.10f, 4, 0.55f, 3});
    const auto fine = noise_layer(surface, {0.006f, 0.006f, 2, 0.6f, 4});
    const auto lichen = noise_layer(surface, {0.07f, 0.07f, 5, 0.62f, 5});
    const auto wash = noise_layer(surface, {0.020f, 0.22f, 4, 0.6f, 7});
    const Lichen crusts(surface, 12);
    const auto stain = noise_layer(surface, {0.36f, 0.72f, 4, 0.55f, 6});
    static const std::array<vec3, 6> kSlates = {
        vec3(0.094f, 0.099f, 0.108f), vec3(0.116f, 0.121f, 0.128f), vec3(0.076f, 0.080f, 0.088f),
        vec3(0.098f, 0.093f, 0.097f), vec3(0.099f, 0.106f, 0.104f), vec3(0.128f, 0.128f, 0.130f)};
    const std::uint32_t seed = surface.seed;
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        struct Hit {
            float below;  ///< metres up from the tail
            float side;   ///< metres to the nearer long edge
            float across; ///< -1 .. 1
            std::uint32_t id;
        };
        const auto slate_at = [&](int j) {
            const float shift = (j & 1) != 0 ? 0.5f : 0.0f;
            const float column = (x + 0.0006f * warp[k]) / width_m + shift;
            const float i = std::floor(column);
            const float across = 2.0f * (column - i) - 1.0f;
            const std::uint32_t id = hash_cell(wrap_index(static_cast<int>(i), columns), wrap_index(j, courses), seed);
            // Hewn edges: wavy, out of square, a corner gone here and there.
            float tail = static_cast<float>(j + 1) * course_m + 0.0035f * hash_signed(id, 1) +
                         0.0030f * hash_signed(id, 2) * across + 0.0022f * warp[k];
            const float corner = (hash_unit(id, 3) < 0.5f ? across : -across) - 0.45f;
            if (hash_unit(id, 4) < 0.45f * broken && corner > 0.0f)
                tail -= corner * (0.02f + 0.05f * hash_unit(id, 5)) + 0.004f * warp[k];
            const float side = 0.5f * width_m * (1.0f - std::abs(across)) - 0.0012f + 0.0006f * warp[k];
            return Hit{tail - y, side, across, id};
        };
        int j = static_cast<int>(std::floor(y / course_m)) - 1;
        Hit hit = slate_at(j);
        while (hit.below < 0.0f) hit = slate_at(++j);
        // Through the gap between two slates the one below is seen.
        float depth = 0.0f;
        for (int turn = 0; turn < 2 && hit.side < 0.0f; ++turn) {
            hit = slate_at(++j);
            depth += thick_m;
        }
        const std::uint32_t id = hit.id;
        const float up = hit.below / course_m;
        const float lip = saturate(hit.below / 0.0022f);
        const float edge = saturate(std::min(hit.below, hit.side) / 0.010f);
        // Split planes: terraces with sharp, ragged steps.
        const float split = mix(0.5f, 1.9f, hash_unit(id, 14));  // some part in one plane, some in many
        const float layers = (riven[k] + 0.5f * cleft[k] * hash_unit(id, 15) + hash_signed(id, 6)) * split;
        const float step_at = std::floor(layers);
        const float terrace = step_at + smooth_step(0.42f, 0.58f, layers - step_at);
        const float rise = thick_m * 0.16f;
        MaterialTexel texel;
        texel.height_m = thick_m * (std::sqrt(lip * (2.0f - lip)) - 1.15f * std::min(up, 1.4f)) - depth +
                         rise * mix(terrace, layers, 0.25f) - 0.0006f * (1.0f - edge) * (1.0f + warp[k]) +
                         0.0012f * hash_signed(id, 7) * hit.across + 0.0010f * hash_signed(id, 8) + 0.00010f * fine[k] +
                         0.00022f * cleft[k];
        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 9) * 6.0f) % 6u;
        vec3 color = kSlates[pick] * (1.0f + 0.20f * hash_signed(id, 10));
        color *= 1.0f + 0.06f * terrace * 0.6f + 0.10f * cleft[k] + 0.05f * fine[k];
        if (hash_unit(id, 11) > 0.82f) color = mix(color, vec3(0.150f, 0.105f, 0.066f), 0.35f * smooth_step(-0.2f, 0.9f, riven[k]));
        color = mix(color, 1.5f * color + vec3(0.015f), 0.45f * (1.0f - edge));
        color = mix(color, 0.55f * color, 0.5f * smooth_step(0.1f, 1.1f, stain[k]));
        color = mix(color, 0.5f * color, smooth_step(0.55f, 1.15f, up) * 0.55f + (depth > 0.0f ? 0.4f : 0.0f));
        const float soiled = smooth_step(-0.3f, 1.0f, stain[k] + 0.4f * wash[k]);
        color = mix(color, vec3(0.060f, 0.058f, 0.050f), 0.40f * soiled);
        color = mix(color, vec3(0.165f, 0.165f, 0.160f), 0.22f * smooth_step(0.2f, 1.1f, -wash[k] - 0.4f * stain[k]));
        const LichenAt crust = crusts.at(x, y, k, 0.75f * grown * (0.4f + 0.6f * smooth_step(1.1f, 0.3f, up)));
        color = mix(color, crust.color, 0.78f * crust.cover);
        const float green = 2.0f * grown * smooth_step(0.0f, 0.95f, stain[k] + 0.35f * lichen[k]);
        const float moss = smooth_step(0.05f, 0.45f, green * smooth_step(0.55f, 1.05f, up) + 0.14f * cleft[k] + 0.12f * fine[k] - 0.05f) *
                           smooth_step(0.0f, 0.2f, green);
        color = mix(color, mix(vec3(0.038f, 0.052f, 0.014f), vec3(0.105f, 0.115f, 0.028f), saturate(0.45f + 0.5f * fine[k])), 0.92f * moss);
        texel.height_m += crust.thick_m + moss * (0.0028f + 0.0010f * fine[k]);
        texel.albedo = color;
        texel.roughness = mix(0.56f + 0.05f * cleft[k] + 0.08f * hash_signed(id, 13) + 0.14f * soiled,
                              0.92f, std::max(moss, 0.8f * crust.cover));
        return texel;
    });
}

}  // namespace

std::vector<KindRow> roof_kinds()
{
    const MaterialParameter moss{"moss", "share", 0.5f, 0.0f, 1.0f, "moss at the laps, crusts of lichen"};
    return {{MaterialKind::RoofTile, "roof_tile", "clay plain tiles with rounded tails", 1.44f,
             {{"tile_width_m", "m", 0.18f, 0.05f, 0.6f, "of a tile"},
              {"course_m", "m", 0.144f, 0.04f, 0.6f, "of a row that is seen"},
              moss},
             make_roof_tile},
            {MaterialKind::StandingSeam, "standing_seam", "patinated sheet roof with seams", 1.6f,
             {{"sheet_m", "m", 0.40f, 0.1f, 2.0f, "between seams"},
              {"wear", "share", 0.5f, 0.0f, 1.0f, "patina that is gone"}},
             make_standing_seam},
            {MaterialKind::Slate, "slate", "riven roofing slates", 1.6f,
             {{"slate_width_m", "m", 0.20f, 0.05f, 0.8f, "of a slate"},
              {"course_m", "m", 0.16f, 0.04f, 0.6f, "of a row that is seen"},
              {"thickness_m", "m", 0.006f, 0.002f, 0.03f, "of a slate"},
              {"wear", "share", 0.35f, 0.0f, 1.0f, "corners that are broken"},
              moss},
             make_slate}};
}

}  // namespace petrichor::texproc::detail
