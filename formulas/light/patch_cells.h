// Where the patches of a scene lie (scene/patches/patches.h): the key of a cell, the place of a key
// in the table, sky bins and the directions of visibility bits. Rows told once for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_LIGHT_PATCH_CELLS_H
#define PETRICHOR_FORMULAS_LIGHT_PATCH_CELLS_H

#include "base/interop.h"
#include "formulas/codec/octahedral.h"

SHARED_BEGIN

SHARED_CONST int kSkyBinsAcross = 32;  // octahedral, whole sphere
SHARED_CONST int kSkyBins = 1024;
SHARED_CONST int kVisibilityAcross = 16;  // hemi-octahedral about +y
SHARED_CONST int kVisibilityTexels = 256;
SHARED_CONST int kSkySubsamples = 16;
SHARED_CONST int kPatchLevels = 16;
// A cell of level 0 is counted from here, so that no index is negative: 2^19 cells along an axis.
SHARED_CONST int kPatchCellBias = 262144;
// The grid is shifted by an irrational share of a cell: surfaces at whole metres are then not on a
// border.
SHARED_CONST float kPatchGridShift = 0.61803399f;

struct PatchKey {
    uint low;   // x: 19 bits, y: 13
    uint high;  // y: 6, z: 19, axis: 3, level: 4
};

// Cell of level 0 that holds the point; inverse_cell = 1 / edge of a cell of level 0.
SHARED_FN ivec3 patch_cell(vec3 x, float inverse_cell)
{
    const vec3 c = floor(x * inverse_cell + splat3(kPatchGridShift));
    return ivec3(int(c.x), int(c.y), int(c.z)) + ivec3(kPatchCellBias, kPatchCellBias, kPatchCellBias);
}

// Of a cell counted in its own level: cell of level 0 >> level. No two cells share a key.
SHARED_FN PatchKey patch_key(ivec3 cell, int axis, int level)
{
    const uint x = uint(cell.x) & 0x7ffffu;
    const uint y = uint(cell.y) & 0x7ffffu;
    const uint z = uint(cell.z) & 0x7ffffu;
    PatchKey key;
    key.low = x | (y << 19u);
    key.high = (y >> 13u) | (z << 6u) | (uint(axis) << 25u) | (uint(level) << 28u);
    return key;
}

// Mixes all bits of a key; the table of nodes starts to look at this, modulo its size.
SHARED_FN uint patch_key_hash(PatchKey key)
{
    uint h = key.low * 0x9e3779b1u ^ key.high * 0x85ebca77u;
    h = h ^ (h >> 15u);
    h = h * 0x2c1b3c6du;
    h = h ^ (h >> 12u);
    h = h * 0x297a2d39u;
    return h ^ (h >> 15u);
}

// The axis that a direction points along most: 0 +x, 1 -x, 2 +y, 3 -y, 4 +z, 5 -z.
SHARED_FN int patch_axis(vec3 n)
{
    const vec3 a = vec3(abs(n.x), abs(n.y), abs(n.z));
    if (a.x >= a.y && a.x >= a.z) return n.x >= 0.0f ? 0 : 1;
    if (a.y >= a.z) return n.y >= 0.0f ? 2 : 3;
    return n.z >= 0.0f ? 4 : 5;
}

// Sky bin of a direction, unit.
SHARED_FN int sky_bin(vec3 d)
{
    const vec2 p = octahedral_encode(d);
    const float across = float(kSkyBinsAcross);
    const int x = clamp(int((p.x * 0.5f + 0.5f) * across), 0, kSkyBinsAcross - 1);
    const int y = clamp(int((p.y * 0.5f + 0.5f) * across), 0, kSkyBinsAcross - 1);
    return y * kSkyBinsAcross + x;
}

// The bin of a ray that leaves the scene. Bins on the horizon hold directions of both sides and light of both: a ray is
// given to the next bin of its own side.
SHARED_FN int sky_bin_left(vec3 d)
{
    const int bin = sky_bin(d);
    const int x = bin % kSkyBinsAcross;
    const int y = bin / kSkyBinsAcross;
    const int last = kSkyBinsAcross - 1;
    // On the horizon |u| + |v| is 1: the two indices, counted from their nearer edges, add up to half.
    const int from_x = min(x, last - x);
    const int from_y = min(y, last - y);
    const bool up = d.y > 0.0f;
    const int short_of = kSkyBinsAcross / 2 - from_x - from_y;
    if (up ? short_of <= 0 : short_of >= 2) return bin;
    // Up is inwards.
    const bool wide = up ? from_x < from_y : from_x > from_y;
    const int across = wide ? (2 * x < last ? 1 : -1) : (2 * y < last ? kSkyBinsAcross : -kSkyBinsAcross);
    return up ? bin + across : bin - across;
}

// Whether a bin is one of rays that leave upwards.
SHARED_FN bool sky_bin_above(int bin)
{
    const int last = kSkyBinsAcross - 1;
    const int x = bin % kSkyBinsAcross;
    const int y = bin / kSkyBinsAcross;
    return min(x, last - x) + min(y, last - y) >= kSkyBinsAcross / 2;
}

// The middle of a sky bin, unit.
SHARED_FN vec3 sky_bin_direction(int bin)
{
    const float across = float(kSkyBinsAcross);
    const float u = (float(bin % kSkyBinsAcross) + 0.5f) / across * 2.0f - 1.0f;
    const float v = (float(bin / kSkyBinsAcross) + 0.5f) / across * 2.0f - 1.0f;
    return octahedral_decode(vec2(u, v));
}

// Direction at a place among the visibility bits, in texels, before it is made unit.
SHARED_FN vec3 visibility_raw_at(float x_texels, float y_texels)
{
    const float across = float(kVisibilityAcross);
    const float u = x_texels / across * 2.0f - 1.0f;
    const float v = y_texels / across * 2.0f - 1.0f;
    const float x = 0.5f * (u + v);
    const float z = 0.5f * (u - v);
    return vec3(x, 1.0f - abs(x) - abs(z), z);
}

// Direction of a visibility bit before it is made unit: texel centres, x fastest.
SHARED_FN vec3 visibility_raw_direction(int texel)
{
    return visibility_raw_at(float(texel % kVisibilityAcross) + 0.5f, float(texel / kVisibilityAcross) + 0.5f);
}

// Directions inside the texel of a visibility bit, kSkySubsamples of them: unit, w: its share of the solid angle, not
// normalized.
SHARED_FN vec4 visibility_subsample(int texel, int sample_index)
{
    const float side = 4.0f;
    const vec3 raw = visibility_raw_at(float(texel % kVisibilityAcross) + (float(sample_index % 4) + 0.5f) / side,
                                       float(texel / kVisibilityAcross) + (float(sample_index / 4) + 0.5f) / side);
    const float length2 = dot(raw, raw);
    const float inverse = 1.0f / sqrt(length2);
    return vec4(raw * inverse, inverse / length2);
}

// Solid angle that a visibility bit stands for; all of them add up to 2 pi.
SHARED_FN float visibility_solid_angle(int texel)
{
    const vec3 raw = visibility_raw_direction(texel);
    const float length2 = dot(raw, raw);
    const float step = 2.0f / float(kVisibilityAcross);
    return 0.5f * step * step / (length2 * sqrt(length2));
}

// Place of an upward direction among the bits, in texels: 0.5 is the centre of the first.
SHARED_FN vec2 visibility_texel(vec3 d)
{
    const float scale = 1.0f / (abs(d.x) + abs(d.y) + abs(d.z));
    const vec2 uv = vec2((d.x + d.z) * scale, (d.x - d.z) * scale);
    const float half_across = 0.5f * float(kVisibilityAcross);
    return vec2((uv.x + 1.0f) * half_across, (uv.y + 1.0f) * half_across);
}

// Nodes are numbered from 0; no node:
SHARED_CONST uint kNoPatch = 0xffffffffu;

// Where less of patches is found, the ground below snow is asked, in so many steps.
SHARED_CONST float kPatchFaint = 0.02f;
SHARED_CONST int kPatchStepsBelow = 24;

// What a lookup needs to know about the grid.
struct PatchGrid {
    float cell_m;      // edge of a cell of level 0
    uint levels;       // the coarsest level is levels - 1
    uint patches;      // nodes from this number on are interior
    uint table_mask;   // entries of the table of coarsest cells - 1
    uint neighbors;    // where connections begin among the ways
};

// Light at a point, from the patches around it.
struct PatchLight {
    vec3 irradiance;  // W/m2 or lux by channel, without direct sun and lamps
    float open;       // share of directions in which nothing is nearer than half a metre
    vec3 gradient;    // how irradiance changes when the normal turns: irradiance_towards
    float weight;     // 0: no patch is near
    vec3 normal;      // mean of the patches, about unit
    float close;        // share of the hemisphere that polygons close by fill (near_light.h)
    float close_light;  // share of the irradiance, by luminance, that they send
};

// Irradiance for a bent normal over that for the mean normal: radiance as a constant and a gradient
// (spherical harmonics of order 1), the constant's share by what a tilted plane sees of the
// hemisphere.
SHARED_FN float irradiance_towards(vec3 gradient, vec3 normal, vec3 bent)
{
    const float even = 1.0f - dot(gradient, normal);
    const float ratio =
        even * 0.5f * (1.0f + dot(normal, bent)) + dot(gradient, bent);
    return clamp(ratio, 0.2f, 2.0f);
}

// Share of open directions among those that no polygon close by fills: they stand within the radius that counts as
// closed.
SHARED_FN float open_beyond(float open, float close)
{
    return min(open / max(1.0f - close, 1.0e-3f), 1.0f);
}

// What occlusion leaves of a point's light: what close polygons send is known as it is, the ratio of the point's own
// occlusion to its patch's, both of what is beyond them, is for the rest.
SHARED_FN float with_close_light(float ratio, float close_light)
{
    return close_light + (1.0f - close_light) * ratio;
}

SHARED_END

#endif
