// petrichor render: a scenario, or a scene under a weather preset, becomes pictures and a film.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/progress.h"
#include "cli/rooms.h"
#include "cli/signals.h"
#include "film/data/folders.h"
#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "film/jobs/weather_source.h"
#include "film/scenario/material_keys.h"
#include "scene/material_table.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    std::string input;
    std::string weather;
    std::string folder;
    std::string frames;
    std::string size;
    std::optional<int> count;
    std::optional<int> samples;
    std::optional<std::uint32_t> seed;
    std::string camera;
    std::string device;
    std::vector<std::string> aovs;
    int threads = 0;
    bool resume = false;
    bool verify = false;
    std::uint64_t memory_mib = 0;
    bool allow_outside = false;
    bool no_exr = false;
    bool no_png = false;
    bool no_film = false;
    bool dump_graph = false;
    bool validate = false;
    bool list_aovs = false;
    std::vector<std::string> words;  // the command line as it was typed
};

bool is_scene(const fs::path& file)
{
    return file.extension() == ".glb" || file.extension() == ".gltf";
}

// The scenario of an input: a file, a scene with defaults around it, or the name of one of ours.
Scenario scenario_of(const std::string& input)
{
    if (input.empty()) return read_scenario(data_folder() / "scenarios" / "demo.toml");
    const fs::path file = input;
    if (is_scene(file)) {
        Scenario scenario;
        scenario.name = printable(input);
        scenario.scene.file = input;
        return scenario;
    }
    if (file.extension() == ".toml" || fs::exists(file)) return read_scenario(file);
    const auto names = preset_names("scenarios");
    for (const std::string& name : names) {
        if (name == input) return read_scenario(data_folder() / "scenarios" / (name + ".toml"));
    }
    throw Error("render: " + printable(input) +
                    " is neither a scenario (.toml), nor a scene (.glb, .gltf), nor one of: " +
                    join_words(names) + "." + did_you_mean(input, names),
                "For example: petrichor render scene.glb --weather rain-then-snow");
}

void apply_options(Scenario& scenario, const RenderOptions& options)
{
    ScenarioOutput& output = scenario.output;
    if (!options.size.empty()) {
        const ImageSize size = parse_size(options.size);
        output.width = size.width;
        output.height = size.height;
    }
    check_size({output.width, output.height});
    if (options.count) output.frames = *options.count;
    if (options.samples) output.samples = *options.samples;
    if (options.seed) output.seed = *options.seed;
    if (!options.camera.empty()) {
        scenario.camera.name = options.camera;
        scenario.camera.keys.clear();
    }
    if (!options.aovs.empty()) output.aovs = options.aovs;
    output.exr = output.exr && !options.no_exr;
    output.png = output.png && !options.no_png;
    output.film = output.film && !options.no_film;
    if (!output.exr && !output.png) {
        throw Error("render: neither EXR nor PNG is asked for, so nothing would be written",
                    "Leave out --no-exr or --no-png.");
    }
    if (!output.aovs.empty() && !output.exr) {
        throw Error("render: AOVs are written into EXR files, which are switched off",
                    "Leave out --no-exr or the AOVs.");
    }
    std::vector<std::string> known;
    for (const gpu::AovInfo& aov : gpu::aov_table()) known.push_back(aov.name);
    for (const std::string& aov : output.aovs) {
        bool exists = false;
        for (const std::string& name : known) exists = exists || name == aov;
        if (!exists) {
            throw Error("render: no AOV \"" + aov + "\"." + did_you_mean(aov, known),
                        "Use: " + join_words(known) + ".");
        }
    }
}

fs::path output_folder(const RenderOptions& options)
{
    if (!options.folder.empty()) return options.folder;
    const std::string stem = fs::path(options.input).stem().string();
    return "petrichor-" + (stem.empty() ? "demo" : stem);
}

std::string resume_command(const RenderOptions& options)
{
    std::string command;
    for (const std::string& word : options.words) {
        const bool plain = word.find_first_of(" \t'\"\\$&;*?()<>|") == std::string::npos;
        command += (command.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
    }
    return options.resume ? command : command + " --resume";
}

void list_aovs()
{
    for (const gpu::AovInfo& aov : gpu::aov_table()) {
        std::cout << aov.name << std::string(aov.name.size() < 16 ? 16 - aov.name.size() : 1, ' ')
                  << aov.channels
                  << std::string(aov.channels.size() < 5 ? 5 - aov.channels.size() : 1, ' ')
                  << aov.meaning << (aov.unit == "1" ? "" : ", " + aov.unit) << "\n";
    }
}

void report_on(const RenderReport& report, const RenderRequest& request)
{
    for (const std::string& message : report.validation)
        std::cerr << "error validation: " << message << "\n";
    for (const std::string& note : report.notes) std::cerr << "info render: " << note << "\n";
    std::cerr << "info render: " << report.rendered << " frames rendered";
    if (report.kept > 0) std::cerr << ", " << report.kept << " kept";
    std::cerr << ", in " << request.folder.string() << (report.film ? " with film.mp4" : "") << "; "
              << duration_text(report.seconds) << ", " << report.peak_mib << " MiB\n";
}

// The log line at the start, and a progress line.
class ProgressWatcher : public RenderWatcher {
public:
    void begin(int count, const ScenarioOutput& output, const gpu::DeviceInfo& device) override
    {
        std::cerr << "info render: " << count << " frames, " << output.width << "x" << output.height
                  << ", " << output.samples << " samples, on " << device.name << "\n";
        progress_.emplace("render", count);
    }
    void written(int count) override { progress_->update(count); }
    void end() { progress_.reset(); }

private:
    std::optional<Progress> progress_;
};

void render(const RenderOptions& options)
{
    if (options.list_aovs) {
        list_aovs();
        return;
    }
    set_way_to_go_on(resume_command(options));
    if (options.threads > 0) {
        // The CPU driver reads its number of threads from here.
        ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    }
    Sequence sequence;
    sequence.scenario = scenario_of(options.input);
    Scenario& scenario = sequence.scenario;
    apply_options(scenario, options);

    RenderRequest request;
    request.folder = output_folder(options);
    request.range = {0, scenario.output.frames - 1};
    if (!options.frames.empty())
        request.range = parse_frame_range(options.frames, scenario.output.frames);
    request.resume = options.resume || options.verify;
    request.verify = options.verify;
    request.memory_budget = options.memory_mib << 20;
    scenario.scene.allow_outside = options.allow_outside;
    request.device = options.device;
    request.threads = options.threads;
    request.validation = options.validate;
    request.stop = interrupted;
    ProgressWatcher watcher;
    request.watcher = &watcher;
    request.command = resume_command(options);

    const WeatherSource weather = weather_source(scenario, options.weather);
    request.weather_name = weather.name;
    sequence.weather = weather.at;
    sequence.duration_s = scenario.output.duration_s.value_or(
        weather.duration_s > 0.0 ? weather.duration_s
                                 : scenario.output.frames / scenario.output.fps);

    require_writable_folder(request.folder);
    load_sequence_scene(sequence, options.threads);
    for (const std::string& warning : sequence.scene.warnings)
        std::cerr << "warn scene: " << warning << "\n";
    for (const std::string& unmatched :
         apply_material_overrides(scenario.materials, sequence.scene.materials)) {
        std::cerr << "warn " << unmatched << "\n";
    }
    for (const std::string& line : scene::unshaded_properties(sequence.scene))
        std::cerr << "warn scene: " << line << "\n";
    const RenderReport report = render_sequence(sequence, request);
    watcher.end();
    if (options.dump_graph) std::cout << report.graph << std::flush;
    report_on(report, request);
    if (!report.validation.empty()) throw ExitCode{kExitOurs};
}

}  // namespace

void add_render(CLI::App& app, std::vector<std::string> words)
{
    auto o = std::make_shared<RenderOptions>();
    o->words = std::move(words);
    CLI::App* command =
        app.add_subcommand("render", "Render a scenario or a scene into pictures and a film.");
    command->add_option("SCENARIO|SCENE", o->input,
                        "scenario (.toml) or scene (.glb, .gltf); nothing: the demo street");
    command->add_option("-w,--weather", o->weather,
                        "weather preset or file; wins over the scenario's own");
    command->add_option("-o,--output", o->folder, "folder for the frames (petrichor-NAME)");
    command->add_option("-f,--frames", o->frames,
                        "A:B renders frames A to B, both included; N only that one");
    command->add_option("--count", o->count, "number of frames of the whole sequence")
        ->check(CLI::Range(1, 1000000));
    command->add_option("-s,--size", o->size, "WIDTHxHEIGHT in pixels");
    command->add_option("--samples", o->samples, "samples a pixel")->check(CLI::Range(1, 256));
    command->add_option("--seed", o->seed, "of the sample pattern");
    command->add_option("--camera", o->camera, "a camera of the scene");
    command->add_option("--aov", o->aovs, "more images in the EXR, names joined by commas")
        ->delimiter(',');
    command->add_flag("--list-aovs", o->list_aovs, "name the images that --aov takes, and stop");
    command->add_option("--device", o->device,
                        "part of a device name, or its number in `petrichor doctor`");
    command->add_option("--threads", o->threads, "CPU threads (all)")->check(CLI::Range(1, 1024));
    command->add_flag(
        "--resume", o->resume,
        "keep frames whose files have the hashes they were written with and that would "
        "come out the same");
    command->add_flag("--verify", o->verify,
                      "--resume that also decodes the pictures and compares their pixels");
    command
        ->add_option("--memory", o->memory_mib,
                     "MiB that the scene may take (three quarters of the machine's)")
        ->check(CLI::Range(64, 1 << 30));
    command->add_flag("--allow-outside", o->allow_outside,
                      "links in the scene's folder may lead out of it");
    command->add_flag("--no-exr", o->no_exr, "write no EXR");
    command->add_flag("--no-png", o->no_png, "write no PNG, and so no film");
    command->add_flag("--no-film", o->no_film, "write no film");
    command->add_flag("--dump-graph", o->dump_graph,
                      "print the passes and what they read and write");
    command->add_flag("--validate", o->validate,
                      "run the Vulkan validation layer and print what it says");
    command->footer(
        "Examples: petrichor render\n"
        "          petrichor render street.glb --weather first-snow -o street --size 1280x720\n"
        "          petrichor render my-street.toml --frames 0:23 --aov depth --resume");
    command->callback([o] { render(*o); });
}

}  // namespace petrichor::cli
