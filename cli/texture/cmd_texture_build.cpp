// petrichor texture build: maps in, everything that an engine wants out.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "cli/exit.h"
#include "cli/rooms.h"
#include "cli/signals.h"
#include "cli/texture/build/build.h"
#include "cli/texture/build/build_scene.h"
#include "cli/texture/build/plan_build.h"
#include "cli/texture/build/recipe_file.h"
#include "cli/texture/build/watch.h"
#include "cli/texture/cmd_texture.h"
#include "film/data/folders.h"
#include "texproc/gltf/rewrite.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> inputs;
    std::string out;
    BuildChoice choice;
    BuildOptions options;
    bool list = false, watch = false, fallback = false;
};

void list_engines()
{
    for (const EngineInfo& engine : engines()) {
        std::cout << engine.name << ": " << engine.note << "\n";
        for (const texproc::OutputRule& output : engine.outputs) {
            std::cout << "    " << output.file << "." << output.format
                      << (output.compression == "none" ? "" : " " + output.compression);
            for (std::size_t c = 0; c < output.channels.channels.size(); ++c) {
                std::cout << (c ? ", " : "  ") << "RGBA"[c] << " = " << output.channels.channels[c];
            }
            std::cout << "\n";
        }
    }
}

// A recipe by path; a bare name may also be a recipe in the folder one is in.
std::vector<fs::path> input_paths(const Arguments& a)
{
    if (a.inputs.empty()) {
        throw Error("texture build: no recipe and no folder", "Name one; --help shows an example.");
    }
    return {a.inputs.begin(), a.inputs.end()};
}

void report(const BuildResult& result, double seconds)
{
    std::printf("%d built (%d files), %d up to date, %zu failed, %.2f s\n", result.built,
                result.files, result.current, result.failures.size(), seconds);
    std::fflush(stdout);
    for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
    for (const std::string& failure : result.failures) std::cerr << "error " << failure << "\n";
}

// Images in a folder that nothing is made of.
void report_unnamed(const Arguments& a)
{
    constexpr std::size_t kShown = 20;
    for (const fs::path& input : input_paths(a)) {
        if (input.extension() == ".toml") continue;
        const std::vector<fs::path> images = texproc::unnamed_images(input);
        if (!images.empty()) std::cout << "passed over: the names do not say what these are\n";
        for (std::size_t i = 0; i < std::min(images.size(), kShown); ++i)
            std::cout << "  " << images[i].string() << "\n";
        if (images.size() > kShown) std::cout << "  and " << images.size() - kShown << " more\n";
    }
}

BuildResult build_once(const Arguments& a)
{
    const auto start = std::chrono::steady_clock::now();
    const BuildResult result = build(plan_build(input_paths(a), a.choice), a.options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (a.options.dry_run) {
        report_unnamed(a);
    } else {
        report(result, took.count());
    }
    return result;
}

std::set<fs::path> watched_folders(const Arguments& a)
{
    std::vector<fs::path> files, trees;
    for (const fs::path& input : input_paths(a)) {
        (input.extension() == ".toml" ? files : trees).push_back(input);
    }
    try {
        for (const texproc::PlannedMaterial& material : plan_build(input_paths(a), a.choice)) {
            if (!material.recipe->folder.empty()) trees.push_back(material.recipe->folder);
            for (const auto& [role, map] : material.files.inputs) files.push_back(map.path);
        }
    } catch (const Error&) {
        // A recipe that is broken right now is watched until it is mended.
    }
    std::set<fs::path> folders = folders_of(files, trees);
    // What we write ourselves must not wake us.
    std::erase_if(folders, [&](const fs::path& folder) {
        const fs::path relative =
            fs::weakly_canonical(folder).lexically_relative(fs::weakly_canonical(a.options.out));
        return !relative.empty() && *relative.begin() != "..";
    });
    return folders;
}

void watch(const Arguments& a)
{
    while (!interrupted()) {
        FolderWatch changes(watched_folders(a));  // before the build: nothing is missed meanwhile
        try {
            build_once(a);
        } catch (const Error& error) {
            std::cerr << "error " << error.what() << "\n  " << error.fix() << "\n";
        }
        std::cout << "watching; Ctrl-C ends" << std::endl;
        if (!changes.wait()) break;
    }
}

void run(Arguments& a)
{
    if (a.list) {
        list_engines();
        return;
    }
    for (const std::string& input : a.inputs) {
        if (!texproc::is_gltf_name(input)) continue;
        if (a.inputs.size() > 1 || a.watch) {
            throw Error("texture build: a scene (" + input + ") is built alone, once",
                        "Leave --watch and the other inputs out.");
        }
        const bool made = build_scene(
            {input, a.out, a.choice, a.fallback, a.options.dry_run, a.options.threads});
        if (!made) throw ExitCode{kExitUser};
        return;
    }
    if (a.fallback) {
        throw Error("texture build: --fallback is for scenes (.glb, .gltf)", "Leave it out.");
    }
    if (a.out.empty() && !a.options.dry_run) {
        throw Error("texture build: no output folder", "Give -o FOLDER.");
    }
    a.options.out = a.out;
    if (a.watch) {
        watch(a);
        return;
    }
    const BuildResult result = build_once(a);
    if (result.stopped) {
        throw Interrupted(
            "texture build: stopped; what was finished is kept, the same command goes on");
    }
    if (!result.failures.empty()) {
        if (a.options.dry_run) {
            for (const std::string& failure : result.failures)
                std::cerr << "error " << failure << "\n";
        }
        throw ExitCode{kExitUser};
    }
}

constexpr const char* kFooter =
    "A folder: maps are recognised by their names (X_albedo, X_diff_2k, X_Color, X_normal, "
    "X_nor_gl,\n"
    "X_NormalDX, X_rough, X_smoothness, X_height, X_Displacement, X_ao, X_arm, X_LuxSPEC, T_X_BC, "
    "...;\n"
    "--dry-run shows what was made of them).\n"
    "What is up to date is not made again: OUT/.petrichor-build.json remembers sources, options "
    "and\n"
    "outputs by content. OUT/manifest.json says what every file is, with hashes and measured "
    "error.\n"
    "\n"
    "A scene (.glb, .gltf): every material's textures are prefiltered with the normals that belong to\n"
    "them and written as KTX2 with all levels (UASTC, KHR_texture_basisu); the rest stays byte for\n"
    "byte. Images that two materials use with different normals become two.\n"
    "With --engine its maps go into a folder as that engine takes them, and the scene stays.\n"
    "\n"
    "Maps of different sizes are brought to the largest of those that meet in a file. Tiles of a\n"
    "UDIM set (X_albedo.1001.png; <UDIM> in a recipe) stay tiles: X_normal.1001.dds, edges clamped.\n"
    "\n"
    "Examples:\n"
    "  petrichor texture build scene.glb -o better.glb\n"
    "  petrichor texture build scene.glb --engine unreal -o Textures\n"
    "  petrichor texture build textures/ --engine unity-hdrp -o Assets/Textures\n"
    "  petrichor texture build wall.toml -o out --watch\n"
    "\n"
    "wall.toml:\n"
    "  engines = [\"unity-hdrp\"]         # outputs of --list; [[output]] adds others\n"
    "  [inputs]                         # or folder = \"textures\", for every material in it\n"
    "  albedo    = \"wall_diff.png\"\n"
    "  normal    = \"wall_nor_dx.png\"    # green direction: from the name, else from the map\n"
    "  roughness = \"wall_arm.png:g\"     # one channel\n"
    "  occlusion = \"wall_arm.png:r\"\n"
    "  [prefilter]\n"
    "  rule = \"overlap\"                 # none: plain mips\n"
    "  quality = \"full\"                 # quick\n"
    "  lobes = 2                        # a second lobe, in a texture of its own\n"
    "  [mips]\n"
    "  filter = \"kaiser\"                # box, lanczos3, mitchell; wrap_u, wrap_v, alpha_cutoff\n"
    "  alpha_weighted = false           # alpha of colour is no coverage\n"
    "  [[output]]\n"
    "  file = \"{name}_wet\"\n"
    "  channels = [\"porosity\", \"1 - roughness\"]\n"
    "  format = \"ktx2\"                  # png, tga, tif, exr, dds, ktx2\n"
    "  compression = \"bc5\"              # bc1, bc3, bc4, bc5, bc7, uastc, astc-4x4 .. astc-8x8 (ktx2)\n"
    "  rdo = 1                          # blocks repeat others: smaller under zstd (uastc: the default)\n"
    "  rdo_most = 1                  # codes that a block may get off by it\n"
    "  order = \"bgra\"                   # dds without compression: as Unreal reads it\n"
    "  import = \"unity\"                 # settings beside it: unity (.meta), godot (.import)\n"
    "  size = 1024";

}  // namespace

void add_texture_build(CLI::App& texture)
{
    auto a = std::make_shared<Arguments>();
    CLI::App* app =
        texture.add_subcommand("build", "a recipe, a folder of maps or a scene into engine-ready files");
    app->add_option("inputs", a->inputs, "recipes (.toml) and folders of maps, or one scene (.glb, .gltf)");
    app->add_option("-o,--out", a->out, "the folder to write into; of a scene the new scene");
    app->add_option("--engine", a->choice.engines,
                    "outputs of this engine (see --list), in place of the recipe's");
    app->add_option("--rule", a->choice.rule, "prefilter: picture (default; once stored never worse than plain mips), overlap, "
                    "median, ..., or none");
    app->add_option("--quality", a->choice.quality, "prefilter: full or quick (default: as the recipe says, else quick)")
        ->check(CLI::IsMember({"full", "quick"}));
    app->add_option("--lobes", a->choice.lobes,
                    "of a texel of the small levels: 2 adds a texture {name}_second_lobe that a shader reads as "
                    "formulas/light/second_lobe.h says; a scene gets it as PETRICHOR_materials_two_lobes (rule picture, quality full)")
        ->check(CLI::Range(1, 2));
    app->add_option("--format", a->choice.format, "of all outputs")
        ->check(CLI::IsMember({"png", "tga", "tif", "exr", "dds", "ktx2"}));
    app->add_option("--size", a->choice.size, "longest side at most this")
        ->check(CLI::Range(1, 65536));
    app->add_option("--rdo", a->choice.rdo,
                    "blocks repeat bytes of others where that costs at most so much squared error a bit, for smaller "
                    "files under zstd; default: as the recipe says, else 1 for uastc (which is stored so) "
                    "but of normals, 0 for others")
        ->check(CLI::Range(0.0, 1000.0));
    app->add_option("--rdo-most", a->choice.rdo_most,
                    "how far off a block may get by it, root mean square in codes of 255 (1: 48 dB)")
        ->check(CLI::Range(0.01, 255.0));
    app->add_option("--wrap", a->choice.wrap,
                    "past the edges of the maps: wrap, clamp, mirror; default: as the recipe says")
        ->check(CLI::IsMember({"wrap", "clamp", "mirror"}));
    app->add_option("--normal-green", a->choice.normal_green,
                    "which way green points in the normal maps, whatever names and maps say")
        ->check(CLI::IsMember({"up", "down"}));
    app->add_flag("--no-score", a->choice.no_score, "do not measure the lobe error and the pictures");
    app->add_option("--threads", a->options.threads, "0: all cores; the bytes do not depend on it");
    app->add_flag("--dry-run", a->options.dry_run, "print what would be made");
    app->add_flag("--force", a->options.force, "make what is up to date as well");
    app->add_flag("--watch", a->watch, "go on, and build again when a map or a recipe changes");
    app->add_flag("--fallback", a->fallback,
                  "scenes: keep the old images beside, for readers without KTX2");
    app->add_flag("--list", a->list, "show the engines and their outputs");
    app->footer(kFooter);
    app->callback([a] { run(*a); });
}

}  // namespace petrichor::cli
