#include "film/scenario/starter.h"

#include "base/words.h"
#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"
#include "weather/models/artist/model.h"

namespace petrichor::film {
namespace {

std::string header_of(const std::string& table)
{
    if (table == "materials") return "[materials.\"*cobble*\"]";
    if (table == "nodes") return "[nodes.\"car*\"]";
    if (table == "shapes") return "[shapes.\"sponge\"]";
    if (table == "decals") return "[decals.\"poster\"]";
    return table == "lamps" ? "[lamps.\"*lantern*\"]" : "[" + table + "]";
}

// Parameters of the artist model: for keys, and for files under it. A preset has its own.
std::string artist_table(bool all_active)
{
    const weather::ArtistParams defaults;
    const std::string off = all_active ? "" : "# ";
    std::string text =
        "\n# How the artist model reacts; with keys, or with a file and model = "
        "\"artist\".\n" +
        off + "[weather.artist]\n";
    for (const auto& parameter : weather::artist_parameters()) {
        const std::string name(parameter.name);
        text += "# " + number_text(parameter.low) + " to " + number_text(parameter.high) + "\n" +
                off + name + " = " + number_text(defaults.*parameter.member) + "\n";
    }
    return text + "# 0 to 1 each: the state at 0 s\n" + off +
           "initial = { water_to_snow = 0.01, wetness = 0.0, cracks = 0.0, puddles = 0.0, snow = "
           "0.0 }\n";
}

// The same frames under other conditions and from elsewhere: arrays of tables.
constexpr const char* kParts =
    "\n# The same frames under other conditions: frame_0003_dry.exr and frame_0003_snow.exr. "
    "Tables\n"
    "# weather, sun, sky, lights and look stand in for those above.\n"
    "# [[variant]]\n# name = \"dry\"\n# [variant.weather]\n# keys = [{ time_s = 0.0, "
    "temperature_c = 15.0, rainfall = 0.0 }]\n"
    "# [[variant]]\n# name = \"snow\"\n# [variant.weather]\n# preset = \"first-snow\"\n"
    "\n# The same frames from other cameras: frame_0003_left.exr; with variants "
    "frame_0003_snow_left.exr.\n"
    "# [[view]]\n# name = \"left\"\n# [view.camera]\n# position_m = [-4.0, 2.0, 8.0]\n# "
    "look_at_m = [0.0, 1.0, 0.0]\n";

}  // namespace

std::string starter_scenario(const std::string& name, const std::string& scene_file,
                             bool all_active)
{
    std::string text =
        "# " + printable(name) + ": a scenario of petrichor. Render it: petrichor render " +
        printable(name) + ".toml -o " + printable(name) +
        "\n# Lines that start with # are off; the value shown is the default or an example.\n"
        "# Numbers marked \"keyed\" also take [[time_s, value], ...] and change over time.\n"
        "# Axes: x east, y up, z south, metres.\n";
    std::string table;
    for (const ScenarioKey& key : scenario_keys()) {
        const bool first_of_table = key.table != table;
        if (first_of_table && table == "weather") text += artist_table(all_active);
        if (first_of_table) {
            table = key.table;
            const bool optional =
                (table == "materials" || table == "nodes" || table == "decals" || table == "shapes" || table == "lamps") &&
                !all_active;
            text += "\n# " + table_meaning(table) + "\n" + (optional ? "# " : "") +
                    header_of(table) + "\n";
        }
        const std::string value =
            key.table == "scene" && key.name == "file" ? toml_quoted(scene_file) : key.example;
        const bool active = all_active || key.starter;
        std::string line = key.name + " = " + value;
        if (!active) {
            line.insert(0, "# ");
            for (std::size_t at = line.find('\n'); at != std::string::npos;
                 at = line.find('\n', at + 3)) {
                line.insert(at + 1, "# ");
            }
        }
        text += "# " + key.meaning + (key.keyed ? " (keyed)" : "") + "\n" + line + "\n";
    }
    return text + kParts;
}

}  // namespace petrichor::film
