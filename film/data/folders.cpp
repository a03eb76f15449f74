#include "film/data/folders.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "base/error.h"
#include "base/words.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLandmark = "scenarios/demo.toml";  // what makes a folder ours

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

}  // namespace

std::optional<fs::path> find_data_folder()
{
    std::error_code failed;
    const std::string set = environment("PETRICHOR_DATA");
    if (!set.empty()) {
        if (fs::exists(fs::path(set) / kLandmark, failed)) return fs::path(set);
        return std::nullopt;
    }
    // bin/petrichor beside share/petrichor, or build/release/cli/petrichor below the sources.
    fs::path folder = fs::read_symlink("/proc/self/exe", failed).parent_path();
    for (int level = 0; level < 5 && !folder.empty(); ++level) {
        for (const char* candidate : {"share/petrichor", "data"}) {
            if (fs::exists(folder / candidate / kLandmark, failed)) return folder / candidate;
        }
        if (folder == folder.root_path()) break;
        folder = folder.parent_path();
    }
    return std::nullopt;
}

fs::path data_folder()
{
    if (auto found = find_data_folder()) return *found;
    const std::string set = environment("PETRICHOR_DATA");
    if (!set.empty()) {
        throw Error("data: PETRICHOR_DATA names " + set + ", which holds no " + kLandmark,
                    "Unset it, or let it name the data folder of petrichor.");
    }
    throw Error("data: the data folder of petrichor was not found beside the program",
                "Set PETRICHOR_DATA to the folder that holds scenarios/ and weather/.");
}

void require_writable_folder(const fs::path& folder)
{
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!failed && !fs::is_directory(folder))
        failed = std::make_error_code(std::errc::not_a_directory);
    if (!failed && ::access(folder.c_str(), W_OK | X_OK) != 0)
        failed = std::error_code(errno, std::generic_category());
    if (failed) {
        throw Error("output: cannot write into the folder " + printable(folder.string()) + ": " +
                        failed.message(),
                    "Choose another folder with -o, or make this one writable.");
    }
}

std::string find_lighting_model(const std::string& name, const fs::path& folder)
{
    const fs::path path(name);
    if (path.extension() != ".glsl") return name;
    const fs::path beside = folder / path;
    std::error_code none;
    if (fs::exists(beside, none)) return beside.string();
    if (const auto data = find_data_folder()) {
        if (fs::exists(*data / "shaders" / path, none)) return (*data / "shaders" / path).string();
    }
    return beside.string();
}

std::vector<std::string> preset_names(const std::string& kind)
{
    std::vector<std::string> names;
    const auto data = find_data_folder();
    if (!data) return names;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(*data / kind, failed)) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace petrichor::film
