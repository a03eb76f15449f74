#version 460
// The occlusion of each pixel of a list. It is zero before.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/ambient_occlusion/ambient_occlusion.glsl"

layout(local_size_x = AMBIENT_OCCLUSION_TILE, local_size_y = AMBIENT_OCCLUSION_TILE) in;
layout(binding = AMBIENT_OCCLUSION_TARGET, scalar) buffer Target { uint target[]; };

void main()
{
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    const float depth = depth_at(texel);
    if (depth <= 0.0) return;  // nobody asks there
    const uint pixel = uint(texel.x & 1) + 2u * uint(texel.y & 1);
    const Open open = open_at(texel, depth, picture_pixel(texel));
    atomicOr(target[occlusion_block(texel / OCCLUSION_BLOCK, frame.size)], occlusion_in_word(open.share, pixel));
    if (BENT != 0u) atomicOr(target[bent_word(texel, frame.size)], bent_code(open.bent) << 16 * (texel.x & 1));
}
