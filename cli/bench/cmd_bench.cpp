// petrichor bench: how long a frame takes; bench weather, bench texture: how long those take.
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "cli/bench/render_bench.h"
#include "cli/bench/skill/board.h"
#include "cli/bench/texture_bench.h"
#include "cli/bench/weather_bench.h"
#include "cli/commands.h"
#include "cli/exit.h"

namespace petrichor::cli {
namespace {

void add_weather(CLI::App& bench)
{
    auto o = std::make_shared<WeatherBenchOptions>();
    auto rivals = std::make_shared<std::vector<std::string>>();
    CLI::App* command = bench.add_subcommand(
        "weather", "Time the weather models and readers beside a plain degree-day loop.");
    command->add_option("--file", o->file,
                        "a real weather file of any known kind (made-up weather)");
    command->add_option("-r,--repeat", o->repeat, "runs of each row; medians are printed (5)")
        ->check(CLI::Range(1, 100000));
    command->add_option("--grid-repeat", o->grid_repeat, "runs of the long rows of many cells (1)")
        ->check(CLI::Range(1, 1000));
    command->add_option("--cells", o->cells, "cells of the grid (10000)")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--days", o->days, "length of the made-up weather (365)")
        ->check(CLI::Range(2, 365));
    command->add_option("--threads", o->threads, "most CPU threads (all)")
        ->check(CLI::Range(1, 1024));
    command
        ->add_option("--rival", *rivals,
                     "another program to time, as NAME=COMMAND for the shell; may be repeated")
        ->type_name("NAME=COMMAND")
        ->allow_extra_args(false);
    command->add_flag("--json", o->json, "report for programs");
    command->footer(
        "Example: petrichor bench weather --file denver.epw --repeat 9\n"
        "         petrichor bench weather --file met_CdP_0506.txt \\\n"
        "             --rival \"FSM2=./FSM2 < nlst_CdP_0506.txt\" \\\n"
        "             --rival \"petrichor=petrichor simulate met_CdP_0506.txt -o run.csv\"\n"
        "A rival is timed whole: its start, its reading and its writing are in its time, not in "
        "ours; "
        "the hours\n"
        "of the file stand in the row cell_year_file. Give petrichor itself as a rival to compare "
        "whole programs.\n"
        "CPU time is that of all threads together. `goal` is what the row should stay below; it is "
        "that of\n"
        "10000 cells, 365 days and 1000 segments.");
    command->callback([o, rivals] {
        for (const std::string& text : *rivals) o->rivals.push_back(parse_rival(text));
        run_weather_bench(*o);
    });
}

void add_skill(CLI::App& bench)
{
    auto o = std::make_shared<SkillOptions>();
    auto rivals = std::make_shared<std::vector<std::string>>();
    CLI::App* command = bench.add_subcommand(
        "skill", "Score the weather model against every measured winter, road and sky it finds.");
    command->add_option("--data", o->data, "a folder; all below it is looked at (.)");
    command->add_option("--html", o->html, "write the table as a page");
    command
        ->add_option("--set", o->settings,
                     "a constant of the model to try, NAME=X; road.X is surface.X of the roads "
                     "alone; may be repeated")
        ->type_name("NAME=X")
        ->allow_extra_args(false);
    command->add_flag("--json", o->json, "report for programs");
    command
        ->add_option("--rival", *rivals,
                     "another snow model, as NAME=COMMAND for the shell; may be repeated")
        ->type_name("NAME=COMMAND")
        ->allow_extra_args(false);
    command->footer(
        "Example: petrichor bench skill --data data/weather --html skill.html\n"
        "Winters: met_X.txt beside obs_X.csv (place: site.toml with a [site] table). Roads: "
        "station.xml,\n"
        "observation.xml and roadcast_reference.xml of METRo in a folder. Skies: SURFRAD files. "
        "Maps of\n"
        "snow: dem.asc, weather.* and snow_YYYY-MM-DD.asc (0 bare, 100 snow, 205 cloud) in a "
        "folder.\n"
        "A rival runs once a winter with the files in $MET and $OBS and prints CSV: "
        "date,snow_depth_m,swe_kg_m2.\n"
        "Exit code 1: a score is worse than it is stated to be (cli/bench/skill/stated.cpp).");
    command->callback([o, rivals] {
        for (const std::string& text : *rivals) {
            const Rival rival = parse_rival(text);
            o->rivals.push_back({rival.name, rival.command});
        }
        if (!run_skill_bench(*o)) throw ExitCode{1};
    });
}

void add_texture_bench(CLI::App& bench)
{
    auto o = std::make_shared<TextureBenchOptions>();
    CLI::App* command = bench.add_subcommand(
        "texture", "Time prefilter, mips, pack and block compression beside other programs.");
    command->add_option("--normal", o->normal, "normal map, 16-bit PNG (a generated wall)");
    command->add_option("--roughness", o->roughness, "its roughness map");
    command->add_option("--color", o->color,
                        "what is compressed as BC7 (the wall's colour, or the normal map)");
    command->add_option("--size", o->size, "of the generated wall")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    command->add_option("-r,--repeat", o->repeat, "runs of each row after one to warm up")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_flag("--full", o->full, "also prefilter in full quality, which takes a minute");
    command->add_flag("--json", o->json, "report for programs");
    command->footer(
        "Example: petrichor bench texture --size 2048 --repeat 3\n"
        "Each row is a whole program, its start, reading and writing included: median CPU time of "
        "all its\n"
        "threads and processes, time by the clock, the memory of its largest process, and how near "
        "to the\n"
        "picture its blocks are. `kernel` is the filter alone beside what memory moves. Programs "
        "that are not\n"
        "installed are named with their Debian package. Goals at 4096 x 4096, in CPU seconds: "
        "median 6,\n"
        "picture quick 30, full 120; pack 4 as PNG, 1 as DDS.");
    command->callback([o] {
        const std::vector<TextureBenchRow> rows = texture_rows(*o);
        std::cout << (o->json ? to_json(rows) : to_text(rows));
    });
}

}  // namespace

void add_bench(CLI::App& app)
{
    auto o = std::make_shared<RenderBenchOptions>();
    CLI::App* command = app.add_subcommand("bench",
                                           "Time one frame: medians of CPU time, wall time and "
                                           "each pass. `bench weather`, `bench texture`: those.");
    CLI::Option* input =
        command->add_option("SCENARIO", o->scenario,
                            "scenario (.toml), scene or preset, with its weather, sky and size");
    command->add_option("--frame", o->frame, "of the scenario (0)")->check(CLI::Range(0, 999999));
    command->add_option("--variant", o->variant, "of the scenario (its first)");
    command->add_option("--view", o->view, "of the scenario (its first)");
    CLI::Option* scene = command->add_option(
        "--scene", o->scene, "instead: a .glb or .gltf file with nothing that is not asked for");
    scene->excludes(input);
    command->add_option("-s,--size", o->size,
                        "WIDTHxHEIGHT in pixels (the scenario's; with --scene 1280x720)");
    command->add_option("-r,--repeat", o->repeat, "timed frames after one to warm up (5)")
        ->check(CLI::Range(1, 100000));
    command->add_option("--samples", o->samples, "samples a pixel (the scenario's; with --scene 1)")
        ->check(CLI::Range(1, 256));
    command->add_option("--camera", o->camera, "a camera of the scene (its first)");
    command->add_option("--device", o->device,
                        "part of a device name, or its number in `petrichor doctor`");
    command->add_option("--threads", o->threads, "CPU threads (all)")->check(CLI::Range(1, 1024));
    command->add_option("--png", o->picture, "keep the picture that was timed");
    command->add_flag("--apart", o->apart,
                      "wait for each pass and tell its CPU time, too (the frame takes longer)");
    command->add_flag("--json", o->json, "report for programs");
    command
        ->add_option("--surface-path", o->surface_path,
                     "how surfaces are shaded: auto, fragment or visibility")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, gpu::SurfacePath>{{"auto", gpu::SurfacePath::Auto},
                                                    {"fragment", gpu::SurfacePath::Fragment},
                                                    {"visibility", gpu::SurfacePath::Visibility}}));
    command->add_flag("--relight", o->relight,
                      "solve the light between surfaces in each timed frame, and say what that takes");
    command
        ->add_flag("--film", o->film,
                   "as in a film: before each timed frame the next one is drawn, untimed, so that what "
                   "changes between them (sun, clouds, snow) is made anew; nothing is metered")
        ->excludes(scene);
    command->add_flag("--shadows", o->shadows, "with shadows of the sun")->needs(scene);
    command->add_flag("--ao", o->ambient_occlusion, "with ambient occlusion")->needs(scene);
    command->add_flag("--ibl", o->image_based_light, "with light from the sky")->needs(scene);
    command->add_flag("--sky", o->sky, "with the sky drawn")->needs(scene);
    command->add_flag("--rain", o->rain, "in heavy rain: ripples, puddles, shelter")->needs(scene);
    CLI::Option* compare =
        command
            ->add_flag("--compare", o->compare,
                       "time three.js, Filament, Blender EEVEE and Cycles on the same file")
            ->needs(scene);
    command->add_option("--peers", o->peers, "folder with their node_modules (.)")->needs(compare);
    command->add_option("--peer-pictures", o->peer_pictures, "keep their pictures in this folder")
        ->needs(compare);
    command->add_option("--peer-limit", o->peer_limit_s, "seconds until a peer is given up (300)")
        ->check(CLI::Range(1, 86400))
        ->needs(compare);
    command->footer(
        "Example: petrichor bench my.toml --frame 22\n"
        "         petrichor bench --scene lights64.glb --compare --peers tools\n"
        "         petrichor bench --scene lights64.glb --size 1280x720 --repeat 5 --json\n"
        "         petrichor bench weather\n"
        "         petrichor bench texture\n"
        "With --scene and no flags: no shadows, occlusion, sky light or anti-aliasing; tone "
        "mapped. The time "
        "runs from\n"
        "the call until the pixels can be read.\n"
        "--compare: each peer that is installed draws the lights and the camera of the GLB, "
        "without shadows; the\n"
        "first of its frames is not counted. `likeness` is the correlation of its picture with "
        "ours (block means);\n"
        "below 0.85 it has drawn something else and its time is not compared. What is missing is "
        "named with how\n"
        "to install it: npm install --prefix tools three filament puppeteer-core; apt install "
        "chromium blender.");
    add_weather(*command);
    add_texture_bench(*command);
    add_skill(*command);
    command->callback([o, command, scene, input] {
        if (!command->get_subcommands().empty()) return;
        if (scene->empty() && input->empty()) throw CLI::RequiredError("SCENARIO or --scene");
        run_render_bench(*o);
    });
}

}  // namespace petrichor::cli
