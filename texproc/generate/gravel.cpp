// Loose stone: gravel, and soil of clods and crumbs.
#include <array>

#include "texproc/generate/detail/loose_stones.h"
#include "texproc/generate/detail/strokes.h"

namespace petrichor::texproc::detail {

namespace {

using glm::vec3;

void make_gravel(MaterialSurface& surface)
{
    const float size_m = surface.value("stone_m");
    const float round = surface.value("roundness");
    const float dusty = surface.value("dust");
    const float mixed = surface.value("variety");
    const auto layer = [&](float size, float sunk, float share, std::uint32_t salt) {
        return StoneLayer(surface, {.size_m = size * size_m,
                                    .roundness = round,
                                    .flatness = mix(0.85f, 0.62f, round),
                                    .spread_m = 0.16f * size * size_m,
                                    .sunk_m = sunk * size_m,
                                    .share = share,
                                    .salt = salt});
    };
    const std::array<StoneLayer, 5> layers = {layer(1.25f, 0.10f, 0.80f, 1), layer(1.0f, 0.08f, 0.85f, 2),
                                              layer(0.75f, 0.12f, 0.9f, 3), layer(0.5f, 0.16f, 0.95f, 4),
                                              layer(0.3f, 0.20f, 1.0f, 5)};
    const auto warp_x = noise_layer(surface, {0.35f * size_m, 0.35f * size_m, 3, 0.6f, 1});
    const auto warp_y = noise_layer(surface, {0.35f * size_m, 0.35f * size_m, 3, 0.6f, 2});
    const auto mounds = noise_layer(surface, {0.30f, 0.30f, 3, 0.5f, 3});
    const auto grain = noise_layer(surface, {0.0045f, 0.0045f, 2, 0.65f, 4});
    const auto sand = noise_layer(surface, {0.010f, 0.010f, 3, 0.7f, 5});
    static const std::array<vec3, 8> kStones = {
        vec3(0.230f, 0.222f, 0.208f), vec3(0.170f, 0.168f, 0.166f), vec3(0.285f, 0.262f, 0.225f),
        vec3(0.205f, 0.178f, 0.142f), vec3(0.120f, 0.121f, 0.124f), vec3(0.330f, 0.315f, 0.290f),
        vec3(0.225f, 0.172f, 0.132f), vec3(0.190f, 0.196f, 0.200f)};
    const vec3 kMean(0.216f, 0.203f, 0.182f);
    const vec3 kDust(0.265f, 0.240f, 0.200f);
    const vec3 kSand(0.165f, 0.140f, 0.108f);
    const bool from_afar = layers[0].left_out();  // texels wider than stones
    const float bumpy = (1.0f - 0.75f * round) * size_m;
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        const float px = x + 0.055f * bumpy * warp_x[k], py = y + 0.055f * bumpy * warp_y[k];
        StoneAt stone;
        for (const StoneLayer& stones : layers) {
            const StoneAt here = stones.at(px, py);
            if (here.height_m > stone.height_m) stone = here;
        }
        MaterialTexel texel;
        const float bed = -0.26f * size_m + 0.0009f * sand[k];
        const float above = stone.height_m - bed;
        const float is_stone = from_afar ? 1.0f : smooth_step(0.0f, 0.0008f, above);
        texel.height_m = std::max(stone.height_m + 0.018f * bumpy * warp_y[k] + 0.00012f * grain[k], bed) +
                         0.006f * mounds[k];
        const std::uint32_t id = stone.id;
        const std::size_t pick = static_cast<std::size_t>(hash_unit(id, 40) * 8.0f) & 7u;
        vec3 color = mix(kMean, kStones[pick], std::min(2.0f * mixed, 1.0f)) *
                     (1.0f + 0.3f * std::min(mixed, 1.0f) * hash_signed(id, 41));
        if (from_afar) color = kMean * (1.0f + 0.10f * mixed * mounds[k]);
        color *= 1.0f + 0.10f * grain[k] + 0.10f * warp_x[k];
        if (hash_unit(id, 42) > 0.88f)  // veins of quartz
            color = mix(color, vec3(0.42f, 0.41f, 0.39f), 0.7f * smooth_step(0.86f, 1.0f, 1.0f - std::abs(warp_y[k])));
        // Dust lies low and on what is level.
        const float low = smooth_step(0.02f * size_m, -0.22f * size_m, stone.height_m);
        color = mix(color, kDust, saturate(dusty * (0.35f + 0.75f * low + 0.3f * sand[k])));
        color *= from_afar ? 0.9f : mix(0.60f, 1.0f, smooth_step(-0.24f * size_m, 0.10f * size_m, stone.height_m));
        texel.albedo = mix(kSand * (0.62f + 0.2f * sand[k]), color, is_stone);
        texel.roughness = mix(0.95f, mix(0.80f, 0.58f, round) + 0.12f * dusty + 0.05f * grain[k] +
                                         0.06f * hash_signed(id, 43), is_stone);
        return texel;
    });
}

// Trodden earth: clods of all sizes in crumbs, stones, bits of root.
void make_soil(MaterialSurface& surface)
{
    const float clod_m = surface.value("clod_m");
    const float stony = surface.value("stones");
    const float trodden = surface.value("trodden");
    const auto clods = [&](float size, float sunk, float share, float flat, std::uint32_t salt) {
        return StoneLayer(surface, {.size_m = size * clod_m,
                                    .roundness = 0.45f,
                                    .flatness = flat * (1.0f - 0.75f * trodden),
                                    .spread_m = 0.10f * size * clod_m,
                                    .sunk_m = sunk * clod_m,
                                    .share = share,
                                    .salt = salt});
    };
    const std::array<StoneLayer, 4> layers = {clods(1.5f, 0.16f, 0.35f, 0.7f, 1), clods(0.8f, 0.12f, 0.6f, 0.7f, 2),
                                              clods(0.42f, 0.09f, 0.8f, 0.8f, 3), clods(0.22f, 0.08f, 1.0f, 0.9f, 4)};
    const StoneLayer pebbles(surface, {.size_m = 0.022f, .roundness = 0.7f, .flatness = 0.6f, .spread_m = 0.003f,
                                       .sunk_m = 0.004f, .share = 0.5f * stony, .salt = 5});
    const StoneLayer grit(surface, {.size_m = 0.008f, .roundness = 0.5f, .flatness = 0.6f, .spread_m = 0.001f,
                                    .sunk_m = 0.0015f, .share = 0.6f * stony, .salt = 6});
    const auto mounds = noise_layer(surface, {0.45f, 0.45f, 4, 0.5f, 61});
    const auto warp_x = noise_layer(surface, {0.022f, 0.022f, 5, 0.58f, 62});
    const auto warp_y = noise_layer(surface, {0.022f, 0.022f, 5, 0.58f, 63});
    const auto crumbs = noise_layer(surface, {0.009f, 0.009f, 4, 0.75f, 64});
    const auto damp = noise_layer(surface, {0.35f, 0.35f, 5, 0.6f, 65});
    const vec3 kDark(0.062f, 0.043f, 0.028f), kLight(0.150f, 0.112f, 0.074f);
    shade_texels(surface, [&](float x, float y, std::size_t k) {
        // Clods have no outline of their own: they crumble into the crumbs about them.
        const float px = x + 0.0075f * warp_x[k], py = y + 0.0075f * warp_y[k];
        StoneAt clod;
        for (const StoneLayer& layer : layers) {
            const StoneAt here = layer.at(px, py);
            if (here.height_m > clod.height_m) clod = here;
        }
        clod.height_m += 0.030f * clod_m * warp_y[k] + 0.0012f * crumbs[k];
        const float bed = -0.07f * clod_m + 0.0026f * crumbs[k] + 0.0020f * warp_x[k];
        const float soft = 0.14f * clod_m;
        const float above = clod.height_m - bed;
        const float blend = std::max(soft - std::abs(above), 0.0f);
        MaterialTexel texel;
        texel.height_m = std::max(clod.height_m, bed) + 0.25f * blend * blend / soft + 0.0012f * crumbs[k] +
                         0.0010f * warp_x[k] + 0.010f * mounds[k];
        const float lit = smooth_step(-0.6f, 0.9f, 0.8f * crumbs[k] + 0.5f * warp_y[k]);
        vec3 color = mix(kDark, kLight, 0.25f + 0.45f * lit + 0.12f * hash_signed(clod.id, 40) * (above > 0.0f ? 1.0f : 0.0f));
        // What stands up dries first.
        color *= mix(0.70f, 1.10f, smooth_step(-0.12f * clod_m, 0.25f * clod_m, std::max(clod.height_m, bed)));
        const float moist = smooth_step(-0.3f, 0.9f, damp[k] + 0.2f * crumbs[k] - 0.35f * (above > 0.0f ? 1.0f : 0.0f));
        color *= 1.0f - 0.42f * moist;
        color = mix(color, color * vec3(1.10f, 0.98f, 0.84f), smooth_step(0.0f, 0.9f, -damp[k]));
        texel.roughness = 0.96f - 0.05f * trodden * smooth_step(-0.4f, 0.6f, mounds[k]) - 0.14f * moist;
        for (const StoneLayer* layer : {&grit, &pebbles}) {
            const StoneAt stone = layer->at(px, py);
            const float out = stone.height_m + 0.010f * mounds[k] - texel.height_m;
            if (stone.height_m <= -1.0f || out <= -0.0004f) continue;
            const float cover = smooth_step(-0.0004f, 0.0006f, out);
            const vec3 rock = mix(vec3(0.125f, 0.118f, 0.108f), vec3(0.270f, 0.240f, 0.195f), hash_unit(stone.id, 41)) *
                              (1.0f + 0.10f * crumbs[k]);
            color = mix(color, mix(rock, color, 0.25f), cover);
            texel.height_m = std::max(texel.height_m, texel.height_m + out);
            texel.roughness = mix(texel.roughness, 0.76f, cover);
        }
        texel.albedo = color;
        return texel;
    });
    // Dry stalks and roots.
    draw_fibres(surface, {.count_m2 = 260.0f * surface.value("litter"), .length_m = 0.055f, .width_m = 0.0014f,
                          .rise_m = 0.0012f, .color = vec3(0.235f, 0.185f, 0.110f), .salt = 7});
}

}  // namespace

std::vector<KindRow> gravel_kinds()
{
    return {{MaterialKind::Gravel, "gravel", "broken stone of several sizes", 1.0f,
             {{"stone_m", "m", 0.020f, 0.004f, 0.2f, "of the stones"},
              {"roundness", "share", 0.25f, 0.0f, 1.0f, "0 broken by a crusher, 1 rolled by a river"},
              {"variety", "share", 0.5f, 0.0f, 1.0f, "of colours"},
              {"dust", "share", 0.35f, 0.0f, 1.0f, "fines on and between the stones"}},
             make_gravel},
            {MaterialKind::Soil, "soil", "earth of clods and crumbs with pebbles", 1.5f,
             {{"clod_m", "m", 0.040f, 0.01f, 0.2f, "of the clods"},
              {"stones", "share", 0.3f, 0.0f, 1.0f, "pebbles and grit"},
              {"trodden", "share", 0.4f, 0.0f, 1.0f, "pressed flat"},
              {"litter", "share", 0.4f, 0.0f, 1.0f, "dry stalks"}},
             make_soil}};
}

}  // namespace petrichor::texproc::detail
