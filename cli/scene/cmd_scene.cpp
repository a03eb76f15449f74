// petrichor scene: what the program sees in a scene, in lines, as JSON and as pictures.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/rooms.h"
#include "cli/scene/bake_light.h"
#include "cli/scene/ground_map.h"
#include "cli/scene/scene_map.h"
#include "cli/scene/scene_view.h"
#include "film/jobs/camera.h"
#include "film/jobs/sequence.h"
#include "film/scenes/demo_scene.h"
#include "scene/gltf/glb_writer.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

struct SceneOptions {
    SceneViewOptions view;
    bool json = false;
    std::string map;
    std::string output;
    std::string camera;
    std::string size = "960x540";
    MapConditions conditions;
    BakeArguments bake;
    std::optional<double> rain_mm;
    std::string glb;
};

std::vector<std::string> map_names()
{
    std::vector<std::string> names;
    for (const SceneMap& map : scene_maps()) names.push_back(map.name);
    names.emplace_back(kBasinsMap);
    return names;
}

const SceneMap& find_map(const std::string& name)
{
    for (const SceneMap& map : scene_maps()) {
        if (map.name == name) return map;
    }
    throw Error("scene: no map \"" + name + "\"." + did_you_mean(name, map_names()),
                "Use: " + join_words(map_names()) + ".");
}

// The demo's scenes for other programs.
void write_demo(const SceneOptions& options)
{
    if (options.view.file.rfind("demo:", 0) != 0) {
        throw Error("scene: --glb writes a scene of the demo, got " + options.view.file,
                    "Use demo:street or demo:stage; a scene of your own is a file already.");
    }
    if (!options.map.empty() || !options.bake.what.empty() || options.json)
        throw Error("scene: --glb is not of --map, --bake and --json", "Run the program once for each.");
    if (std::filesystem::path(options.glb).extension() != ".glb")
        throw Error("scene: --glb writes a .glb file, got \"" + options.glb + "\"", "Add --glb street.glb.");
    const auto loaded = load_demo(options.view.file, {.threads = options.view.threads}, user_cache(), "scene");
    const std::vector<std::byte> bytes = scene::write_glb(loaded.scene);
    write_text_file(options.glb, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    std::cout << options.glb << ": " << loaded.scene.meshes.size() << " meshes, " << loaded.scene.materials.size()
              << " materials, " << bytes.size() / 1048576 << " MiB\n";
}

void check(const SceneOptions& options)
{
    check_bake(options.bake, options.output);
    if (!options.bake.what.empty()) {
        if (!options.map.empty())
            throw Error("scene: --bake and --map in one run", "Run the program once for each.");
        if (options.json)
            throw Error("scene: --bake has no report for programs", "Leave out --json.");
    } else if (!options.map.empty()) {
        if (options.map != kBasinsMap) find_map(options.map);
        const std::filesystem::path file = options.output;
        if (file.extension() != ".png") {
            throw Error("scene: a map is written as .png, got \"" + options.output + "\"",
                        "Add -o map.png.");
        }
    } else if (!options.output.empty()) {
        throw Error("scene: -o " + options.output + " without --map or --bake: nothing would be written",
                    "Add --map sky, or leave out -o.");
    }
    if (options.rain_mm && options.map != kBasinsMap) {
        throw Error("scene: --rain-mm is of --map basins", "Add --map basins, or leave it out.");
    }
    parse_size(options.size);
}

void write_basins(const SceneOptions& options, const SceneView& view)
{
    const Pixels pixels = draw_basins(view.ground, options.rain_mm);
    texproc::write_png8(options.output, pixels.width, pixels.height, 3, pixels.rgb,
                        {{"scene", view.scene->name}, {"map", options.map}});
}

void run(SceneOptions options)
{
    check(options);
    if (!options.glb.empty()) return write_demo(options);
    options.view.quiet = options.json;
    options.view.ground = options.bake.what.empty();
    options.view.holes = !options.map.empty() && options.map != kBasinsMap;
    const SceneView view = open_scene(options.view);
    if (!options.bake.what.empty()) {
        options.bake.light.north_degrees = options.conditions.north_degrees;
        std::cout << bake_light_maps(view, options.view, options.bake, options.output);
        return;
    }
    if (options.map == kBasinsMap) {
        write_basins(options, view);
    } else if (!options.map.empty()) {
        const ImageSize size = parse_size(options.size);
        MapPicture picture;
        picture.width = size.width;
        picture.height = size.height;
        picture.threads = options.view.threads;
        ScenarioCamera camera;
        camera.name = options.camera;
        const Pixels pixels = draw_scene_map(
            view, find_map(options.map), options.conditions,
            camera_at(camera, *view.scene, framing_of(*view.scene),
                      static_cast<double>(size.width) / size.height, 0.0),
            picture);
        texproc::write_png8(options.output, pixels.width, pixels.height, 3, pixels.rgb,
                            {{"scene", view.scene->name}, {"map", options.map}});
    }
    if (options.json)
        std::cout << scene_json(view) << "\n";
    else
        std::cout << scene_report(view);
}

}  // namespace

void add_scene(CLI::App& app)
{
    auto o = std::make_shared<SceneOptions>();
    CLI::App* command = app.add_subcommand(
        "scene", "Show what the program sees in a scene: triangles, patches, ground, sky and rain.");
    command->add_option("SCENE", o->view.file, ".glb or .gltf file, or demo:street, demo:stage")->required();
    command->add_flag("--json", o->json, "report for programs");
    std::string kinds;
    for (const SceneMap& map : scene_maps()) kinds += (kinds.empty() ? "" : "; ") + map.name + ": " + map.help;
    kinds += "; basins: the ground from above and the water in its hollows";
    command->add_option("--map", o->map, "a picture that explains: " + kinds);
    add_bake_options(*command, o->bake);
    command->add_option("--rain-mm", o->rain_mm,
                        "basins: rain that has run together, mm (without end)")
        ->check(CLI::Range(0.0, 100000.0));
    command->add_option("-o,--output", o->output, "where the picture goes, .png, or the folder of light maps");
    command->add_option("--glb", o->glb, "write a scene of the demo as glTF, for other programs, and stop");
    command->add_option("--camera", o->camera, "of the scene (its first, else one that frames it)");
    command->add_option("--size", o->size, "of the picture (960x540)");
    command->add_option("--wind-from", o->conditions.wind_from_degrees,
                        "rain: where the wind comes from, degrees from north (270)")
        ->check(CLI::Range(-360.0, 360.0));
    command->add_option("--wind", o->conditions.wind_m_s, "rain: wind, m/s (0)")
        ->check(CLI::Range(0.0, 60.0));
    command->add_option("--latitude", o->conditions.latitude_degrees, "sun: degrees north (50)")
        ->check(CLI::Range(-90.0, 90.0));
    command->add_option("--day", o->conditions.day_of_year, "sun: day of the year (172)")
        ->check(CLI::Range(1.0, 366.0));
    command->add_option("--north", o->conditions.north_degrees,
                        "where north is: degrees clockwise from -z (0)")
        ->check(CLI::Range(-360.0, 360.0));
    command->add_option("--cell", o->view.cell_m, "edge of the finest regular patch, metres (auto)")
        ->check(CLI::Range(0.0001, 100000.0));
    command->add_option("--rays", o->view.rays, "links of each patch (128)")
        ->check(CLI::Range(16, 1024));
    command->add_option("--threads", o->view.threads, "CPU threads (all)")->check(CLI::Range(1, 1024));
    command->add_flag("--fresh", o->view.fresh, "make patches anew: neither read nor fill the cache");
    command->footer(
        "Example: petrichor scene street.glb --map rain --wind 8 --wind-from 250 -o rain.png\n"
        "Patches are kept in the cache under a fingerprint of the scene's shape.");
    command->callback([o] { run(*o); });
}

}  // namespace petrichor::cli
