#version 460
// One depth map of the sky as texels of a buffer, four neighbours in each (formulas/weather/depth_quads.h).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/depth_quads.h"
#include "gpu/passes/depth_maps/depth_quads_io.h"

layout(local_size_x = DEPTH_QUADS_TILE, local_size_y = DEPTH_QUADS_TILE) in;
layout(binding = DEPTH_QUADS_MAPS) uniform sampler2DArray maps;
layout(binding = DEPTH_QUADS_QUADS, scalar) writeonly buffer Quads { uvec2 quads[]; };
layout(push_constant, scalar) uniform Push { DepthQuadsParams params; };

// The rim of a map is open: a place beside it is held to the rim, and nothing stands over that.
float depth_at(int x, int y)
{
    const int last = SKY_MAP_SIZE - 1;
    if (min(x, y) <= 0 || max(x, y) >= last) return 0.0;
    return texelFetch(maps, ivec3(x, y, params.layer), 0).r;
}

void main()
{
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    const vec4 depths =
        vec4(depth_at(at.x, at.y), depth_at(at.x + 1, at.y), depth_at(at.x, at.y + 1), depth_at(at.x + 1, at.y + 1));
    quads[(params.layer * SKY_MAP_SIZE + at.y) * SKY_MAP_SIZE + at.x] = depth_quad(depths);
}
