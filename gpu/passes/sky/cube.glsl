#ifndef PETRICHOR_CUBE_GLSL
#define PETRICHOR_CUBE_GLSL

// Direction through (s, t), each -1..1, of a cube face in Vulkan's order and orientation.
vec3 cube_direction(int face, vec2 st)
{
    if (face == 0) return vec3(1.0, -st.y, -st.x);
    if (face == 1) return vec3(-1.0, -st.y, st.x);
    if (face == 2) return vec3(st.x, 1.0, st.y);
    if (face == 3) return vec3(st.x, -1.0, -st.y);
    if (face == 4) return vec3(st.x, -st.y, 1.0);
    return vec3(-st.x, -st.y, -1.0);
}

// Solid angle of a texel relative to others of a face.
float cube_texel_weight(vec2 st)
{
    const float q = 1.0 + dot(st, st);
    return 1.0 / (q * sqrt(q));
}

#endif
