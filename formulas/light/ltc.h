// Light of shapes by linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016): seen through a
// matrix, the lobe of a rough mirror is a cosine, and a cosine's share of a polygon has a closed form
// (formulas/light/area.h). The matrices are a table over roughness and angle (gpu/lighting/ltc_table.inc).
//
// Round shapes are polygons of kOutlineCorners corners and of their own area.
#ifndef PETRICHOR_FORMULAS_LIGHT_LTC_H
#define PETRICHOR_FORMULAS_LIGHT_LTC_H

#include "base/interop.h"
#include "formulas/light/area.h"
#include "formulas/light/layers.h"

SHARED_BEGIN

#define LTC_TABLE_SIDE 32  // rows of roughness, each with so many angles

SHARED_CONST int kOutlineCorners = 16;
SHARED_CONST float kOutlineScale = 1.0130013f;  // radius of the polygon for a circle's area

// The edge of a light as it is seen: two half rings about two ends, or four corners.
struct Outline {
    vec3 first;         // middle of the half ring that `out` points to; of a rectangle its middle
    vec3 second;        // of the other one
    vec3 first_out;     // radii of the rings; of a rectangle half its edges
    vec3 first_side;
    vec3 second_out;
    vec3 second_side;
    int corners;
};

SHARED_FN Outline rectangle_outline(vec3 centre, vec3 half_u, vec3 half_v)
{
    Outline o;
    o.first = centre;
    o.second = centre;
    o.first_out = half_u;
    o.first_side = half_v;
    o.second_out = half_u;
    o.second_side = half_v;
    o.corners = 4;
    return o;
}

// A flat disc; its front is cross(u, v), both as long as the radius.
SHARED_FN Outline disc_outline(vec3 centre, vec3 u, vec3 v)
{
    Outline o = rectangle_outline(centre, u * kOutlineScale, v * kOutlineScale);
    o.corners = kOutlineCorners;
    return o;
}

// A tube with round ends from `a` to `b`, relative to the eye; a sphere where these are the same.
SHARED_FN Outline tube_outline(vec3 a, vec3 b, float radius)
{
    Outline o;
    const vec3 axis = b - a;
    const float far_a = max(length(a), 1.0e-4f);
    const float far_b = max(length(b), 1.0e-4f);
    const vec3 to_a = a / far_a;
    const vec3 to_b = b / far_b;
    // What is seen of a sphere is a disc before its middle.
    const float sin_a = min(radius / far_a, 0.98f);
    const float sin_b = min(radius / far_b, 0.98f);
    const float cos2_a = 1.0f - sin_a * sin_a;
    const float cos2_b = 1.0f - sin_b * sin_b;
    const float size_a = far_a * sin_a * sqrt(cos2_a) * kOutlineScale;
    const float size_b = far_b * sin_b * sqrt(cos2_b) * kOutlineScale;
    vec3 side = cross(axis, to_b);
    const float level = length(side);
    side = level > 1.0e-4f * far_b ? side / max(level, 1.0e-12f) : frame_tangent(to_b);
    o.first = b * cos2_b;
    o.second = a * cos2_a;
    o.first_side = side * size_b;
    o.second_side = side * size_a;
    o.first_out = cross(to_b, side) * size_b;
    // The side is across the plane of both ends and the eye, and so across `to_a` too.
    vec3 out_a = cross(to_a, side);
    o.second_out = out_a * (size_a * inversesqrt(max(dot(out_a, out_a), 1.0e-12f)));
    o.corners = kOutlineCorners;
    return o;
}

// Corner of an outline; `turn` is cosine and sine of its angle.
SHARED_FN vec3 outline_corner(Outline o, vec2 turn, int i)
{
    if (o.corners == 4) {
        const float u = i == 1 || i == 2 ? 1.0f : -1.0f;
        const float v = i >= 2 ? 1.0f : -1.0f;
        return o.first + o.first_out * u + o.first_side * v;
    }
    return turn.x > 0.0f ? o.first + o.first_out * turn.x + o.first_side * turn.y
                         : o.second + o.second_out * turn.x + o.second_side * turn.y;
}

// Rows of a matrix that turns and stretches space.
struct Frame3 {
    vec3 x;
    vec3 y;
    vec3 z;
};

SHARED_FN vec3 through(Frame3 f, vec3 p)
{
    return vec3(dot(f.x, p), dot(f.y, p), dot(f.z, p));
}

// The lobe's frame at a surface: the eye lies in the plane of x and the normal.
SHARED_FN Frame3 surface_frame(vec3 n, vec3 v)
{
    Frame3 f;
    const vec3 level = v - n * dot(n, v);
    const float size = length(level);
    f.x = size > 1.0e-4f ? level / max(size, 1.0e-12f) : frame_tangent(n);
    f.y = cross(n, f.x);
    f.z = n;
    return f;
}

// The same, after which the lobe is a cosine about z. `m` is the table's: the middle of the matrix is 1.
SHARED_FN Frame3 lobe_frame(Frame3 surface, vec4 m)
{
    Frame3 f;
    f.x = surface.x * m.x + surface.z * m.y;
    f.y = surface.y;
    f.z = surface.x * m.z + surface.z * m.w;
    return f;
}

// The vector of the irradiance of an outline (formulas/light/area.h), in that frame.
SHARED_FN vec3 outline_irradiance(Outline o, Frame3 f)
{
    // Half a step before the first corner: no corner lies where the half rings meet.
    const vec2 step_turn = vec2(0.92387953f, 0.38268343f);
    vec2 turn = vec2(0.98078528f, -0.19509032f);
    vec3 before = normalize(through(f, outline_corner(o, turn, o.corners - 1)));
    turn = vec2(0.98078528f, 0.19509032f);
    vec3 sum = splat3(0.0f);
    for (int i = 0; i < o.corners; ++i) {
        const vec3 here = normalize(through(f, outline_corner(o, turn, i)));
        sum = sum + edge_irradiance(here, before);
        before = here;
        turn = vec2(turn.x * step_turn.x - turn.y * step_turn.y,
                    turn.x * step_turn.y + turn.y * step_turn.x);
    }
    return sum;
}

// Share of a cosine lobe about z that an outline fills, 0..1, of its irradiance vector.
SHARED_FN float cosine_share(vec3 irradiance)
{
    const float size = length(irradiance);
    return size < 1.0e-7f ? 0.0f : sphere_form_factor(size, irradiance.z / size);
}

// Where the table is read: roughness, angle; 0..1.
SHARED_FN vec2 ltc_place(float roughness, float nv)
{
    return vec2(clamp(roughness, 0.0f, 1.0f), sqrt(max(1.0f - nv, 0.0f)));
}

// Sphere and tube as one point that stands for the highlight, as Lux 2.02 has them (Karis 2013): the
// point of the light that is nearest to the mirrored ray, and what its size takes from the highlight.
struct NearestLight {
    vec3 direction;  // to it, unit
    float energy;
};

// Relative to the surface: `centre`, half the axis (0 of a sphere). r: the mirrored direction.
SHARED_FN NearestLight nearest_light(vec3 centre, vec3 half_axis, float radius, vec3 r, float alpha)
{
    vec3 q = centre;
    const float length2 = 4.0f * dot(half_axis, half_axis);
    if (length2 > 0.0f) {
        const vec3 e0 = centre - half_axis;
        const vec3 e = half_axis * 2.0f;
        const float re = dot(r, e);
        const float across = length2 - re * re;
        // Along the axis every point is as near: the middle.
        const float t = across > 1.0e-6f * length2 ? (dot(r, e0) * re - dot(e0, e)) / across : 0.5f;
        q = e0 + e * clamp(t, 0.0f, 1.0f);
    }
    const vec3 c = r * dot(q, r) - q;
    const vec3 nearest = q + c * clamp(radius / max(length(c), 1.0e-6f), 0.0f, 1.0f);
    const float a = max(alpha, 0.05f);
    const float s = clamp(radius / max(length(centre), 1.0e-6f), 0.0f, 1.0f);
    const float z = a / clamp(a + 0.5f * s, 0.0f, 1.0f);
    NearestLight light;
    light.direction = normalize(nearest);
    light.energy = z * z;
    return light;
}

// Direction in which such a light shines on a matt surface: of its nearest point along the axis.
SHARED_FN vec3 nearest_on_axis(vec3 centre, vec3 half_axis)
{
    const float h = length(half_axis);
    if (h <= 0.0f) return normalize(centre);
    const vec3 y = half_axis / h;
    return normalize(centre - y * clamp(dot(centre, y), -h, h));
}

SHARED_END

#endif
