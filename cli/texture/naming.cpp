#include "cli/texture/naming.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Pair {
    const char* map;
    std::vector<const char*> normals;
    bool smoothness;
    int channel;
};

const std::vector<Pair>& pairs()
{
    static const std::vector<Pair> all{
        {"LuxSPEC", {"LuxNRM"}, true, 3},
        {"Roughness", {"NormalGL", "Normal", "NormalDX", "normal"}, false, 0},
        {"Smoothness", {"NormalGL", "Normal", "NormalDX", "normal"}, true, 0},
        {"roughness", {"normal_gl", "normal", "nor_gl", "normal_dx", "nor_dx"}, false, 0},
        {"smoothness", {"normal_gl", "normal", "normal_dx"}, true, 0},
        {"rough", {"nor_gl", "normal_gl", "nor", "normal", "nor_dx"}, false, 0},
        {"arm", {"nor_gl", "normal_gl", "nor", "normal", "nor_dx"}, false, 1},
        {"orm", {"normal_gl", "normal", "nor_gl", "normal_dx"}, false, 1},
        {"ORM", {"Normal", "NormalGL", "NormalDX", "N"}, false, 1},
        {"nrm_rgh", {"nrm_rgh"}, false, 3},
        {"R", {"N"}, false, 0},
        {"r", {"n"}, false, 0},
    };
    return all;
}

// Where `token` stands as a whole token (between '_', '-', '.' or the ends), or npos.
std::size_t find_token(const std::string& name, const std::string& token)
{
    const auto edge = [&](std::size_t i) {
        return i >= name.size() || name[i] == '_' || name[i] == '-' || name[i] == '.' ||
               name[i] == ' ';
    };
    for (std::size_t at = name.find(token); at != std::string::npos;
         at = name.find(token, at + 1)) {
        if ((at == 0 || edge(at - 1)) && edge(at + token.size())) return at;
    }
    return std::string::npos;
}

}  // namespace

NormalPartner find_normal(const fs::path& map)
{
    const std::string stem = map.stem().string();
    std::string tried;
    for (const Pair& pair : pairs()) {
        const std::string token = pair.map;
        const std::size_t at = find_token(stem, token);
        if (at == std::string::npos) continue;
        for (const char* normal : pair.normals) {
            // Lux drops what follows the token; other tools keep it.
            std::string name = stem.substr(0, at) + normal;
            if (token != "LuxSPEC") name += stem.substr(at + token.size());
            for (const std::string& extension :
                 {map.extension().string(), std::string(".png"), std::string(".jpg"),
                  std::string(".tga"), std::string(".tif"), std::string(".exr")}) {
                const fs::path path = map.parent_path() / (name + extension);
                std::error_code ignored;
                if (fs::is_regular_file(path, ignored)) {
                    const std::string n = normal;
                    const bool down =
                        n.find("DX") != std::string::npos || n.find("_dx") != std::string::npos;
                    return {path, down, pair.smoothness, pair.channel};
                }
            }
            tried += (tried.empty() ? "" : ", ") + name + map.extension().string();
        }
    }
    throw Error("texture: no normal map beside " + map.string() +
                    (tried.empty() ? ": its name follows no known pair" : " (tried " + tried + ")"),
                "Name it with --normal FILE.");
}

int named_channel(const fs::path& map)
{
    const std::string stem = map.stem().string();
    for (const Pair& pair : pairs()) {
        if (find_token(stem, pair.map) != std::string::npos) return pair.channel;
    }
    return 0;
}

std::optional<std::string> find_height(const fs::path& map)
{
    static constexpr std::pair<const char*, const char*> kHeights[] = {
        {"Displacement", ""}, {"Height", ""}, {"height", ""}, {"disp", ""}, {"alb_ht", ":a"}};
    const std::string stem = map.stem().string();
    for (const Pair& pair : pairs()) {
        const std::size_t at = find_token(stem, pair.map);
        if (at == std::string::npos) continue;
        for (const auto& [height, channel] : kHeights) {
            const std::string name =
                stem.substr(0, at) + height + stem.substr(at + std::string(pair.map).size());
            for (const char* extension : {".png", ".jpg", ".tif", ".exr", ".tga"}) {
                const fs::path path = map.parent_path() / (name + extension);
                std::error_code ignored;
                if (fs::is_regular_file(path, ignored)) return path.string() + channel;
            }
        }
    }
    return std::nullopt;
}

fs::path find_material(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<fs::path> found;
    for (const fs::path& file : files) {
        try {
            find_normal(file);
            found.push_back(file);
        } catch (const Error&) {
            // Not the roughness of a pair.
        }
    }
    if (found.size() == 1) return found.front();
    throw Error("texture: " + folder.string() + " holds " +
                    (found.empty() ? "no" : std::to_string(found.size())) +
                    " roughness or smoothness maps with a normal map beside them",
                "Name the roughness map itself.");
}

}  // namespace petrichor::cli
