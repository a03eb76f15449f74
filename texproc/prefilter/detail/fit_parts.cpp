#include "texproc/prefilter/detail/fit_parts.h"

#include <algorithm>
#include <cmath>

#include "texproc/prefilter/detail/chain_fit.h"

namespace petrichor::texproc::detail {

std::array<std::vector<Image>*, 7> parts_of(Prefiltered& chain)
{
    return {&chain.roughness,     &chain.normal,           &chain.metal_share,
            &chain.second.normal, &chain.second.roughness, &chain.second.share, &chain.base_share};
}

FitLevels fitted_levels(Prefiltered& chain)
{
    FitLevels all(chain.roughness.size());
    for (std::size_t k = 1; k < all.size(); ++k) {
        if (!is_fitted(chain.roughness[k].width, chain.roughness[k].height)) continue;
        const auto parts = parts_of(chain);
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (k < parts[i]->size()) all[k][i] = (*parts[i])[k];
    }
    return all;
}

void mix(const Image& from, const Image& to, float share, Image& mixed)
{
    for (std::size_t i = 0; i < mixed.pixels.size(); ++i)
        mixed.pixels[i] = from.pixels[i] + share * (to.pixels[i] - from.pixels[i]);
    if (mixed.channels < 3) return;
    for (std::size_t i = 0; i < mixed.pixels.size(); i += 3) {  // normals, made unit length again
        float* code = &mixed.pixels[i];
        float squares = 0.0f;
        for (int c = 0; c < 3; ++c) squares += (2.0f * code[c] - 1.0f) * (2.0f * code[c] - 1.0f);
        const float scale = 1.0f / std::sqrt(std::max(squares, 1e-12f));
        for (int c = 0; c < 3; ++c) code[c] = 0.5f + scale * (code[c] - 0.5f);
    }
}

}  // namespace petrichor::texproc::detail
