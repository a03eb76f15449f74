#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_LOBE_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_PICTURE_LOBE_H

#include <array>

#include "texproc/prefilter/detail/map_surface.h"
#include "texproc/prefilter/detail/overlap.h"

namespace petrichor::texproc::detail {

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
    static constexpr int kEyes = 4, kLights = 12, kMost = kEyes * kLights;
    using Row = std::array<float, kMost>;

    void radiance(const Direction& n, float alpha2, float base_share, Row& out) const;
    void show(Row& radiance) const;
    void expose(const MapSurface& surface);

    int pairs_ = kMost;
    // One number a pair of eye and light; unit vectors, h between the two.
    alignas(64) Row vx_{}, vy_{}, vz_{}, lx_{}, ly_{}, lz_{}, hx_{}, hy_{}, hz_{};
    alignas(64) Row fresnel_{}, diffuse_{}, light2_{}, exposure_{};
};

}  // namespace petrichor::texproc::detail

#endif
