#include "film/scenario/scenario.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include "base/error.h"
#include "base/words.h"
#include "film/scenario/material_keys.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {
namespace {

// A key and what reading it does: the one place where a key is declared.
struct Rule {
    ScenarioKey key;
    void (*apply)(Scenario&, const TomlValue&);
};

std::vector<CameraKey> camera_path(const TomlValue& value)
{
    std::vector<CameraKey> path;
    for (const TomlValue& element : value.elements()) {
        CameraKey key;
        bool timed = false;
        for (const auto& [name, entry] :
             element.entries({"time_s", "position_m", "look_at_m", "fov_degrees"})) {
            if (name == "time_s") {
                key.time_s = entry.number(-1e9, 1e9);
                timed = true;
            }
            if (name == "position_m") key.position_m = entry.point();
            if (name == "look_at_m") key.look_at_m = entry.point();
            if (name == "fov_degrees") key.fov_degrees = entry.number(1.0, 170.0);
        }
        if (!timed || !key.position_m || !key.look_at_m) {
            element.refuse("a table with time_s, position_m and look_at_m");
        }
        if (!path.empty() && key.time_s <= path.back().time_s) {
            element.refuse("later than the key before it");
        }
        path.push_back(key);
    }
    if (path.empty()) value.refuse("at least one key");
    return path;
}

// [camera] position_m, look_at_m and fov_degrees without keys make a path of one key.
CameraKey& still_camera(Scenario& s)
{
    if (s.camera.keys.empty()) s.camera.keys.emplace_back();
    return s.camera.keys.front();
}

const std::vector<Rule>& rules()
{
    static const std::vector<Rule> table{
        {{"scene", "file", "\"scene.glb\"",
          "glTF scene (.glb, .gltf), relative to this file; \"demo:street\" is the generated demo",
          false, true},
         [](Scenario& s, const TomlValue& v) { s.scene.file = v.text(); }},
        {{"scene", "demo_seed", "1", "which street the demo generator builds"},
         [](Scenario& s, const TomlValue& v) {
             s.scene.demo_seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"scene", "max_texture", "4096",
          "larger textures are reduced to this many texels a side, 16 to 16384"},
         [](Scenario& s, const TomlValue& v) { s.scene.max_texture = v.integer(16, 16384); }},

        {{"camera", "name", "\"Camera\"",
          "a camera of the scene; without one the whole scene is framed"},
         [](Scenario& s, const TomlValue& v) { s.camera.name = v.text(); }},
        {{"camera", "position_m", "[6.0, 2.0, 8.0]",
          "where a camera of your own stands: x, y (up), z"},
         [](Scenario& s, const TomlValue& v) { still_camera(s).position_m = v.point(); }},
        {{"camera", "look_at_m", "[0.0, 1.0, 0.0]", "the point it looks at"},
         [](Scenario& s, const TomlValue& v) { still_camera(s).look_at_m = v.point(); }},
        {{"camera", "fov_degrees", "45.0", "vertical field of view, 1 to 170"},
         [](Scenario& s, const TomlValue& v) {
             still_camera(s).fov_degrees = v.number(1.0, 170.0);
         }},
        {{"camera", "keys",
          "[{ time_s = 0.0, position_m = [6.0, 2.0, 8.0], look_at_m = [0.0, 1.0, 0.0], fov_degrees "
          "= 45.0 },\n"
          "    { time_s = 48.0, position_m = [4.0, 1.6, 7.0], look_at_m = [0.0, 1.0, 0.0], "
          "fov_degrees = 40.0 }]",
          "a camera that moves: one entry a point of the path"},
         [](Scenario& s, const TomlValue& v) { s.camera.keys = camera_path(v); }},
        {{"camera", "interpolation", "\"smooth\"", "between keys: hold, linear or smooth"},
         [](Scenario& s, const TomlValue& v) { s.camera.interpolation = v.interpolation(); }},
        {{"camera", "near_m", "0.05", "nothing nearer than this is drawn, metres"},
         [](Scenario& s, const TomlValue& v) { s.camera.near_m = v.number(1e-4, 1e4); }},
        {{"camera", "exposure", "1.0e-4",
          "linear scale of the PNG; without it metered from sun and sky", true},
         [](Scenario& s, const TomlValue& v) { s.camera.exposure = v.keyed(1e-12, 1e12); }},
        {{"camera", "exposure_bias", "0.0", "stops brighter (+) or darker (-), -10 to 10", true},
         [](Scenario& s, const TomlValue& v) { s.camera.exposure_bias = v.keyed(-10.0, 10.0); }},

        {{"sun", "source", "\"sky\"",
          "sky: a sun that matches the sky; scene: the directional lights of the scene instead"},
         [](Scenario& s, const TomlValue& v) {
             s.sun.from_scene = v.choice({"sky", "scene"}) == 1;
         }},
        {{"sun", "elevation_degrees", "35.0", "height above the horizon, -90 to 90", true, true},
         [](Scenario& s, const TomlValue& v) { s.sun.elevation_degrees = v.keyed(-90.0, 90.0); }},
        {{"sun", "azimuth_degrees", "140.0",
          "clockwise from north (-z) over east (+x); go past 360 rather than back to 0", true,
          true},
         [](Scenario& s, const TomlValue& v) { s.sun.azimuth_degrees = v.keyed(-3600.0, 3600.0); }},
        {{"sun", "time_of_day_hours", "[[0.0, 14.0], [48.0, 18.5]]",
          "local solar time instead of elevation and azimuth, 0 to 24 (48 is the next midnight)",
          true},
         [](Scenario& s, const TomlValue& v) {
             s.sun.time_of_day_hours = v.keyed(-240.0, 2400.0);
         }},
        {{"sun", "latitude_degrees", "50.0", "with time_of_day_hours: -90 south to 90 north"},
         [](Scenario& s, const TomlValue& v) { s.sun.latitude_degrees = v.number(-90.0, 90.0); }},
        {{"sun", "day_of_year", "80", "with time_of_day_hours: 1 to 366; 80 is the spring equinox"},
         [](Scenario& s, const TomlValue& v) { s.sun.day_of_year = v.number(1.0, 366.0); }},
        {{"sun", "illuminance_lux", "100000.0",
          "of a clear sun on a plane that faces it, 0 to 200000"},
         [](Scenario& s, const TomlValue& v) { s.sun.illuminance_lux = v.number(0.0, 200000.0); }},

        {{"sky", "cloud_cover", "[[0.0, 0.9], [24.0, 0.4]]",
          "0 clear to 1 overcast; without it the weather decides", true},
         [](Scenario& s, const TomlValue& v) { s.sky.cloud_cover = v.keyed(0.0, 1.0); }},
        {{"sky", "turbidity", "2.5", "haze: 1.5 very clear to 10", true},
         [](Scenario& s, const TomlValue& v) { s.sky.turbidity = v.keyed(1.0, 10.0); }},
        {{"sky", "environment", "\"sky.hdr\"",
          "a lat-long HDR picture (.hdr, .exr) that lights the scene instead of the analytic sky"},
         [](Scenario& s, const TomlValue& v) { s.sky.environment = v.text(); }},
        {{"sky", "environment_scale", "1.0", "multiplies the HDR picture, 0 to 1e6"},
         [](Scenario& s, const TomlValue& v) { s.sky.environment_scale = v.number(0.0, 1e6); }},
        {{"sky", "environment_rotation_degrees", "0.0", "turns the HDR picture about the vertical"},
         [](Scenario& s, const TomlValue& v) {
             s.sky.environment_rotation_degrees = v.number(-3600.0, 3600.0);
         }},
        {{"sky", "ground_albedo", "0.2", "of the land beyond the scene, 0 to 1"},
         [](Scenario& s, const TomlValue& v) { s.sky.ground_albedo = v.number(0.0, 1.0); }},

        {{"lights", "lamps", "\"dusk\"",
          "point and spot lights and glowing materials: on, off, or on at dusk"},
         [](Scenario& s, const TomlValue& v) {
             s.lights.lamps = static_cast<Lamps>(v.choice({"on", "off", "dusk"}));
         }},
        {{"lights", "dusk_degrees", "4.0",
          "lamps are fully lit with the sun at this elevation or lower"},
         [](Scenario& s, const TomlValue& v) { s.lights.dusk_degrees = v.number(-90.0, 90.0); }},
        {{"lights", "dusk_fade_degrees", "4.0", "and dark this far above it, 0 to 90"},
         [](Scenario& s, const TomlValue& v) { s.lights.dusk_fade_degrees = v.number(0.0, 90.0); }},
        {{"lights", "scale", "1.0", "multiplies the lamps, 0 to 1e6"},
         [](Scenario& s, const TomlValue& v) { s.lights.scale = v.number(0.0, 1e6); }},

        {{"render", "shadows", "true", "of sun and lamps"},
         [](Scenario& s, const TomlValue& v) { s.render.shadows = v.boolean(); }},
        {{"render", "ambient_occlusion", "true", "darker corners"},
         [](Scenario& s, const TomlValue& v) { s.render.ambient_occlusion = v.boolean(); }},
        {{"render", "image_based_light", "true", "light from the sky or the HDR picture"},
         [](Scenario& s, const TomlValue& v) { s.render.image_based_light = v.boolean(); }},
        {{"render", "shelter", "true", "roofs keep rain and snow off"},
         [](Scenario& s, const TomlValue& v) { s.render.shelter = v.boolean(); }},
        {{"render", "draw_sky", "true", "false: black where the scene ends"},
         [](Scenario& s, const TomlValue& v) { s.render.draw_sky = v.boolean(); }},
        {{"render", "tone_map", "true",
          "of the PNG; false: plain sRGB. The EXR is never tone mapped"},
         [](Scenario& s, const TomlValue& v) { s.render.tone_map = v.boolean(); }},
        {{"render", "surface_path", "\"auto\"",
          "how surfaces are shaded: fragment, visibility (a buffer of triangle numbers, resolved), "
          "or auto, the faster on this device"},
         [](Scenario& s, const TomlValue& v) {
             s.render.surface_path =
                 static_cast<gpu::SurfacePath>(v.choice({"auto", "fragment", "visibility"}));
         }},

        {{"output", "width", "640", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.width = v.integer(1, 16384); }},
        {{"output", "height", "360", "pixels, 1 to 16384", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.height = v.integer(1, 16384); }},
        {{"output", "samples", "8", "a pixel, for smooth edges, 1 to 256", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.samples = v.integer(1, 256); }},
        {{"output", "seed", "1", "of the sample pattern"},
         [](Scenario& s, const TomlValue& v) {
             s.output.seed = static_cast<std::uint32_t>(v.integer(0, 1 << 30));
         }},
        {{"output", "frames", "48", "number of frames, 1 to 1000000", false, true},
         [](Scenario& s, const TomlValue& v) { s.output.frames = v.integer(1, 1000000); }},
        {{"output", "fps", "12.0", "frames a second of the film; also the clock of ripples", false,
          true},
         [](Scenario& s, const TomlValue& v) { s.output.fps = v.number(0.01, 1000.0); }},
        {{"output", "start_s", "0.0", "time of frame 0 on the clock of weather, sun and camera"},
         [](Scenario& s, const TomlValue& v) { s.output.start_s = v.number(-1e9, 1e9); }},
        {{"output", "duration_s", "48.0",
          "from frame 0 to one frame after the last on that clock; without it as long as the "
          "weather"},
         [](Scenario& s, const TomlValue& v) { s.output.duration_s = v.number(0.0, 1e9); }},
        {{"output", "exr", "true", "write frame_0000.exr: linear light, half float, all AOVs"},
         [](Scenario& s, const TomlValue& v) { s.output.exr = v.boolean(); }},
        {{"output", "png", "true", "write frame_0000.png: as seen, 8 bits"},
         [](Scenario& s, const TomlValue& v) { s.output.png = v.boolean(); }},
        {{"output", "film", "true", "write film.mp4 where ffmpeg is installed (needs the PNGs)"},
         [](Scenario& s, const TomlValue& v) { s.output.film = v.boolean(); }},
        {{"output", "aovs", "[]",
          "images beside the picture in the EXR; `petrichor render --list-aovs` names them"},
         [](Scenario& s, const TomlValue& v) { s.output.aovs = v.texts(); }},
    };
    return table;
}

std::vector<std::string> table_names()
{
    std::vector<std::string> names;
    for (const Rule& rule : rules()) {
        if (names.empty() || names.back() != rule.key.table) names.push_back(rule.key.table);
    }
    names.push_back("weather");
    names.push_back("materials");
    return names;
}

void read_table(Scenario& scenario, const std::string& table, const TomlValue& value)
{
    std::vector<std::string> known;
    for (const Rule& rule : rules()) {
        if (rule.key.table == table) known.push_back(rule.key.name);
    }
    // Read in the order of the rules, not of the file: what a file means does not depend on its
    // order.
    const auto entries = value.entries(known);
    for (const Rule& rule : rules()) {
        if (rule.key.table != table) continue;
        for (const auto& [name, entry] : entries) {
            if (name == rule.key.name) rule.apply(scenario, entry);
        }
    }
}

void read_weather_preset(Scenario& scenario, const toml::table& table)
{
    const toml::node* preset = table.get("preset");
    if (!preset) return;
    const TomlValue value(*preset, scenario.name, "weather.preset");
    scenario.weather_preset = value.text();
    if (scenario.weather_preset.empty()) value.refuse("the name of a preset or a file");
    if (table.size() > 1) {
        throw Error(value.place() + ": [weather] has a preset and also keys of its own",
                    "Give either preset = \"...\" alone, or the keys without it.");
    }
}

void check_camera(const Scenario& scenario, const toml::table& root)
{
    const auto& keys = scenario.camera.keys;
    if (keys.empty()) return;
    const toml::table& table = *root["camera"].as_table();
    const TomlValue camera(*root.get("camera"), scenario.name, "camera");
    if (table.contains("keys") && (table.contains("position_m") || table.contains("look_at_m") ||
                                   table.contains("fov_degrees"))) {
        throw Error(
            camera.place() + ": camera has keys and also position_m, look_at_m or fov_degrees",
            "Give either a path in keys or one fixed position.");
    }
    if (keys.front().position_m.has_value() != keys.front().look_at_m.has_value()) {
        throw Error(camera.place() + ": camera needs position_m and look_at_m together",
                    "Give both, or leave both out.");
    }
}

}  // namespace

Scenario parse_scenario(std::string_view text, const std::string& name)
{
    Scenario scenario;
    scenario.name = name;
    scenario.text = std::string(text);
    const toml::table root = parse_toml(text, name);
    const auto known = table_names();
    for (const auto& [key, node] : root) {
        const std::string table(key.str());
        const TomlValue value(node, name, table);
        if (std::find(known.begin(), known.end(), table) == known.end()) {
            refuse_name(value.place(), node.is_table() ? "table" : "key outside of a table", table,
                        known);
        }
        if (!node.is_table()) value.refuse("a table, written [" + table + "]");
        if (table == "weather") {
            scenario.has_weather = true;
            read_weather_preset(scenario, *node.as_table());
        } else if (table == "materials") {
            scenario.materials = read_material_overrides(*node.as_table(), scenario.name);
        } else {
            read_table(scenario, table, value);
        }
    }
    if (root.contains("camera")) check_camera(scenario, root);
    for (KeyedNumber* number : {&scenario.camera.exposure, &scenario.camera.exposure_bias}) {
        number->interpolation = scenario.camera.interpolation;
    }
    return scenario;
}

Scenario read_scenario(const std::filesystem::path& file)
{
    if (std::filesystem::is_directory(file)) {
        throw Error("scenario: " + file.string() + " is a folder",
                    "Name a scenario (.toml) or a scene (.glb, .gltf) in it.");
    }
    if (!std::filesystem::exists(file)) {
        throw Error("scenario: cannot read " + file.string(),
                    "Check the name; `petrichor init NAME` writes a scenario to start from.");
    }
    const std::string text = read_toml_text(file, "scenario");
    Scenario scenario = parse_scenario(text, file.string());
    scenario.folder = file.parent_path();
    return scenario;
}

const std::vector<ScenarioKey>& scenario_keys()
{
    static const std::vector<ScenarioKey> keys = [] {
        std::vector<ScenarioKey> all;
        for (const Rule& rule : rules()) all.push_back(rule.key);
        for (ScenarioKey& key : material_keys()) all.push_back(std::move(key));
        return all;
    }();
    return keys;
}

std::string table_meaning(const std::string& table)
{
    static const std::vector<std::pair<std::string, std::string>> meanings{
        {"scene", "What is seen."},
        {"camera",
         "Where from. Without this table: the scene's first camera, else the whole scene is "
         "framed."},
        {"sun", "Without this table: the direction of the scene's own sun, else a morning sun."},
        {"sky", "What lights the scene besides the sun."},
        {"lights", "The lamps of the scene. Without this table they are always on."},
        {"render", "What the renderer computes; all of it without this table."},
        {"output", "The sequence and its files."},
        {"weather", "What falls from the sky, and when."},
        {"materials",
         "Properties of materials, by their names; * stands for any letters. Later tables win."},
    };
    for (const auto& [name, meaning] : meanings) {
        if (name == table) return meaning;
    }
    return "";
}

}  // namespace petrichor::film
