#include "cli/render/scenario_input.h"

#include <filesystem>

#include "base/error.h"
#include "base/words.h"
#include "film/data/folders.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

bool is_scene(const fs::path& file)
{
    return file.extension() == ".glb" || file.extension() == ".gltf";
}

}  // namespace

Scenario scenario_of(const std::string& input, const std::string& what)
{
    if (input.empty()) return read_scenario(data_folder() / "scenarios" / "demo.toml");
    const fs::path file = input;
    if (is_scene(file) || input.rfind("demo:", 0) == 0) {
        Scenario scenario;
        scenario.name = printable(input);
        scenario.scene.file = input;
        return scenario;
    }
    const auto names = preset_names("scenarios");
    // A folder may have the name of a scenario of ours: a render of it made one.
    std::error_code ignored;
    if (file.extension() == ".toml" || fs::is_regular_file(file, ignored))
        return read_scenario(file);
    for (const std::string& name : names) {
        if (name == input) return read_scenario(data_folder() / "scenarios" / (name + ".toml"));
    }
    if (fs::exists(file, ignored)) return read_scenario(file);  // says what it is instead
    throw Error(what + ": " + input +
                    " is neither a scenario (.toml), nor a scene (.glb, .gltf), nor one of: " +
                    join_words(names) + "." + did_you_mean(input, names),
                "For example: petrichor " + what + " scene.glb");
}

}  // namespace petrichor::cli
