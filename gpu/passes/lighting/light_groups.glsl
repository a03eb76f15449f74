// Which lights may light some invocation of a group of LIGHTS_AT_ONCE, all of which are there. A CPU does for the
// whole group what one of it needs; so each of them asks about another light, by bounds of where they all are
// and of how they are turned. What is left out would have added nothing to any of them.
#ifndef PETRICHOR_LIGHT_GROUPS_GLSL
#define PETRICHOR_LIGHT_GROUPS_GLSL

#include "gpu/passes/lighting/light_rows.glsl"

// Asking costs about what one light does: it pays where there are many.
const bool SIFTED = (WAYS & (LIGHTS_TOGETHER | LIGHTS_MANY)) == (LIGHTS_TOGETHER | LIGHTS_MANY) && LISTED != 1u;

// Told out: a loop costs more than what is in it.
#define OVER_GROUP(type_, name_, both_)                                   \
    type_ name_(type_ a)                                                  \
    {                                                                     \
        type_ b = subgroupShuffle(a, gl_SubgroupInvocationID ^ 1u);       \
        a = both_;                                                        \
        b = subgroupShuffle(a, gl_SubgroupInvocationID ^ 2u);             \
        a = both_;                                                        \
        b = subgroupShuffle(a, gl_SubgroupInvocationID ^ 4u);             \
        return both_;                                                     \
    }
OVER_GROUP(vec3, group_min, min(a, b))
OVER_GROUP(uint, group_or, a | b)
#undef OVER_GROUP

// Bounds of a group: its places, world metres, and its normals.
struct LitGroup {
    vec3 low;
    vec3 high;
    vec3 turned_low;
    vec3 turned_high;
};

// there: whether this invocation shows a surface.
LitGroup group_of(vec3 position, vec3 normal, bool there)
{
    const vec3 none = vec3(1.0e15);
    LitGroup group;
    group.low = group_min(there ? position : none);
    group.high = -group_min(there ? -position : none);
    group.turned_low = group_min(there ? normal : none);
    group.turned_high = -group_min(there ? -normal : none);
    return group;
}

float most_of(float low_a, float high_a, float low_b, float high_b)
{
    return max(max(low_a * low_b, low_a * high_b), max(high_a * low_b, high_a * high_b));
}

// Most of the product of a normal and a direction.
float most_toward(LitGroup group, vec3 low, vec3 high)
{
    return most_of(group.turned_low.x, group.turned_high.x, low.x, high.x) +
           most_of(group.turned_low.y, group.turned_high.y, low.y, high.y) +
           most_of(group.turned_low.z, group.turned_high.z, low.z, high.z);
}

// Light may come from behind the surface.
const bool FROM_BEHIND = (LAYERS & (LAYERS_TRANSLUCENT | LAYERS_SKIN | LAYERS_TRANSMISSION | LAYERS_SECOND_LOBE)) != 0u;

// shadowed, shaped: as of punctual_light.
bool may_light(LitGroup group, LightRow light, const bool shadowed, const bool shaped)
{
    const vec4 sphere = light.sphere;
    const vec3 low = sphere.xyz - group.high;
    const vec3 high = sphere.xyz - group.low;
    const vec3 gap = max(max(low, -high), vec3(0.0));
    bool may = dot(gap, gap) <= sphere.w * sphere.w;
    if (FROM_BEHIND || (shaped && (WAYS & (LIGHTS_LTC | LIGHTS_NEAREST)) != 0u)) return may;
    // The product that decides is rounded, of a unit vector.
    float most = -1.0e-5 * sphere.w;
    if (shaped && RECTANGLES != 0u && (!shadowed || light.color.w < LIGHT_POINT - 0.5)) {
        // Its form factor is cut by the horizon as that of a ball (formulas/light/area.h), which is as wide as
        // both half edges at most.
        const float wide = length(light.axis.xyz) + length(light.across.xyz);
        most = -2.5 * wide - 1.0e-3 * sphere.w;
    }
    return may && most_toward(group, low, high) > most;
}

#endif
