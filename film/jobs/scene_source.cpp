#include "film/jobs/scene_source.h"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "film/data/content_cache.h"
#include "film/jobs/camera.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/demo_scene.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/weather_textures.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDemoStreet = "demo:street";

LoadedScene load(const Scenario& scenario, int threads)
{
    const std::string& file = scenario.scene.file;
    if (file.empty()) {
        throw Error(scenario.name + ": no scene is named",
                    "Add [scene] file = \"scene.glb\", or file = \"demo:street\" for the demo.");
    }
    if (file == kDemoStreet) {
        return load_demo_street({.seed = scenario.scene.demo_seed, .threads = threads},
                                user_cache());
    }
    if (file.rfind("demo:", 0) == 0) {
        throw Error(scenario.name + ": no generated scene \"" + file + "\"." +
                        did_you_mean(file, {kDemoStreet}),
                    std::string("Use ") + kDemoStreet + ", or a .glb or .gltf file.");
    }
    return read_scene(scenario.folder / file, scenario.scene.allow_outside);
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
    sequence.triangles = triangles;
    sequence.bounds = content_bounds(loaded.scene);
    sequence.scene = std::move(loaded.scene);
    const AppliedOverrides applied =
        apply_material_overrides(scenario.materials, scenario.folder, sequence.scene);
    sequence.scene.warnings.insert(sequence.scene.warnings.end(), applied.unmatched.begin(),
                                   applied.unmatched.end());
    Hasher content;
    content.add(loaded.fingerprint);
    content.add(applied.textures);
    sequence.content = content.text();
    sequence.weather_textures =
        weather_textures_fingerprint(scenario.render.weather_textures, scenario.folder);
    for (SequenceVariant& variant : sequence.variants) {
        const std::string& file = variant.conditions.sky.environment;
        if (!file.empty()) variant.environment = file_fingerprint(scenario.folder / file);
    }
}

std::string own_models_fingerprint(const scene::Scene& scene)
{
    std::set<std::string> files;
    for (const scene::Material& material : scene.materials) {
        if (fs::path(material.lighting_model).extension() == ".glsl")
            files.insert(material.lighting_model);
    }
    if (files.empty()) return "";
    Hasher hasher;
    for (const std::string& file : files) hasher.add(file_fingerprint(file));
    return hasher.text();
}

}  // namespace petrichor::film
