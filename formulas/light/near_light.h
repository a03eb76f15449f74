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

// An edge's part of Lambert's sum for the normal n: the angle from p to q over 2 pi, times how its plane faces.
// The quotient of angle and sine is Hill's rational fit (2016), good to 1e-4, with the sine from the cross
// product: a point a hair beside an edge sees its ends half a turn apart.
SHARED_FN float near_edge(vec3 p, vec3 q, vec3 n)
{
    const vec3 across = cross(q, p);
    const float c = clamp(dot(p, q), -1.0f, 1.0f);
    const float y = abs(c);
    const float acute =
        (0.8543985f + (0.4965155f + 0.0145206f * y) * y) / (3.4175940f + (4.1616724f + y) * y);
    const float quotient = c > 0.0f ? acute : 0.5f * inversesqrt(max(dot(across, across), 1.0e-14f)) - acute;
    return dot(across, n) * quotient;
}

// Where the way between two corners meets the horizon, as a direction, for heights of two signs.
SHARED_FN vec3 near_crossing(vec3 p, vec3 q, float height_p, float height_q)
{
    return near_direction(p * abs(height_q) + q * abs(height_p));
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
    const vec3 p = near_direction(a);
    const vec3 q = near_direction(b);
    const vec3 r = near_direction(c);
    const vec3 s = near_direction(d);
    // On each edge: what stands for an end that is below. Both ends below are one place and add nothing.
    const vec3 ab = near_crossing(a, b, ha, hb);
    const vec3 bc = near_crossing(b, c, hb, hc);
    const vec3 cd = near_crossing(c, d, hc, hd);
    const vec3 da = near_crossing(d, a, hd, ha);
    const bool up_a = ha >= 0.0f;
    const bool up_b = hb >= 0.0f;
    const bool up_c = hc >= 0.0f;
    const bool up_d = hd >= 0.0f;
    float sum = near_edge(up_a ? p : ab, up_b ? q : ab, n) + near_edge(up_b ? q : bc, up_c ? r : bc, n) +
                near_edge(up_c ? r : cd, up_d ? s : cd, n) + near_edge(up_d ? s : da, up_a ? p : da, n);
    // A convex polygon goes down once and comes up once: along the horizon between.
    const vec3 none = splat3(0.0f);
    const vec3 down = up_a && !up_b ? ab : up_b && !up_c ? bc : up_c && !up_d ? cd : up_d && !up_a ? da : none;
    const vec3 up = !up_a && up_b ? ab : !up_b && up_c ? bc : !up_c && up_d ? cd : !up_d && up_a ? da : none;
    sum = sum + near_edge(down, up, n);
    const vec3 diagonal = c - a;
    const vec3 area = cross(diagonal, d - b);
    const float area2 = dot(area, area);
    const float before = -dot(area, a);  // how far in front of it the point is, times the length of area
    const float against = -dot(area, n);
    const bool own_sheet = against > 0.0f && against * against > 0.5f * area2 &&
                           before * before < kNearSheet * kNearSheet * area2 * dot(diagonal, diagonal);
    return before > 0.0f && !own_sheet ? clamp(sum, 0.0f, 1.0f) : 0.0f;
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
