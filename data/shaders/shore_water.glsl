// An example of a surface of your own that is no solid: the sea at a coast, for a plane that lies where the
// water stands. A mask says what it is like at each place; it is the colour of the vertices, or the base
// colour texture where there is one (its values after decoding from sRGB):
//
//   red    foam
//   green  how much lighter shallow water is than deep
//   blue   where waves are
//   alpha  depth, 0 shore .. 1 open sea; of the vertices alone, a texture has 1
//
//   [materials."sea*"]
//   surface = "shore_water.glsl"
//
// Of a material that is blended (preset = "fade") the ground below shows through, the less the deeper.
// Waves go with the wind and grow with it. They move the mesh, as far as it is fine enough for them, and lean what
// is seen by all of them; a plane is cut by `displacement_phong = 1.0` and the other keys of displacement. Rain is
// lost in the sea, snow melts on it.
#include "gpu/passes/surface/own_surface.glsl"

const vec3 kShoreDeep = vec3(0.004, 0.022, 0.034);     // light that comes back from below, of clear sea
const vec3 kShoreShallow = vec3(0.055, 0.16, 0.15);    // the same over sand
const vec3 kShoreAbsorbs = vec3(4.2, 0.84, 0.36);      // of clear water, there and back through 6 m
const float kShoreFoam = 0.55;                         // albedo of foam (Koepke 1984)
const int kShoreWaves = 6;

vec4 shore_mask(SurfaceInput at)
{
    if (!has(TEXTURE_BASE_COLOR)) return at.color;
    return vec4(texel(base_color_texture, coordinates(TEXTURE_BASE_COLOR, at, vec2(0.0))).rgb, 1.0);
}

vec3 shore_to_eye(SurfaceInput at)
{
    const bool orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    return orthographic ? -frame.forward : normalize(frame.camera_m - at.position);
}

struct ShoreWaves {
    float height_m;
    vec2 slope;      // of what is resolved
    float variance;  // of its slope, all waves
    float resolved;  // the part of it that is resolved
    float crest;     // -1 trough .. 1 crest
};

// Crests are uneven: slow noise shifts them, by so much of a turn at a place, and by so much more a metre on.
vec3 shore_uneven(vec2 xz, float length_m, uint seed)
{
    const float scale_m = 2.3 * length_m;
    const vec2 p = xz / scale_m;
    const float beside = 0.05;
    const float here = tileable_noise(p, 4096, seed);
    const vec2 on = vec2(tileable_noise(p + vec2(beside, 0.0), 4096, seed), tileable_noise(p + vec2(0.0, beside), 4096, seed));
    return 7.0 * vec3(here, (on - here) / (beside * scale_m));
}

// Waves of deep water: the longer, the faster (omega^2 = g k). Of one that is shorter than twice `least_m` only
// the roughness is left.
ShoreWaves shore_waves(vec2 xz, float least_m, float speed, vec2 along)
{
    ShoreWaves w = ShoreWaves(0.0, vec2(0.0), 0.0, 0.0, 0.0);
    const float slope = 0.02 + 0.006 * speed;  // of each wave, at its steepest
    float length_m = 1.3 + 0.35 * speed;
    float weight = 0.0;
    for (int i = 0; i < kShoreWaves; ++i) {
        const float turn = 2.8 * (hash_f(71u + uint(i)) - 0.5);
        const vec2 d = vec2(along.x * cos(turn) - along.y * sin(turn),
                            along.x * sin(turn) + along.y * cos(turn));
        const float k = 6.2831853 / length_m;
        const vec3 uneven = shore_uneven(xz, length_m, 90u + uint(i));
        const float phase = k * dot(d, xz) - sqrt(9.81 * k) * frame.time_s + uneven.x +
                            6.2831853 * hash_f(51u + uint(i));
        const float seen = 1.0 - smooth_edge(0.25 * length_m, 0.5 * length_m, least_m);
        const float height_m = slope / k * seen;
        w.height_m += height_m * sin(phase);
        w.slope += (k * d + uneven.yz) * (height_m * cos(phase));
        w.variance += 0.5 * slope * slope;
        w.resolved += 0.5 * slope * slope * seen * seen;
        w.crest += seen * length_m * sin(phase);
        weight += length_m;
        length_m *= 0.61;
    }
    w.crest /= weight;
    return w;
}

// Speed of the wind, and where it goes.
vec3 shore_wind()
{
    const float speed = length(frame.weather.wind_m_s);
    return vec3(speed, speed > 0.01 ? frame.weather.wind_m_s / speed : vec2(0.8, 0.6));
}

vec3 shore_water_move(MoveInput at)
{
    const float calm = has(TEXTURE_BASE_COLOR) ? texel_at(base_color_texture, TEXTURE_BASE_COLOR, at).b : at.color.b;
    const vec3 wind = shore_wind();
    return vec3(0.0, calm * shore_waves(at.position.xz, at.spacing, wind.x, wind.yz).height_m, 0.0);
}

// Threads and holes of foam, drifting with the wind; never finer than a pixel.
float shore_foam(SurfaceInput at, vec2 drift)
{
    const float pixel_m = max(length(at.position_dx.xz), length(at.position_dy.xz));
    const vec2 p = at.position.xz - drift;
    float threads = 0.5;
    float size_m = 1.1;
    float weight = 0.6;
    for (uint i = 0u; i < 3u; ++i) {
        const float seen = 1.0 - smooth_edge(0.25 * size_m, 0.5 * size_m, pixel_m);
        const float ridge = 1.0 - abs(2.0 * tileable_noise(p / size_m, 4096, 11u + i) - 1.0);
        threads += weight * seen * (ridge - 0.65);
        size_m *= 0.43;
        weight *= 0.6;
    }
    return threads;
}

void shore_water_input(inout SurfaceInput at)
{
    at.weather.gb = vec2(0.0);
}

void shore_water_surface(SurfaceInput at, inout SurfaceData data)
{
    const vec4 mask = shore_mask(at);
    const vec3 wind = shore_wind();
    const float speed = wind.x;
    const vec2 along = wind.yz;
    const float pixel_m = max(length(at.position_dx.xz), length(at.position_dy.xz));
    ShoreWaves w = shore_waves(at.position.xz, pixel_m, speed, along);
    const vec2 slope = w.slope * mask.b;
    // All waves lean the level water, so it is the same whatever part of them the mesh has.
    const vec3 level = vec3(0.0, at.normal.y < 0.0 ? -1.0 : 1.0, 0.0);
    vec3 water_normal = normalize(level - vec3(slope.x, 0.0, slope.y) * level.y);
    // Slopes that face away are hidden behind crests: what is seen there is the crest.
    const vec3 eye = shore_to_eye(at);
    water_normal = normalize(water_normal + eye * max(0.04 - dot(water_normal, eye), 0.0));

    // What comes back from below: Beer's law over the depth. Crests of shallow water are lighter.
    const float deep = 1.0 - exp(-4.0 * mask.a);
    const float light = mask.g * (1.0 + 0.25 * w.crest * mask.b);
    const vec3 below = mix(mix(kShoreDeep, kShoreShallow, saturate(light)), kShoreDeep, deep);

    // Foam lies where the mask has it, the more on crests; wind above 5 m/s breaks crests at sea.
    const float breaking = saturate((speed - 5.0) / 15.0) * mask.b * smooth_edge(0.25, 0.7, w.crest);
    const float amount = saturate(mask.r * (1.0 + 0.4 * w.crest * mask.b) + breaking);
    const float foam = amount * smooth_edge(0.75 - 0.6 * amount, 1.0 - 0.6 * amount,
                                            shore_foam(at, along * (0.1 + 0.03 * speed) * frame.time_s));

    // Slopes of a sea in the wind (Cox and Munk 1954), less those that are drawn.
    const float all = (0.003 + 0.00512 * speed) * mix(0.15, 1.0, mask.b);
    const float alpha = sqrt(max(all - w.resolved * mask.b * mask.b, 0.002));
    data.texel.base_color = mix(below, vec3(kShoreFoam), foam);
    if (material.alpha_mode == ALPHA_BLEND) {  // the sand is not painted then, it is there
        const float seen = (1.0 - deep) * (1.0 - foam);
        data.opacity = 1.0 - seen;
        data.filtered = exp(-kShoreAbsorbs * mask.a);
        data.texel.base_color =
            (kShoreDeep * (deep * (1.0 - foam)) + kShoreFoam * foam) / max(1.0 - seen, 1.0e-3);
    }
    data.texel.roughness = mix(sqrt(alpha), 0.8, foam);
    data.texel.metallic = 0.0;
    data.texel.f0 = vec3(0.02);
    data.texel.porosity = 0.0;
    data.texel.base_normal = normalize(mix(water_normal, level, 0.6 * foam));
    data.texel.cover_normal = data.texel.base_normal;
    data.texel.weather = vec4(0.0);
}
