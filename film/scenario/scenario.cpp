#include "film/scenario/scenario.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include "base/error.h"
#include "base/words.h"
#include "film/scenario/decal_keys.h"
#include "film/scenario/shape_keys.h"
#include "film/scenario/lamp_keys.h"
#include "film/scenario/look_keys.h"
#include "film/scenario/material_keys.h"
#include "film/scenario/node_keys.h"
#include "film/scenario/rules.h"
#include "film/scenario/weather_table.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {
namespace {

std::vector<std::string> table_names()
{
    std::vector<std::string> names;
    for (const Rule& rule : rules()) {
        if (names.empty() || names.back() != rule.key.table) names.push_back(rule.key.table);
    }
    for (const char* name : {"look", "materials", "nodes", "decals", "shapes", "lamps", "variant", "view"}) names.emplace_back(name);
    return names;
}

void read_rules(Scenario& scenario, const std::string& table, const TomlValue& value)
{
    std::vector<std::string> known;
    for (const Rule& rule : rules()) {
        if (rule.key.table == table) known.push_back(rule.key.name);
    }
    if (table == "weather") known.emplace_back("artist");
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

// What [weather] says, in place of what was there before: a source is never mixed with another.
void read_weather(Scenario& scenario, const TomlValue& value, const toml::table& table)
{
    scenario.weather = {};
    read_rules(scenario, "weather", value);
    ScenarioWeather& weather = scenario.weather;
    const bool keyed = table.contains("keys") || table.contains("interpolation") ||
                       table.contains("duration_s") || table.contains("loop");
    const bool artist = table.contains("artist");
    if (!weather.preset.empty() && (keyed || artist)) {
        throw Error(value.place() + ": [weather] has a preset and also keys of its own",
                    "Give either preset = \"...\" alone, or the keys without it.");
    }
    if (!weather.file.empty() && (keyed || !weather.preset.empty())) {
        throw Error(value.place() + ": [weather] has a file and also a preset or keys",
                    "Give either file = \"...\", or preset = \"...\", or keys.");
    }
    if (keyed) {
        weather.script = weather_script_from(value);
    } else if (artist) {
        weather.artist =
            artist_settings_from(TomlValue(*table.get("artist"), scenario.name, "weather.artist"));
    }
}

void read_look(Scenario& scenario, const TomlValue& value)
{
    std::vector<std::string> known;
    for (const LookKey& key : look_keys()) known.push_back(key.name);
    for (const auto& [name, entry] : value.entries(known)) {
        for (const LookKey& key : look_keys()) {
            if (key.name != name) continue;
            // A variant's key takes the place of the scenario's.
            std::erase_if(scenario.look, [&](const auto& old) { return old.first == key.name; });
            scenario.look.emplace_back(name, entry.keyed_numbers(key.count, key.low, key.high));
        }
    }
}

void check_camera(const ScenarioCamera& camera, const TomlValue& value, const toml::table& table)
{
    const auto& keys = camera.keys;
    if (keys.empty()) return;
    if (table.contains("keys") && (table.contains("position_m") || table.contains("look_at_m") ||
                                   table.contains("fov_degrees"))) {
        throw Error(
            value.place() + ": camera has keys and also position_m, look_at_m or fov_degrees",
            "Give either a path in keys or one fixed position.");
    }
    if (keys.front().position_m.has_value() != keys.front().look_at_m.has_value()) {
        throw Error(value.place() + ": camera needs position_m and look_at_m together",
                    "Give both, or leave both out.");
    }
}

void read_camera(Scenario& scenario, const TomlValue& value, const toml::table& table)
{
    read_rules(scenario, "camera", value);
    check_camera(scenario.camera, value, table);
    ScenarioCamera& camera = scenario.camera;
    if (table.contains("ev100") && !table.contains("exposure"))
        camera.exposure_mode = Exposure::Fixed;
    const bool by_ev100 = camera.exposure_mode == Exposure::Fixed && !camera.exposure.given();
    if (by_ev100 != camera.ev100.given()) {
        throw Error(value.place() + (by_ev100 ? ": camera has exposure = \"fixed\" and no ev100"
                                              : ": camera has ev100 and an exposure that is not "
                                                "\"fixed\""),
                    "Give ev100 alone or with exposure = \"fixed\", for example ev100 = 12.");
    }
    if (table.contains("white_balance_strength") && !camera.white_balance_auto) {
        throw Error(value.place() + ": camera has white_balance_strength and a white_balance_k that is not \"auto\"",
                    "Write white_balance_k = \"auto\", or leave white_balance_strength out.");
    }
    for (KeyedNumber* number :
         {&camera.exposure, &camera.ev100, &camera.exposure_bias, &camera.white_balance_k,
          &camera.white_balance_strength, &camera.bloom,
          &camera.wet_lens}) {
        number->interpolation = scenario.camera.interpolation;
    }
}

// A variant may take the cookie away (cookie = "") whose size it inherits.
void check_sun(const ScenarioSun& sun, const TomlValue& value, const toml::table& table)
{
    if (!table.contains("cookie_size_m") || !sun.cookie.empty()) return;
    throw Error(value.place() + ": sun has cookie_size_m and no cookie",
                "Name a picture, cookie = \"leaves.png\", or leave cookie_size_m out.");
}

// Linear fog from start_m to end_m: at every key of either the end lies beyond the start.
void check_fog(const ScenarioFog& fog, const TomlValue& value)
{
    for (const KeyedNumber* keyed : {&fog.start_m, &fog.end_m}) {
        for (const NumberKey& key : keyed->keys) {
            const double start = value_at(fog.start_m, key.time_s, 0.0);
            const double end = value_at(fog.end_m, key.time_s, 100.0);
            if (end > start) continue;
            throw Error(value.place() + ": fog ends at " + std::to_string(end) +
                            " m and begins at " + std::to_string(start) + " m",
                        "Let end_m (100 when it is not given) lie beyond start_m (0).");
        }
    }
}

// A config takes the place of our curves; without it there is nothing to choose from.
void check_color(const ScenarioRender& render, const TomlValue& value, const toml::table& table)
{
    if (!render.color.config.empty()) {
        if (table.contains("tone_map")) {
            throw Error(value.place() + ": render has ocio_config and also tone_map",
                        "Give one of them: a config's view has a curve of its own.");
        }
        if (render.gamma) {
            throw Error(value.place() + ": render has ocio_config and color_space = \"gamma\", whose sums are not light",
                        "Leave one of them out.");
        }
    } else if (render.color != ColorManagement{}) {
        throw Error(value.place() + ": render chooses of an OpenColorIO config (ocio_display, ocio_view, ocio_scene_space or "
                                    "ocio_look) and has none",
                    "Name it by ocio_config, for example ocio_config = \"config.ocio\".");
    }
}

void read_table(Scenario& scenario, const std::string& table, const toml::node& node,
                const TomlValue& value)
{
    if (!node.is_table()) value.refuse("a table, written [" + table + "]");
    if (table == "weather") {
        read_weather(scenario, value, *node.as_table());
    } else if (table == "materials") {
        scenario.materials = read_material_overrides(*node.as_table(), scenario.name);
    } else if (table == "nodes") {
        scenario.nodes = read_node_overrides(*node.as_table(), scenario.name);
    } else if (table == "decals") {
        scenario.decals = read_decals(*node.as_table(), scenario.name);
    } else if (table == "shapes") {
        scenario.shapes = read_shapes(*node.as_table(), scenario.name);
    } else if (table == "lamps") {
        scenario.lamps = read_lamp_overrides(*node.as_table(), scenario.name);
    } else if (table == "look") {
        read_look(scenario, value);
    } else if (table == "camera") {
        read_camera(scenario, value, *node.as_table());
    } else {
        read_rules(scenario, table, value);
        if (table == "fog") check_fog(scenario.fog, value);
        if (table == "render") check_color(scenario.render, value, *node.as_table());
        if (table == "sun") check_sun(scenario.sun, value, *node.as_table());
    }
}

// [[variant]] or [[view]]: a name, and tables read over a copy of the scenario.
void read_parts(const Scenario& scenario, const std::string& kind, const toml::node& node,
                const std::vector<std::string>& tables,
                const std::function<void(const std::string&, const Scenario&)>& add)
{
    const TomlValue list(node, scenario.name, kind);
    if (!node.is_array_of_tables()) list.refuse("an array of tables, written [[" + kind + "]]");
    std::vector<std::string> known = tables;
    known.insert(known.begin(), "name");
    std::vector<std::string> names;
    for (const TomlValue& part : list.elements()) {
        Scenario changed = scenario;
        std::string name;
        const auto entries = part.entries(known);
        for (const auto& [key, value] : entries) {
            if (key == "name") {
                name = value.text();
                check_part_name(name, value.place() + ": " + kind + " name");
            }
        }
        if (name.empty()) part.refuse("a table with a name, which becomes part of file names");
        if (std::find(names.begin(), names.end(), name) != names.end()) {
            throw Error(part.place() + ": there are two [[" + kind + "]] called \"" + name + "\"",
                        "Give each its own name.");
        }
        names.push_back(name);
        const toml::table& table = *node.as_array()->get(names.size() - 1)->as_table();
        for (const auto& [key, value] : entries) {
            if (key != "name") read_table(changed, key, *table.get(key), value);
        }
        add(name, changed);
    }
}

}  // namespace

void check_part_name(const std::string& name, const std::string& what)
{
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '.';
    };
    if (name.empty() || name.size() > 64 || name[0] == '.' ||
        !std::all_of(name.begin(), name.end(), fits)) {
        throw Error(what + ": must be 1 to 64 letters, digits, - or ., got \"" + name + "\"",
                    "It becomes part of file names: frame_0003_wet.exr.");
    }
}

Scenario parse_scenario(std::string_view text, const std::string& name)
{
    Scenario scenario;
    scenario.name = name;
    const toml::table root = parse_toml(text, name);
    const auto known = table_names();
    for (const auto& [key, node] : root) {
        const std::string table(key.str());
        const TomlValue value(node, name, table);
        if (std::find(known.begin(), known.end(), table) == known.end()) {
            const bool tables = node.is_table() || node.is_array_of_tables();
            refuse_name(value.place(), tables ? "table" : "key outside of a table", table, known);
        }
        if (table != "variant" && table != "view") read_table(scenario, table, node, value);
    }
    // Over all that the file says, wherever in it they stand.
    if (const toml::node* node = root.get("variant")) {
        read_parts(scenario, "variant", *node, scenario_variant_tables(),
                   [&](const std::string& part, const Scenario& changed) {
                       scenario.variants.push_back({part, changed});
                   });
    }
    if (const toml::node* node = root.get("view")) {
        Scenario bare = scenario;
        bare.camera = {};
        read_parts(bare, "view", *node, {"camera"},
                   [&](const std::string& part, const Scenario& changed) {
                       scenario.views.push_back({part, changed.camera});
                   });
    }
    return scenario;
}

const std::vector<std::string>& scenario_variant_tables()
{
    static const std::vector<std::string> tables{"weather", "sun", "sky", "moon", "fog", "lights", "look"};
    return tables;
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
        for (const LookKey& key : look_keys()) {
            const std::string meaning =
                key.count == 1 ? key.meaning : key.meaning + " (keyed: [[time_s, [..]], ...])";
            all.push_back({"look", key.name, key.example, meaning, key.count == 1, false});
        }
        for (ScenarioKey& key : material_keys()) all.push_back(std::move(key));
        for (ScenarioKey& key : node_keys()) all.push_back(std::move(key));
        for (ScenarioKey& key : decal_keys()) all.push_back(std::move(key));
        for (ScenarioKey& key : shape_keys()) all.push_back(std::move(key));
        for (ScenarioKey& key : lamp_keys()) all.push_back(std::move(key));
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
        {"moon", "Without this table: where place and clock of a weather file have it, else none."},
        {"fog", "Fog and haze. Without this table: by the visibility of the weather."},
        {"lights", "The lamps of the scene. Without this table they are always on."},
        {"ground",
         "What the scene's surfaces do with a weather file. Sensible without this table."},
        {"render", "What the renderer computes; all of it without this table."},
        {"output", "The sequence and its files."},
        {"weather", "What falls from the sky, and when: a preset, a weather file, or keys."},
        {"look", "How weather is drawn."},
        {"nodes",
         "Values of single things instead of their materials', by the names of their nodes; * stands for "
         "any letters. Later tables win."},
        {"decals", "Boxes that project a material onto what lies in them: posters, road marks, stains."},
        {"shapes",
         "Things without triangles, to whose surface rays are marched: fractals and simple bodies, under sun, rain "
         "and snow as all else."},
        {"lamps", "Lamps of the scene, by their names; * stands for any letters. Later tables win."},
        {"materials",
         "Properties of materials, by their names; * stands for any letters. Later tables win."},
    };
    for (const auto& [name, meaning] : meanings) {
        if (name == table) return meaning;
    }
    return "";
}

}  // namespace petrichor::film
