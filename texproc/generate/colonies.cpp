#include "texproc/generate/detail/colonies.h"

#include <array>

namespace petrichor::texproc::detail {

using glm::vec3;

Lichen::Lichen(const MaterialSurface& surface, std::uint32_t salt)
    : large_(surface, 0.070f, salt), small_(surface, 0.019f, salt + 1u),
      lobes_(noise_layer(surface, {0.012f, 0.012f, 3, 0.55f, 700u + salt})),
      grain_(noise_layer(surface, {0.0032f, 0.0032f, 2, 0.7f, 701u + salt})),
      zone_(noise_layer(surface, {0.45f, 0.45f, 3, 0.5f, 702u + salt}))
{
}

LichenAt Lichen::at(float x_m, float y_m, std::size_t k, float share) const
{
    // The commonest first.
    static const std::array<vec3, 6> kColors = {vec3(0.205f, 0.212f, 0.172f), vec3(0.275f, 0.280f, 0.248f),
                                                vec3(0.160f, 0.175f, 0.135f), vec3(0.225f, 0.205f, 0.130f),
                                                vec3(0.185f, 0.195f, 0.158f), vec3(0.260f, 0.165f, 0.045f)};
    LichenAt result;
    const float here = share * smooth_step(-0.5f, 1.0f, zone_[k] + 0.10f * lobes_[k]);
    for (const Colonies* layer : {&large_, &small_}) {
        const ColonyAt c = layer->at(x_m, y_m, here);
        const float rim = c.inside + 0.55f * lobes_[k] * std::min(1.0f, 0.010f / std::max(c.radius_m, 1e-4f) + 0.40f);
        if (rim <= -0.25f) continue;
        // Old rosettes fall out in the middle.
        const float hollow = hash_unit(c.id, 9) > 0.7f ? smooth_step(0.45f, 0.85f, c.inside + 0.2f * lobes_[k]) : 0.0f;
        const float cover = smooth_step(-0.02f, 0.45f, rim + 0.34f * grain_[k]) * (1.0f - 0.8f * hollow);
        if (cover <= result.cover) continue;
        result.cover = cover;
        result.thick_m = 0.0009f * cover * (0.6f + 0.4f * (1.0f - c.inside)) + 0.00022f * grain_[k] * cover;
        const vec3 base = kColors[static_cast<std::size_t>(hash_unit(c.id, 10) * hash_unit(c.id, 12) * 6.0f) % 6u];
        // A pale rim that grows, darker fruits within.
        result.color = base * (1.0f + 0.18f * smooth_step(0.45f, 0.0f, rim) + 0.20f * grain_[k] +
                               0.10f * hash_signed(c.id, 11));
    }
    return result;
}

}  // namespace petrichor::texproc::detail
