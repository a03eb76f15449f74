#version 460
// What smooth surfaces mirror: the picture itself where the reflected ray meets it, else the probes
// around, else the sky. The ray is walked through the depth of this sample; where no probe serves, the sky
// stands in, dimmed by how much of it the place sees. Just beyond the sides of the picture, where no probe serves either, land
// and houses are taken to go on as the picture does, the other way round.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#define FRAME_BY_WORDS
#include "gpu/frame/gbuffer.glsl"
#include "formulas/light/seen_lobe.h"
#include "formulas/noise/noise.h"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/reflections/reflections_io.h"
#define PIXEL_LIST_BINDING REFLECTIONS_PIXELS
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = REFLECTIONS_TILE, local_size_y = REFLECTIONS_TILE) in;
#define FRAME_PLACE binding = REFLECTIONS_FRAME
#include "gpu/frame/frame_words.glsl"
#include "gpu/frame/picture_pixel.glsl"
layout(binding = REFLECTIONS_DEPTH_ROWS) uniform samplerBuffer depth_rows;
layout(binding = REFLECTIONS_OWN_DEPTH) uniform samplerBuffer own_depth_rows;
layout(binding = REFLECTIONS_RADIANCE) uniform sampler2D radiance_map;
layout(binding = REFLECTIONS_MIRROR_WEIGHT) uniform sampler2D mirror_weight;
layout(binding = REFLECTIONS_MIRROR_SHAPE) uniform sampler2D mirror_shape;
layout(binding = REFLECTIONS_SPECULAR) uniform samplerCube specular_map;
layout(binding = REFLECTIONS_ACCUMULATED, rgba32f) uniform image2D accumulated;
layout(binding = REFLECTIONS_PROBES) uniform samplerBuffer probe_rows;
layout(binding = REFLECTIONS_PROBE_LIGHT) uniform samplerBuffer probe_light;
layout(binding = REFLECTIONS_EMISSION) uniform samplerBuffer emission_rows;
layout(binding = REFLECTIONS_WEATHER) uniform samplerBuffer weather_rows;
layout(binding = REFLECTIONS_PARTS, rgba32f) uniform image2DArray light_parts;
layout(binding = REFLECTIONS_LABEL, rgba32f) uniform writeonly image2DArray label_image;
layout(binding = REFLECTIONS_AROUND_DEPTH) uniform samplerBuffer around_depth;
layout(binding = REFLECTIONS_AROUND_LIGHT) uniform samplerBuffer around_light;
layout(binding = REFLECTIONS_AROUND_GLOW) uniform samplerBuffer around_glow;
layout(push_constant, scalar) uniform Push { MirrorWindow window; };
layout(constant_id = REFLECTIONS_SPEC_PROBES) const uint PROBES = 0;
layout(constant_id = REFLECTIONS_SPEC_SPLIT) const uint SPLIT = 0;
layout(constant_id = REFLECTIONS_SPEC_LABEL) const uint LABEL = 0;
layout(constant_id = REFLECTIONS_SPEC_PICTURE) const uint PICTURE = 1;
layout(constant_id = REFLECTIONS_SPEC_GLOWS) const uint GLOWS = 0;
layout(constant_id = REFLECTIONS_SPEC_WINDOW) const uint WINDOW = 0;

#include "gpu/passes/reflections/probes.glsl"
#include "gpu/passes/reflections/mirrored_picture.glsl"

const int kSteps = 32;
const int kStepsAtOnce = 4;
const int kRefinements = 2;  // of two halvings, and one more
const int kTaps = 4;  // at one sample
const float kWidest_px = 24.0;

struct Hit {
    vec2 pixel;
    float confidence;  // 0: nothing met
    float inside;      // the same, if nothing is known beyond the sides of the picture
    bool hidden;       // where the ray went behind what is seen, not where it met it
};

// A ray on the screen, from its origin to where it leaves the picture or vanishes far away: along it
// pixels and 1 / depth go evenly.
struct ScreenRay {
    vec3 from;  // pixel, 1 / view depth
    vec3 to;
};

vec3 on_screen(vec4 clip)
{
    return vec3(in_picture((clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.size)), 1.0 / clip.w);
}

ScreenRay screen_ray(vec3 origin, vec3 direction)
{
    const vec4 begin = frame.world_to_clip * vec4(origin, 1.0);
    const vec4 along = frame.world_to_clip * vec4(direction, 0.0);
    ScreenRay ray;
    ray.from = on_screen(begin);
    if (along.w > 1.0e-4) {
        // A point at infinity.
        ray.to = vec3(in_picture((along.xy / along.w * 0.5 + 0.5) * vec2(frame.size)), 0.0);
    } else {
        const float t = (frame.near_m * 2.0 - begin.w) / min(along.w, -1.0e-4);
        ray.to = on_screen(begin + along * clamp(t, 0.0, 1.0e4));
    }
    const vec2 delta = ray.to.xy - ray.from.xy;
    const vec2 size = vec2(picture_size());
    const vec2 beyond = vec2(kBeyond * size.x, -0.5);
    const vec2 limit = mix(-beyond, size + beyond, greaterThan(delta, vec2(0.0)));
    const vec2 reach = (limit - ray.from.xy) / mix(delta, vec2(1.0e-6), lessThan(abs(delta), vec2(1.0e-6)));
    const float kept = clamp(min(reach.x, reach.y), 0.0, 1.0);
    ray.to = mix(ray.from, ray.to, kept);
    return ray;
}

struct WalkStep {
    float s;      // share of the way
    float ray_m;  // view depths of the ray and of the picture there
    float seen_m;
};

WalkStep walk_step(ScreenRay ray, float s)
{
    const vec3 at = mix(ray.from, ray.to, s);
    return WalkStep(s, 1.0 / max(at.z, 1.0e-7), scene_depth_m(at.xy));
}

// Between the step before and this one the ray went into what is seen. Thicker than a step goes deep, nothing is
// known to be.
bool meets(WalkStep here, float before_m)
{
    const float low_m = min(before_m, here.ray_m) * 0.985 - 0.03;
    return here.ray_m > here.seen_m && here.seen_m > low_m;
}

bool is_behind(ScreenRay ray, float s)
{
    const WalkStep here = walk_step(ray, s);
    return here.ray_m > here.seen_m;
}

// Shorter steps near the surface, half as long as even ones: the frame beside a pane is a few pixels wide.
float part_of_way(float t)
{
    return 0.5 * (t + t * t);
}

// Walks the ray through the depth of the picture. Steps are a few pixels, so that nothing wider is
// missed; what the ray passes behind is let be.
Hit trace(vec3 origin, vec3 direction)
{
    Hit hit;
    hit.confidence = 0.0;
    hit.inside = 0.0;
    hit.hidden = false;
    const ScreenRay ray = screen_ray(origin, direction);
    const float pixels = length(ray.to.xy - ray.from.xy);
    if (pixels < 1.0) return hit;
    const int steps = clamp(int(pixels / 3.0), 4, kSteps);
    float before = 0.0;
    float before_m = 1.0 / ray.from.z;
    float met = -1.0;
    float hidden = -1.0;  // where the ray went behind what is seen
    // Off the pixel that it starts from.
    const float first = min(1.5 / pixels, 0.5);
    // Steps read at once wait for memory together; they are judged in order.
    int i = 1;
    do {
        WalkStep walk[kStepsAtOnce];
        for (int j = 0; j < kStepsAtOnce; ++j)
            walk[j] = walk_step(ray, mix(first, 1.0, part_of_way(float(i + j) / float(steps))));
        for (int j = 0; j < kStepsAtOnce; ++j) {
            const WalkStep here = walk[j];
            const bool goes = met < 0.0 && i + j <= steps;
            const bool meets_it = goes && meets(here, before_m);
            const bool passes = goes && !meets_it;
            const bool in_front = here.ray_m <= here.seen_m;
            met = meets_it ? here.s : met;
            hidden = passes ? (in_front ? -1.0 : (hidden < 0.0 ? here.s : hidden)) : hidden;
            before = passes ? here.s : before;
            before_m = passes ? here.ray_m : before_m;
        }
        i += kStepsAtOnce;
    } while (i <= steps && met < 0.0);
    // After the walk, so that a CPU's lanes, which meet things at different steps, refine together.
    if (met >= 0.0) {
        float low = before;
        float high = met;
        // Two halvings a turn, with both places that the second may ask.
        for (int k = 0; k < kRefinements; ++k) {
            const float middle = 0.5 * (low + high);
            const float nearer = 0.5 * (low + middle);
            const float farther = 0.5 * (middle + high);
            const bool behind = is_behind(ray, middle);
            const bool behind_nearer = is_behind(ray, nearer);
            const bool behind_farther = is_behind(ray, farther);
            high = behind ? (behind_nearer ? nearer : middle) : (behind_farther ? farther : high);
            low = behind ? (behind_nearer ? low : nearer) : (behind_farther ? middle : farther);
        }
        const float last = 0.5 * (low + high);
        if (is_behind(ray, last)) high = last;
        hit.pixel = mix(ray.from, ray.to, high).xy;
        hit.confidence = 1.0;
    } else if (hidden >= 0.0) {
        // It never came out again: what hides it is likelier what it meets than the sky.
        hit.pixel = mix(ray.from, ray.to, hidden).xy;
        hit.confidence = 0.8;
        hit.hidden = true;
    }
    if (hit.confidence > 0.0) {
        const vec2 size = vec2(picture_size());
        const vec2 edge = min(hit.pixel, size - hit.pixel) / size;
        const vec2 ends = hit.hidden ? step(vec2(0.0), edge) : clamp(edge * 30.0, 0.0, 1.0);
        hit.inside = hit.confidence * min(ends.x, ends.y);
        hit.confidence *= min(clamp(1.0 + edge.x / kBeyond, 0.0, 1.0), ends.y);
        hit.pixel = turned_back(hit.pixel);
    }
    return hit;
}

// How far the lobe of a smooth surface is spread on the picture where its ray met it, pixels: half of all facets
// of GGX lean less than alpha.
float spread_px(vec3 position, vec2 pixel, float alpha)
{
    const float hit_m = scene_depth_m(pixel);
    const ivec2 at = clamp(ivec2(pixel), ivec2(0), picture_size() - 1);
    const vec3 met = pixel_position(frame, in_window(vec2(at) + 0.5), picture_depth(at));
    return clamp(2.8 * alpha * length(met - position) / max(pixel_width_m(frame, hit_m), 1.0e-6), 0.0, kWidest_px);
}

// The mean of that disc, the same part of it for all pixels of a sample: no grain. What lies much nearer than what
// was met is not there in the mirror: `met` stands for it. What lies farther is about what rays beside it go on to.
vec3 seen_around(vec2 pixel, float radius, float roughness, vec3 met)
{
    const float hit_m = scene_depth_m(pixel);
    const float turn = 0.61803399 * float(frame.sample_index);
    const int taps = max(kTaps / int(frame.samples), 1);
    vec3 sum = vec3(0.0);
    int i = 0;
    do {
        const float k = float(i) + fract(turn + 0.5);
        const float way = radius * sqrt(k / float(taps));
        const float angle = 2.39996323 * k + 6.2831853 * turn;
        const vec2 at = pixel + way * vec2(cos(angle), sin(angle));
        const bool nearer = scene_depth_m(at) < 0.85 * hit_m - 0.05;
        const vec3 seen = picture_at(clamp(ivec2(floor(at)), ivec2(0), picture_size() - 1), roughness);
        sum += nearer ? met : seen;
    } while (++i < taps);
    return sum / float(taps);
}

// What most of the mirrored light comes from, and how much of it is mirrored.
vec2 reflection_label(vec3 weight, Hit hit, float probed)
{
    const vec3 shares = vec3(hit.confidence, vec2(probed, 1.0 - probed) * (1.0 - hit.confidence));
    const float strength = (weight.r + weight.g + weight.b) / 3.0;
    if (shares.x >= max(shares.y, shares.z)) {
        const ivec2 met = clamp(ivec2(hit.pixel), ivec2(0), picture_size() - 1);
        const ivec2 at = here(met);
        if (picture_depth(met) > 0.0) {
            // Of what is beyond a window materials are not known.
            if (beyond_window(at)) return vec2(REFLECTS_PROBE, strength * shares.x);
            return vec2(float(material_of(texelFetch(weather_rows, row_texel(at, frame.size)), LABEL)), strength * shares.x);
        }
        return vec2(REFLECTS_SKY, strength * (shares.x + shares.z));
    }
    if (shares.y >= shares.z) return vec2(REFLECTS_PROBE, strength * shares.y);
    return vec2(REFLECTS_SKY, strength * shares.z);
}

void main()
{
    read_frame();
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    const vec4 mirror = texelFetch(mirror_weight, texel, 0);
    const vec3 weight = mirror.rgb;
    vec3 mirrored_light = vec3(0.0);
    vec2 label = vec2(REFLECTS_NOTHING, 0.0);
    if (weight.r + weight.g + weight.b > 0.0) {
        const vec4 shape = texelFetch(mirror_shape, texel, 0);
        const float depth = texelFetch(own_depth_rows, row_texel(texel, frame.size)).r;
        const vec2 pixel = vec2(texel) + 0.5;
        const vec3 position = pixel_position(frame, pixel, depth);
        const vec3 view = pixel_view_direction(frame, pixel);
        const vec3 n = octahedral_decode(shape.xy);
        const float roughness = shape.z;
        // Of the maps of the sky and of probes.
        const SeenLobe lobe = seen_lobe(n, reflect(view, n), roughness);
        const float view_m = linear_depth(frame, depth);

        // A facet of the lobe a sample: at a grazing angle they make a streak. By the plastic number, since two
        // numbers that advance alike would lie on a line; the tail of GGX is left out, few samples find it.
        const float n_th = float(frame.sample_index);
        const ivec2 seed = picture_pixel(texel);
        const float turn = 6.2831853 * fract(dither(seed, 11u) + 0.7548777 * n_th);
        const float u = 0.8 * fract(dither(seed.yx, 3u) + 0.5698403 * n_th);
        // Smooth ones send one ray, whose end is blurred: pixels that draw their facets are grain at few samples.
        const float drawn = smoothstep(0.1, 0.18, roughness);
        const float alpha = roughness * roughness;
        const float slope = drawn * alpha * sqrt(u / (1.0 - u));
        const vec3 side = normalize(cross(n, abs(n.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
        const vec3 facet = normalize(n + (side * cos(turn) + cross(n, side) * sin(turn)) * slope);
        vec3 ray = reflect(view, facet);
        // What a facet sends down comes up from the next.
        ray += n * max(0.0, -2.0 * dot(ray, n));

        Hit hit;
        hit.confidence = 0.0;
        hit.inside = 0.0;
        hit.hidden = false;
        if (PICTURE != 0u && (frame.flags & FRAME_ORTHOGRAPHIC) == 0u && dot(ray, n) > 0.0 && roughness < kWideRoughness) {
            // Water stands above the relief that the depth map knows.
            hit = trace(position + n * (0.001 * view_m + 0.015 * mirror.a), ray);
        }
        const float lod = lobe.roughness * float(SKY_PREFILTER_MIPS - 1);
        const vec3 sky = textureLod(specular_map, lobe.direction, lod).rgb;
        // A ray that met nothing saw the sky if the place sees much of it.
        const float open = clamp(shape.w * 1.3 - 0.05, 0.0, 1.0);
        vec3 mirrored = sky * mix(frame.bounce * 0.7, 1.0, open);
        float probed_share = 0.0;
        if (PROBES != 0u) {
            const Probed probed = probes_around(int(PROBES), position, lobe.direction, lobe.roughness);
            // What stands near here and not around the probe hides its sky.
            const float here = clamp(open / max(probed.open, 0.1), 0.0, 1.0);
            const vec3 around = probed.light.rgb * frame.ambient_scale +
                                sky * (probed.light.a * mix(frame.bounce * 0.7, 1.0, here));
            mirrored = mix(mirrored, around, probed.share);
            probed_share = probed.share;
            // A probe knows what is beside the picture.
            hit.confidence = mix(hit.confidence, hit.inside, probed.share);
            // A probe saw what is behind there: where it saw the sky, the ray goes on to it.
            if (hit.hidden) hit.confidence *= 1.0 - probed.share * probed.light.a;
        }
        hit.confidence *= 1.0 - smoothstep(kSharpRoughness, kWideRoughness, roughness);
        if (hit.confidence > 0.0) {
            vec3 seen = picture_at(ivec2(hit.pixel), roughness);
            const float radius = spread_px(position, hit.pixel, (1.0 - drawn) * alpha);
            if (radius > 0.7) seen = seen_around(hit.pixel, radius, roughness, seen);
            mirrored = mix(mirrored, seen, hit.confidence);
        }
        mirrored_light = weight * mirrored;
        if (LABEL != 0u) label = reflection_label(weight, hit, probed_share);
    }
    if (SPLIT != 0u) {
        // The lighting pass has put there what its maps mirror.
        const ivec3 at = ivec3(texel, PART_SPECULAR_INDIRECT);
        imageStore(light_parts, at, imageLoad(light_parts, at) + vec4(mirrored_light, 0.0));
    }
    if (LABEL != 0u && frame.sample_index == 0u) {
        imageStore(label_image, ivec3(texel, REFLECTION_LABEL_LAYER), vec4(label, 0.0, 0.0));
    }
    imageStore(accumulated, texel, imageLoad(accumulated, texel) + vec4(mirrored_light, 0.0));
}
