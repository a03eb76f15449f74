#ifndef PETRICHOR_TEXPROC_STUDY_DETAIL_YARDSTICK_H
#define PETRICHOR_TEXPROC_STUDY_DETAIL_YARDSTICK_H

#include <array>
#include <cstdint>
#include <vector>

#include "texproc/prefilter/detail/cells.h"
#include "texproc/prefilter/detail/lobe_kernel.h"
#include "texproc/prefilter/detail/lobe_tools.h"

namespace petrichor::texproc::detail {

// One mip texel on the yardstick: half-vectors, and the light that a lobe misplaces there.

/// A stream of uniform numbers in [0, 1) from a seed (splitmix64).
struct Random {
    std::uint64_t state;
    double operator()()
    {
        state += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        z ^= z >> 31;
        return static_cast<double>(z >> 11) / 9007199254740992.0;
    }
};

/// D(h) (n.h) of a GGX lobe, 0 behind it. In doubles and from n x h, where formulas/light/brdf.h
/// takes 1 - (n.h)^2: weights are one over this, and for narrow lobes single precision is nothing
/// but rounding there. lobe_twins_test.cpp holds the two together.
double lobe_density(double alpha2, const Direction& n, double hx, double hy, double hz);

/// Widths from the narrowest to the widest lobe that may be tested, at most a factor of 4 in alpha
/// apart: between two that are further apart a lobe could hide where no point lies, and look half
/// as bad as it is.
std::vector<float> widths_between(float narrow2, float wide2);

/// The points of one texel: half-vectors from the footprint (half) and from lobes about the mean
/// normal of these widths, weighted by one over the density of the mixture; shaded by the
/// footprint.
void place_points(const Cells& cells, const Direction& mean, const std::vector<float>& widths,
                  int points, Random& random, Samples& samples);

/// Light of the footprint under each view.
std::array<double, kViews> reference_mass(Samples& samples);

EllipticLobe round_lobe(const Direction& n, float alpha2);

struct Measure {
    double error = 0.0;   ///< misplaced light, mean over the views, 0..2
    double energy = 0.0;  ///< light of the lobe over that of the reference, - 1
};
Measure measure(Samples& samples, const std::array<double, kViews>& mass, const EllipticLobe& lobe);

/// The error of the best isotropic alpha about the mean normal (a scan in log alpha, then golden
/// section), at most plain_error. narrowest: the smallest alpha worth a try.
double best_error(Samples& samples, const std::array<double, kViews>& mass, const Direction& mean,
                  double plain_error, double narrowest);

}  // namespace petrichor::texproc::detail

#endif
