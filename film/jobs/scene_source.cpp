#include "film/jobs/scene_source.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/content_cache.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "film/jobs/camera.h"
#include "film/jobs/eyes.h"
#include "film/scenario/material_keys.h"
#include "film/scenario/node_keys.h"
#include "film/scenes/lamps.h"
#include "film/scenes/decals.h"
#include "film/scenes/demo_scene.h"
#include "film/scenes/displacement.h"
#include "film/scenes/ground_plane.h"
#include "film/scenes/shapes.h"
#include "film/scenes/snow_tracks.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/weather_textures.h"
#include "film/weather/film_by_name.h"
#include "scene/icicles/icicles.h"
#include "scene/patches/lanterns.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

LoadedScene load(const Scenario& scenario, int threads)
{
    const std::string& file = scenario.scene.file;
    if (file.empty()) {
        throw Error(scenario.name + ": no scene is named",
                    "Add [scene] file = \"scene.glb\", or file = \"demo:street\" for the demo.");
    }
    if (file.rfind("demo:", 0) == 0) {
        return load_demo(file, {.seed = scenario.scene.demo_seed, .threads = threads}, user_cache(),
                         scenario.name);
    }
    return read_scene(scenario.folder / file,
                      {.allow_outside = scenario.scene.allow_outside,
                       .variant = scenario.scene.variant,
                       .playing = {scenario.scene.animation, scenario.scene.animation_loop}});
}

// A camera below it would see nothing but ground, and a picture of the sky shows some already.
bool wants_ground(const Scenario& scenario, const scene::Scene& scene, const scene::Bounds& bounds)
{
    if (scenario.scene.ground != StandsOn::Auto)
        return scenario.scene.ground == StandsOn::Plane;
    // The generated scenes are whole: their cameras do not see where they end.
    if (scenario.scene.file.rfind("demo:", 0) == 0) return false;
    if (!scenario.sky.environment.empty() || brings_ground(scene, bounds)) return false;
    const auto below = [&](double y) { return y < static_cast<double>(bounds.low.y); };
    for (const CameraKey& key : scenario.camera.keys) {
        if (key.position_m && below(key.position_m->y)) return false;
    }
    return !(scenario.camera.keys.empty() &&
             std::any_of(scene.cameras.begin(), scene.cameras.end(), [&](const scene::Camera& c) {
                 return below(static_cast<double>(c.to_world[3].y));
             }));
}

// A tree of two kilometres was drawn in other units than metres.
void say_odd_size(const Scenario& scenario, const scene::Bounds& bounds, bool ground,
                  std::vector<std::string>& warnings)
{
    const glm::vec3 size = bounds.high - bounds.low;
    const float largest = std::max({size.x, size.y, size.z});
    const bool huge = ground && size.y > 250.0f;
    const bool tiny = largest > 0.0f && largest < 0.01f;
    if (!huge && !tiny) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "it is %.4g m high and %.4g m wide: its units may not be metres, and weather lies on "
                  "it at that size; scale it where it was exported",
                  static_cast<double>(size.y), static_cast<double>(std::max(size.x, size.z)));
    warnings.push_back(scenario.scene.file + ": " + text);
}

std::size_t triangles_of(const scene::Scene& scene)
{
    std::size_t triangles = 0;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives)
            triangles += primitive.indices.size() / 3;
    }
    return triangles;
}

// Its shape follows from where the cameras of the whole film stand.
void add_displacement(Sequence& sequence, Hasher& content)
{
    if (!wants_displacement(sequence.scene)) return;
    content.add("displacement");
    for (const glm::vec3& eye : sequence.eyes_m) content.add_numbers(std::span<const float>(&eye[0], 3));
    for (std::string& note : displace(sequence.scene, sequence.eyes_m))
        sequence.scene.warnings.push_back(std::move(note));
    const std::size_t before = sequence.triangles;
    sequence.triangles = triangles_of(sequence.scene);
    sequence.notes.push_back("displacement: " + std::to_string(before) + " triangles became " +
                             std::to_string(sequence.triangles));
}

}  // namespace

void load_sequence_scene(Sequence& sequence, int threads)
{
    const Scenario& scenario = sequence.scenario;
    LoadedScene loaded = load(scenario, threads);
    sequence.triangles = triangles_of(loaded.scene);
    if (sequence.triangles == 0) {
        throw Error("scene: " + loaded.scene.name + " shows no triangles",
                    "Export meshes with triangles, placed in the default scene.");
    }
    const std::string shapes = add_shapes(scenario.shapes, scenario.materials, loaded.scene);
    sequence.framing = framing_of(loaded.scene);
    const bool ground = wants_ground(scenario, loaded.scene, sequence.framing.bounds);
    if (ground) add_ground(loaded.scene, sequence.framing.bounds);
    say_odd_size(scenario, sequence.framing.bounds, ground, loaded.scene.warnings);
    sequence.scene = std::move(loaded.scene);
    sequence.notes = std::move(loaded.notes);
    const auto unnamed = apply_node_overrides(scenario.nodes, sequence.scene);
    sequence.scene.warnings.insert(sequence.scene.warnings.end(), unnamed.begin(), unnamed.end());
    const std::string decals = add_decals(scenario.decals, scenario.materials, sequence.scene);
    if (!carries_icicles(sequence.framing.bounds.high.y - sequence.framing.bounds.low.y))
        for (SequenceVariant& variant : sequence.variants) variant.icicles = IcicleHistory();
    const bool icicles = std::any_of(sequence.variants.begin(), sequence.variants.end(), [&](const SequenceVariant& v) {
        return v.icicles.any(scenario.output.start_s, scenario.output.start_s + sequence.duration_s);
    });
    if (icicles) scene::add_icicle_material(sequence.scene);
    const AppliedOverrides applied =
        apply_material_overrides(scenario.materials, scenario.folder, sequence.scene);
    sequence.scene.warnings.insert(sequence.scene.warnings.end(), applied.unmatched.begin(),
                                   applied.unmatched.end());
    set_films_by_name(sequence.scene);
    const glm::vec3 size = sequence.framing.bounds.high - sequence.framing.bounds.low;
    set_beads(sequence.scene, std::max({size.x, size.y, size.z}));
    check_decals(sequence.scene);
    check_shapes(sequence.scene);
    const AppliedLamps lamps =
        apply_lamp_overrides(scenario.lamps, scenario.folder, sequence.scene);
    sequence.scene.warnings.insert(sequence.scene.warnings.end(), lamps.unmatched.begin(),
                                   lamps.unmatched.end());
    if (scenario.lights.lanterns && scenario.render.lamp_shadows > 0) {
        std::vector<std::string> lanterns = scene::shade_by_lanterns(sequence.scene);
        const std::string count = std::to_string(lanterns.size());
        if (lanterns.size() > 6) {
            lanterns.resize(6);
            lanterns.push_back("...");
        }
        if (!lanterns.empty())
            sequence.notes.push_back("lamps in lanterns, whose parts shade softly: " + count + " (" + join_words(lanterns) + ")");
    }
    std::vector<std::string> cookies;
    for (const SequenceVariant& variant : sequence.variants)
        cookies.push_back(variant.conditions.sun.cookie);
    SunCookies sun = read_sun_cookies(cookies, scenario.folder, sequence.scene);
    sequence.sun_cookies = std::move(sun.of_file);
    Hasher content;
    content.add(loaded.fingerprint);
    if (!lamps.content.empty()) content.add(lamps.content);
    if (!sun.content.empty()) content.add(sun.content);
    for (const NodeOverride& one : scenario.nodes) {
        content.add(one.glob);
        const scene::InstanceLook& look = one.look;
        const glm::vec3 color = look.color.value_or(glm::vec3(-1.0f));
        for (const float v : {color.r, color.g, color.b, look.metallic.value_or(-1.0f),
                              look.roughness.value_or(-1.0f), look.emission.value_or(-1.0f)})
            content.add(v);
    }
    if (!decals.empty()) content.add(decals);
    if (!shapes.empty()) content.add(shapes);
    if (icicles) content.add("icicles");
    content.add(applied.textures);
    content.add(ground);
    content.add(scenario.scene.variant);
    content.add(scenario.scene.animation);
    content.add(scenario.scene.animation_loop);
    content.add(scenario.render.probes.automatic);
    content.add_bytes(std::as_bytes(std::span(scenario.render.probes.places)));
    for (const ScenarioProbePicture& picture : scenario.render.probes.pictures) {
        if (picture.file.empty()) continue;
        content.add(file_fingerprint(scenario.folder / picture.file));
        content.add(static_cast<int>(picture.decode));
    }
    if (!scenario.ground.tracks.empty()) content.add(tracks_fingerprint(scenario.ground.tracks));
    sequence.eyes_m = eyes_of(sequence);
    add_displacement(sequence, content);
    const auto& tracks = scenario.ground.tracks;
    if (std::any_of(tracks.begin(), tracks.end(), [](const ScenarioTrack& track) { return !track.nodes.empty(); })) {
        const AnimationClock clock{scenario.scene.animation_start_s, scenario.scene.animation_speed, scenario.output.fps,
                                   scenario.output.frames};
        sequence.node_ways = node_ways(tracks, sequence.scene, clock, sequence.notes);
        for (const NodeWay& one : sequence.node_ways) {
            content.add(ways_fingerprint({one.way}));
            content.add_numbers(std::span<const double>(one.at_s));
        }
    }
    sequence.content = content.text();
    sequence.weather_textures =
        weather_textures_fingerprint(scenario.render.weather_textures, scenario.folder);
    for (SequenceVariant& variant : sequence.variants) {
        const std::string& file = variant.conditions.sky.environment;
        if (file.empty()) continue;
        variant.environment = file_fingerprint(scenario.folder / file);
        const LightCode decode = variant.conditions.sky.environment_decode;
        if (decode != LightCode::Auto)
            variant.environment += " " + std::to_string(static_cast<int>(decode));
    }
}

std::string own_models_fingerprint(const scene::Scene& scene)
{
    std::set<std::string> files;
    for (const scene::Material& material : scene.materials) {
        for (const std::string& name : {material.lighting_model, material.surface}) {
            if (fs::path(name).extension() == ".glsl") files.insert(name);
        }
    }
    if (files.empty()) return "";
    Hasher hasher;
    for (const std::string& file : files) hasher.add(file_fingerprint(file));
    return hasher.text();
}

}  // namespace petrichor::film
