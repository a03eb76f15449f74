#include "film/scenes/scene_file.h"

#include <cstddef>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scene/gltf/gltf.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> read_bytes(const fs::path& file, const std::string& what,
                                  const std::string& fix)
{
    std::error_code failed;
    const auto size = fs::file_size(file, failed);
    std::ifstream in(file, std::ios::binary);
    if (failed || !in) {
        throw Error(what + ": cannot read " + file.string() +
                        (failed ? ": " + failed.message() : std::string()),
                    fix);
    }
    std::vector<std::byte> bytes(size);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(in.gcount()) != size) {
        throw Error(what + ": " + file.string() + " ended early", fix);
    }
    return bytes;
}

}  // namespace

LoadedScene read_scene(const fs::path& file)
{
    const auto asset = read_bytes(file, "scene", "Check the name; scenes are .glb or .gltf files.");
    Hasher hasher;
    hasher.add_bytes(asset);
    const auto read_resource = [&](const std::string& uri) {
        auto bytes =
            read_bytes(file.parent_path() / uri, "scene " + file.filename().string(),
                       "Put the file that the scene names beside it, or export the scene as .glb.");
        hasher.add(uri);
        hasher.add_bytes(bytes);
        return bytes;
    };
    LoadedScene loaded;
    loaded.scene = scene::load_gltf(asset, file.filename().string(), read_resource);
    loaded.fingerprint = hasher.text();
    return loaded;
}

std::string file_fingerprint(const fs::path& file)
{
    Hasher hasher;
    hasher.add_bytes(read_bytes(file, "file", "Check the name; it is relative to the scenario."));
    return hasher.text();
}

gpu::EnvironmentMap read_environment(const fs::path& file)
{
    const Image image = texproc::read_image(file, {.space = ColorSpace::Linear});
    if (image.width != 2 * image.height) {
        throw Error("environment: " + file.string() + " is " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + ", not twice as wide as high",
                    "Use a lat-long (equirectangular) picture.");
    }
    gpu::EnvironmentMap map;
    map.width = image.width;
    map.height = image.height;
    map.rgb.reserve(image.pixels.size() / static_cast<std::size_t>(image.channels) * 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c)
                map.rgb.push_back(image.at(x, y, image.channels >= 3 ? c : 0));
        }
    }
    return map;
}

}  // namespace petrichor::film
