// Where a lamp's profile is read, in texels of its square: over angles (IES photometry), over a spot's
// picture (cookie), over an octahedron around a lamp in its lantern.
#ifndef PETRICHOR_FORMULAS_LIGHT_LIGHT_PROFILE_H
#define PETRICHOR_FORMULAS_LIGHT_LIGHT_PROFILE_H

#include "base/interop.h"
#include "formulas/codec/octahedral.h"
#include "formulas/light/area.h"
#include "formulas/light/brdf.h"

SHARED_BEGIN

SHARED_CONST float kProfileTexels = 128.0f;  // a side
SHARED_CONST float kProfileLanternHalf_m = 0.35f;  // scene/patches/lanterns.h

// Of directions as the lamp sees them: x to its right, y up, z along its axis; unit.

// A column a turn about the axis from up, which wraps; a row an angle from it.
SHARED_FN vec2 photometry_place(vec3 at)
{
    const float turn = atan2(at.x, at.y) * (0.5f / kPi);
    const vec2 place = vec2((turn - floor(turn)) * kProfileTexels, arc_cosine(at.z) / kPi * (kProfileTexels - 1.0f));
    return clamp(place, splat2(0.0f), splat2(kProfileTexels - 0.001f));
}

// Of the square around the cone of a spot, y down; only where at.z > 0.
//   outer  cosine of half the cone
SHARED_FN vec2 cookie_place(vec3 at, float outer)
{
    const float half_m = sqrt(max(1.0f - outer * outer, 0.0f)) / max(outer, 1.0e-3f);
    const vec2 across = vec2(at.x, -at.y) / (at.z * half_m);
    const vec2 place = (across * 0.5f + splat2(0.5f)) * (kProfileTexels - 1.0f);
    return clamp(place, splat2(0.0f), splat2(kProfileTexels - 0.001f));
}

//   away  from the lamp, in the world
SHARED_FN vec2 lantern_place(vec3 away)
{
    const vec2 place = (octahedral_encode(away) * 0.5f + splat2(0.5f)) * kProfileTexels - splat2(0.5f);
    return clamp(place, splat2(0.0f), splat2(kProfileTexels - 1.001f));
}

// What is seen of a lamp so many metres away past its lantern; within it what lies before the lantern's parts
// sees all.
//   seen  of the profile: share, metres to what lies first that way
SHARED_FN float lantern_seen(vec2 seen, vec3 away, float far_m)
{
    const float along = max(abs(away.x), max(abs(away.y), abs(away.z)));
    const float outside = clamp(far_m * along * (5.0f / kProfileLanternHalf_m) - 4.5f, 0.0f, 1.0f);
    return mix(far_m < 1.03f * seen.y + 0.005f ? 1.0f : seen.x, seen.x, outside);
}

SHARED_END

#endif
