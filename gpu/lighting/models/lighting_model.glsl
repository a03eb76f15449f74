// What a lighting model is: how a surface answers to light. One file a model, found by its name; a
// user's own is compiled at run time against this text. The file NAME.glsl defines
//
//   vec3 NAME_light(LitPoint p, vec3 to_light)
//       radiance towards the eye per lux of a light that the surface would face, its cosine included;
//       `to_light` is a unit vector and may come from behind
//   Reflected NAME_surround(LitPoint p, Surroundings s)
//       the answer to light from all around
//   vec3 NAME_own(LitPoint p)
//       radiance, cd/m2, that needs no light
//
// Beside NAME_light, or in its place, a user's own may gather the light of sun and lamps first and be
// composed with the material once, as in a pre-pass of lighting ([render] lighting_path):
//
//   LightSum NAME_gather(LitPoint p, vec3 to_light)
//       what is gathered of one lux of a light that the surface would face; sums over lights follow
//   vec3 NAME_compose(LitPoint p, LightSum sum)
//       radiance towards the eye of all that was gathered
//
// Only the models of what is in the picture are compiled into its shader.
#ifndef PETRICHOR_GPU_LIGHTING_LIGHTING_MODEL_GLSL
#define PETRICHOR_GPU_LIGHTING_LIGHTING_MODEL_GLSL

#include "formulas/light/brdf.h"
#include "formulas/light/iridescence.h"
#include "formulas/light/layers.h"
#include "formulas/light/ltc.h"
#include "formulas/light/other_lobes.h"
#include "formulas/light/translucent.h"
#include "formulas/light/two_lobes.h"
#include "formulas/light/water_film.h"

// What lamps that have a size need to know of the surface and the eye: the same for every lamp.
struct ShapedLobes {
    Frame3 surface;
    Frame3 lobe;       // in which the lobe is a cosine; the film's
    Frame3 film;
    vec2 split_sum;    // scale and offset of F0
    float film_keeps;  // of light of the surface below, on the way out
    float film_mirrors;
    Frame3 second_lobe;  // of a surface of two lobes
    vec2 second_sum;
};

// A second lobe of what is mirrored. Then LitPoint.lobe is the first, with the first's normal, and
// LitPoint.normal is that of what is diffuse.
struct LobeBeside {
    Lobe lobe;        // its diffuse part is the first's
    float roughness;  // perceptual
    float share;      // of what is mirrored; 0: there is none
};

// Light of sun and lamps, gathered before the material is asked. What the two mean is the model's.
struct LightSum {
    vec3 diffuse;
    vec3 specular;
};

// What is asked of a model for one light (LitPoint.gathers).
const uint GATHERS_NOTHING_FIRST = 0u;  // its answer
const uint GATHERS_DIFFUSE = 1u;
const uint GATHERS_SPECULAR = 2u;
const uint GATHERS_REST = 3u;  // what lies over the model alone
const uint GATHERS_FALLING = 4u;  // not the model: what falls on the surface, lux

// A surface point; weather is on it already.
struct LitPoint {
    vec3 position;     // world, metres
    vec3 normal;       // unit, of the material or of what covers it
    vec3 view;         // unit, to the eye
    vec3 base_color;   // dry, linear, 0..1
    vec3 albedo;       // of what is not metal
    vec3 diffuse;      // albedo without the share that is mirrored
    vec3 specular;     // F0, the reflectance at normal incidence
    float roughness;   // perceptual, 0.045..1
    vec3 emission;     // radiance, cd/m2
    float exposure;    // radiance times this is 1 where the display is white
    uint model;        // its number
    uint gathers;      // one of GATHERS_...; the pass's own
    Lobe lobe;         // of GGX, made ready for shade_lobe()
    LobeBeside second;  // of the material's small levels
    Layers layers;     // coat, sheen and so on of the material; zero where it has none
    Translucency translucency;  // of the material; the pass adds it
    ThinFilm thin_film;  // of the material; the pass colours `specular` and `lobe` by it for each lamp
    float curvature;   // of skin, 0 flat .. 1
    float hair_shift;  // radians
    WaterFilm film;    // of rain; the pass adds it
    float sunlit;      // 0 in the shadow of the sun .. 1
    float left;        // by shadows, of the light of sun and lamps that would fall on it; set where unlit_shadowed is seen
    bool point_lamps;  // sizes of lamps are not seen
    bool unshadowed;   // nor their shadows, and the sun's
    ShapedLobes shaped;  // set where the picture has lamps that have a size
    vec3 mesh_normal;    // of the triangle; set where shadows are asked
};

// What a white surface sends back of a light at that cosine (formulas/light/skin.h), from a table.
vec3 skin_lookup(float nl, float curvature);

// Light from all around a point.
struct Surroundings {
    vec3 irradiance;           // divided by pi: what a white Lambert surface sends out
    vec3 irradiance_behind;    // the same on the other side, for what lets light through
    float occlusion;           // 1 open; of the material and the screen
    float specular_occlusion;  // the same for what is mirrored
    vec2 split_sum;            // scale and offset of F0 for GGX at this roughness and angle
    float scale;               // of the environment
};

struct Reflected {
    vec3 radiance;  // cd/m2
    vec3 mirror;    // factor of what is seen in the mirror direction, blurred by the roughness
};

// Light that a bright surface throws back into its own crevices (Jimenez et al. 2016).
vec3 bounced_occlusion(vec3 albedo, float occlusion)
{
    const vec3 a = 2.0404 * albedo - 0.3324;
    const vec3 b = -4.7951 * albedo + 0.6417;
    const vec3 c = 2.7552 * albedo + 0.6903;
    return max(vec3(occlusion), ((occlusion * a + b) * occlusion + c) * occlusion);
}

#endif
