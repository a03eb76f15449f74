#include "film/scenario/starter.h"

#include "base/words.h"
#include "film/scenario/scenario.h"
#include "film/toml/toml_value.h"

namespace petrichor::film {
namespace {

std::string header_of(const std::string& table)
{
    return table == "materials" ? "[materials.\"*cobble*\"]" : "[" + table + "]";
}

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
        if (first_of_table && table == "output") {
            text += "\n# " + table_meaning("weather") + "\n[weather]\n" +
                    "# a name that `petrichor doctor` lists, or a file with a [weather] table\n"
                    "preset = \"rain-then-snow\"\n"
                    "# ... or instead of the preset, keys of your own (rainfall 0 to 1; snow below "
                    "0 C):\n"
                    "# interpolation = \"linear\"\n"
                    "# keys = [\n"
                    "#     { time_s = 0.0, temperature_c = 12.0, rainfall = 0.0, cloud_cover = "
                    "0.3, wind_m_s = 2.0,\n"
                    "#       wind_from_deg = 240.0, visibility_m = 20000.0 },\n"
                    "#     { time_s = 10.0, rainfall = 0.8, cloud_cover = 0.9 },\n"
                    "#     { time_s = 30.0, temperature_c = -6.0 },\n"
                    "# ]\n";
        }
        if (first_of_table) {
            table = key.table;
            const bool optional = table == "materials" && !all_active;
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
    return text;
}

}  // namespace petrichor::film
