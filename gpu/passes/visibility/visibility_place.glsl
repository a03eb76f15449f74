// Where a draw, or one instance of a run of them, stands.
#ifndef PETRICHOR_VISIBILITY_PLACE_GLSL
#define PETRICHOR_VISIBILITY_PLACE_GLSL

layout(constant_id = VISIBILITY_SPEC_INSTANCED) const uint INSTANCED = 0u;
layout(set = 0, binding = VISIBILITY_DRAWS) uniform usamplerBuffer draw_table;
layout(push_constant, scalar) uniform Push { VisibilityDraw draw; };

vec4 place_row(int number, int row)
{
    if (INSTANCED == 0u) return draw.to_world[row];
    return uintBitsToFloat(texelFetch(draw_table, number * RESOLVE_DRAW_TEXELS + row));
}

vec3 placed(int number, vec3 position)
{
    const vec4 p = vec4(position, 1.0);
    return vec3(dot(place_row(number, 0), p), dot(place_row(number, 1), p),
                dot(place_row(number, 2), p));
}

#endif
