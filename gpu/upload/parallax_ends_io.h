// Relief of a material with holes that is a hole beyond the edges of its height map, where the sampler of that map ends there
// (glTF: CLAMP_TO_EDGE): so a quad has the silhouette of its relief. Beside the PARALLAX_... of material_io.h.
#ifndef PETRICHOR_PARALLAX_ENDS_IO_H
#define PETRICHOR_PARALLAX_ENDS_IO_H

#define PARALLAX_ENDS_U 8u
#define PARALLAX_ENDS_V 16u

#ifndef __cplusplus
// at: where the relief is met, in coordinates of its height map; a part of them is what rounding is worth.
bool beyond_relief(uint parallax, vec2 at)
{
    const vec2 out_of = max(-at, at - 1.0) - 1.0e-5;
    return ((parallax & PARALLAX_ENDS_U) != 0u && out_of.x > 0.0) || ((parallax & PARALLAX_ENDS_V) != 0u && out_of.y > 0.0);
}
#endif

#endif
