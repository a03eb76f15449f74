// A vertex of a caster. HOLES: its fragments are asked; PLACES_SET: one instance of a run, whose places before the map
// stand in a table.
#include "base/interop.h"
#include "gpu/passes/depth_maps/depth_maps_io.h"

layout(constant_id = DEPTH_SPEC_FLATTEN) const uint FLATTEN = 1u;

layout(location = 0) in vec3 in_position;
#ifdef HOLES
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 0) out vec4 out_uv;
#endif

#ifdef PLACES_SET
layout(set = PLACES_SET, binding = 0) uniform samplerBuffer places;  // columns

mat4 clip_from_object()
{
    const int at = 4 * gl_InstanceIndex;
    return mat4(texelFetch(places, at), texelFetch(places, at + 1), texelFetch(places, at + 2),
                texelFetch(places, at + 3));
}
#else
struct DepthDraw {
    mat4 clip_from_object;
};
layout(push_constant, scalar) uniform Push { DepthDraw draw; };

mat4 clip_from_object()
{
    return draw.clip_from_object;
}
#endif

void main()
{
    gl_Position = clip_from_object() * vec4(in_position, 1.0);
    if (FLATTEN != 0u) gl_Position.z = min(gl_Position.z, gl_Position.w);
#ifdef HOLES
    out_uv = vec4(in_uv0, in_uv1);
#endif
}
