// Walls: brick, plaster.
#include <array>

#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

void make_brick(MaterialSurface& surface)
{
    // As usual 8 bricks of 225 mm and 24 courses of 75 mm, joints of 10 mm included.
    const float length_m = surface.value("brick_length_m");
    const float course_m = surface.value("course_m");
    const float joint_m = surface.value("joint_m");
    const float worn = 2.0f * surface.value("wear");
    const float sooty = 2.0f * surface.value("soot");
    const Courses courses(surface.tile_m,
                          {.rows = surface.cells(course_m), .stone_length_m = length_m, .half_bond = true},
                          surface.seed);
    // Whole bricks fill the tile, so they may be a little longer than asked.
    const auto kept = [&](float asked_m, int count) {
        const float more_m = surface.tile_m / static_cast<float>(count) - asked_m;
        return std::abs(more_m) > 1e-5f ? more_m : 0.0f;
    };
    const float kept_x = kept(length_m, std::max(2, surface.cells(length_m)));
    const float kept_y = kept(course_m, surface.cells(course_m));
    const float half_length_m = 0.1073f + 0.5f * ((length_m - 0.225f) + kept_x - (joint_m - 0.010f));
    const float half_height_m = 0.0324f + 0.5f * ((course_m - 0.075f) + kept_y - (joint_m - 0.010f));
    const auto warp_x = noise_layer(surface, {0.05f, 0.05f, 4, 0.55f, 1});
    const auto warp_y = noise_layer(surface, {0.60f, 0.15f, 5, 0.45f, 2});
    const auto chips = noise_layer(surface, {0.030f, 0.030f, 3, 0.6f, 3});
    const auto rough = noise_layer(surface, {0.011f, 0.011f, 3, 0.65f, 4});
    const auto crease = noise_layer(surface, {0.045f, 0.012f, 3, 0.6f, 5});
    const auto soot = noise_layer(surface, {0.45f, 0.9f, 5, 0.55f, 6});
    const auto sand = noise_layer(surface, {0.007f, 0.007f, 2, 0.7f, 7});

    static const std::array<vec3, 7> kBricks = {
        vec3(0.285f, 0.096f, 0.056f), vec3(0.235f, 0.076f, 0.047f), vec3(0.335f, 0.132f, 0.074f),
        vec3(0.190f, 0.066f, 0.048f), vec3(0.300f, 0.145f, 0.090f), vec3(0.250f, 0.088f, 0.062f),
        vec3(0.215f, 0.105f, 0.078f)};
    const vec3 kSoot(0.052f, 0.041f, 0.037f);
    const vec3 kMortar(0.270f, 0.243f, 0.205f);

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const float px = x + 0.0012f * warp_x[k];
        const float py = y + 0.0016f * warp_y[k] + 0.0008f * warp_x[k];
        const CourseStone stone = courses.find(px, py);
        const std::uint32_t id = stone.id;
        // Laid by hand: each brick a little off its place, longer or shorter, not quite level.
        const float centre_x = 0.5f * (stone.left_m + stone.right_m) + 0.0016f * hash_signed(id, 1);
        const float centre_y = 0.5f * (stone.top_m + stone.bottom_m) + 0.0013f * hash_signed(id, 2);
        const float turn = 0.011f * hash_signed(id, 3);
        const float local_x = (px - centre_x) + turn * (py - centre_y);
        const float local_y = (py - centre_y) - turn * (px - centre_x);
        const float half_x = half_length_m + 0.0016f * hash_signed(id, 4);
        const float half_y = half_height_m + 0.0012f * hash_signed(id, 5);
        float d = rounded_inside(half_x - std::abs(local_x), half_y - std::abs(local_y), 0.0075f);
        d += 0.0011f * chips[k] + 0.0004f * rough[k];
        // Lost corners and edges: deeper where the chip noise peaks, only on some bricks.
        const float fragile = worn * smooth_step(0.35f, 1.0f, hash_unit(id, 6));
        const float near_edge = 1.0f - saturate(d / 0.0075f);
        const float lost =
            fragile * smooth_step(0.25f, 0.9f, chips[k] + 0.4f * warp_x[k]) * (0.25f + near_edge);
        d -= 0.0045f * lost;

        const float edge = saturate(d / 0.0042f);
        const float round = std::sqrt(std::max(0.0f, 1.0f - (1.0f - edge) * (1.0f - edge)));
        const float dents = smooth_step(0.45f, 1.1f, crease[k]);
        const float level = 0.0011f * hash_signed(id, 7);
        const float tilt = 0.0008f * (hash_signed(id, 8) * local_x / half_x +
                                      hash_signed(id, 9) * local_y / half_y);
        const float face = 0.0078f * round + level * round + tilt * round + 0.00045f * crease[k] +
                           0.00042f * rough[k] - 0.0011f * dents - 0.0028f * lost +
                           0.00016f * sand[k];
        const float mortar = 0.0026f + 0.0009f * warp_x[k] + 0.00055f * rough[k] +
                             0.0003f * sand[k] -
                             0.0018f * smooth_step(0.5f, 1.2f, soot[k] + 0.3f * chips[k]);
        const float above = face - mortar;
        const float is_brick = smooth_step(-0.0002f, 0.0007f, above);

        MaterialTexel texel;
        texel.height_m = std::max(face, mortar);

        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 10) * 7.0f) % 7u;
        const std::size_t other = static_cast<std::size_t>(hash_unit(id, 11) * 7.0f) % 7u;
        vec3 color = mix(kBricks[pick], kBricks[other], 0.4f * hash_unit(id, 12));
        color *= 1.0f + 0.14f * hash_signed(id, 13);
        // Burnt heads and smoke from the kiln.
        const float burnt = hash_unit(id, 14) > 0.86f ? 0.78f : 0.0f;
        const float flame = smooth_step(
            0.2f, 1.0f, hash_signed(id, 15) * local_x / half_x + 0.5f * chips[k] - 0.25f);
        color = mix(color, kSoot, saturate(burnt + 0.5f * flame * hash_unit(id, 16)));
        color *= 1.0f + 0.15f * rough[k] + 0.10f * crease[k] + 0.06f * sand[k];
        color = mix(color, 1.25f * color + vec3(0.02f), 0.5f * lost);
        const float weathered = std::min(sooty * smooth_step(-0.05f, 0.75f, soot[k]), 1.0f);
        color = mix(color, 0.45f * color + 0.5f * kSoot, 0.7f * weathered);
        const float bloom = smooth_step(0.40f, 0.9f, -soot[k] + 0.25f * chips[k]);
        color = mix(color, vec3(0.42f, 0.36f, 0.31f), 0.22f * bloom);
        vec3 joint = kMortar * (1.0f + 0.13f * rough[k] + 0.10f * sand[k] + 0.08f * warp_x[k]);
        joint = mix(joint, 0.36f * joint, 0.8f * weathered);
        joint *= 0.72f + 0.28f * smooth_step(-0.004f, 0.0f, above);
        texel.albedo = mix(joint, color, is_brick);
        texel.roughness = mix(
            0.94f, saturate(0.80f + 0.06f * rough[k] - 0.24f * burnt + 0.05f * hash_signed(id, 17)),
            is_brick);
        return texel;
    });
}

void make_plaster(MaterialSurface& surface)
{
    const float stained = 2.0f * surface.value("stains");
    const float cracked = 2.0f * surface.value("cracks");
    const auto waves = noise_layer(surface, {0.48f, 0.34f, 4, 0.5f, 1});
    const auto trowel = noise_layer(surface, {0.16f, 0.08f, 4, 0.5f, 2});
    const auto grain = noise_layer(surface, {0.008f, 0.008f, 2, 0.7f, 3});
    const auto stain = noise_layer(surface, {0.60f, 0.80f, 6, 0.55f, 4});
    const auto drip = noise_layer(surface, {0.040f, 0.60f, 4, 0.6f, 5});
    const auto crack_x = noise_layer(surface, {0.15f, 0.15f, 5, 0.46f, 6});
    const auto crack_y = noise_layer(surface, {0.15f, 0.15f, 5, 0.46f, 7});
    const auto sand = noise_layer(surface, {0.0052f, 0.0052f, 2, 0.8f, 8});
    const auto blotch = noise_layer(surface, {0.075f, 0.075f, 5, 0.6f, 9});
    const int crack_cells = surface.cells(0.6f);
    const float to_cells = static_cast<float>(crack_cells) / surface.tile_m;
    const vec3 kLime(0.545f, 0.430f, 0.285f);
    const vec3 kPale(0.620f, 0.535f, 0.405f);
    const vec3 kDamp(0.285f, 0.225f, 0.150f);
    const std::uint32_t crack_seed = hash_u32(surface.seed + 11u);

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Hair cracks: seams of large warped cells, only where the wall has moved.
        float crack = 0.0f;
        const float moved = std::min(cracked * smooth_step(0.15f, 0.7f, stain[k]), 1.0f);
        if (moved > 0.0f) {
            const CellPoint cell =
                cell_noise(x * to_cells + 0.16f * crack_x[k], y * to_cells + 0.16f * crack_y[k],
                           crack_cells, crack_cells, crack_seed, 0.9f);
            crack = moved * (1.0f - smooth_step(0.002f, 0.009f, cell.second - cell.nearest));
        }
        // Trowel marks: overlapping shallow facets.
        const float sweep = std::abs(trowel[k]);
        const float thin = smooth_step(0.75f, 1.25f, waves[k] + 0.35f * crack_x[k]);

        MaterialTexel texel;
        texel.height_m = 0.0016f * waves[k] + 0.0011f * (1.0f - sweep) + 0.00022f * grain[k] + 0.00016f * sand[k] + 0.00030f * blotch[k] -
                         0.0011f * crack - 0.0016f * thin;
        vec3 color = mix(kLime, kPale, smooth_step(-0.8f, 0.8f, waves[k] + 0.5f * crack_y[k]));
        const float streak = stained * smooth_step(0.05f, 0.8f, drip[k] + 0.5f * stain[k]);
        color = mix(color, kDamp, 0.34f * streak);
        color = mix(color, 0.72f * kDamp, stained * 0.42f * smooth_step(0.15f, 0.8f, stain[k]));
        color *= 1.0f + 0.035f * grain[k] + 0.05f * trowel[k] + 0.035f * sand[k] + 0.045f * blotch[k];
        // Limewash is thin on what the trowel left high, and gone in flakes.
        color = mix(color, vec3(0.47f, 0.37f, 0.25f), 0.35f * smooth_step(0.35f, 1.0f, blotch[k] - 0.6f * trowel[k]));
        color = mix(color, vec3(0.42f, 0.38f, 0.33f), 0.7f * thin);
        color = mix(color, vec3(0.10f, 0.08f, 0.06f), 0.75f * crack);
        texel.albedo = color;
        texel.roughness = 0.88f + 0.03f * grain[k] + 0.04f * blotch[k] - 0.07f * streak + 0.05f * thin;
        return texel;
    });
}

}  // namespace

std::vector<KindRow> masonry_kinds()
{
    return {{MaterialKind::Brick, "brick", "brickwork in running bond, chipped and sooty", 1.8f,
             {{"brick_length_m", "m", 0.225f, 0.05f, 1.0f, "with its joint"},
              {"course_m", "m", 0.075f, 0.03f, 0.5f, "height of a course with its joint"},
              {"joint_m", "m", 0.010f, 0.002f, 0.025f, "of mortar"},
              {"wear", "share", 0.5f, 0.0f, 1.0f, "corners and edges that are lost"},
              {"soot", "share", 0.5f, 0.0f, 1.0f, "dark weathering"}},
             make_brick},
            {MaterialKind::Plaster, "plaster", "lime plaster with stains and hair cracks", 2.4f,
             {{"stains", "share", 0.5f, 0.0f, 1.0f, "damp and streaks"},
              {"cracks", "share", 0.5f, 0.0f, 1.0f, "hair cracks where the wall has moved"}},
             make_plaster}};
}

}  // namespace petrichor::texproc::detail
