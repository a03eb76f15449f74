// petrichor bench: renders one frame again and again and reports medians.
#include <sys/resource.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cli/render/camera.h"
#include "cli/commands.h"
#include "cli/render/scene_file.h"
#include "cli/render/scene_textures.h"
#include "cli/render/sequence.h"
#include "gpu/renderer.h"
#include "texproc/files/io.h"

namespace petrichor::cli {
namespace {

struct BenchOptions {
    std::string scene;
    std::string size = "1280x720";
    std::string camera;
    std::string device;
    std::string picture;
    int repeat = 5;
    int samples = 1;
    int threads = 0;
    bool json = false;
    bool shadows = false;
    bool ambient_occlusion = false;
    bool image_based_light = false;
    bool sky = false;
    bool rain = false;
};

// What one repetition cost.
struct Cost {
    double cpu_ms = 0.0;
    double wall_ms = 0.0;
    std::vector<gpu::PassTime> passes;
};

double clock_ms(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double median_of(const std::vector<Cost>& costs, double Cost::* member)
{
    std::vector<double> values;
    for (const Cost& cost : costs) values.push_back(cost.*member);
    return median(values);
}

// Median of each pass, by its place in the frame.
std::vector<gpu::PassTime> median_passes(const std::vector<Cost>& costs)
{
    std::vector<gpu::PassTime> passes = costs.front().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        std::vector<double> values;
        for (const Cost& cost : costs) {
            if (i < cost.passes.size()) values.push_back(cost.passes[i].milliseconds);
        }
        passes[i].milliseconds = median(values);
    }
    return passes;
}

// The workload that renderers are compared by: the scene's own lights, nothing that is not asked for.
gpu::Frame bench_frame(const gpu::Scene& scene, const BenchOptions& options, const ImageSize& size)
{
    gpu::Frame frame;
    ScenarioCamera camera;
    camera.name = options.camera;
    const double aspect = static_cast<double>(size.width) / size.height;
    frame.camera = camera_at(camera, scene, content_bounds(scene), aspect, 0.0);
    bool has_sun = false;
    for (const gpu::Light& light : scene.lights) {
        has_sun = has_sun || light.kind == gpu::LightKind::Directional;
    }
    frame.sky.analytic_sun = !has_sun;
    gpu::FrameSettings& settings = frame.settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.samples = options.samples;
    settings.shadows = options.shadows;
    settings.ambient_occlusion = options.ambient_occlusion;
    settings.image_based_light = options.image_based_light;
    settings.draw_sky = options.sky;
    settings.shelter = options.rain;
    settings.exposure = has_sun ? 1.0f : 0.0f;  // such scenes count a bright sun as about 3
    if (options.rain) {
        frame.weather.rain = 0.8f;
        frame.weather.flood_cracks = 0.8f;
        frame.weather.flood_puddles = 0.6f;
        frame.weather.film_albedo = 0.8f;
        frame.weather.film_smoothness = 0.5f;
    }
    return frame;
}

Cost timed_render(gpu::Renderer& renderer, const gpu::Frame& frame, gpu::RenderResult& result)
{
    const double cpu_before_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
    const double wall_before_ms = clock_ms(CLOCK_MONOTONIC);
    result = renderer.render(frame);
    Cost cost;
    cost.wall_ms = clock_ms(CLOCK_MONOTONIC) - wall_before_ms;
    cost.cpu_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_before_ms;
    cost.passes = result.passes;
    return cost;
}

long peak_memory_mib()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

void print_json(const BenchOptions& options, const std::string& device, const std::vector<Cost>& costs,
                const gpu::RenderResult& result)
{
    nlohmann::ordered_json report;
    report["scene"] = std::filesystem::path(options.scene).filename().string();
    report["device"] = device;
    report["width"] = result.width;
    report["height"] = result.height;
    report["samples"] = options.samples;
    report["repeat"] = options.repeat;
    report["cpu_ms_per_frame"] = median_of(costs, &Cost::cpu_ms);
    report["wall_ms_per_frame"] = median_of(costs, &Cost::wall_ms);
    report["peak_memory_mib"] = peak_memory_mib();
    report["light_list_overflows"] = result.light_list_overflows;
    report["passes"] = nlohmann::ordered_json::array();
    for (const gpu::PassTime& pass : median_passes(costs)) {
        report["passes"].push_back({{"name", pass.name}, {"wall_ms", pass.milliseconds}});
    }
    std::cout << report.dump(2) << "\n";
}

void print_text(const BenchOptions& options, const std::string& device, const std::vector<Cost>& costs,
                const gpu::RenderResult& result)
{
    std::printf("%s, %d x %d, %d samples, on %s: medians of %d\n", options.scene.c_str(), result.width,
                result.height, options.samples, device.c_str(), options.repeat);
    std::printf("  cpu_ms_per_frame   %10.2f\n  wall_ms_per_frame  %10.2f\n  peak_memory_mib    %10ld\n",
                median_of(costs, &Cost::cpu_ms), median_of(costs, &Cost::wall_ms), peak_memory_mib());
    for (const gpu::PassTime& pass : median_passes(costs)) {
        std::printf("    %-24s %8.2f ms\n", pass.name.c_str(), pass.milliseconds);
    }
    if (result.light_list_overflows > 0) {
        std::printf("  %u tiles see more lights than a list holds\n", result.light_list_overflows);
    }
}

void bench(const BenchOptions& options)
{
    if (options.threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    const ImageSize size = parse_size(options.size);
    gpu::Scene scene = read_scene(options.scene).scene;
    gpu::Renderer renderer({.device = options.device});
    renderer.load(scene, prepare_textures(scene, {.threads = options.threads}));
    const gpu::Frame frame = bench_frame(scene, options, size);
    gpu::RenderResult result;
    timed_render(renderer, frame, result);  // warm-up: shaders are compiled on first use
    std::vector<Cost> costs;
    for (int i = 0; i < options.repeat; ++i) costs.push_back(timed_render(renderer, frame, result));
    if (!options.picture.empty()) {
        texproc::write_png8(options.picture, result.width, result.height, 4, result.display);
    }
    if (options.json) {
        print_json(options, renderer.device().name, costs, result);
    } else {
        print_text(options, renderer.device().name, costs, result);
    }
}

}  // namespace

void add_bench(CLI::App& app)
{
    auto o = std::make_shared<BenchOptions>();
    CLI::App* command =
        app.add_subcommand("bench", "Time one frame: medians of CPU time, wall time and each pass.");
    command->add_option("--scene", o->scene, "a .glb or .gltf file")->required();
    command->add_option("-s,--size", o->size, "WIDTHxHEIGHT in pixels (1280x720)");
    command->add_option("-r,--repeat", o->repeat, "timed frames after one to warm up (5)")
        ->check(CLI::Range(1, 100000));
    command->add_option("--samples", o->samples, "samples a pixel (1)")->check(CLI::Range(1, 256));
    command->add_option("--camera", o->camera, "a camera of the scene (its first)");
    command->add_option("--device", o->device, "part of a device name, or its number in `petrichor doctor`");
    command->add_option("--threads", o->threads, "CPU threads (all)")->check(CLI::Range(1, 1024));
    command->add_option("--png", o->picture, "keep the picture that was timed");
    command->add_flag("--json", o->json, "report for programs");
    command->add_flag("--shadows", o->shadows, "with shadows of the sun");
    command->add_flag("--ao", o->ambient_occlusion, "with ambient occlusion");
    command->add_flag("--ibl", o->image_based_light, "with light from the sky");
    command->add_flag("--sky", o->sky, "with the sky drawn");
    command->add_flag("--rain", o->rain, "in heavy rain: ripples, puddles, shelter");
    command->footer(
        "Example: petrichor bench --scene lights64.glb --size 1280x720 --repeat 5 --json\n"
        "Without flags: no shadows, occlusion, sky light or anti-aliasing; tone mapped. The time runs from\n"
        "the call until the pixels can be read.");
    command->callback([o] { bench(*o); });
}

}  // namespace petrichor::cli
