#version 460
// Groups of a pass over a list of pixels.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/pixel_list_io.h"

layout(local_size_x = 1) in;
layout(binding = LIST_GROUPS_LIST, scalar) readonly buffer List { uint count; };
layout(binding = LIST_GROUPS_GROUPS, scalar) writeonly buffer Groups { uint groups[]; };

void main()
{
    groups[0] = (count + uint(PIXEL_LIST_GROUP) - 1u) / uint(PIXEL_LIST_GROUP);
    groups[1] = 1u;
    groups[2] = 1u;
}
