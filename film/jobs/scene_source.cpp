#include "film/jobs/scene_source.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "demo/street.h"
#include "film/jobs/camera.h"
#include "film/scenes/scene_file.h"

namespace petrichor::film {
namespace {

constexpr const char* kDemoStreet = "demo:street";

// The generator has no file to fingerprint: its bytes are hashed as they come out.
std::string fingerprint_of(const scene::Scene& scene)
{
    Hasher hasher;
    for (const scene::EncodedImage& image : scene.textures) hasher.add_bytes(image.bytes);
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            hasher.add_bytes(std::as_bytes(std::span(primitive.positions)));
            hasher.add_bytes(std::as_bytes(std::span(primitive.uv0)));
            hasher.add_bytes(std::as_bytes(std::span(primitive.weather)));
            hasher.add_bytes(std::as_bytes(std::span(primitive.indices)));
            hasher.add(primitive.material);
        }
    }
    return hasher.text();
}

LoadedScene load(const Scenario& scenario, int threads)
{
    const std::string& file = scenario.scene.file;
    if (file.empty()) {
        throw Error(scenario.name + ": no scene is named",
                    "Add [scene] file = \"scene.glb\", or file = \"demo:street\" for the demo.");
    }
    if (file == kDemoStreet) {
        LoadedScene loaded;
        loaded.scene =
            demo::make_demo_street({.seed = scenario.scene.demo_seed, .threads = threads});
        loaded.fingerprint = fingerprint_of(loaded.scene);
        return loaded;
    }
    if (file.rfind("demo:", 0) == 0) {
        throw Error(scenario.name + ": no generated scene \"" + file + "\"." +
                        did_you_mean(file, {kDemoStreet}),
                    std::string("Use ") + kDemoStreet + ", or a .glb or .gltf file.");
    }
    return read_scene(scenario.folder / file);
}

}  // namespace

void load_sequence_scene(Sequence& sequence, int threads)
{
    const Scenario& scenario = sequence.scenario;
    LoadedScene loaded = load(scenario, threads);
    std::size_t triangles = 0;
    for (const scene::Instance& instance : loaded.scene.instances) {
        for (const scene::Primitive& primitive : loaded.scene.meshes[instance.mesh].primitives) {
            triangles += primitive.indices.size() / 3;
        }
    }
    if (triangles == 0) {
        throw Error("scene: " + loaded.scene.name + " shows no triangles",
                    "Export meshes with triangles, placed in the default scene.");
    }
    sequence.bounds = content_bounds(loaded.scene);
    sequence.scene = std::move(loaded.scene);
    Hasher content;
    content.add(loaded.fingerprint);
    if (!scenario.sky.environment.empty()) {
        content.add(file_fingerprint(scenario.folder / scenario.sky.environment));
    }
    sequence.content = content.text();
}

}  // namespace petrichor::film
