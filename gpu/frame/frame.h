#ifndef PETRICHOR_GPU_FRAME_FRAME_H
#define PETRICHOR_GPU_FRAME_FRAME_H

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "formulas/weather/moment.h"
#include "gpu/frame/place_io.h"
#include "gpu/frame/switches.h"
#include "gpu/upload/scene_names.h"
#include "scene/icicles/icicle.h"
#include "scene/material_table.h"

namespace petrichor::gpu {

/// A lat-long HDR environment: linear RGB radiance, row 0 = straight up, column 0 = -x... The image
/// centre looks along -z; u grows to the right (+x).
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  ///< width * height * 3
};

/// Light from the sky. With an environment map the map lights the scene (scaled), else an analytic
/// sky does: clear air by single scattering, clouds over it.
struct Sky {
    float sun_elevation_rad = 0.7f;  ///< -pi/2 .. pi/2
    float sun_azimuth_rad = 0.6f;    ///< from -z (north) clockwise towards +x (east)
    float sun_illuminance =
        100000.0f;                   ///< lux, on a plane facing the sun above the atmosphere's haze
    float cloud_cover = 0.0f;        ///< 0 clear .. 1 overcast
    float turbidity = 2.5f;          ///< 1.5 very clear .. 10 hazy
    float ground_albedo = 0.2f;      ///< of the land beyond the scene
    float environment_scale = 1.0f;  ///< multiplies the environment map
    float environment_rotation_rad = 0.0f;
    float sun_shadow_strength = 1.0f;  ///< 0..1: share of the light that shadows of sun or moon take away
    bool analytic_sun = true;  ///< false: the scene's own directional lights replace the sun
    bool land_as_ground = true;  ///< the land that is seen goes on from the ground at the scene's rim, where patches light it
    float skyline_from_m = -1.0f;  ///< trees and hills stand from here on where the land of the computed sky ends; negative: none do
    float moon_elevation_rad = -1.0f;
    float moon_azimuth_rad = 0.0f;  ///< as the sun's
    float moon_lux = 0.0f;          ///< above the air, on a plane that faces it; 0: there is none
    float moon_illuminated = 1.0f;  ///< share of its disc
    float latitude_rad = 0.87f;     ///< of the place: where the pole of the stars stands
    float sidereal_rad = 0.0f;      ///< hour angle of the vernal equinox: how far they have turned
    float north_rad = 0.0f;         ///< of the stars: where north is, from -z towards +x
};

/// A picture before the sun, told over the plane that faces it, fixed to the world's origin.
struct SunCookie {
    int first_texel = -1;      ///< in the table of all LightProfile: smaller pictures follow; none when negative
    float size_m = 8.0f;       ///< of the picture, metres
    glm::vec3 mean{1.0f};      ///< of its texels
};

/// How the G-buffer is filled: by fragments, or by resolving a buffer of triangle numbers.
enum class SurfacePath {
    Auto,  ///< what is faster on the device
    Fragment,
    Visibility,
};

/// How the size of lamps is lit.
enum class AreaLights {
    Off,      ///< as points; rectangles as surfaces that glow
    Ltc,      ///< by linearly transformed cosines
    Nearest,  ///< from the point that is nearest to what is mirrored, as Lux 2.02
};

/// The curve from exposed light to the display (formulas/color).
enum class ToneMap {
    Linear,   ///< clipped
    Filmic,   ///< a gentle shoulder; the default
    Agx,      ///< Sobotka's
    Aces,     ///< the fit of ACES 1
    Neutral,  ///< Khronos' PBR Neutral
};

/// How fog thickens with the path (formulas/light/fog.h).
enum class FogMode {
    Off,
    Metres,  ///< by the visibility of the weather: 2 % contrast is left there
    Exp,
    Exp2,
    Linear,
};

/// Fog over the scene and up to the analytic sky. It glows with the sky's light: there is none
/// without image-based light.
struct Fog {
    FogMode mode = FogMode::Metres;
    float per_m = 0.01f;  ///< of Exp and Exp2
    float start_m = 0.0f, end_m = 100.0f;  ///< of Linear
    float height_m = 120.0f;  ///< scale height of the layer over the scene's lowest point; 0: endless
    float mist_per_m = 0.0f;  ///< extinction of mist on wet ground, some hands high (formulas/light/mist.h); any mode
};

/// How rain and snow are drawn on their way down. What falls, and how fast, the weather says.
struct Falling {
    glm::dvec2 air_m{0.0};     ///< how far the air has gone since the film began, world x and z
    float shutter_s = 0.004f;  ///< > 0: a drop is drawn as long as its way in this time
    float density = 1.0f;      ///< times as many as the weather says, >= 0
    int budget = 20000;        ///< so many are drawn, about; the rest dims what lies behind
    std::uint32_t seed = 1;
};

/// How a frame is taken.
struct FrameSettings : FrameSwitches {
    int width = 640;
    int height = 360;
    int samples = 8;         ///< jittered samples a pixel, 1..256
    float adaptive = 0.0f;   ///< pixels whose first two samples differ by less on the display, 0..1, are
                             ///< not shaded again (passes/adaptive); 0: all are
    double time_s = 0.0;     ///< drives ripples and flow
    std::uint32_t seed = 1;  ///< jitter
    float exposure = 0.0f;   ///< > 0: linear scale; 0: by the light that falls in, of sun and sky
    float exposure_bias_stops = 0.0f;
    float occlusion_direct = 0.0f;  ///< 0..1: how much occlusion maps darken sun and lamps too
    bool gamma = false;  ///< colours are lit as the codes that they are stored as, and shown so
    AreaLights area_lights = AreaLights::Ltc;
    float least_lux = 0.0f;  ///< lamps without a range end where they give so little; 0: by the exposure
    bool lazarov = false;  ///< what is mirrored of the sky by Lazarov's fit, as Lux 2.02
    float horizon_fade = 0.0f;  ///< > 0: mirrors darken below the horizon of the mesh, so fast
    float specular_aa = 1.0f;   ///< times the variance of normals in a pixel; 0: off
    float specular_aa_limit = 0.18f;
    float anisotropic_dither = 0.0f;  ///< 0..1: mirrors of anisotropic surfaces are drawn out by chance ..
    float anisotropic_dither_distance_m = 50.0f;  ///< .. up to here, fading over the last of it
    float anisotropic_dither_fade_m = 15.0f;
    float lod_scale = 1.0f;  ///< times the size by which levels of detail are chosen, > 0
    bool patch_light = true;  ///< light between surfaces by patches, when the renderer holds some
    int transparent_layers = 4;  ///< of what lets light through, exact; what is behind goes by chance
    int lamp_shadows =
        4;  ///< so many lamps throw shadows, 0 to 16: the brightest as the eye sees them
    ToneMap tone_map = ToneMap::Filmic;
    bool exposed_light = false;  ///< what the display is made of is handed over in place of it, for curves of the host
    float white_balance_k = 0.0f;  ///< light of this temperature is white; 0: as it is
    glm::vec3 white_light{0.0f};   ///< if not black, light of this colour (linear, luminance 1) is white instead ..
    float white_share = 1.0f;      ///< .. by this share of its cast, 0..1
    float bloom = 0.0f;  ///< 0..1: share of light that the lens scatters around; display only
    float wet_lens = 0.0f;  ///< 0..1: drops on its glass while it rains; display only
    SurfacePath surface_path = SurfacePath::Auto;
    bool light_prepass = true;  ///< users' own lighting models that can gather light before they compose it do
    bool coarse_shadows = false;  ///< one map of the sun holds all of the view: for small pictures
    bool any_light = false;  ///< one pipeline of the lighting for any sun, air, rain and snow: for small pictures
    bool all_lights = false;  ///< every pixel asks every light: slow, for checking light lists
    std::vector<std::string> aovs;  ///< names from aov_table()
};

/// Where the patches of the loaded scene lie, and the hollows of its ground: the same for all
/// frames.
struct PlaceShape {
    shared::PatchGrid grid{};
    std::vector<glm::uvec4> table;  ///< as scene::Patches::table; behind it the parts of patches (gpu/place/place_parts.h)
    glm::vec2 basin_corner_m{0.0f};
    float basin_cell_m = 1.0f;
    std::uint32_t basin_width = 0, basin_depth = 0;
    std::vector<std::uint32_t> labels;  ///< as scene::Basins::label; basin_width * basin_depth
};

/// The weather of every patch of the scene at a moment.
struct PlaceWeather {
    std::shared_ptr<const PlaceShape> shape;
    std::vector<glm::vec4> states;  ///< PLACE_STATE_TEXELS a patch, see place_io.h
    std::vector<float> levels_m;    ///< of the water over each pit, by label; at least one
    /// State of level ground in the open, for ground of its material beyond the patches: PLACE_STATE_TEXELS;
    /// empty: such ground has the weather of the frame.
    std::vector<glm::vec4> open;
};

/// What of the rain and snow of a frame is in its picture.
struct FallingFacts {
    std::uint32_t drawn = 0;       ///< one by one
    double seen = 0.0;             ///< how many there are between the camera and the visibility
    float per_m3 = 0.0f;
    float extinction_per_m = 0.0f; ///< of all of them, a part of the air's
    float drawn_reach_m = 0.0f;    ///< how far the drawn ones are, in the mean by what they hide
    float visibility_m = 0.0f;
};

/// What lights a frame, besides the sky.
struct LightFacts {
    enum class Direct { None, Sun, Moon, Scene };
    Direct direct = Direct::None;  ///< the strongest that comes from one direction; Scene: a light of the scene
    glm::vec3 towards{0.0f, 1.0f, 0.0f};
    glm::vec3 lux{0.0f};           ///< red, green, blue of linear sRGB, on a plane that faces it, behind air and clouds
    std::size_t lamps = 0;         ///< all others that are lit, wherever they are
    std::size_t glowing = 0;       ///< of them surfaces that glow
};

/// The lens: every sample looks through another point of it, all of them at the same things in focus.
/// Labels are those of its middle.
struct Lens {
    float radius_m = 0.0f;  ///< of the aperture; 0: all is sharp
    float focus_m = 10.0f;  ///< along the view axis
};

/// Where camera and scene are when a sample is taken.
struct ShutterMoment {
    Camera camera;
    double animation_s = 0.0;
    double off_s = 0.0;  ///< from the frame's own moment: what sways in the wind goes on
};

struct Frame {
    Camera camera;
    Lens lens;
    /// Of each sample while the shutter is open; the first is the frame's own moment. Empty: all are.
    std::vector<ShutterMoment> shutter;
    Sky sky;
    SunCookie sun_cookie;
    Fog fog;
    Falling falling;
    shared::WeatherMoment weather;    ///< all of it: what is seen, and the SI values beside it
    shared::WeatherLook look;         ///< how weather is drawn
    /// Where pixels find their weather; null: `weather` is everywhere, under the shelter map.
    std::shared_ptr<const PlaceWeather> place;
    scene::IcicleLengths icicles = {};  ///< at edges that drip
    std::vector<Light> extra_lights;  ///< added to the scene's own (a lamp lit at dusk)
    float scene_light_scale = 1.0f;   ///< multiplies point and spot lights of the scene
    float emissive_scale = 1.0f;      ///< multiplies emission of materials
    std::vector<MaterialChange> materials; ///< those that are not named are as loaded
    std::vector<ShapeMoment> shapes = {};  ///< by number; those behind the list are at rest
    /// Albedo of every patch under this frame's weather; empty: worked out from `weather`.
    std::vector<glm::vec3> patch_albedo = {};
    double animation_s = 0.0;         ///< on the clock of the scene's animations
    bool emissive_lights = true;      ///< what glows lights its surroundings
    FrameSettings settings;
};

}  // namespace petrichor::gpu

#endif
