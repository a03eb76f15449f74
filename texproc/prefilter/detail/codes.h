#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_CODES_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_CODES_H

#include <array>

#include "texproc/prefilter/detail/lobe_cost.h"

namespace petrichor::texproc::detail {

/// How a lobe is stored in a file of integers.
struct StoredAs {
    int bits = 0;             ///< 0: as floats, else 8 or 16
    bool smoothness = false;  ///< 1 - p instead of p
    bool alpha = false;       ///< p^2 instead of p
    bool green_down = false;
    bool rebuild_z = false;  ///< only x and y are read
};

/// The numbers of a file, 0..1.
struct Codes {
    std::array<float, 3> normal{};
    float rough = 0.0f;
};
Codes rounded(const Direction& normal, float alpha2, const StoredAs& as);
/// What a reader makes of codes.
Direction read_normal(const Codes& codes, const StoredAs& as);
float read_alpha2(const Codes& codes, const StoredAs& as);

/// No normal is written shorter: the shorter a vector, the less it counts where a filter blends it with
/// its neighbours.
inline constexpr float kShortestNormal = 0.75f;

/// True where rounding to these bits moves the lobe by a visible part of its width.
bool coarse_codes(float lit_alpha2, const StoredAs& as);

/// The codes that cost least near a lobe: eight bits hold few directions of unit length, but
/// readers normalise, so vectors up to a quarter shorter reach directions between them; and the roughness
/// is chosen for the direction that is really stored. `plain`: codes that must not be beaten by the
/// choice. light2: added to alpha^2 on reading.
Codes cheapest_codes(const LobeCost& cost, const Direction& normal, float alpha2,
                     const Codes& plain, float light2, const StoredAs& as);

}  // namespace petrichor::texproc::detail

#endif
