// Where a material is cut out or let light through.
#ifndef PETRICHOR_SURFACE_HOLES_GLSL
#define PETRICHOR_SURFACE_HOLES_GLSL

#include "formulas/noise/noise.h"
#include "gpu/passes/surface/textures.glsl"
#include "gpu/frame/picture_pixel.glsl"
#include "gpu/upload/parallax_ends_io.h"

// Not where water shifts the lookup to: a hole stays where it is.
float surface_alpha(SurfaceInput at)
{
    float alpha = material.base_color_factor.a * at.color.a;
    if (SECOND == SECOND_LAYERS) {
        // More layers over those of another material are there as far as their weights say.
        if (has(TEXTURE_MIX_MASK)) {
            const vec4 w = texel(mix_mask_texture, coordinates(TEXTURE_MIX_MASK, at, vec2(0.0)));
            alpha *= min(w.x + w.y + w.z + w.w, 1.0);
        }
    } else if (has(TEXTURE_BASE_COLOR)) {
        alpha *= texel(base_color_texture, coordinates(TEXTURE_BASE_COLOR, at, vec2(0.0))).a;
    }
    return alpha;
}

// Without layers, what passes through a clear body is seen as transparency of its surface.
float alpha_at(SurfaceInput at)
{
    return surface_alpha(at) * (1.0 - 0.9 * material.transmission_factor);
}

// 0..1, even over the samples of a pixel, and of two instances independent of each other: else what
// lies behind two panes would be seen more often, or less, than each of them lets it.
float chance(SurfaceInput at)
{
    const ivec2 pixel = picture_pixel(at.pixel);
    const uint own = hash_u3(uint(pixel.x), uint(pixel.y), at.instance_id);
    return fract(hash_f(own) + 0.61803399 * float(frame.sample_index ^ (own & 63u)));
}

// Cut out by the alpha test, or let through by chance: as often as it is transparent.
bool hole_in(SurfaceInput at, float alpha)
{
    if ((PARALLAX & (PARALLAX_ENDS_U | PARALLAX_ENDS_V)) != 0u &&
        beyond_relief(PARALLAX, coordinates(TEXTURE_HEIGHT, at, vec2(0.0)).at)) return true;
    if (material.alpha_mode == ALPHA_MASK && alpha < material.alpha_cutoff) return true;
    return (material.alpha_mode == ALPHA_BLEND || material.transmission_factor > 0.0) &&
           alpha <= chance(at);
}

// A level of detail shows at its share of the pixels; another level has the others.
bool faded(uint fade, ivec2 pixel)
{
    const float d = dither(picture_pixel(pixel), frame.sample_index) * 65535.0;
    return d < float(fade & 65535u) || d >= float(fade >> 16);
}

#endif
