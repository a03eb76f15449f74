#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_LIGHTS_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FIT_LIGHTS_H

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "base/portable_math.h"
#include "texproc/prefilter/detail/chain_fit_kernel.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc::detail {

inline constexpr float kFitDegree = 0.0174532925f, kFitTurn = 6.28318531f;

/// What views, places and lights of a fit are drawn from.
class FitDice {
public:
    explicit FitDice(std::uint64_t seed) : state_(seed) {}
    std::uint32_t whole()  // SplitMix64
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
    }
    float operator()(float low, float high)
    {
        return low + (high - low) * static_cast<float>(whole() >> 8) * (1.0f / 16777216.0f);
    }
    float gaussian()
    {
        const float radius = std::sqrt(-2.0f * portable_log((*this)(1e-7f, 1.0f)));
        return radius * portable_cos((*this)(0.0f, kFitTurn));
    }

private:
    std::uint64_t state_;
};

/// The eight lights of a view (docs/textures.md, 8), of both classes five on paint and three on metal.
///
///   azimuth  where the eye looks, radians
///   eye      the direction towards it
void draw_fit_lights(FitDice& dice, SurfaceClass surface, float azimuth, const glm::vec3& eye, FitLights& to);

}  // namespace petrichor::texproc::detail

#endif
