// Light of a polygon that is close to a point of a surface (scene/patches/near_light.h).
#ifndef PETRICHOR_FORMULAS_LIGHT_NEAR_LIGHT_H
#define PETRICHOR_FORMULAS_LIGHT_NEAR_LIGHT_H

#include "base/interop.h"

SHARED_BEGIN

// A corner's direction; a corner at the point itself has none.
SHARED_FN vec3 near_direction(vec3 corner)
{
    return corner * inversesqrt(max(dot(corner, corner), 1.0e-24f));
}

// An edge's part of Lambert's sum for the normal n: the angle from p to q over 2 pi, times how its plane faces. p and q
// need not be unit: their lengths are given too.
// The quotient of angle and sine is twice that of half the angle, over twice that half's cosine, w / v below, of the way between
// p and q: Hill's rational fit (2016) of it is good to 1e-4, and a point a hair beside an edge, which sees its ends half a turn
// apart, loses nothing. One quotient in all: on a CPU each costs as much as ten products.
SHARED_FN float near_edge(vec3 p, vec3 q, float length_p, float length_q, vec3 n)
{
    const vec3 between = p * length_q + q * length_p;
    const float v = 2.0f * length_p * length_q;
    const float w = max(sqrt(dot(between, between)), 5.0e-8f * v);
    const float above = 0.8543985f * v * v + (0.4965155f * v + 0.0145206f * w) * w;
    const float below = 3.4175940f * v * v + (4.1616724f * v + w) * w;
    return 2.0f * dot(cross(q, p), n) * above / max(below * w, 1.0e-37f);
}

// Where the way between two corners meets the horizon, for heights of two signs; not unit.
SHARED_FN vec3 near_crossing(vec3 p, vec3 q, float height_p, float height_q)
{
    return p * abs(height_q) + q * abs(height_p);
}

// What looks at a point from less than this of its own size away is the back of the sheet on which the point lies: a
// point is on it to rounding, and half of them would be in front.
SHARED_CONST float kNearSheet = 1.0e-3f;

// Share of a hemisphere about n, by cosine, that a convex polygon of four corners fills, 0..1: Lambert's sum
// over the edges of what of it is above the horizon. Corners relative to the point, in one plane, in turn from
// its front, the last one twice for a triangle; 0 from behind, and of the back of the point's own sheet.
SHARED_FN float near_form_factor(vec3 a, vec3 b, vec3 c, vec3 d, vec3 n)
{
    const float ha = dot(a, n);
    const float hb = dot(b, n);
    const float hc = dot(c, n);
    const float hd = dot(d, n);
    const bool up_a = ha >= 0.0f;
    const bool up_b = hb >= 0.0f;
    const bool up_c = hc >= 0.0f;
    const bool up_d = hd >= 0.0f;
    const vec3 ab = near_crossing(a, b, ha, hb);
    const vec3 bc = near_crossing(b, c, hb, hc);
    const vec3 cd = near_crossing(c, d, hc, hd);
    const vec3 da = near_crossing(d, a, hd, ha);
    // A convex polygon goes down once and comes up once: these stand for the ends that are below, and the sum ends along the
    // horizon between them. An edge with both ends below adds nothing.
    const vec3 none = splat3(0.0f);
    const vec3 down =
        near_direction(up_a && !up_b ? ab : up_b && !up_c ? bc : up_c && !up_d ? cd : up_d && !up_a ? da : none);
    const vec3 up =
        near_direction(!up_a && up_b ? ab : !up_b && up_c ? bc : !up_c && up_d ? cd : !up_d && up_a ? da : none);
    const float la = sqrt(dot(a, a));
    const float lb = sqrt(dot(b, b));
    const float lc = sqrt(dot(c, c));
    const float ld = sqrt(dot(d, d));
    const float side_ab = near_edge(up_a ? a : up, up_b ? b : down, up_a ? la : 1.0f, up_b ? lb : 1.0f, n);
    const float side_bc = near_edge(up_b ? b : up, up_c ? c : down, up_b ? lb : 1.0f, up_c ? lc : 1.0f, n);
    const float side_cd = near_edge(up_c ? c : up, up_d ? d : down, up_c ? lc : 1.0f, up_d ? ld : 1.0f, n);
    const float side_da = near_edge(up_d ? d : up, up_a ? a : down, up_d ? ld : 1.0f, up_a ? la : 1.0f, n);
    const float sum = (up_a || up_b ? side_ab : 0.0f) + (up_b || up_c ? side_bc : 0.0f) + (up_c || up_d ? side_cd : 0.0f) +
                      (up_d || up_a ? side_da : 0.0f) + near_edge(down, up, 1.0f, 1.0f, n);
    const vec3 diagonal = c - a;
    const vec3 area = cross(diagonal, d - b);
    const float area2 = dot(area, area);
    const float before = -dot(area, a);  // how far in front of it the point is, times the length of area
    const float against = -dot(area, n);
    const bool own_sheet = against > 0.0f && against * against > 0.5f * area2 &&
                           before * before < kNearSheet * kNearSheet * area2 * dot(diagonal, diagonal);
    const bool above = max(max(ha, hb), max(hc, hd)) > 0.0f;
    return above && before > 0.0f && !own_sheet ? clamp(sum, 0.0f, 1.0f) : 0.0f;
}

// How far before a polygon's plane the point is.
SHARED_FN float near_height(vec3 a, vec3 b, vec3 c, vec3 d)
{
    const vec3 area = cross(c - a, d - b);
    return -dot(area, a) * inversesqrt(max(dot(area, area), 1.0e-24f));
}

// Share of a polygon that is seen, linear over the height before its plane: a frame hides more of a pane from those that
// stand farther out. In one number: at the plane in steps, -1..2, and a reach before it, -2..3, as half of what is left.
SHARED_CONST float kNearSeenSteps = 1023.0f;
SHARED_FN float near_seen_packed(float at_plane, float at_reach)
{
    return floor((clamp(at_plane, -1.0f, 2.0f) + 1.0f) * (kNearSeenSteps / 3.0f) + 0.5f) +
           (clamp(at_reach, -2.0f, 3.0f) + 2.0f) * 0.1f;
}
// heights: height over reach.
SHARED_FN float near_seen(float packed, float heights)
{
    const float steps = floor(packed);
    const float at_plane = steps * (3.0f / kNearSeenSteps) - 1.0f;
    const float at_reach = (packed - steps) * 10.0f - 2.0f;
    return clamp(mix(at_plane, at_reach, clamp(heights, 0.0f, 1.0f)), 0.0f, 1.0f);
}

SHARED_END

#endif
