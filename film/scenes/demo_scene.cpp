#include "film/scenes/demo_scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"

namespace petrichor::film {
namespace {

constexpr const char* kCacheKind = "scenes";

std::string key_of(const demo::DemoOptions& options)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add("demo:street");
    hasher.add(options.seed);
    hasher.add(options.texture_size);
    return hasher.text();
}

}  // namespace

LoadedScene load_demo_street(const demo::DemoOptions& options, const ContentCache& cache)
{
    const std::string key = key_of(options);
    std::optional<std::vector<std::byte>> glb = cache.find(kCacheKind, key);
    std::string problem;
    if (!glb) {
        glb = scene::write_glb(demo::make_demo_street(options));
        try {
            cache.keep(kCacheKind, key, {*glb});
        } catch (const Error& error) {
            problem = std::string(error.what()) + ": the street is made again at every start. " +
                      error.fix();
        }
    }
    Hasher hasher;
    hasher.add_bytes(*glb);
    LoadedScene loaded;
    loaded.fingerprint = hasher.text();
    loaded.scene = scene::load_gltf(*glb, "street.glb", [](const std::string& uri) {
        throw Error("street.glb names the file " + uri, "Report this: it holds all it needs.");
        return std::vector<std::byte>();
    });
    if (!problem.empty()) loaded.scene.warnings.push_back(problem);
    return loaded;
}

}  // namespace petrichor::film
