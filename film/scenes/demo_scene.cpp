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
#include "base/words.h"
#include "demo/stage.h"
#include "scene/gltf/glb_writer.h"
#include "scene/gltf/gltf.h"
#include "scene/tangents.h"

namespace petrichor::film {
namespace {

constexpr const char* kCacheKind = "scenes";
constexpr const char* kStreet = "demo:street";
constexpr const char* kStage = "demo:stage";

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

LoadedScene read_back(std::span<const std::byte> glb, const std::string& name)
{
    Hasher hasher;
    hasher.add_bytes(glb);
    LoadedScene loaded;
    loaded.fingerprint = hasher.text();
    loaded.scene = scene::load_gltf(glb, name, [&](const std::string& uri) {
        throw Error(name + " names the file " + uri, "Report this: it holds all it needs.");
        return std::vector<std::byte>();
    });
    return loaded;
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
    LoadedScene loaded = read_back(kept ? std::span<const std::byte>(*kept) : made, "street.glb");
    if (!problem.empty()) loaded.scene.warnings.push_back(problem);
    return loaded;
}

LoadedScene load_demo(const std::string& name, const demo::DemoOptions& options, const ContentCache& cache,
                      const std::string& who)
{
    if (name == kStreet) return load_demo_street(options, cache);
    if (name == kStage) return read_back(scene::write_glb(demo::make_demo_stage()), "stage.glb");
    throw Error(who + ": no generated scene \"" + name + "\"." + did_you_mean(name, {kStreet, kStage}),
                std::string("Use ") + kStreet + ", " + kStage + ", or a .glb or .gltf file.");
}

}  // namespace petrichor::film
