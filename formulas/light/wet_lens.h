// Drops on the front glass of a lens: out of focus, each a small lens that turns what lies behind
// it upside down. They come while it rains, stay some seconds and dry. Stateless, as
// formulas/weather/beads.h; sizes are ours.
#ifndef PETRICHOR_FORMULAS_LIGHT_WET_LENS_H
#define PETRICHOR_FORMULAS_LIGHT_WET_LENS_H

#include "base/interop.h"
#include "formulas/weather/beads.h"

SHARED_BEGIN

struct LensDrop {
    float cover;   // 0..1: how far the picture is seen through a drop here
    vec2 shift;    // to what is seen, in heights of the picture
    float bright;  // share of light that its rim leaves
};

SHARED_CONST float kLensDropStay_s = 5.0f;
SHARED_CONST float kLensDropShift = 0.33f;

// Those of one size that have come in one turn. p: from the middle of the picture, in heights of
// it.
SHARED_FN LensDrop lens_drops_of(vec2 p, float cell, float amount, float turn, uint seed)
{
    const float epoch = floor(turn);
    const float age = turn - epoch;
    const float here =
        amount * smooth_edge(0.0f, 0.06f, age) * (1.0f - smooth_edge(0.75f, 1.0f, age));
    const vec3 n = vec3(0.0f, 0.0f, 1.0f);
    const vec3 row0 = vec3(0.36f, 0.48f, 0.8f);
    const vec3 row1 = vec3(-0.8f, 0.6f, 0.0f);
    const vec3 row2 = vec3(-0.48f, -0.64f, 0.6f);
    // A slice of its own through the balls of space for every turn.
    const Beads b =
        bead_of_lattice(vec3(p.x, p.y, 3.7f * cell * epoch), n, row0, row1, row2, cell, here, seed);
    const float lean = length(b.lean) / kBeadLean;
    LensDrop d;
    d.cover = b.cover * (1.0f - smooth_edge(0.25f, 0.95f, lean));
    d.shift = vec2(b.lean.x, b.lean.y) * (-kLensDropShift / kBeadLean);
    d.bright = 1.0f - 0.25f * lean * lean;
    return d;
}

// amount: 0 dry .. 1 as wet as it gets.
SHARED_FN LensDrop lens_drops(vec2 p, float amount, float time_s)
{
    const float turn = time_s / kLensDropStay_s;
    // Drops that have run together are no circles.
    const vec2 uneven = p + 0.006f * vec2(sin(19.0f * p.y + 1.3f) + sin(41.0f * p.y + 17.0f * p.x),
                                          sin(23.0f * p.x + 0.4f) + sin(37.0f * p.x - 23.0f * p.y));
    LensDrop best;
    best.cover = 0.0f;
    best.shift = splat2(0.0f);
    best.bright = 1.0f;
    for (int k = 0; k < 4; ++k) {
        const float cell = k < 2 ? 0.24f : 0.1f;
        const LensDrop d =
            lens_drops_of(uneven, cell, k < 2 ? amount : 0.6f * amount,
                          turn + 0.5f * float(k & 1) + 0.23f * float(k >> 1), 21u + uint(k));
        if (d.cover > best.cover) best = d;
    }
    return best;
}

SHARED_END

#endif
