#include "texproc/generate/detail/strokes.h"

namespace petrichor::texproc::detail {

void draw_fibres(MaterialSurface& surface, const Fibres& fibres)
{
    const std::uint32_t seed = hash_u32(surface.seed + 501u * fibres.salt);
    const int count = static_cast<int>(std::min(fibres.count_m2 * surface.tile_m * surface.tile_m, 200000.0f));
    const float to_texels = static_cast<float>(surface.size) / surface.tile_m;
    for (int f = 0; f < count; ++f) {
        const std::uint32_t h = hash_cell(f, 9, seed);
        const float length = fibres.length_m * (0.25f + 0.75f * hash_unit(h, 4)) * to_texels;
        const Stroke stroke{hash_unit(h, 1) * static_cast<float>(surface.size),
                            hash_unit(h, 2) * static_cast<float>(surface.size),
                            6.2831853f * hash_unit(h, 3),
                            length,
                            0.5f * fibres.width_m * (0.5f + hash_unit(h, 5)) * to_texels,
                            1.1f * hash_signed(h, 6) / length};
        const glm::vec3 color = fibres.color * (0.7f + 0.6f * hash_unit(h, 7));
        // It lies straight over what is uneven: a texel that it has met it leaves alone.
        float level = -1.0e9f;
        draw_stroke(surface, stroke, [&](MaterialTexel& texel, float, float across) {
            level = std::max(texel.height_m, level - 0.0004f);
            const float height = level + fibres.rise_m * (1.0f - across * across);
            if (height <= texel.height_m) return;
            texel.height_m = height;
            level = height - fibres.rise_m * (1.0f - across * across);
            texel.albedo = color * (1.0f - 0.35f * across * across);
            texel.roughness = 0.72f;
        });
    }
}

}  // namespace petrichor::texproc::detail
