#version 460
// Groups of the passes that shade the list.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/pixel_list_io.h"
#include "gpu/passes/adaptive/adaptive_io.h"

layout(local_size_x = ADAPTIVE_GROUPS_GROUP) in;
layout(binding = ADAPTIVE_GROUPS_LIST, scalar) readonly buffer List { uint count; };
layout(binding = ADAPTIVE_GROUPS_GROUPS, scalar) writeonly buffer Groups { uint groups[]; };

void main()
{
    groups[0] = (count + uint(PIXEL_LIST_GROUP) - 1u) / uint(PIXEL_LIST_GROUP);
    groups[1] = 1u;
    groups[2] = 1u;
}
