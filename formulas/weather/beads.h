// Drops on what water does not spread on (glass, paint, polish): beads that stay where they are,
// and drops that run down what is steep and take the beads of their way along. Stateless: any frame
// can be made alone.
//
// Beads are sections of balls in cells of space, one ball a cell, so that any surface has them
// without texture coordinates and without seams; three turned lattices keep them from standing in
// rows. Sizes and the angle at which water meets glass and paint: de Gennes, Brochard-Wyart and
// Quere 2004; laws of the picture are ours.
#ifndef PETRICHOR_FORMULAS_WEATHER_BEADS_H
#define PETRICHOR_FORMULAS_WEATHER_BEADS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

struct Beads {
    float cover;  // 0..1: water is here
    vec3 lean;    // of its surface: unit normal = lean + sqrt(1 - lean^2) * normal of the surface
    float wiped;  // 0..1: a drop has run through and taken the film with it
};

SHARED_CONST float kLargeBead_m = 0.013f;  // cells of its lattice; a bead is at most 0.45 of it
SHARED_CONST float kMiddleBead_m = 0.0065f;
SHARED_CONST float kSmallBead_m = 0.003f;
SHARED_CONST float kBeadLean = 0.85f;      // sine of the contact angle: 58 degrees
SHARED_CONST float kRunColumn_m = 0.045f;  // one way down each
SHARED_CONST float kRunRepeat_m = 0.9f;    // a drop on it every so far
SHARED_CONST float kRunTrail_m = 0.5f;

// How far a pixel shows a bead of a lattice: 1 wholly .. 0 it is smaller than the pixel.
SHARED_FN float bead_seen(float cell_m, float pixel_m)
{
    return 1.0f - smooth_edge(0.15f, 0.45f, pixel_m / cell_m);
}

// Three hundredths of numbers of one hash, each 0..1.
SHARED_FN vec3 three_of_hash(uint h)
{
    return vec3(float(h & 1023u), float((h >> 10u) & 1023u), float((h >> 20u) & 1023u)) / 1023.0f;
}

// The ball of the cell of `p` (in cells, turned): its lean comes back in turned axes too.
SHARED_FN Beads bead_of_cell(vec3 p, vec3 normal, uint seed, float amount)
{
    const vec3 corner = floor(p);
    const uint h = hash_u3(uint(int(corner.x)), uint(int(corner.y)),
                           uint(int(corner.z)) ^ (seed * 0x9e3779b9u));
    const vec3 place = three_of_hash(h);
    const vec3 kind = three_of_hash(hash_u(h ^ 0x68bc21ebu));
    const float grown = saturate(1.6f * amount - 0.6f * kind.y) * saturate(6.0f * amount);
    const float radius = (0.2f + 0.25f * kind.x * kind.x) * grown;
    const vec3 d = p - corner - (splat3(radius) + (1.0f - 2.0f * radius) * place);
    const float above = dot(d, normal);
    const vec3 along = d - normal * above;
    const float disc2 = radius * radius - above * above;
    const float x = dot(along, along) / max(disc2, 1.0e-6f);
    Beads b;
    b.cover = disc2 > 1.0e-4f ? 1.0f - smooth_edge(0.8f, 1.0f, x) : 0.0f;
    b.lean = along * (kBeadLean / sqrt(max(disc2, 1.0e-6f)));
    b.wiped = 0.0f;
    return b;
}

// A lattice turned by the rows of a rotation.
SHARED_FN Beads bead_of_lattice(vec3 position_m, vec3 normal, vec3 row0, vec3 row1, vec3 row2,
                                float cell_m, float amount, uint seed)
{
    const vec3 p =
        vec3(dot(row0, position_m), dot(row1, position_m), dot(row2, position_m)) / cell_m;
    const vec3 n = vec3(dot(row0, normal), dot(row1, normal), dot(row2, normal));
    Beads b = bead_of_cell(p, n, seed, amount);
    b.lean = row0 * b.lean.x + row1 * b.lean.y + row2 * b.lean.z;
    return b;
}

// A drop on its way down a column of steep surface, and the trail above it. at_m: along the
// surface, level and up; the lean comes back as (level, up, 0). amount: share of the columns that
// have one.
SHARED_FN Beads running_drop(vec2 at_m, float time_s, float amount, uint seed)
{
    const float column = floor(at_m.x / kRunColumn_m);
    const uint h = hash_u3(uint(int(column)), seed, 77u);
    const vec3 kind = three_of_hash(h);
    const vec3 more = three_of_hash(hash_u(h ^ 0x2c1b3c6du));
    // It stops, gathers, and goes on; never up.
    const float turn = time_s * (0.05f + 0.12f * kind.y) / kRunRepeat_m + kind.z;
    const float gone = turn + 0.14f * sin(6.2831853f * turn) * more.x;
    const float y = at_m.y / kRunRepeat_m + gone;
    const float above_m = fract(y) * kRunRepeat_m;
    const float way = 0.5f + 0.2f * sin(7.0f * at_m.y + 6.2831853f * more.y) +
                      0.09f * sin(31.0f * at_m.y + 6.2831853f * more.z);
    const float aside_m = at_m.x - (column + way) * kRunColumn_m;
    const float head_m = 0.0022f + 0.0018f * kind.x;
    // The head hangs a little below its middle and draws out above.
    const float up_m = above_m - head_m;
    const float along = up_m > 0.0f ? 0.45f * up_m : up_m;
    const vec2 q = vec2(aside_m, along) / head_m;
    const float head = 1.0f - smooth_edge(0.75f, 1.0f, dot(q, q));
    const float left = 1.0f - above_m / kRunTrail_m;
    const float narrow_m = head_m * 0.55f * sqrt(max(left, 0.0f)) *
                           (0.65f + 0.35f * sin(260.0f * at_m.y + 40.0f * more.x));
    const float t = aside_m / max(narrow_m, 1.0e-5f);
    const float trail = left > 0.0f && up_m > 0.0f
                            ? (1.0f - smooth_edge(0.7f, 1.0f, t * t)) * saturate(4.0f * left)
                            : 0.0f;
    const float there = kind.x < amount ? 1.0f : 0.0f;
    Beads b;
    b.cover = max(head, trail) * there;
    const bool of_head = head >= trail;
    const vec2 lean = of_head ? q * kBeadLean : vec2(0.6f * t * kBeadLean, 0.0f);
    const float size = max(length(lean), 1.0e-4f);
    const vec2 bounded = lean * (min(size, 0.9f) / size);
    b.lean = vec3(bounded.x, bounded.y, 0.0f);
    b.wiped = there * (1.0f - smooth_edge(head_m, 1.8f * head_m, abs(aside_m))) *
              saturate(1.2f - above_m / kRunRepeat_m) * step(0.0f, up_m + head_m);
    return b;
}

// amount    0..1, of the film that would be there if water spread
// pouring   0..1: drops run down what is steep while it rains
// pixel_m   width of a pixel on the surface
SHARED_FN Beads beads_on(vec3 position_m, vec3 normal, float amount, float pouring, float pixel_m,
                         float time_s)
{
    const Beads large = bead_of_lattice(
        position_m, normal, vec3(0.36f, 0.48f, 0.8f), vec3(-0.8f, 0.6f, 0.0f),
        vec3(-0.48f, -0.64f, 0.6f), kLargeBead_m, amount * saturate(0.65f + 0.6f * normal.y), 1u);
    const Beads middle =
        bead_of_lattice(position_m, normal, vec3(0.6f, 0.0f, 0.8f), vec3(0.64f, 0.6f, -0.48f),
                        vec3(-0.48f, 0.8f, 0.36f), kMiddleBead_m, amount, 2u);
    const Beads small =
        bead_of_lattice(position_m, normal, vec3(0.8f, 0.36f, -0.48f), vec3(0.0f, 0.8f, 0.6f),
                        vec3(0.6f, -0.48f, 0.64f), kSmallBead_m, amount, 3u);
    const float large_cover = large.cover * bead_seen(kLargeBead_m, pixel_m);
    const float middle_cover = middle.cover * bead_seen(kMiddleBead_m, pixel_m);
    const float small_cover = small.cover * bead_seen(kSmallBead_m, pixel_m);
    Beads b;
    b.cover = max(large_cover, max(middle_cover, small_cover));
    b.lean = large_cover >= max(middle_cover, small_cover) ? large.lean
             : middle_cover >= small_cover                 ? middle.lean
                                                           : small.lean;
    b.wiped = 0.0f;
    // Ways down are laid out in the upright plane that the surface is nearest to; none where two
    // are as near.
    const bool east = abs(normal.x) > abs(normal.z);
    const float steep = smooth_edge(0.5f, 0.8f, 1.0f - normal.y * normal.y) *
                        smooth_edge(0.05f, 0.2f, abs(abs(normal.x) - abs(normal.z)));
    const Beads run = running_drop(vec2(east ? position_m.z : position_m.x, position_m.y), time_s,
                                   pouring * amount, east ? 11u : 12u);
    const float run_seen = steep * bead_seen(0.008f, pixel_m);
    const float run_cover = run.cover * run_seen;
    b.wiped = run.wiped * run_seen;
    b.cover *= 1.0f - b.wiped;
    if (run_cover >= b.cover) {
        const vec3 level = east ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f);
        const vec3 lean = level * run.lean.x + vec3(0.0f, 1.0f, 0.0f) * run.lean.y;
        b.lean = lean - normal * dot(normal, lean);
        b.cover = run_cover;
    }
    return b;
}

// Unit normal of the water.
SHARED_FN vec3 bead_normal(Beads b, vec3 normal)
{
    return normalize(b.lean + normal * sqrt(max(1.0f - dot(b.lean, b.lean), 0.04f)));
}

// How far a surface keeps water from spreading, of what its pores let it: waxed leather does, felt
// does not.
SHARED_FN float beading_share(float beads, float porosity)
{
    return beads * (1.0f - smooth_edge(0.55f, 0.95f, porosity));
}

SHARED_END

#endif
