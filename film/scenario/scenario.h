#ifndef PETRICHOR_FILM_SCENARIO_SCENARIO_H
#define PETRICHOR_FILM_SCENARIO_SCENARIO_H

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "film/color/display_transform.h"
#include "film/scenario/site_options.h"
#include "film/scenario/weather_script.h"
#include "film/toml/keyed.h"
#include "gpu/frame/frame.h"
#include "scene/probes/probes.h"

namespace petrichor::film {

/// What a scene stands on.
enum class StandsOn {
    Auto,   ///< a plane, where the scene brings no ground and no picture of the sky shows one
    Plane,  ///< always a plane
    None,   ///< as it is
};

struct ScenarioScene {
    std::string file;             ///< .glb or .gltf, relative to the scenario; or "demo:street"
    std::uint32_t demo_seed = 1;  ///< for the generated demo scene
    bool allow_outside = false;   ///< links in the scene's folder may lead out of it (command line)
    int max_texture = 4096;       ///< larger textures are reduced to this, texels
    std::string texture_rule = "picture";  ///< small levels of normals and roughness, texproc::rules()
    StandsOn ground = StandsOn::Auto;
    double north_degrees = 0.0;   ///< where north is: clockwise from -z towards +x
    std::string variant;          ///< of its materials; empty: as the file has them
    std::string animation = "all";  ///< "all", "none", or the name of one
    double animation_speed = 1.0;   ///< seconds of its clock for a second of the film
    double animation_start_s = 0.0; ///< on that clock, of frame 0
    bool animation_loop = true;     ///< begins again when it ends
};

struct CameraKey {
    double time_s = 0.0;
    std::optional<glm::dvec3> position_m;
    std::optional<glm::dvec3> look_at_m;
    std::optional<double> fov_degrees;  ///< vertical
};

/// What decides how bright a PNG is.
enum class Exposure {
    Auto,      ///< the picture and those of the frames around it
    Incident,  ///< the light of sun and sky on level ground
    Fixed,     ///< a number of the camera
};

struct ScenarioCamera {
    std::string name;             ///< of a camera in the scene; empty: the first one, else framed
    std::vector<CameraKey> keys;  ///< a path of our own; wins over `name`
    Interpolation interpolation = Interpolation::Smooth;
    std::optional<double> near_m;
    glm::dvec2 shift{0.0};  ///< of the lens, as scene::Camera's
    Exposure exposure_mode = Exposure::Auto;
    KeyedNumber exposure;          ///< with Fixed: linear scale, else ..
    KeyedNumber ev100;             ///< .. the exposure value at ISO 100
    KeyedNumber exposure_bias;     ///< stops
    double ev100_low = -6.0;       ///< limits of Auto
    double ev100_high = 18.0;
    KeyedNumber white_balance_k;   ///< not given: as it is
    bool white_balance_auto = false;       ///< by the light on what is seen, instead
    KeyedNumber white_balance_strength;    ///< with auto: share of the cast that goes; not given: 0.8
    KeyedNumber bloom;
    KeyedNumber wet_lens;
    KeyedNumber shutter_s;
    KeyedNumber f_stop;   ///< not given: all is sharp
    KeyedNumber focus_m;
    double sensor_mm = 24.0;  ///< height
    double exposure_smoothing_s = 0.25;  ///< of the film: half width of Auto's window
};

struct ScenarioSun {
    bool from_scene = false;        ///< the scene's own directional lights replace the sun
    KeyedNumber elevation_degrees;  ///< not given: time of day, else the scene's light, else 35
    KeyedNumber azimuth_degrees;    ///< clockwise from north (-z); not given: as above, else 140
    KeyedNumber time_of_day_hours;  ///< local solar time
    double latitude_degrees = 50.0;
    double day_of_year = 80.0;
    std::optional<double> illuminance_lux;  ///< not given: as the scene's sun is where that shines, else 100000
    std::string cookie;             ///< a picture before it, relative to the scenario; empty: none
    KeyedNumber cookie_size_m;      ///< of the picture on a plane that faces the sun
    KeyedNumber shadow_strength;    ///< 0..1; not given: 1
    bool yields = false;  ///< to the sun of keys: a preset named on the command line brings its own
};

/// How the numbers of a picture of light are meant.
enum class LightCode {
    Auto,   ///< float as it is, 8 and 16 bits as sRGB
    Float,  ///< as it is; whole numbers are refused
    Rgbm,   ///< 8 bits, a multiplier in alpha
    Dldr    ///< 8 bits, half of the light
};

struct ScenarioSky {
    KeyedNumber cloud_cover;  ///< 0..1; not given: from the weather
    KeyedNumber turbidity;
    std::string environment;  ///< lat-long HDR file relative to the scenario; empty: analytic sky
    LightCode environment_decode = LightCode::Auto;
    double environment_scale = 1.0;
    double environment_rotation_degrees = 0.0;
    double ground_albedo = 0.2;
    bool land_as_ground = true;  ///< where ground_albedo is not given
    bool skyline = true;  ///< trees and hills where the land of the computed sky ends
};

/// [moon]: keys win over what place and clock say.
struct ScenarioMoon {
    KeyedNumber elevation_degrees;
    KeyedNumber azimuth_degrees;
    KeyedNumber illuminated;  ///< share of its disc, 0..1
};

/// [fog]: how it thickens; what it veils.
struct ScenarioFog {
    gpu::FogMode mode = gpu::FogMode::Metres;
    KeyedNumber visibility_m;  ///< with Metres; not given: from the weather
    KeyedNumber per_m;         ///< with Exp and Exp2
    KeyedNumber start_m, end_m;  ///< with Linear
    KeyedNumber height_m;
    KeyedNumber mist_per_m;  ///< not given: of the weather, where it knows how warm the ground is
};

/// Which model makes the moments of a weather file.
enum class WeatherModel {
    Auto,      ///< physical for weather files, artist for keys
    Artist,    ///< 0..1, rates in seconds of the film
    Physical,  ///< SI: energy and water balance of a surface
};

/// [weather]: a preset, keys of its own, or a weather file; nothing of it: a dry clear day.
struct ScenarioWeather {
    std::string preset;                    ///< its name, or a .toml file
    std::string file;                      ///< any weather file, relative to the scenario
    std::optional<WeatherScript> script;   ///< keys of the scenario itself
    std::optional<ArtistSettings> artist;  ///< [weather.artist] beside a file
    WeatherModel model = WeatherModel::Auto;
    std::string start, end;         ///< of the film in the file, as times.h; "": first, last row
    double hours_per_second = 1.0;  ///< hours of the file for a second of the clock
    std::optional<double>
        spin_up_days;  ///< physical: days before `start`; not given: all there are
    SiteOptions site;  ///< place, sensors, surface, station, month

    bool given() const { return script || !preset.empty() || !file.empty(); }
};

enum class Lamps { On, Off, Dusk };

struct ScenarioLights {
    Lamps lamps = Lamps::On;         ///< point and spot lights and glowing materials of the scene
    double dusk_degrees = 4.0;       ///< with Dusk: full light at this sun elevation and below ...
    double dusk_fade_degrees = 4.0;  ///< ... none this much above it
    gpu::AreaLights area = gpu::AreaLights::Ltc;
    bool emissive = true;            ///< what glows lights its surroundings
    bool lanterns = true;            ///< what stands around a lamp shades softly
    double scale = 1.0;
    double least_lux = 0.0;          ///< where lamps without a range end; 0: by the exposure
};

/// Light that comes from other surfaces.
enum class IndirectLight {
    Auto,     ///< patches, unless tracing them would take minutes or much memory
    Patches,  ///< from the patches of the scene, solved each frame
    Ambient,  ///< skylight past depth maps, and a constant
};

/// Files in the layouts that `texture generate` writes (Lux's, docs/lux.md 6); "": none.
struct WeatherTextures {
    std::string ripple;           ///< R envelope of a drop, GB direction, A when it falls
    std::string snow_mask;        ///< B where snow lies first; a grey one will do
    std::string snow_water_bump;  ///< AG normal of snow and of moving water, B smoothness of snow

    bool operator==(const WeatherTextures&) const = default;
};

/// A lat-long picture in place of what a probe would trace; none where file is empty.
struct ScenarioProbePicture {
    std::string file;  ///< relative to the scenario
    LightCode decode = LightCode::Auto;
};
/// What mirrors see of a scene beyond the picture.
struct ScenarioProbes {
    bool automatic = true;                 ///< a few, placed by what the scene is; else these
    std::vector<scene::ProbePlace> places;  ///< none and not automatic: mirrors see the sky alone
    std::vector<ScenarioProbePicture> pictures;  ///< one a place
};

struct ScenarioRender : gpu::FrameSwitches {
    int lamp_shadows = 4;
    int transparent_layers = 4;
    gpu::ToneMap tone_map = gpu::ToneMap::Filmic;
    ColorManagement color;  ///< in place of tone_map, where it has a config
    WeatherTextures weather_textures;  ///< relative to the scenario
    int falling_budget = 20000;
    double falling_density = 1.0;
    int ripple_texture_size = 512;  ///< texels a side of the map of rings, a power of two
    bool lazarov = false;           ///< ambient_fit = "lazarov"
    double horizon_fade = 0.0;      ///< 0: off
    double specular_aa = 1.0;       ///< 0: off
    double specular_aa_limit = 0.18;
    double anisotropic_dither = 0.0;  ///< 0: off
    double anisotropic_dither_distance_m = 50.0;
    double anisotropic_dither_fade_m = 15.0;
    double adaptive = 0.02;         ///< 0: all samples everywhere
    double lod_scale = 1.0;
    int tile = 0;                   ///< pixels a side of the tiles that a picture is rendered in; 0: where it is large
    double occlusion_direct = 0.0;  ///< how much occlusion maps darken sun and lamps too
    bool gamma = false;             ///< color_space = "gamma"
    IndirectLight indirect = IndirectLight::Auto;
    ScenarioProbes probes;
    gpu::SurfacePath surface_path = gpu::SurfacePath::Auto;
    bool light_prepass = true;  ///< lighting_path = "prepass"
};

struct ScenarioOutput {
    int width = 640;
    int height = 360;
    int samples = 8;
    std::uint32_t seed = 1;
    int frames = 48;
    double fps = 12.0;
    double start_s = 0.0;              ///< weather clock of frame 0
    std::optional<double> duration_s;  ///< frame 0 to the last; not given: the weather's own length
    bool exr = true;
    bool png = true;
    bool film = true;
    std::vector<std::string> aovs;
};

/// What the materials whose name matches have instead of their own.
struct MaterialOverride {
    std::string glob;
    std::string place;  ///< "file:line", for messages
    /// Values over time by name of a row of scene/material_table.h, one a component; of a choice
    /// its index.
    std::vector<std::pair<std::string, std::vector<KeyedNumber>>> values;
    /// Files by name of a slot of scene::material_textures(), relative to the scenario; "": the
    /// slot is emptied.
    std::vector<std::pair<std::string, std::string>> textures = {};
    std::string lighting_model = {};  ///< as written; empty: left as it is
    std::string surface = {};         ///< likewise
    glm::vec2 tiling{1.0f};           ///< times the scale of the first set of textures
};

/// What the instances of nodes whose name matches have instead of their materials' own.
struct NodeOverride {
    std::string glob;
    std::string place;  ///< "file:line", for messages
    scene::InstanceLook look;
};

/// A box that projects a material onto what lies in it.
struct ScenarioDecal {
    std::string name;
    std::string place;     ///< "file:line", for messages
    std::string material;  ///< by name; of the scene, or described by the scenario
    glm::dvec3 center_m{0.0};
    glm::dvec3 size_m{1.0, 1.0, 0.5};  ///< width, height, depth
    glm::dvec3 direction{0.0, -1.0, 0.0};
    double turn_degrees = 0.0;
    double full_degrees = 46.0, none_degrees = 75.0;
    double edge_fade = 0.0;
    std::string node;  ///< that carries it; empty: none
};

/// A marched shape (scene/shapes.h) that the scenario puts into the scene.
struct ScenarioShape {
    std::string name;
    std::string place;     ///< "file:line", for messages
    std::vector<std::string> given = {};  ///< names of the keys in the file
    int kind = -1;                 ///< SHAPE_...; negative: not given
    std::string material;          ///< by name; of the scene, or described by the scenario
    int iterations = 0;            ///< 0: as its kind has them
    std::vector<KeyedNumber> center_m = {};      ///< x, y, z; empty: 0
    std::vector<KeyedNumber> turn_degrees = {};  ///< about x, y, z, in this order; empty: 0
    KeyedNumber size_m = {};
    KeyedNumber power = {};
    glm::dvec3 sides{1.0};
    double tube = 0.25;
};

/// What the lamps whose name matches have instead of their own.
struct LampOverride {
    std::string glob;
    std::string place;  ///< "file:line", for messages
    std::vector<std::pair<std::string, float>> shape;  ///< by name of a row of scene/light_shape.h
    bool both_sides = false;
    std::optional<glm::vec3> color;
    std::optional<float> intensity;  ///< candela
    std::optional<float> range_m;
    std::string profile;  ///< a file, relative to the scenario
};

/// [look]: keys of look_keys() with their values over time, one number a channel.
using ScenarioLook = std::vector<std::pair<std::string, std::vector<KeyedNumber>>>;

/// What a variant of a frame may change: the weather and what stands in the sky.
struct Conditions {
    ScenarioWeather weather;
    ScenarioSun sun;
    ScenarioSky sky;
    ScenarioMoon moon;
    ScenarioFog fog;
    ScenarioLights lights;
    ScenarioLook look;
};

/// The same frames under other conditions: [[variant]] with tables of its own over the scenario's.
struct ScenarioVariant {
    std::string name;  ///< part of file names: letters, digits, - and .
    Conditions conditions;
};

/// The same frames from elsewhere: [[view]] with a camera of its own.
struct ScenarioView {
    std::string name;  ///< as above
    ScenarioCamera camera;
};

/// What has gone through the snow: a line of tracks.
struct ScenarioTrack {
    bool tyre = true;                  ///< false: feet
    std::vector<glm::dvec3> points_m;  ///< of the way, at least 2; or none, and ..
    std::vector<std::string> nodes;    ///< .. globs of nodes of the scene, which leave it as they go
    std::string place;                 ///< "file:line", for messages
    double width_m = 0.0;              ///< of a tyre or a foot; 0: 0.22, 0.10
    std::optional<double> gauge_m;     ///< between two tyres; 0: one alone; not given: 1.6, of a node by its width
    double depth = 1.0;                ///< 0 nothing .. 1 as deep as the snow lets them
};

/// Water that is let in on the ground.
struct ScenarioTap {
    glm::dvec2 x_z_m{0.0};
    double litres_per_min = 0.0;         ///< >= 0
    double temperature_c = 10.0;         ///< of the water, 0..100
    std::optional<double> from_s, to_s;  ///< of the film; not given: it always runs
};

/// [ground]: the weather of the scene's places, and what its water does.
struct ScenarioGround {
    /// Weather on every patch of the scene; not given: of weather files, and of keys where light is of patches.
    std::optional<bool> patches;
    std::vector<std::string> ground, not_ground;  ///< globs of materials
    std::vector<glm::dvec3> drains;               ///< x, z and radius, m
    std::vector<ScenarioTap> taps;
    bool gutters = true;
    std::vector<ScenarioTrack> tracks;
};

/// Everything a scenario file says, in the units of the file.
struct Scenario : Conditions {
    std::string name;              ///< for messages: the file as the user gave it
    std::filesystem::path folder;  ///< where relative names in it are looked for
    ScenarioScene scene;
    ScenarioCamera camera;
    ScenarioGround ground;
    ScenarioRender render;
    ScenarioOutput output;
    std::vector<MaterialOverride> materials;
    std::vector<NodeOverride> nodes;
    std::vector<ScenarioDecal> decals;
    std::vector<ScenarioShape> shapes;
    std::vector<LampOverride> lamps;
    std::vector<ScenarioVariant> variants;  ///< empty: the scenario's own conditions
    std::vector<ScenarioView> views;        ///< empty: the scenario's own camera
    /// Views of the file beside those, when a run shows some of them: what is made once for a film is
    /// made for all.
    std::vector<ScenarioView> unseen_views;
};

/// "wet", "left-2.5": what may be part of a file name. Throws Error with `what` for anything else.
void check_part_name(const std::string& name, const std::string& what);

/// Reads a scenario from TOML text. Unknown tables and keys, wrong types and values out of range
/// throw Error with "name:line" and, for names, the nearest one that exists.
Scenario parse_scenario(std::string_view text, const std::string& name);

/// The same from a file; relative names in it are taken from the file's folder.
Scenario read_scenario(const std::filesystem::path& file);

/// One key of a scenario file, for `petrichor init`, the documentation and the tests.
struct ScenarioKey {
    std::string table;     ///< "output"; "materials" stands for [materials."glob"]
    std::string name;      ///< "width"
    std::string example;   ///< a valid value, as TOML; the default where there is one
    std::string meaning;   ///< one line: what it does, unit, range
    bool keyed = false;    ///< takes a number or [[time_s, value], ...]
    bool starter = false;  ///< written active, not commented out, by `petrichor init`
};

/// All keys, in the order in which they are documented.
const std::vector<ScenarioKey>& scenario_keys();

/// The tables that a [[variant]] may bring.
const std::vector<std::string>& scenario_variant_tables();

/// One line about each table.
std::string table_meaning(const std::string& table);

}  // namespace petrichor::film

#endif
