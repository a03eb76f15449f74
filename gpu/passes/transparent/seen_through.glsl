// What is seen through a layer that bends or blurs: which way its light came. Before the include: frame, solid_map, solid_depth.
#ifndef PETRICHOR_GPU_PASSES_TRANSPARENT_SEEN_THROUGH_GLSL
#define PETRICHOR_GPU_PASSES_TRANSPARENT_SEEN_THROUGH_GLSL

const int kTaps = 32;
const float kGoldenAngle = 2.39996323;
const float kClear = 0.08;  // smoother surfaces blur nothing

float solid_m(ivec2 texel)
{
    const float d = texelFetch(solid_depth, texel, 0).r;
    return d > 0.0 ? linear_depth(frame, d) : 1.0e5;
}

vec3 solid_at(ivec2 texel)
{
    return min(texelFetch(solid_map, texel, 0).rgb, vec3(60000.0));
}

// The k-th place of a lobe of GGX around a pixel. Half of its facets are steeper than alpha, a share u less steep
// than alpha times the root of u / (1 - u). Each sample of a pixel has places of its own.
//   half_way   pixels from the middle within which half of it lies;  farthest: beyond that none is looked for
ivec2 lobe_texel(int k, vec2 pixel, float half_way, float farthest)
{
    const float within = fract(0.5 + 0.61803399 * float(frame.sample_index));
    const float u = (float(k) + within) / float(kTaps);
    const float r = min(half_way * sqrt(u / (1.0 - u)), farthest);
    const float turn = kGoldenAngle * (float(k) + within - 0.5);
    const vec2 at = pixel + r * vec2(cos(turn), sin(turn));
    return clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
}

// How a layer is looked through, at one index of refraction.
struct Way {
    vec2 pixel;      // the middle of what is seen
    float blur;      // what the roughness makes of a metre, metres
    float least_m;   // .. over at least so much
    float behind_m;  // how far the solid picture is there
};

// Pixels within which half of a lobe lies at what is so far away.
float half_way_px(Way way, float at_m, float layer_m)
{
    const float wide_m = way.blur * max(at_m - layer_m, way.least_m);
    return clamp(wide_m / max(pixel_width_m(frame, at_m), 1.0e-6), 0.0, 0.085 * float(frame.size.y));
}

float farthest_px()
{
    return 0.34 * float(frame.size.y);
}

// Where the solid picture is seen through a body: pixel of the point where the bent ray leaves it.
vec2 bent_pixel(vec2 pixel, vec3 position, vec3 view, vec3 normal, float ior, float thickness_m)
{
    const vec3 bent = refract(view, normal, 1.0 / max(ior, 1.0));
    const vec4 clip = frame.world_to_clip * vec4(position + bent * thickness_m, 1.0);
    if (clip.w <= 0.0) return pixel;
    return (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.size);
}

Way way_through(vec2 pixel, vec3 position, vec3 view, vec3 normal, float ior, float thickness_m, float roughness,
                float layer_m)
{
    Way way;
    way.pixel = pixel;
    if (thickness_m > 0.0) way.pixel = bent_pixel(pixel, position, view, normal, ior, thickness_m);
    const ivec2 there = clamp(ivec2(floor(way.pixel)), ivec2(0), frame.size - 1);
    // What stands before the layer is not seen through it.
    if (solid_m(there) < layer_m * 0.999) way.pixel = pixel;
    way.behind_m = max(solid_m(clamp(ivec2(floor(way.pixel)), ivec2(0), frame.size - 1)), layer_m);
    // A lobe through a thin pane spreads about as one that is mirrored, less the less it bends. In a body a
    // facet turns the ray by 1 - 1 / ior of its own tilt.
    const float bends = thickness_m > 0.0 ? 1.0 - 1.0 / max(ior, 1.0) : 0.70710678 * clamp(2.0 * ior - 2.0, 0.0, 1.0);
    way.blur = roughness * roughness * bends;
    way.least_m = thickness_m;
    return way;
}

// The solid picture along it: the mean over the lobe, without what stands before the layer.
vec3 seen_along(Way way, ivec2 here, float layer_m)
{
    vec3 sum = vec3(0.0);
    float count = 0.0;
    const float half_way = half_way_px(way, way.behind_m, layer_m);
    const int taps = half_way > 0.0 ? kTaps : 1;
    for (int k = 0; k < taps; ++k) {
        const ivec2 texel = lobe_texel(k, way.pixel, half_way, farthest_px());
        if (solid_m(texel) < layer_m * 0.999) continue;
        sum += solid_at(texel);
        count += 1.0;
    }
    return count > 0.0 ? sum / count : texelFetch(solid_map, here, 0).rgb;
}

// The pixel that is seen through a drop on a pane, which is a lens as strong as it is round: a ray is bent at the
// water and again where it leaves the flat side.
ivec2 through_drop(vec2 pixel, ivec2 texel, vec3 position, vec3 view, vec3 water, vec3 flat_side, float layer_m)
{
    const float kWater = 1.33;
    const vec3 inside = refract(view, water, 1.0 / kWater);
    const vec3 left_by = refract(inside, flat_side, kWater);
    const vec3 way = dot(left_by, left_by) > 0.5 ? left_by : inside;
    const vec2 size = vec2(frame.size);
    ivec2 there = texel;
    float far_m = 1000.0;
    // First as if all were far, then as far as what was met.
    for (int turn = 0; turn < 2; ++turn) {
        const vec4 clip = frame.world_to_clip * vec4(position + way * far_m, 1.0);
        vec2 at = clip.w > 0.0 ? (clip.xy / clip.w * 0.5 + 0.5) * size : pixel;
        // Beyond the picture it goes on as its mirror image does.
        at = size - abs(mod(at, 2.0 * size) - size);
        there = clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
        far_m = clamp(solid_m(there) - layer_m, 0.2, 1000.0);
    }
    return solid_m(there) < layer_m * 0.999 ? texel : there;
}

#endif
