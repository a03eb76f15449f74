// Shapes that a ray marches to instead of meeting triangles: how far away they are, and where it meets them.
//
// One text for C++ and GLSL. A shape stands in a space of its own, around the origin; `half` is half of the box
// that holds it (shape_half). Distances are below zero inside and never more than the true one, so a ray may go
// that far.
// Source: Hart 1996, Sphere tracing (The Visual Computer 12); Hart, Sandin and Kauffman 1989, Ray tracing
// deterministic 3-D fractals; White and Nylander 2009 for the power of a point that makes the Mandelbulb. That
// one step of folding is exact for the tetrahedron and the sponge is our own: both sets are mirrored by the
// planes of the fold, so the nearest point lies on this side of each of them.
#ifndef PETRICHOR_FORMULAS_GEOMETRY_SHAPES_H
#define PETRICHOR_FORMULAS_GEOMETRY_SHAPES_H

#include "base/interop.h"

// Kinds, as `half` and distance have them.
#define SHAPE_MANDELBULB 0
#define SHAPE_SIERPINSKI 1  // tetrahedron with the corners (1,1,1), (1,-1,-1), (-1,1,-1), (-1,-1,1)
#define SHAPE_MENGER 2      // sponge of the cube of -1 to 1
#define SHAPE_SPHERE 3      // of radius 1
#define SHAPE_BOX 4         // of the size of its box
#define SHAPE_TORUS 5       // around y

SHARED_BEGIN

struct MarchedShape {
    int kind;
    int iterations;  // levels of a set that is made in steps
    float power;     // of the Mandelbulb, 2 to 12
    vec3 half_m;     // half of its box, in its own units
};

SHARED_CONST float kBulbEscape = 4.0f;   // orbits beyond it never come back
SHARED_CONST int kShapeSteps = 192;      // of a ray, at most
// So near, as a share of the footprint, a ray has met the shape. More would give edges a rim that looks both ways.
SHARED_CONST float kShapeTouch = 0.04f;
SHARED_CONST float kBulbTouch = 0.25f;  // what is rough at every scale has no edges
// Holes of the last level are two footprints wide or more; finer ones would flicker.
SHARED_CONST float kShapeDetail = 1.0f;

// Largest coordinate first.
SHARED_FN vec3 sorted_down(vec3 p)
{
    const float a = max(p.x, p.y);
    const float b = min(p.x, p.y);
    return vec3(max(a, p.z), max(b, min(a, p.z)), min(b, p.z));
}

SHARED_FN float box_distance(vec3 p, vec3 box_half)
{
    const vec3 q = abs(p) - box_half;
    return length(max(q, splat3(0.0f))) + min(max(q.x, max(q.y, q.z)), 0.0f);
}

// Mirrors a point by the planes between corners of the tetrahedron, until (1,1,1) is the nearest.
SHARED_FN vec3 to_first_corner(vec3 p)
{
    if (p.x + p.y < 0.0f) p = vec3(-p.y, -p.x, p.z);
    if (p.x + p.z < 0.0f) p = vec3(-p.z, p.y, -p.x);
    if (p.y + p.z < 0.0f) p = vec3(p.x, -p.z, -p.y);
    return p;
}

SHARED_FN float tetrahedron_distance(vec3 p)
{
    // Where (1,1,1) is the nearest corner and (1,-1,-1), (-1,1,-1) follow, what is nearest lies on the face of
    // these three or on the edge of the first two.
    const vec3 q = sorted_down(to_first_corner(p));
    const float beyond = (q.x + q.y - q.z - 1.0f) * 0.57735027f;
    if (beyond <= 0.0f) return beyond;
    if (-2.0f * (q.x - 1.0f) + q.y - q.z >= 0.0f) return beyond;
    const float along = min(0.5f * (q.y + q.z), 1.0f);
    return length(q - vec3(1.0f, along, along));
}

// Levels may be parted: between two whole ones the set shrinks from one to the other.
SHARED_FN float sierpinski_distance(vec3 p, float levels)
{
    const int whole = int(floor(levels));
    const float part = levels - float(whole);
    float size = 1.0f;
    for (int i = 0; i < whole; ++i) {
        p = 2.0f * to_first_corner(p) - splat3(1.0f);
        size *= 0.5f;
    }
    const float d = size * tetrahedron_distance(p);
    if (part <= 0.0f) return d;
    return mix(d, 0.5f * size * tetrahedron_distance(2.0f * to_first_corner(p) - splat3(1.0f)), part);
}

// Nine cubes of a level in three rows: the nearest that is left has its middle here.
SHARED_FN vec3 to_small_cube(vec3 p)
{
    const vec3 q = sorted_down(abs(p));
    return 3.0f * q - vec3(2.0f, 2.0f, q.z > 1.0f / 3.0f ? 2.0f : 0.0f);
}

SHARED_FN float menger_distance(vec3 p, float levels)
{
    const int whole = int(floor(levels));
    const float part = levels - float(whole);
    float size = 1.0f;
    for (int i = 0; i < whole; ++i) {
        p = to_small_cube(p);
        size *= 1.0f / 3.0f;
    }
    const float d = size * box_distance(p, splat3(1.0f));
    if (part <= 0.0f) return d;
    return mix(d, size / 3.0f * box_distance(to_small_cube(p), splat3(1.0f)), part);
}

// A point to a power: its length to that power, its angles from the axis y and around it times it. `growth`: how
// much lengths grow there at most.
struct BulbPower {
    vec3 to;
    float growth;
};
SHARED_FN BulbPower bulb_power(vec3 v, float r, float power)
{
    const float across = sqrt(v.x * v.x + v.z * v.z);
    const float theta = power * atan2(across, v.y);
    const float phi = power * atan2(v.z, v.x);
    const float level = sin(theta);
    const float raised = pow(max(r, 1.0e-20f), power - 1.0f);
    BulbPower b;
    b.to = r * raised * vec3(level * cos(phi), cos(theta), level * sin(phi));
    // By power r^(power - 1) along r and towards the axis. Around it a circle of `across` becomes one of
    // r^power |sin theta|, power times: on the axis that is power times as much.
    b.growth = power * raised * clamp(abs(level) * r / max(across, 1.0e-20f), 1.0f, power);
    return b;
}

// Of the points whose orbit v <- v^power + c stays within kBulbEscape for so many steps.
SHARED_FN float mandelbulb_distance(vec3 c, float power, int iterations)
{
    vec3 v = c;
    float r = length(v);
    float growth = 1.0f;  // of a length at c, up to here
    float left = log(kBulbEscape);  // that of the set's rim
    int i = 0;
    while (i < iterations && r <= kBulbEscape) {
        const BulbPower b = bulb_power(v, r, power);
        growth = b.growth * growth + 1.0f;
        v = b.to + c;
        r = length(v);
        ++i;
    }
    // By the potential log(r) / power^i, of which the rim has log(escape) / power^iterations.
    for (int k = i; k < iterations; ++k) left /= power;
    return 0.5f * r * (log(max(r, 1.0e-20f)) - left) / growth;
}

// Half of the box that holds a shape. The orbit of what is longer than 2^(1 / (power - 1)) grows for ever.
SHARED_FN vec3 shape_half(int kind, float power)
{
    if (kind == SHAPE_MANDELBULB) return splat3(exp2(1.0f / (power - 1.0f)));
    return splat3(1.0f);
}

// footprint: of what can be told apart there, in the shape's units; smaller levels are left out. 0: all of them.
SHARED_FN float shape_distance(MarchedShape s, vec3 p, float footprint)
{
    const float most = float(s.iterations);
    if (s.kind == SHAPE_MANDELBULB) return mandelbulb_distance(p, s.power, s.iterations);
    if (s.kind == SHAPE_SIERPINSKI) {
        const float seen = footprint > 0.0f ? log2(kShapeDetail / footprint) : most;
        return sierpinski_distance(p, clamp(seen, 0.0f, most));
    }
    if (s.kind == SHAPE_MENGER) {
        const float seen = footprint > 0.0f ? log2(kShapeDetail / footprint) / 1.5849625f : most;
        return menger_distance(p, clamp(seen, 0.0f, most));
    }
    if (s.kind == SHAPE_SPHERE) return length(p) - 1.0f;
    if (s.kind == SHAPE_BOX) return box_distance(p, s.half_m);
    const float around = sqrt(p.x * p.x + p.z * p.z) - (s.half_m.x - s.half_m.y);
    return sqrt(around * around + p.y * p.y) - s.half_m.y;
}

// Where a ray enters and leaves the box; none where the second is less.
SHARED_FN vec2 through_box(vec3 origin, vec3 direction, vec3 box_half)
{
    float near_end = -1.0e30f;
    float far_end = 1.0e30f;
    for (int i = 0; i < 3; ++i) {
        const float d = direction[i];
        if (abs(d) < 1.0e-20f) {
            if (abs(origin[i]) > box_half[i]) far_end = -1.0e30f;
        } else {
            const float a = (-box_half[i] - origin[i]) / d;
            const float b = (box_half[i] - origin[i]) / d;
            near_end = max(near_end, min(a, b));
            far_end = min(far_end, max(a, b));
        }
    }
    return vec2(near_end, far_end);
}

// How far a ray of unit direction goes until it meets the shape, from `begin` on; negative where it does not
// before `end`. footprint: x + y * way, metres of the shape's space.
SHARED_FN float shape_met(MarchedShape s, vec3 origin, vec3 direction, float begin, float end, vec2 footprint)
{
    float t = begin;
    float d = 0.0f;
    for (int i = 0; i < kShapeSteps; ++i) {
        const float f = footprint.x + footprint.y * max(t, 0.0f);
        d = shape_distance(s, origin + direction * t, f);
        if (d < (s.kind == SHAPE_MANDELBULB ? kBulbTouch : kShapeTouch) * f) return max(t + d, 0.0f);
        t += d;
        if (t > end) return -1.0f;
    }
    // So many steps are only used up along a surface, or among details: near one it is met.
    return d < 4.0f * (footprint.x + footprint.y * t) ? t : -1.0f;
}

SHARED_FN float outside_shape(MarchedShape s, vec3 p, float footprint)
{
    return max(shape_distance(s, p, footprint), 0.0f);
}

// Outward, unit: how the distance changes over a footprint.
SHARED_FN vec3 shape_normal(MarchedShape s, vec3 p, float footprint)
{
    // The Mandelbulb is rough at every scale: its normal is that of a footprint's surroundings. Edges of the others
    // stay sharp.
    const float h = max((s.kind == SHAPE_MANDELBULB ? 1.0f : 0.15f) * footprint, 1.0e-4f);
    if (s.kind == SHAPE_MENGER) {
        // Its cubes touch: inside, where they do, each has an end of its own. Only what is outside counts.
        const vec3 x = vec3(h, 0.0f, 0.0f);
        const vec3 y = vec3(0.0f, h, 0.0f);
        const vec3 z = vec3(0.0f, 0.0f, h);
        const vec3 n = vec3(outside_shape(s, p + x, footprint) - outside_shape(s, p - x, footprint),
                            outside_shape(s, p + y, footprint) - outside_shape(s, p - y, footprint),
                            outside_shape(s, p + z, footprint) - outside_shape(s, p - z, footprint));
        const float size = length(n);
        return size > 1.0e-12f ? n / size : vec3(0.0f, 1.0f, 0.0f);
    }
    const vec3 a = vec3(1.0f, -1.0f, -1.0f);
    const vec3 b = vec3(-1.0f, -1.0f, 1.0f);
    const vec3 c = vec3(-1.0f, 1.0f, -1.0f);
    const vec3 e = vec3(1.0f, 1.0f, 1.0f);
    const vec3 n = a * shape_distance(s, p + h * a, footprint) + b * shape_distance(s, p + h * b, footprint) +
                   c * shape_distance(s, p + h * c, footprint) + e * shape_distance(s, p + h * e, footprint);
    const float size = length(n);
    return size > 1.0e-12f ? n / size : vec3(0.0f, 1.0f, 0.0f);
}

// How open the shape leaves a point of its surface, 0 to 1: how far it is from the shape at five places above it, as
// shares of their heights. 1 over all that bulges. After Evans 2006, Fast approximations for global illumination on
// dynamic scenes (SIGGRAPH course notes), whose sum of differences is a mean of shares here.
SHARED_FN float shape_open(MarchedShape s, vec3 p, vec3 normal, float footprint)
{
    // The distance to the Mandelbulb is about half of the true one.
    const float scale = s.kind == SHAPE_MANDELBULB ? 2.0f : 1.0f;
    float open = 0.0f;
    float height = 0.5f;
    for (int i = 0; i < 5; ++i) {
        const float h = max(height, footprint);
        open += clamp(scale * shape_distance(s, p + normal * h, footprint) / h, 0.0f, 1.0f);
        height *= 0.5f;
    }
    return 0.2f * open;
}

// Normal and openness of a point in 32 bits: 13 each of the octahedral map, 6.
SHARED_FN uint shape_code(vec2 octahedral, float open)
{
    const uint x = uint(clamp(octahedral.x * 0.5f + 0.5f, 0.0f, 1.0f) * 8191.0f + 0.5f);
    const uint y = uint(clamp(octahedral.y * 0.5f + 0.5f, 0.0f, 1.0f) * 8191.0f + 0.5f);
    return x | (y << 13u) | (uint(clamp(open, 0.0f, 1.0f) * 63.0f + 0.5f) << 26u);
}

// Octahedral map, openness.
SHARED_FN vec3 shape_decode(uint code)
{
    return vec3(float(code & 8191u) / 4095.5f - 1.0f, float((code >> 13u) & 8191u) / 4095.5f - 1.0f,
                float(code >> 26u) / 63.0f);
}

SHARED_END

#endif
