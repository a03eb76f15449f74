// What every pass of a frame knows: camera, sun, weather. One uniform block a jittered sample.
#ifndef PETRICHOR_GPU_FRAME_FRAME_IO_H
#define PETRICHOR_GPU_FRAME_FRAME_IO_H

#include "base/interop.h"
#include "formulas/light/patch_cells.h"
#include "formulas/weather/moment.h"
#include "gpu/frame/place_io.h"

#define SHADOW_CASCADES 3
#define LAMP_SHADOWS_MOST 16
#define LIGHT_TILE 16         // pixels a side of a light list
#define LIGHT_COARSE 8        // light tiles a side of a coarse tile
#define GLOW_BLOCK 4          // pixels a side for which the glow of lamps is computed once
#define SKY_DIRECTIONS 16     // depth maps over the upper hemisphere, for skylight's shadow
#define SKY_MAP_SIZE 512      // texels a side of each
#define SKY_PREFILTER_MIPS 6  // roughness 0, 0.2 .. 1

SHARED_BEGIN

// A direction that rain and snow come from.
struct FallConstants {
    vec4 column;   // of its depth map, from the world: texels from the middle of the first one, lifted towards the sky ..
    vec4 row;
    vec4 depth;
    float lift_m;  // .. and along the normal so far, off the surface itself: the same for all
    vec3 level;    // what facing_on_level wants
    float rain;    // share of it
    float snow;
    int layer;     // number of the map
};

// Those of which shaders ask some by number.
struct FrameArrays {
    FallConstants falls[SKY_DIRECTIONS];  // where rain and snow come from, as many as SURFACE_SPEC_FALLS says
    mat4 shadow_from_world[SHADOW_CASCADES];  // to (u, v, depth), reversed depth
    mat4 sky_from_world[SKY_DIRECTIONS];
    vec4 sky_direction[SKY_DIRECTIONS];  // towards the sky, unit
    vec4 lamp_offset_m[LAMP_SHADOWS_MOST];  // of the point that a lamp's shadow is seen from
};

// A new member is listed in frame_words_io.h, too.
struct FrameConstants {
    mat4 world_to_clip;
    mat4 shelter_from_world;

    vec3 camera_m;
    float time_s;
    vec3 ray_corner;  // perspective: direction through pixel (0, 0) corner, forward part 1 long
    vec3 ray_dx;      // change per pixel
    float near_m;
    vec3 ray_dy;
    float far_m;  // > 0: orthographic, depth is 1 - distance / far
    vec3 forward;
    uint sample_index;
    vec3 origin_corner;  // orthographic: world position of the corner on the camera plane
    float pixel_angle;   // radians a pixel spans near the image centre

    vec3 sun_direction;    // towards the sun, unit
    float shadow_texel_m;  // of the first cascade
    vec3 sun_illuminance;  // lux by channel on a facing plane, after air and clouds
    vec3 cookie_right;     // axes of a picture before the sun, over its size in metres
    vec3 cookie_down;
    int cookie_texel;      // its first; none when negative
    float cookie_texel_m;
    vec4 cascade_end_m;    // view distance where cascade i ends; w: where the window begins (window_io.h)
    vec4 cascade_scale;    // texel size of cascade i relative to the first; w: strength of the shadow

    vec3 moon_direction;  // towards it, unit
    vec3 moon_radiance;   // of its lit part, behind the air
    vec3 moon_lit_from;   // towards the sun as the moon has it, unit
    vec3 stars_x;         // axes of right ascension 0, 6 h and the pole, in the world
    vec3 stars_y;
    vec3 stars_z;

    WeatherMoment weather;
    WeatherLook look;

    ivec2 size;  // pixels
    ivec2 light_tiles;
    ivec2 coarse_tiles;
    uint light_count;
    uint light_words;        // 32 lights a word
    uint directional_count;  // first lights of the table; not in lists; behind them those with a shadow,
    uint shaped_shadows;     // .. of them, from here on what is lit by its shape,
    uint plain_lights;       // .. from here on points and spots without one,
    uint shaped_lights;      // .. from here on what is lit by its shape, without one

    float ao_radius_m;
    float ao_strength;
    float ambient_scale;  // of the environment
    float sky_scale;      // of what is seen behind the scene
    vec4 land;            // radiance of the ground at the scene's rim, which the land beyond goes on from; w 0: not known
    float fog_per_m;      // extinction; 0: no fog
    int fog_mode;
    float fog_start_m;
    float fog_end_m;
    float fog_height_m;
    float fog_base_m;     // world height
    float mist_per_m;     // extinction of the layer on warm wet ground (formulas/light/mist.h); 0: none
    vec2 mist_air_m;      // how far its air has gone
    float drawn_per_m;    // extinction of the drops and flakes that are drawn one by one ..
    float drawn_reach_m;  // .. and how far they are, in the mean
    vec3 gusts;           // way of the wind that carries their clouds, x and z; strength (formulas/weather/gusts.h)
    vec3 white_gains;     // of the cones
    float bloom;
    float wet_lens;       // of this moment: 0 dry
    float emissive_scale;
    float exposure;       // > 0: given; 0: metered
    float exposure_bias;  // linear factor
    float samples;
    float sun_angular_cos;   // cosine of the sun's angular radius
    float shelter_spread_m;  // splashes and drift carry water and snow this far under a roof
    float horizon_fade;      // how fast mirrors darken below the horizon of the mesh
    float specular_aa;       // times the variance of normals inside a pixel
    float specular_aa_limit;
    vec3 grain_dither;       // of what grained surfaces mirror: spread, distance, fade (formulas/light/grain.h)
    float occlusion_direct;  // how much occlusion maps darken direct light
    float bounce;            // share of skylight that hidden directions still send
    uint flags;
    int ripple_bits;  // the maps of rings and waves have 2^bits texels a side
    int flow_bits;
    vec4 tracks;      // world x and z of the map's corner, repeats of it per metre along both
    vec2 tracks_y_m;  // heights between which it counts
    PatchGrid patches;  // levels 0: none
    float snow_lift_m;  // snow with a body stands at most so far over its ground
    PlaceConstants place;  // of the scene's patches
#ifndef FRAME_BY_WORDS  // they are beside it there
    FrameArrays arrays;
#endif
};

SHARED_END

#define FRAME_DITHER 16u
#define FRAME_SHELTER 32u
#define FRAME_ORTHOGRAPHIC 64u
#define FRAME_SUN_DISC 128u
#define FRAME_GAMMA 256u
#define FRAME_WHITE_BALANCE 512u
#define FRAME_LAND 2048u      // the sky is computed, with land below its horizon
#define FRAME_TWO_SETS 1024u  // the G-buffer keeps shares of two sets of textures
#define FRAME_RINGS 4096u     // it rains: normals of covers have the roughness of rings that they do not show (rough_normal.h)

#endif
