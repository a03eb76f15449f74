#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_SPLIT_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_LOBE_SPLIT_H

#include <array>
#include <span>

namespace petrichor::texproc::detail {

/// A texel of level 0 in a footprint: x and y of its unit normal, perceptual roughness.
struct SplitSample {
    float x, y, p;
};
/// What belongs to one lobe: means, and the variance of the normals (of x and y together).
struct SplitLobe {
    float x = 0.0f, y = 0.0f, p = 0.0f, spread = 0.0f;
};
struct LobeSplit {
    std::array<SplitLobe, 2> lobes;
    float second = 0.5f;  ///< share of the second
    float gain = 0.0f;    ///< what two are likelier than one, in log likelihood of a sample; 0: one is as good
};

/// Parts a footprint in two: the mixture of two round Gaussians of normals that is likeliest for its
/// texels, each with the variance of its own lobe about its own normal. So two glosses part as two
/// glosses, two slopes as two slopes, a few steep scratches as a wide lobe below a narrow one.
/// The narrower one is the first.
LobeSplit split_lobes(std::span<const SplitSample> samples);

/// Alpha^2 of a lobe by its moments: its own and what its normals spread.
float width2(const SplitLobe& lobe);
/// How far two lobes are apart, in their own widths: which of two of a texel goes with which of its neighbour's.
float lobe_distance(const SplitLobe& a, const SplitLobe& b);

}  // namespace petrichor::texproc::detail

#endif
