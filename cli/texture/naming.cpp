#include "cli/texture/naming.h"

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
        {"R", {"N"}, false, 0},
        {"r", {"n"}, false, 0},
    };
    return all;
}

// Where `token` stands as a whole token (between '_', '-', '.' or the ends), or npos.
std::size_t find_token(const std::string& name, const std::string& token)
{
    const auto edge = [&](std::size_t i) {
        return i >= name.size() || name[i] == '_' || name[i] == '-' || name[i] == '.' || name[i] == ' ';
    };
    for (std::size_t at = name.find(token); at != std::string::npos; at = name.find(token, at + 1)) {
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
                    const bool down = n.find("DX") != std::string::npos ||
                                      n.find("_dx") != std::string::npos;
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

}  // namespace petrichor::cli
