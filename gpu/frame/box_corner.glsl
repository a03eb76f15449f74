// The corners of the twelve triangles of the cube from -0.5 to 0.5, counter-clockwise from outside.
#ifndef PETRICHOR_BOX_CORNER_GLSL
#define PETRICHOR_BOX_CORNER_GLSL

// vertex: 0 to 35
vec3 box_corner(int vertex)
{
    // A face by its axis and side, two triangles each.
    const int corners[6] = int[6](0, 1, 2, 0, 2, 3);
    const int face = vertex / 6;
    const int corner = corners[vertex % 6];
    const int axis = face >> 1;
    const float side = (face & 1) != 0 ? 0.5 : -0.5;
    const vec2 across = vec2(corner == 1 || corner == 2 ? 0.5 : -0.5, corner >= 2 ? 0.5 : -0.5);
    vec3 p;
    p[axis] = side;
    p[(axis + 1) % 3] = side > 0.0 ? across.x : across.y;
    p[(axis + 2) % 3] = side > 0.0 ? across.y : across.x;
    return p;
}

#endif
