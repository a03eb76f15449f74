// petrichor init: writes a scenario to start from, every key explained.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/rooms.h"
#include "film/scenario/schema.h"
#include "film/scenario/starter.h"

namespace petrichor::cli {
namespace {

struct InitOptions {
    std::string name;
    std::string scene = "demo:street";
    bool force = false;
    bool schema = false;
};

constexpr const char* kSchema = "petrichor.schema.json";

// Beside the scenario; its content follows the program, so an old one is replaced.
void write_schema(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / kSchema;
    write_text_file(file, film::scenario_schema());
    std::cout << "wrote " << printable(file.string()) << "\n";
}

void init(const InitOptions& options)
{
    if (options.name.empty()) {
        if (!options.schema) {
            throw Error("init: a name is missing",
                        "For example: petrichor init my-street, or --schema alone for the schema.");
        }
        write_schema({});
        std::cout << "put this first into a scenario beside it: #:schema " << kSchema << "\n";
        return;
    }
    std::filesystem::path file = options.name;
    if (file.extension() != ".toml") file += ".toml";
    const std::string name = file.stem().string();
    if (name.empty() || name == ".toml") {
        throw Error("init: a scenario needs a name, got \"" + options.name + "\"",
                    "For example: petrichor init my-street");
    }
    if (std::filesystem::exists(file) && !options.force) {
        throw Error("init: " + file.string() + " exists already",
                    "Choose another name, or replace it with --force.");
    }
    const std::string text = starter_scenario(name, options.scene);
    if (options.schema) write_schema(file.parent_path());
    write_text_file(file, options.schema ? std::string("#:schema ") + kSchema + "\n" + text : text);
    std::cout << "wrote " << printable(file.string()) << "\nrender it: petrichor render "
              << printable(file.string()) << " -o " << printable(name) << "\n";
}

}  // namespace

void add_init(CLI::App& app)
{
    auto options = std::make_shared<InitOptions>();
    CLI::App* command =
        app.add_subcommand("init", "Write a scenario to start from, every key explained.");
    command->add_option("NAME", options->name, "file to write; .toml is added");
    command->add_option("--scene", options->scene, "scene to put into it: a .glb or .gltf file");
    command->add_flag("--force", options->force, "replace an existing file");
    command->add_flag("--schema", options->schema,
                      "write petrichor.schema.json beside it, by which editors complete and check keys");
    command->footer(
        "Example: petrichor init my-street --scene street.glb && petrichor render my-street.toml\n"
        "         petrichor init my-street --schema    VS Code with Even Better TOML, Helix, Neovim (taplo)");
    command->callback([options] { init(*options); });
}

}  // namespace petrichor::cli
