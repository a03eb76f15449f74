// What a surface point is asked with, and what it answers. The same for a fragment shader and for a
// compute shader that resolves ids and barycentrics: derivatives are given, never taken.
#ifndef PETRICHOR_SURFACE_DATA_GLSL
#define PETRICHOR_SURFACE_DATA_GLSL

#include "gpu/frame/gbuffer.glsl"
#include "gpu/frame/layer_shares.glsl"

// dx, dy: change to the next pixel to the right and below.
struct SurfaceInput {
    vec3 position;  // world, metres
    vec3 position_dx;
    vec3 position_dy;
    vec3 normal;  // of the geometry, unit, towards the eye
    vec3 normal_dx;
    vec3 normal_dy;
    vec4 tangent;  // along u, of any length; w: side of the bitangent, for the side that is seen
    vec4 uv;       // texture coordinates 0 and 1
    vec4 uv_dx;
    vec4 uv_dy;
    vec4 color;        // of the vertices, linear
    vec4 weather;      // of the vertices: mix, puddle mask, snow mask, -
    ivec2 pixel;       // seeds what is drawn by chance
    uint instance_id;  // likewise
    uint material_id;
    uint look;  // of the instance: a number of the table of looks; 0: none
    vec2 shares;   // of two sets of textures; filled by read_sets
    float relief;  // height of both, 0 low .. 1 high; of mixed sets and of layers alone
    vec4 ground;        // shares of four layers; filled by read_layers
    vec3 ground_color;  // of all four
    float far;          // 0 layers .. 1 the colour of all of it from afar
};

struct SurfaceData {
    GBufferTexel texel;
    vec3 emission;  // radiance
    LayerShares shares;
    bool hole;      // nothing is here: cut out, or let through by chance
    float alpha;    // with SURFACE_ALPHA: where parallax has moved the point
    float opacity;  // of what lets light through: share of what lies behind that it hides; below 0: the material's
    vec3 filtered;  // .. and of the rest what it lets through, by colour
};

// Unit axes of the texture coordinates on the surface.
struct TangentFrame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

TangentFrame tangent_frame(SurfaceInput at)
{
    TangentFrame f;
    f.normal = at.normal;
    const vec3 along = at.tangent.xyz - at.normal * dot(at.tangent.xyz, at.normal);
    const float size = length(along);
    f.tangent = size > 1.0e-6 ? along / size
                              : normalize(abs(at.normal.y) < 0.9 ? cross(at.normal, vec3(0, 1, 0))
                                                                 : cross(at.normal, vec3(1, 0, 0)));
    f.bitangent = cross(f.normal, f.tangent) * at.tangent.w;
    return f;
}

vec3 to_world(TangentFrame f, vec3 n)
{
    return n.x * f.tangent + n.y * f.bitangent + n.z * f.normal;
}

#endif
