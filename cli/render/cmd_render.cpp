// petrichor render: a scenario, or a scene under a weather preset, becomes pictures and a film.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/words.h"
#include "cli/commands.h"
#include "cli/exit.h"
#include "cli/progress.h"
#include "cli/render/scenario_input.h"
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
    std::string model;
    std::string from;
    std::string to;
    std::optional<double> hours_per_second;
    std::optional<double> spin_up_days;
    std::optional<double> max_gap_days;
    std::string surface;
    std::optional<double> latitude_deg;
    std::optional<double> longitude_deg;
    std::string shard;
    std::vector<std::string> views;
    std::vector<std::string> variants;
    std::string folder;
    std::string frames;
    std::string size;
    std::optional<int> count;
    std::optional<int> samples;
    std::optional<std::uint32_t> seed;
    std::string camera;
    std::string ground;
    std::string device;
    std::vector<std::string> aovs;
    std::optional<int> tile;
    int threads = 0;
    int in_flight = 0;
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

// What the command line says of the weather: over the scenario's own and that of every variant.
void apply_weather(ScenarioWeather& weather, const RenderOptions& options)
{
    if (!options.weather.empty()) name_weather(weather, options.weather, fs::path());
    if (!options.model.empty()) {
        weather.model = options.model == "artist" ? WeatherModel::Artist : WeatherModel::Physical;
    }
    if (!options.from.empty()) weather.start = options.from;
    if (!options.to.empty()) weather.end = options.to;
    if (options.hours_per_second) weather.hours_per_second = *options.hours_per_second;
    if (options.spin_up_days) weather.spin_up_days = options.spin_up_days;
    if (!options.surface.empty()) weather.site.surface = options.surface;
    if (options.latitude_deg) weather.site.latitude_deg = options.latitude_deg;
    if (options.longitude_deg) weather.site.longitude_deg = options.longitude_deg;
    if (options.max_gap_days) weather.site.max_gap_days = *options.max_gap_days;
}

// Keeps of the scenario's variants those that are asked for.
void choose_variants(Scenario& scenario, const std::vector<std::string>& names)
{
    std::vector<std::string> known;
    for (const ScenarioVariant& variant : scenario.variants) known.push_back(variant.name);
    std::vector<ScenarioVariant> chosen;
    for (const std::string& name : names) {
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end()) {
            throw Error("render: no variant \"" + name + "\"." + did_you_mean(name, known),
                        known.empty() ? "The scenario has no [[variant]]."
                                      : "Use: " + join_words(known) + ".");
        }
        chosen.push_back(scenario.variants[static_cast<std::size_t>(found - known.begin())]);
    }
    scenario.variants = std::move(chosen);
}

// Names of the scenario's views, or else of cameras of the scene.
void choose_views(Scenario& scenario, const std::vector<std::string>& names)
{
    std::vector<ScenarioView> chosen;
    for (const std::string& name : names) {
        const auto own = std::find_if(scenario.views.begin(), scenario.views.end(),
                                      [&](const ScenarioView& view) { return view.name == name; });
        if (own != scenario.views.end()) {
            chosen.push_back(*own);
            continue;
        }
        check_part_name(name, "render: --views");
        ScenarioView view{name, scenario.camera};
        view.camera.name = name;
        view.camera.keys.clear();
        chosen.push_back(std::move(view));
    }
    scenario.unseen_views = std::exchange(scenario.views, std::move(chosen));
}

void apply_options(Scenario& scenario, const RenderOptions& options)
{
    apply_weather(scenario.weather, options);
    scenario.sun.yields = !options.weather.empty();
    if (!options.variants.empty()) choose_variants(scenario, options.variants);
    for (ScenarioVariant& variant : scenario.variants)
        apply_weather(variant.conditions.weather, options);
    for (ScenarioVariant& variant : scenario.variants)
        variant.conditions.sun.yields = !options.weather.empty();
    if (!options.views.empty()) choose_views(scenario, options.views);
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
    if (options.tile) scenario.render.tile = *options.tile;
    if (!options.camera.empty()) {
        scenario.camera.name = options.camera;
        scenario.camera.keys.clear();
        scenario.views.clear();
    }
    if (!options.aovs.empty()) output.aovs = options.aovs;
    output.exr = output.exr && !options.no_exr;
    output.png = output.png && !options.no_png;
    output.film = output.film && !options.no_film;
    scenario.scene.allow_outside = options.allow_outside;
    if (!options.ground.empty()) {
        scenario.scene.ground = options.ground == "plane"  ? StandsOn::Plane
                                : options.ground == "none" ? StandsOn::None
                                                           : StandsOn::Auto;
    }
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

// A word as a shell reads it back.
std::string in_shell_quotes(const std::string& word)
{
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_-./:=,@%+").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string resume_command(const RenderOptions& options)
{
    std::string command;
    for (const std::string& word : options.words) {
        command += (command.empty() ? "" : " ") + in_shell_quotes(word);
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
    std::cerr << ", in " << request.folder.string();
    if (report.films == 1) std::cerr << " with a film";
    if (report.films > 1) std::cerr << " with " << report.films << " films";
    std::cerr << "; " << duration_text(report.seconds) << ", " << report.peak_mib << " MiB\n";
}

// What was read, filled, guessed and spun up: once a source, however many variants share it.
void report_weather(const Sequence& sequence)
{
    std::vector<std::string> said;
    for (const SequenceVariant& variant : sequence.variants) {
        for (const std::string& note : variant.weather.notes) {
            const std::string line = "info weather: " + variant.weather.name + ": " + note;
            if (std::find(said.begin(), said.end(), line) != said.end()) continue;
            said.push_back(line);
            std::cerr << line << "\n";
        }
    }
    const ScenarioSun& sun = sequence.scenario.sun;
    const bool own_sun = sun.time_of_day_hours.given() || sun.elevation_degrees.given() ||
                         sun.azimuth_degrees.given();
    for (const SequenceVariant& variant : sequence.variants) {
        const weather::Moment first = variant.weather.at(0.0);
        if (!own_sun || !first.sun || (sun.yields && !first.utc_us)) continue;
        std::cerr << "info sun: [sun] of the scenario is used, not the place and clock of "
                  << variant.weather.name
                  << "; leave its angles and hours out to follow the file\n";
        break;
    }
}

// The log line at the start, and a progress line.
class ProgressWatcher : public RenderWatcher {
public:
    void tracing(double share) override
    {
        if (!progress_) progress_.emplace("light between surfaces", 100);
        progress_->update(std::min(static_cast<int>(share * 100.0), 99));
    }
    void begin(int count, const ScenarioOutput& output, const gpu::DeviceInfo& device) override
    {
        progress_.reset();
        std::cerr << "info render: " << count << " frames, " << output.width << "x" << output.height
                  << ", " << output.samples << " samples, on " << device.name << "\n";
        progress_.emplace("render", count);
    }
    void tile(int frame, int done, int count) override
    {
        const std::lock_guard lock(mutex_);
        progress_->stage("frame " + std::to_string(frame) + " tile " + std::to_string(done) + " of " + std::to_string(count));
    }
    void written(int count) override
    {
        const std::lock_guard lock(mutex_);
        progress_->update(count);
    }
    void end() { progress_.reset(); }

private:
    std::mutex mutex_;
    std::optional<Progress> progress_;
};

void render(const RenderOptions& options)
{
    if (options.list_aovs) {
        list_aovs();
        return;
    }
    struct Progressing {
        RenderTally tally;
        RenderRequest request;
    };
    // Outlives this function: it may be asked while the program ends.
    const auto work = std::make_shared<Progressing>();
    RenderRequest& request = work->request;
    request.folder = output_folder(options);
    request.command = resume_command(options);
    request.tally = &work->tally;
    set_last_words([work] { return stop_message(work->tally, work->request); });
    if (options.threads > 0) {
        // The CPU driver reads its number of threads from here.
        ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    }
    Scenario asked = scenario_of(options.input, "render");
    apply_options(asked, options);
    Sequence sequence = make_sequence(std::move(asked));
    const Scenario& scenario = sequence.scenario;
    report_weather(sequence);
    if (sequence.display) {
        for (const std::string& note : sequence.display->notes()) std::cerr << "info color: " << note << "\n";
    }

    request.range = {0, scenario.output.frames - 1};
    if (!options.frames.empty())
        request.range = parse_frame_range(options.frames, scenario.output.frames);
    if (!options.shard.empty()) request.shard = parse_shard(options.shard);
    request.resume = options.resume || options.verify;
    request.verify = options.verify;
    request.memory_budget = options.memory_mib << 20;
    request.device = options.device;
    request.threads = options.threads;
    request.in_flight = options.in_flight;
    request.validation = options.validate;
    request.stop = interrupted;
    ProgressWatcher watcher;
    request.watcher = &watcher;

    require_writable_folder(request.folder);
    load_sequence_scene(sequence, options.threads);
    for (const std::string& warning : sequence.scene.warnings)
        std::cerr << "warn scene: " << warning << "\n";
    for (const std::string& note : sequence.notes) std::cerr << "info scene: " << note << "\n";
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
                        "scenario (.toml), scene (.glb, .gltf) or demo:street; nothing: the demo");
    const char* weather = "Weather";
    command
        ->add_option("-w,--weather", o->weather,
                     "weather preset or file; wins over the scenario's own")
        ->group(weather);
    command
        ->add_option("--model", o->model,
                     "of a weather file: physical (SI; default) or artist (0..1)")
        ->check(CLI::IsMember({"artist", "physical"}))
        ->group(weather);
    command
        ->add_option("--from", o->from,
                     "where in the file the film begins, by the clock of its place: 2005-12-01T06:00, 12-01, or seconds")
        ->group(weather);
    command->add_option("--to", o->to, "and where it ends (the last row)")->group(weather);
    command
        ->add_option("--hours-per-second", o->hours_per_second,
                     "hours of the file for a second of the clock (1)")
        ->check(CLI::Range(1e-4, 1e4))
        ->group(weather);
    command
        ->add_option("--surface", o->surface,
                     "of the physical model: asphalt (default), grass, cobblestone, ..")
        ->group(weather);
    command
        ->add_option("--spin-up-days", o->spin_up_days,
                     "the physical model begins this long before --from (the first row)")
        ->check(CLI::Range(0.0, 36500.0))
        ->group(weather);
    command->add_option("--latitude", o->latitude_deg, "north; where the file does not say")
        ->check(CLI::Range(-90.0, 90.0))
        ->group(weather);
    command->add_option("--longitude", o->longitude_deg, "east; likewise")
        ->check(CLI::Range(-180.0, 360.0))
        ->group(weather);
    command
        ->add_option("--max-gap", o->max_gap_days,
                     "days, longest time between two rows of a weather file (60)")
        ->check(CLI::Range(0.0, 1e6))
        ->group(weather);
    command
        ->add_option("--variants", o->variants,
                     "only these [[variant]] of the scenario, names joined by commas")
        ->delimiter(',');
    command
        ->add_option("--views", o->views,
                     "from each of these [[view]] or cameras of the scene, joined by commas")
        ->delimiter(',');
    command->add_option("--shard", o->shard,
                        "I/N: the I-th of N equal parts of the pictures, for many machines");
    command->add_option("-o,--output", o->folder, "folder for the frames (petrichor-NAME)");
    command->add_option("-f,--frames", o->frames,
                        "A:B renders frames A to B, both included; N only that one");
    command->add_option("--count", o->count, "number of frames of the whole sequence")
        ->check(CLI::Range(1, 1000000));
    command->add_option("-s,--size", o->size, "WIDTHxHEIGHT in pixels");
    command->add_option("--samples", o->samples, "samples a pixel")->check(CLI::Range(1, 256));
    command
        ->add_option("--tile", o->tile,
                     "render in tiles of so many pixels a side, 32 to 4096 in steps of 32 (as [render] tile)")
        ->check([](const std::string& text) {
            const int tile = std::atoi(text.c_str());
            return tile >= 32 && tile <= 4096 && tile % 32 == 0 ? "" : "expected 32 to 4096 in steps of 32, got " + text;
        });
    command->add_option("--seed", o->seed, "of the sample pattern");
    command->add_option("--camera", o->camera, "a camera of the scene");
    command
        ->add_option("--ground", o->ground,
                     "what the scene stands on: auto (level ground if it brings none), plane, none")
        ->check(CLI::IsMember({"auto", "plane", "none"}));
    command->add_option("--aov", o->aovs, "more images in the EXR, names joined by commas")
        ->delimiter(',');
    command->add_flag("--list-aovs", o->list_aovs, "name the images that --aov takes, and stop");
    command->add_option("--device", o->device,
                        "part of a device name, or its number in `petrichor doctor`");
    command->add_option("--threads", o->threads, "CPU threads (all)")->check(CLI::Range(1, 1024));
    command
        ->add_option("--frames-in-flight", o->in_flight,
                     "pictures rendered at a time, each takes the device's memory once more (on a "
                     "CPU two to four in a long run, else one); the bytes do not depend on it")
        ->check(CLI::Range(1, 16));
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
        "          petrichor render street.glb --weather denver.epw --from 01-10 --to 01-12\n"
        "          petrichor render my-street.toml --frames 0:23 --aov depth --resume");
    command->callback([o] { render(*o); });
}

}  // namespace petrichor::cli
