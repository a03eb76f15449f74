#include "film/scenes/scene_file.h"

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "scene/gltf/gltf.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = 4ull << 30;

// Opened like any file, so that a pipe or a device is refused instead of waited for.
std::vector<std::byte> read_bytes(const fs::path& file, const std::string& what)
{
    const InputFile in = open_regular_file(file, what);
    if (in.size() > kMostBytes) {
        throw Error(what + " " + printable(file.string()) + ": it has " +
                        std::to_string(in.size() >> 20) + " MiB, over the limit of " +
                        std::to_string(kMostBytes >> 20),
                    "Split the scene, or use smaller textures.");
    }
    std::vector<std::byte> bytes(static_cast<std::size_t>(in.size()));
    if (in.read(bytes) != bytes.size()) {
        throw Error(what + " " + printable(file.string()) + ": it ended early",
                    "Wait until it is written, or copy it again.");
    }
    return bytes;
}

// A scene from elsewhere names files; a name is decoded without ".." and may still be a link that
// leads anywhere. Where it really lies decides.
fs::path resource_path(const fs::path& folder, const std::string& uri, const std::string& scene,
                       bool allow_outside)
{
    const fs::path named = folder / uri;
    if (allow_outside) return named;
    std::error_code failed;
    const fs::path home = fs::canonical(folder.empty() ? "." : folder, failed);
    if (failed) return named;  // opening it says what is wrong
    const fs::path real = fs::canonical(named, failed);
    if (failed) return named;
    const auto [rest, inside] = std::mismatch(home.begin(), home.end(), real.begin(), real.end());
    if (rest != home.end()) {
        throw Error(
            "scene " + printable(scene) + ": " + printable(uri) +
                " is a link that leads out of the scene's folder, to " + printable(real.string()),
            "Copy the file into the folder, or say --allow-outside if you trust the scene.");
    }
    return real;
}

}  // namespace

LoadedScene read_scene(const fs::path& file, const SceneFileOptions& options)
{
    const auto asset = read_bytes(file, "scene");
    Hasher hasher;
    hasher.add_bytes(asset);
    const std::string name = printable(file.filename().string());
    const auto read_resource = [&](const std::string& uri) {
        const fs::path path = resource_path(file.parent_path(), uri, name, options.allow_outside);
        auto bytes = read_bytes(path, "scene " + name + ":");
        hasher.add(uri);
        hasher.add_bytes(bytes);
        return bytes;
    };
    LoadedScene loaded;
    loaded.scene = scene::load_gltf(asset, name, read_resource, {.variant = options.variant});
    loaded.notes = scene::settle_animation(loaded.scene, options.playing);
    loaded.fingerprint = hasher.text();
    for (scene::Material& material : loaded.scene.materials) {
        material.lighting_model = find_shader(material.lighting_model, file.parent_path());
        material.surface = find_shader(material.surface, file.parent_path());
    }
    return loaded;
}

std::string file_fingerprint(const fs::path& file)
{
    Hasher hasher;
    hasher.add_bytes(read_bytes(file, "file"));
    return hasher.text();
}

}  // namespace petrichor::film
