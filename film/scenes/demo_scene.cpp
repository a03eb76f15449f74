#include "film/data/source_fingerprint.h"
#include "film/scenes/demo_scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"
#include "scene/tangents.h"

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

// Loading would compute them at every start.
scene::Scene street_with_tangents(const demo::DemoOptions& options)
{
    scene::Scene street = demo::make_demo_street(options);
    for (scene::Mesh& mesh : street.meshes) {
        for (scene::Primitive& primitive : mesh.primitives) {
            const bool lacks = primitive.tangents.empty();
            if (lacks && !primitive.normals.empty() && !primitive.uv0.empty())
                scene::generate_tangents(primitive);
        }
    }
    return street;
}

}  // namespace

LoadedScene load_demo_street(const demo::DemoOptions& options, const ContentCache& cache)
{
    const std::string key = key_of(options);
    const std::optional<CachedBytes> kept = cache.find(kCacheKind, key);
    std::vector<std::byte> made;
    std::string problem;
    if (!kept) {
        made = scene::write_glb(street_with_tangents(options));
        try {
            cache.keep(kCacheKind, key, {made});
        } catch (const Error& error) {
            problem = std::string(error.what()) + ": the street is made again at every start. " +
                      error.fix();
        }
    }
    const std::span<const std::byte> glb = kept ? std::span<const std::byte>(*kept) : made;
    Hasher hasher;
    hasher.add_bytes(glb);
    LoadedScene loaded;
    loaded.fingerprint = hasher.text();
    loaded.scene = scene::load_gltf(glb, "street.glb", [](const std::string& uri) {
        throw Error("street.glb names the file " + uri, "Report this: it holds all it needs.");
        return std::vector<std::byte>();
    });
    if (!problem.empty()) loaded.scene.warnings.push_back(problem);
    return loaded;
}

}  // namespace petrichor::film
