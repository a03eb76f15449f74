#include "cli/starter.h"

#include "cli/scenario.h"

namespace petrichor::cli {
namespace {

std::string header_of(const std::string& table)
{
    return table == "materials" ? "[materials.\"*cobble*\"]" : "[" + table + "]";
}

}  // namespace

std::string starter_scenario(const std::string& name, const std::string& scene_file, bool all_active)
{
    std::string text = "# " + name + ": a scenario of petrichor. Render it: petrichor render " + name +
                       ".toml -o " + name +
                       "\n# Lines that start with # are off; the value shown is the default or an example.\n"
                       "# Numbers marked \"keyed\" also take [[time_s, value], ...] and change over time.\n"
                       "# Axes: x east, y up, z south, metres.\n";
    std::string table;
    for (const ScenarioKey& key : scenario_keys()) {
        const bool first_of_table = key.table != table;
        if (first_of_table && table == "output") {
            text += "\n# " + table_meaning("weather") + "\n[weather]\n" +
                    "preset = \"rain-then-snow\"  # a name from `petrichor doctor`, or keys of your own: see README\n";
        }
        if (first_of_table) {
            table = key.table;
            const bool optional = table == "materials" && !all_active;
            text += "\n# " + table_meaning(table) + "\n" + (optional ? "# " : "") + header_of(table) + "\n";
        }
        const std::string value =
            key.table == "scene" && key.name == "file" ? "\"" + scene_file + "\"" : key.example;
        const bool active = all_active || key.starter;
        std::string line = key.name + " = " + value;
        if (!active) {
            line.insert(0, "# ");
            for (std::size_t at = line.find('\n'); at != std::string::npos; at = line.find('\n', at + 3)) {
                line.insert(at + 1, "# ");
            }
        }
        text += "# " + key.meaning + (key.keyed ? " (keyed)" : "") + "\n" + line + "\n";
    }
    return text;
}

}  // namespace petrichor::cli
