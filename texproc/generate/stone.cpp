// Stone underfoot: setts, slabs, hammered granite.
#include <array>

#include "base/portable_math.h"
#include "texproc/generate/detail/colonies.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

// Granite is a mosaic of pale feldspar, grey quartz and black mica.
vec3 granite_grain(const vec3& base, float coarse, float fine)
{
    const float mica = smooth_step(0.38f, 0.62f, coarse + 0.5f * fine);
    const float feldspar = smooth_step(0.3f, 0.6f, fine - 0.55f * coarse);
    vec3 color = base * (1.0f + 0.10f * coarse + 0.08f * fine);
    color = mix(color, 0.42f * base, 0.6f * mica);
    return mix(color, 1.35f * base + vec3(0.012f), 0.5f * feldspar);
}

// Distances to the four sides, each moved in by its share of the joint.
struct Sides {
    float x;       ///< to the nearer of left and right
    float y;       ///< to the nearer of top and bottom
    float across;  ///< -1 left .. 1 right
    float along;   ///< -1 top .. 1 bottom
    float half_m;  ///< half of the shorter edge
};

Sides sides_of(const CourseStone& stone, float x, float y, float joint_m)
{
    const float middle_y = 0.5f * (stone.top_m + stone.bottom_m);
    const float left = stone.left_m + stone.slant_left * (y - middle_y) +
                       joint_m * (0.3f + 0.5f * hash_unit(stone.id, 1));
    const float right = stone.right_m + stone.slant_right * (y - middle_y) -
                        joint_m * (0.3f + 0.5f * hash_unit(stone.id, 2));
    const float top = stone.top_m + joint_m * (0.3f + 0.5f * hash_unit(stone.id, 3));
    const float bottom = stone.bottom_m - joint_m * (0.3f + 0.5f * hash_unit(stone.id, 4));
    Sides sides;
    sides.x = std::min(x - left, right - x);
    sides.y = std::min(y - top, bottom - y);
    const float half_x = 0.5f * (right - left);
    const float half_y = 0.5f * (bottom - top);
    sides.across = (x - 0.5f * (left + right)) / half_x;
    sides.along = (y - 0.5f * (top + bottom)) / half_y;
    sides.half_m = std::min(half_x, half_y);
    return sides;
}

void make_cobble(MaterialSurface& surface)
{
    const float irregular = 2.0f * surface.value("irregularity");
    const float joint_m = surface.value("joint_m");
    const float mossy = 2.0f * surface.value("moss");
    const float worn = 2.0f * surface.value("wear");
    const Courses courses(surface.tile_m,
                          {.rows = surface.cells(surface.value("stone_width_m")),
                           .row_jitter = 0.34f * irregular,
                           .stone_length_m = surface.value("stone_length_m"),
                           .length_jitter = 0.42f * irregular,
                           .slant = 0.16f * irregular},
                          surface.seed);
    const auto warp_x = noise_layer(surface, {0.30f, 0.30f, 5, 0.44f, 1});
    const auto warp_y = noise_layer(surface, {0.48f, 0.48f, 5, 0.44f, 2});
    const auto bumps = noise_layer(surface, {0.055f, 0.055f, 4, 0.5f, 3});
    const auto pits = noise_layer(surface, {0.0075f, 0.0075f, 2, 0.6f, 4});
    const auto grain = noise_layer(surface, {0.006f, 0.006f, 2, 0.7f, 5});
    const auto grit = noise_layer(surface, {0.014f, 0.014f, 3, 0.75f, 6});
    const auto moss = noise_layer(surface, {0.40f, 0.40f, 4, 0.55f, 7});

    static const std::array<vec3, 8> kStones = {
        vec3(0.185f, 0.188f, 0.192f), vec3(0.150f, 0.147f, 0.143f), vec3(0.205f, 0.184f, 0.158f),
        vec3(0.168f, 0.138f, 0.110f), vec3(0.176f, 0.128f, 0.108f), vec3(0.092f, 0.096f, 0.104f),
        vec3(0.262f, 0.252f, 0.236f), vec3(0.140f, 0.145f, 0.150f)};
    const vec3 kSand(0.118f, 0.098f, 0.074f);
    const vec3 kDirt(0.060f, 0.050f, 0.039f);
    const vec3 kMoss(0.052f, 0.070f, 0.018f);

    // The edge of the tile runs through stones, not along a joint of theirs, the steepest line there is.
    const float half_course_m = 0.5f * surface.tile_m / static_cast<float>(surface.cells(surface.value("stone_width_m")));
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const float px = x + 0.010f * warp_x[k] + 0.0022f * bumps[k];
        const float py = y + half_course_m + 0.014f * warp_y[k] - 0.0022f * bumps[k];
        const CourseStone stone = courses.find(px, py);
        const std::uint32_t id = stone.id;
        const Sides sides = sides_of(stone, px, py, joint_m);
        const float radius = mix(0.020f, 0.042f, hash_unit(id, 5));
        const float d = rounded_inside(sides.x, sides.y, radius) + 0.0009f * pits[k];

        // A worn sett: steep flank, round shoulder, slightly domed and tilted top.
        const float shoulder = saturate(d / mix(0.016f, 0.027f, hash_unit(id, 6)));
        const float flank = std::sqrt(std::max(0.0f, 1.0f - (1.0f - shoulder) * (1.0f - shoulder)));
        const float dome =
            (1.0f - sides.across * sides.across) * (1.0f - sides.along * sides.along);
        const float edge = 1.0f - shoulder;
        const float chip = worn * smooth_step(0.45f, 0.95f, bumps[k] + 0.35f * warp_x[k]) * edge;
        const float level = 0.0028f * hash_signed(id, 7);
        const float tilt =
            0.0022f * (hash_signed(id, 8) * sides.across + hash_signed(id, 9) * sides.along);
        const float polish = std::min(worn * smooth_step(0.25f, 0.85f, dome), 1.0f);
        const float top = 0.0165f * flank + 0.0055f * std::max(dome, 0.0f) + level +
                          tilt * shoulder + mix(0.0016f, 0.0010f, polish) * bumps[k] -
                          0.0045f * chip - 0.00055f * smooth_step(0.1f, 0.9f, pits[k]) -
                          0.00022f * grain[k];

        // Sand in the joints, higher where moss grows.
        const float green = std::min(mossy * smooth_step(0.05f, 0.75f, moss[k] + 0.25f * grit[k]), 1.0f);
        const float sand = 0.0032f + 0.0011f * grit[k] + 0.0014f * warp_y[k] +
                           green * (0.0026f + 0.0012f * pits[k]);
        const float above = top - sand;
        const float is_stone = smooth_step(-0.0006f, 0.0016f, above);
        // A smooth maximum: stone and sand meet without a crease.
        const float soft = 0.0012f;
        const float blend = std::max(soft - std::abs(above), 0.0f);

        MaterialTexel texel;
        texel.height_m = std::max(top, sand) + 0.25f * blend * blend / soft;

        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 10) * 8.0f) & 7u;
        const std::size_t other = static_cast<std::size_t>(hash_unit(id, 11) * 8.0f) & 7u;
        vec3 color = mix(kStones[pick], kStones[other], 0.35f * hash_unit(id, 12));
        color *= 0.92f + 0.20f * hash_signed(id, 13);
        color = granite_grain(color, pits[k], grain[k]) * (1.0f + 0.10f * bumps[k]);
        color *= mix(0.86f, 1.07f, polish);
        const float grime = saturate(1.15f * portable_pow(1.0f - flank, 0.8f) +
                                     0.25f * smooth_step(0.2f, 0.9f, -warp_x[k]));
        color = mix(color, kDirt, 0.78f * grime);
        color = mix(color, kMoss, 0.55f * green * smooth_step(0.15f, 0.75f, 1.0f - flank));

        vec3 joint = kSand * (1.0f + 0.28f * grit[k] + 0.15f * grain[k]);
        joint = mix(joint, kDirt, 0.55f * smooth_step(-0.3f, 0.6f, -grit[k]));
        joint = mix(joint, kMoss * (1.0f + 0.35f * pits[k]), 0.9f * green);
        texel.albedo = mix(joint, color, is_stone);

        const float stone_rough = mix(0.80f, 0.54f, polish) + 0.06f * pits[k] + 0.08f * grime +
                                  0.05f * hash_signed(id, 14);
        texel.roughness = mix(0.95f, std::min(stone_rough, 0.95f), is_stone);
        return texel;
    });
}

void make_paving(MaterialSurface& surface)
{
    const float irregular = 2.0f * surface.value("irregularity");
    const float joint_m = surface.value("joint_m");
    const float mossy = 2.0f * surface.value("moss");
    const float worn = 2.0f * surface.value("wear");
    const Courses courses(surface.tile_m,
                          {.rows = surface.cells(surface.value("stone_width_m")),
                           .row_jitter = 0.36f * irregular,
                           .stone_length_m = surface.value("stone_length_m"),
                           .length_jitter = 0.5f * irregular,
                           .slant = 0.008f * irregular},
                          surface.seed);
    const auto warp = noise_layer(surface, {0.10f, 0.10f, 4, 0.5f, 1});
    const auto riven = noise_layer(surface, {0.22f, 0.34f, 5, 0.5f, 2});
    const auto fine = noise_layer(surface, {0.012f, 0.012f, 3, 0.7f, 3});
    const auto stain = noise_layer(surface, {0.55f, 0.55f, 5, 0.55f, 4});
    const auto grit = noise_layer(surface, {0.02f, 0.02f, 3, 0.7f, 5});
    const auto bands = noise_layer(surface, {0.30f, 0.12f, 4, 0.5f, 6});
    const auto pits = noise_layer(surface, {0.026f, 0.026f, 3, 0.6f, 7});
    const auto chips = noise_layer(surface, {0.035f, 0.035f, 3, 0.6f, 8});
    const Colonies gum(surface, 0.21f, 3);
    const Lichen crusts(surface, 13);

    static const std::array<vec3, 5> kStones = {
        vec3(0.235f, 0.214f, 0.180f), vec3(0.200f, 0.192f, 0.176f), vec3(0.255f, 0.226f, 0.178f),
        vec3(0.178f, 0.176f, 0.172f), vec3(0.220f, 0.190f, 0.150f)};
    const vec3 kDirt(0.062f, 0.053f, 0.042f);
    const vec3 kMoss(0.058f, 0.072f, 0.024f);

    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const float px = x + 0.0016f * warp[k];
        const float py = y + 0.0016f * riven[k];
        const CourseStone stone = courses.find(px, py);
        const std::uint32_t id = stone.id;
        const Sides sides = sides_of(stone, px, py, joint_m);
        const float whole = rounded_inside(sides.x, sides.y, mix(0.006f, 0.022f, hash_unit(id, 5)));
        // Edges are hewn, corners knocked off here and there.
        const float d = whole - 0.0022f * std::max(chips[k] - 0.15f, 0.0f) * irregular -
                        worn * 0.010f * smooth_step(0.55f, 1.1f, chips[k]) * (1.0f - smooth_step(0.0f, 0.02f, std::min(sides.x, sides.y)));

        // Sandstone splits along its bedding: shallow terraces with soft steps.
        const float layers = (riven[k] + 0.4f * hash_signed(id, 6)) * 2.6f;
        const float step_at = std::floor(layers);
        const float terrace = step_at + smooth_step(0.35f, 0.65f, layers - step_at);
        const float wear =
            worn * ((1.0f - sides.across * sides.across) * (1.0f - sides.along * sides.along));
        const float edge = saturate(d / 0.007f);
        const float round = std::sqrt(std::max(0.0f, 1.0f - (1.0f - edge) * (1.0f - edge)));
        const float top =
            0.0085f * round + 0.00065f * mix(terrace, layers, 0.45f) - 0.0009f * wear +
            0.0012f * hash_signed(id, 7) +
            0.0011f * (hash_signed(id, 8) * sides.across + hash_signed(id, 9) * sides.along) +
            0.00020f * fine[k] - 0.0007f * smooth_step(0.55f, 1.15f, pits[k] + 0.25f * fine[k]);
        const float green = std::min(mossy * smooth_step(0.25f, 0.8f, stain[k] + 0.2f * grit[k]), 1.0f);
        const float sand = 0.0016f + 0.0006f * grit[k] + 0.0016f * green;
        const float is_stone = smooth_step(-0.0004f, 0.0010f, top - sand);

        MaterialTexel texel;
        texel.height_m = std::max(top, sand);
        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 10) * 5.0f) % 5u;
        vec3 color = kStones[pick] * (1.0f + 0.12f * hash_signed(id, 11));
        // Iron in the bedding: rusty bands through some slabs.
        const float band = 0.5f + 0.5f * portable_sin(9.0f * (bands[k] + hash_signed(id, 13)) + 3.0f * hash_signed(id, 14));
        const float iron = smooth_step(0.45f, 0.9f, hash_unit(id, 15)) * smooth_step(0.35f, 0.95f, band);
        color = mix(color, color * vec3(1.08f, 0.86f, 0.66f), 0.75f * iron);
        color *= 1.0f + 0.055f * terrace * 0.5f + 0.10f * fine[k] + 0.06f * warp[k] + 0.05f * pits[k];
        if (hash_unit(id, 16) < 0.5f)  // grains of quartz and mica
            color *= 1.0f + 0.16f * smooth_step(0.5f, 1.0f, fine[k]) - 0.20f * smooth_step(0.55f, 1.1f, -fine[k]);
        const float pit = smooth_step(0.55f, 1.15f, pits[k] + 0.25f * fine[k]);
        color *= 1.0f - 0.22f * pit;
        // Dirt lies in hollows and creeps in from the joints; what feet cross stays clean.
        const float soiled = smooth_step(-0.1f, 1.0f, -stain[k] + 0.15f * fine[k] - 0.5f * wear);
        color = mix(color, color * vec3(0.60f, 0.58f, 0.55f), soiled);
        const float creep = 1.0f - smooth_step(0.0f, 0.055f, std::min(sides.x, sides.y) + 0.020f * warp[k]);
        color = mix(color, kDirt * 1.3f, 0.42f * creep * smooth_step(-0.7f, 0.6f, stain[k] + 0.5f * chips[k]));
        color = mix(color, kMoss * 1.2f, 0.30f * creep * green);
        color = mix(color, kDirt, 0.6f * (1.0f - round));
        const ColonyAt trodden = gum.at(x, y, 0.30f * worn);  // what people drop
        const float blot = trodden.radius_m < 0.022f + 0.012f * warp[k] ? smooth_step(0.0f, 0.25f, trodden.inside + 0.2f * pits[k]) : 0.0f;
        color = mix(color, 0.55f * color, 0.65f * blot);
        const LichenAt crust = crusts.at(x, y, k, 0.22f * mossy);
        color = mix(color, crust.color, 0.55f * crust.cover * round);
        const vec3 joint = mix(kDirt * (1.0f + 0.3f * grit[k]), kMoss, 0.85f * green);
        texel.albedo = mix(joint, color, is_stone);
        texel.roughness = mix(
            0.95f, 0.76f - 0.14f * wear + 0.06f * fine[k] + 0.06f * hash_signed(id, 12) + 0.07f * soiled + 0.08f * pit - 0.10f * blot, is_stone);
        return texel;
    });
}

void make_granite(MaterialSurface& surface)
{
    const float grain_m = surface.value("grain_m");
    const float stained = 2.0f * surface.value("stains");
    const auto waves = noise_layer(surface, {0.16f, 0.16f, 4, 0.5f, 1});
    const auto hammer = noise_layer(surface, {0.012f, 0.012f, 2, 0.6f, 2});
    const auto coarse = noise_layer(surface, {grain_m, grain_m, 2, 0.6f, 3});
    const auto fine = noise_layer(surface, {0.5f * grain_m, 0.5f * grain_m, 1, 0.6f, 4});
    const auto stain = noise_layer(surface, {0.33f, 0.33f, 5, 0.55f, 5});
    const vec3 kBase(0.205f, 0.200f, 0.195f);
    shade_texels(surface, [&](float, float, std::size_t k) {
        const float pock = smooth_step(0.25f, 0.8f, hammer[k]);
        MaterialTexel texel;
        texel.height_m = 0.0012f * waves[k] - 0.0009f * pock + 0.00015f * fine[k];
        vec3 color = granite_grain(kBase, coarse[k], fine[k]) * (1.0f + 0.08f * waves[k]);
        color = mix(color, 0.6f * color, 0.6f * pock);
        color = mix(color, color * vec3(0.74f, 0.71f, 0.66f),
                    std::min(stained * smooth_step(0.0f, 0.9f, stain[k]), 1.0f));
        texel.albedo = color;
        texel.roughness = 0.66f + 0.07f * coarse[k] + 0.12f * pock;
        return texel;
    });
}

}  // namespace

std::vector<KindRow> stone_kinds()
{
    const MaterialParameter irregular{"irregularity", "share", 0.5f, 0.0f, 0.9f, "of courses, lengths and sides; 0 sawn and laid by rule"};
    const MaterialParameter moss{"moss", "share", 0.5f, 0.0f, 1.0f, "of the joints that are green"};
    const MaterialParameter wear{"wear", "share", 0.5f, 0.0f, 1.0f, "polish of the tops by wheels and feet, chips of the edges"};
    return {{MaterialKind::Cobble, "cobble", "worn granite setts in irregular courses", 2.4f,
             {{"stone_width_m", "m", 2.4f / 19.0f, 0.03f, 1.0f, "of a course"},
              {"stone_length_m", "m", 0.158f, 0.03f, 1.0f, "along the course, mean"},
              {"joint_m", "m", 0.011f, 0.001f, 0.05f, "between stones"},
              irregular, moss, wear},
             make_cobble},
            {MaterialKind::Paving, "paving", "riven stone slabs in courses", 2.4f,
             {{"stone_width_m", "m", 0.48f, 0.08f, 2.0f, "of a course"},
              {"stone_length_m", "m", 0.60f, 0.08f, 2.0f, "along the course, mean"},
              {"joint_m", "m", 0.010f, 0.001f, 0.05f, "between slabs"},
              irregular, moss, wear},
             make_paving},
            {MaterialKind::Granite, "granite", "bush-hammered granite without joints", 1.0f,
             {{"grain_m", "m", 0.007f, 0.002f, 0.05f, "of its crystals"},
              {"stains", "share", 0.5f, 0.0f, 1.0f, "of dirt and rust"}},
             make_granite}};
}

}  // namespace petrichor::texproc::detail
