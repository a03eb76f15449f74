// petrichor headers: writes the formulas for the shaders and programs of others.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/commands.h"
#include "gpu/shader_library/shader_library.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

struct HeadersOptions {
    std::string folder;
    std::vector<std::string> languages = {"glsl", "hlsl", "cpp"};
};

using File = std::pair<fs::path, std::string>;

std::vector<File> files_of(const std::string& language)
{
    if (language == "glsl") return {{"petrichor.glsl", gpu::shader_library(gpu::ShaderLanguage::Glsl)}};
    if (language == "hlsl") return {{"petrichor.hlsl", gpu::shader_library(gpu::ShaderLanguage::Hlsl)}};
    std::vector<File> files;
    for (const gpu::ShaderText& one : gpu::formula_headers()) {
        files.emplace_back(fs::path("petrichor") / one.name, one.text);
    }
    return files;
}

void headers(const HeadersOptions& options)
{
    if (options.folder.empty()) {
        throw Error("headers: no folder to write to", "For example: petrichor headers -o Assets/Petrichor");
    }
    const fs::path folder = options.folder;
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw Error("headers: " + folder.string() + " is no folder", "Name a folder, which may be a new one.");
    }
    for (const std::string& language : options.languages) {
        const std::vector<File> files = files_of(language);
        for (const auto& [name, text] : files) write_text_file(folder / name, text);
        const fs::path seen = files.size() == 1 ? folder / files[0].first : folder / "petrichor";
        std::cout << "wrote " << printable(seen.string());
        if (files.size() > 1) std::cout << ": " << files.size() << " files; put that folder into the include path";
        std::cout << "\n";
    }
}

}  // namespace

void add_headers(CLI::App& app)
{
    auto options = std::make_shared<HeadersOptions>();
    CLI::App* command =
        app.add_subcommand("headers", "Write the formulas for the shaders and programs of others.");
    command->add_option("-o,--out", options->folder, "folder to write to; what is there by these names is replaced");
    command
        ->add_option("--language", options->languages,
                     "glsl: petrichor.glsl, hlsl: petrichor.hlsl, each one file that includes nothing; cpp: a folder "
                     "petrichor of headers that are C++ (with GLM), GLSL and HLSL at once")
        ->check(CLI::IsMember({"glsl", "hlsl", "cpp"}))
        ->capture_default_str();
    command->footer("Example: petrichor headers --language hlsl -o Assets/Petrichor\n"
                    "How to call them: docs/shaders.md");
    command->callback([options] { headers(*options); });
}

}  // namespace petrichor::cli
