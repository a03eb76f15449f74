// The picture that mirrors show, by its pixels. In a window of a larger picture they are those of the larger one, and what is
// beyond the window comes from a small picture of the whole (picture_around.h). Wants the bindings of reflections.comp.glsl.
#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_MIRRORED_PICTURE_GLSL
#define PETRICHOR_GPU_PASSES_REFLECTIONS_MIRRORED_PICTURE_GLSL

// Those that read the picture otherwise say how before the include.
#ifndef MIRRORED_LIGHT
#define MIRRORED_LIGHT(at) texelFetch(radiance_map, at, 0)
#define MIRRORED_GLOW(at) texelFetch(emission_rows, row_texel(at, frame.size))
#define AROUND_GLOW(at) texelFetch(around_glow, at)
#endif

const float kBeyond = 0.125;  // of the width: so far the picture is taken to go on beyond its sides

ivec2 picture_size()
{
    return WINDOW != 0u ? window.picture : frame.size;
}

// A place of the window in the picture, and back.
vec2 in_picture(vec2 pixel)
{
    return WINDOW != 0u ? pixel + vec2(window.corner) : pixel;
}

vec2 in_window(vec2 pixel)
{
    return WINDOW != 0u ? pixel - vec2(window.corner) : pixel;
}

ivec2 here(ivec2 pixel)
{
    return WINDOW != 0u ? pixel - window.corner : pixel;
}

bool beyond_window(ivec2 texel)
{
    return WINDOW != 0u && (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, frame.size)));
}

// Of the small picture, what stands for a pixel.
int around_texel(ivec2 pixel)
{
    return row_texel(clamp(ivec2((vec2(pixel) + 0.5) * window.per_pixel), ivec2(0), window.around - 1), window.around);
}

// The depth at a pixel within the picture.
float picture_depth(ivec2 pixel)
{
    const ivec2 texel = here(pixel);
    if (beyond_window(texel)) return texelFetch(around_depth, around_texel(pixel)).r;
    return texelFetch(depth_rows, row_texel(texel, frame.size)).r;
}

// The pixel that stands for a place, beyond the sides of the picture the one as far inside.
vec2 turned_back(vec2 pixel)
{
    const float wide = float(picture_size().x);
    return vec2(wide - abs(wide - abs(pixel.x)), pixel.y);
}

float scene_depth_m(vec2 pixel)
{
    const float d = picture_depth(clamp(ivec2(turned_back(pixel)), ivec2(0), picture_size() - 1));
    return d > 0.0 ? linear_depth(frame, d) : 1.0e9;
}

// The picture where a ray met it; what glows is in part a lamp, whose highlight is there already.
vec3 picture_at(ivec2 pixel, float roughness)
{
    const ivec2 at = here(pixel);
    if (beyond_window(at)) {
        const int texel = around_texel(pixel);
        vec3 seen = texelFetch(around_light, texel).rgb;
        if (GLOWS != 0u) seen -= min(seen, AROUND_GLOW(texel).rgb * glow_share(roughness));
        return seen;
    }
    vec3 seen = MIRRORED_LIGHT(at).rgb;
    if (GLOWS != 0u) seen -= min(seen, MIRRORED_GLOW(at).rgb * glow_share(roughness));
    return seen;
}

#endif
