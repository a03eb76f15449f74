#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_LOBE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_LOBE_H

#include <array>

#include "texproc/prefilter/detail/map_surface.h"
#include "texproc/prefilter/detail/overlap.h"

namespace petrichor::texproc::detail {

/// Pairs of eye and light, one number each: unit vectors, h between the two.
struct LitPairs {
    static constexpr int kMost = 48;
    using Row = std::array<float, kMost>;

    int count = kMost;
    alignas(64) Row vx{}, vy{}, vz{}, lx{}, ly{}, lz{}, hx{}, hy{}, hz{};
    alignas(64) Row fresnel{}, diffuse{}, light2{}, exposure{};
};

/// What the eye of each pair receives from a surface, times the exposure.
using PairRadiance = void (*)(const LitPairs& pairs, const Direction& n, float alpha2, float base_share,
                              LitPairs::Row& out);
/// The sum of the squares of what a display shows otherwise than `shown`.
using PairDistance = float (*)(const LitPairs& pairs, const Direction& n, float alpha2, float base_share,
                               const LitPairs::Row& shown);
struct PairKernel {
    PairRadiance radiance;
    PairDistance distance;
};
/// For plain processors, and for this one: the same operations in more lanes, so the same bits.
PairKernel plain_pair_kernel();
PairKernel pair_kernel();

/// The rule `picture` (docs/textures.md, 8): the roughness with which a mip texel looks most like
/// its footprint where a floor of the material is lit and shown: diffuse and specular light
/// together, over a fixed set of eyes and lights, as the display shows it.
class PictureLobe {
public:
    /// quick: half of the eyes; metal: nothing is diffuse. How bright each picture is exposed is found from the surface.
    PictureLobe(const MapSurface& surface, bool quick, bool metal = false);

    /// The normal is the mean one, of unit length: what that adds to diffuse light is to be taken
    /// from the base colour (Prefiltered::base_share). Never dearer than the plain mip.
    FittedLobe operator()(const Cells& cells, const Means& means) const;

private:
    static constexpr int kEyes = 4, kLights = 12;
    static_assert(kEyes * kLights == LitPairs::kMost);
    using Row = LitPairs::Row;

    void radiance(const Direction& n, float alpha2, float base_share, Row& out) const;
    void show(Row& radiance) const;
    void expose(const MapSurface& surface);

    LitPairs pairs_;
    PairKernel kernel_ = pair_kernel();
};

}  // namespace petrichor::texproc::detail

#endif
