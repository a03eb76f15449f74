#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_COST_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_COST_H

#include <array>

#include "texproc/prefilter/detail/lobe_tools.h"

namespace petrichor::texproc::detail {

/// What every lobe for a footprint is measured against.
struct Whole {
    std::array<float, kViews> mass{};  ///< mirrored light under each view
    Direction mean;                    ///< mean normal, as short as it is
};
Whole whole_of(const CellsView& cells, const Means& means);

/// A lobe with what it costs.
struct Candidate {
    Direction normal;
    float alpha2 = 0.0f;  ///< with the light
    float cost = 2.0f;
};

/// What a lobe costs on one set of samples: mass + mass - 2 overlap, relative to the mass of the
/// footprint, mean over the views, 0..2. A lobe that wanders off the samples costs 2. To that comes
/// a share of what its normal n does to diffuse light, |n - mean|^2 more than the mean direction
/// itself, so that no texel turns from the light for a little more gloss.
class LobeCost {
public:
    /// Draws the samples into `storage`, which must outlive the cost.
    LobeCost(const CellsView& cells, const Whole& whole, int samples, std::uint32_t seed,
             Samples& storage);

    static constexpr int kMost = 16;
    /// For up to kMost lobes that share a normal.
    void operator()(const Direction& n, const float* alpha2s, int count, float* costs) const;
    float operator()(const Direction& n, float alpha2) const;
    /// Elliptic lobes have no table: their mass is that of the isotropic lobe as wide as each view
    /// sees them.
    float operator()(const EllipticLobe& lobe) const;

    /// The brightest half-vector drawn and the narrow lobe that would be as bright there.
    Candidate mode() const;

private:
    float diffuse(const Direction& n) const;

    const LobeKernel& kernel_;
    Samples& storage_;
    Whole whole_;
    float length_;  ///< of the mean
};

/// n + u t + v b, unit.
Direction leaned(const Frame& frame, float u, float v);

}  // namespace petrichor::texproc::detail

#endif
