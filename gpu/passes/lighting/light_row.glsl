// A row of the table of lights (gpu/passes/lights/lights_io.h), which the includer has as `lights`.
#ifndef PETRICHOR_LIGHT_ROW_GLSL
#define PETRICHOR_LIGHT_ROW_GLSL

struct LightRow {
    vec4 sphere;  // centre, world metres; reach, metres
    vec4 color;   // strength; cosine of the outer cone, or LIGHT_...
    vec4 axis;    // direction, or half a side; cosine of the inner cone
    vec4 across;  // up, or half the other side; number of its shadow, -1: none; and its channel of masks
    float inverse_reach2;  // 1/m2
    vec4 size;    // radius and half length, metres; share of the highlight, or LIGHT_GLOWS; number of its profile, -1: none
};

LightRow light_row(int light)
{
    const int first = light * LIGHT_TEXELS;
    LightRow row;
    row.sphere = texelFetch(lights, first);
    row.inverse_reach2 = 1.0 / (row.sphere.w * row.sphere.w);
    row.color = texelFetch(lights, first + 1);
    row.axis = texelFetch(lights, first + 2);
    row.across = texelFetch(lights, first + 3);
    row.size = texelFetch(lights, first + 4);
    return row;
}

#endif
