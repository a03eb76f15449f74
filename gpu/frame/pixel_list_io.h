// A list of pixels that a pass shades in place of all: how many, then x + 65536 y of each.
#ifndef PETRICHOR_GPU_FRAME_PIXEL_LIST_IO_H
#define PETRICHOR_GPU_FRAME_PIXEL_LIST_IO_H

#define PIXEL_LIST_SPEC 90     // 1: by the list, unless that says all
#define PIXEL_LIST_ALL 0xffffffffu  // in place of how many
#define PIXEL_LIST_GROUP 64    // pixels that a workgroup shades; 8 x 8 without the list

// list_groups: how many groups shade a list
#define LIST_GROUPS_LIST 0
#define LIST_GROUPS_GROUPS 1   // VkDispatchIndirectCommand

#endif
