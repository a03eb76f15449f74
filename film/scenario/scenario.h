#ifndef PETRICHOR_FILM_SCENARIO_SCENARIO_H
#define PETRICHOR_FILM_SCENARIO_SCENARIO_H

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "film/toml/keyed.h"
#include "gpu/frame/frame.h"

namespace petrichor::film {

struct ScenarioScene {
    std::string file;             ///< .glb or .gltf, relative to the scenario; or "demo:street"
    std::uint32_t demo_seed = 1;  ///< for the generated demo scene
    bool allow_outside = false;   ///< links in the scene's folder may lead out of it (command line)
    int max_texture = 4096;       ///< larger textures are reduced to this, texels
};

struct CameraKey {
    double time_s = 0.0;
    std::optional<glm::dvec3> position_m;
    std::optional<glm::dvec3> look_at_m;
    std::optional<double> fov_degrees;  ///< vertical
};

struct ScenarioCamera {
    std::string name;             ///< of a camera in the scene; empty: the first one, else framed
    std::vector<CameraKey> keys;  ///< a path of our own; wins over `name`
    Interpolation interpolation = Interpolation::Smooth;
    std::optional<double> near_m;
    KeyedNumber exposure;       ///< linear scale; not given: metered
    KeyedNumber exposure_bias;  ///< stops
};

struct ScenarioSun {
    bool from_scene = false;        ///< the scene's own directional lights replace the sun
    KeyedNumber elevation_degrees;  ///< not given: time of day, else the scene's light, else 35
    KeyedNumber azimuth_degrees;    ///< clockwise from north (-z); not given: as above, else 140
    KeyedNumber time_of_day_hours;  ///< local solar time
    double latitude_degrees = 50.0;
    double day_of_year = 80.0;
    double illuminance_lux = 100000.0;
};

struct ScenarioSky {
    KeyedNumber cloud_cover;  ///< 0..1; not given: from the weather
    KeyedNumber turbidity;
    std::string environment;  ///< lat-long HDR file relative to the scenario; empty: analytic sky
    double environment_scale = 1.0;
    double environment_rotation_degrees = 0.0;
    double ground_albedo = 0.2;
};

enum class Lamps { On, Off, Dusk };

struct ScenarioLights {
    Lamps lamps = Lamps::On;         ///< point and spot lights and glowing materials of the scene
    double dusk_degrees = 4.0;       ///< with Dusk: full light at this sun elevation and below ...
    double dusk_fade_degrees = 4.0;  ///< ... none this much above it
    double scale = 1.0;
};

struct ScenarioRender {
    bool shadows = true;
    bool ambient_occlusion = true;
    bool image_based_light = true;
    bool shelter = true;
    bool draw_sky = true;
    bool tone_map = true;
    gpu::SurfacePath surface_path = gpu::SurfacePath::Auto;
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

/// Properties of the materials whose name matches: values by name of scene/material_table.h (of a
/// choice its index).
struct MaterialOverride {
    std::string glob;
    std::string place;  ///< "file:line", for messages
    std::vector<std::pair<std::string, std::vector<double>>> values;
};

/// Everything a scenario file says, in the units of the file.
struct Scenario {
    std::string name;              ///< for messages: the file as the user gave it
    std::filesystem::path folder;  ///< where relative names in it are looked for
    std::string text;              ///< the file itself: weather_script reads [weather] from it
    bool has_weather = false;      ///< there is a [weather] table
    std::string weather_preset;    ///< its `preset`: a name or a file, instead of keys of its own
    ScenarioScene scene;
    ScenarioCamera camera;
    ScenarioSun sun;
    ScenarioSky sky;
    ScenarioLights lights;
    ScenarioRender render;
    ScenarioOutput output;
    std::vector<MaterialOverride> materials;
};

/// Reads a scenario from TOML text. Unknown tables and keys, wrong types and values out of range
/// throw Error with "name:line" and, for names, the nearest one that exists. Of [weather] only
/// `preset` is read here, its keys are weather_script's.
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

/// All keys, in the order in which they are documented ([weather] is not among them).
const std::vector<ScenarioKey>& scenario_keys();

/// One line about each table.
std::string table_meaning(const std::string& table);

}  // namespace petrichor::film

#endif
