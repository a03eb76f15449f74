#version 460
// Lists the pixels that show icicles: a CPU would do the work of clear_ice for all others, too. The order of the list decides
// no pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/clear_ice/clear_ice_io.h"
#define PIXEL_LIST_BINDING ICE_LIST_PIXELS
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = REFLECTIONS_TILE, local_size_y = REFLECTIONS_TILE) in;
layout(binding = ICE_LIST_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = ICE_LIST_MATERIAL) uniform samplerBuffer material_rows;
layout(binding = ICE_LIST_DEPTH_ROWS) uniform samplerBuffer depth_rows;
layout(binding = ICE_LIST_LIST, scalar) buffer Ice { uint ice_count; uint ice_pixels[]; };
layout(push_constant, scalar) uniform Push { ClearIcePush push; };

void main()
{
    ivec2 texel;
    bool ice = this_pixel(frame.size, texel);
    const int row = ice ? row_texel(texel, frame.size) : 0;
    const uint model = uint(texelFetch(material_rows, row).w * 255.0 + 0.5);
    // What no surface covers keeps what another frame left there.
    ice = ice && model == push.model && texelFetch(depth_rows, row).r > 0.0;
    const uvec4 asked = subgroupBallot(ice);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(ice_count, subgroupBallotBitCount(asked));
    first = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(asked);
    if (ice) ice_pixels[first] = uint(texel.y) * 65536u + uint(texel.x);
}
