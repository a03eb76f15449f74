#include "cli/bench/render_bench.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cli/bench/measure.h"
#include "cli/bench/peers.h"
#include "cli/render/scenario_input.h"
#include "cli/rooms.h"
#include "film/color/shown_picture.h"
#include "film/jobs/camera.h"
#include "film/jobs/exposure.h"
#include "film/jobs/render_job.h"
#include "film/jobs/scene_places.h"
#include "film/jobs/scene_source.h"
#include "film/jobs/sequence.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/scene_textures.h"
#include "gpu/renderer.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

// What one repetition cost.
struct FrameCost {
    Cost cost;
    std::vector<gpu::PassTime> passes;
    double patch_light_cpu_ms = 0.0;
};

double patch_light_of(const std::vector<FrameCost>& costs)
{
    std::vector<double> values;
    for (const FrameCost& frame : costs) values.push_back(frame.patch_light_cpu_ms);
    return median(values);
}

double median_of(const std::vector<FrameCost>& costs, double Cost::*member)
{
    std::vector<double> values;
    for (const FrameCost& frame : costs) values.push_back(frame.cost.*member);
    return median(values);
}

// Median of each pass, by its place in the frame.
std::vector<gpu::PassTime> median_passes(const std::vector<FrameCost>& costs)
{
    std::vector<gpu::PassTime> passes = costs.front().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        std::vector<double> wall, cpu;
        for (const FrameCost& frame : costs) {
            if (i >= frame.passes.size()) continue;
            wall.push_back(frame.passes[i].milliseconds);
            cpu.push_back(frame.passes[i].cpu_milliseconds);
        }
        passes[i].milliseconds = median(wall);
        passes[i].cpu_milliseconds = median(cpu);
    }
    return passes;
}

// The workload that renderers are compared by: the scene's own lights, nothing that is not asked
// for.
gpu::Frame bench_frame(const scene::Scene& scene, const RenderBenchOptions& options,
                       const ImageSize& size)
{
    gpu::Frame frame;
    ScenarioCamera camera;
    camera.name = options.camera;
    const double aspect = static_cast<double>(size.width) / size.height;
    frame.camera = camera_at(camera, scene, framing_of(scene), aspect, 0.0);
    bool has_sun = false;
    for (const scene::Light& light : scene.lights) {
        has_sun = has_sun || light.kind == scene::LightKind::Directional;
    }
    frame.sky.analytic_sun = !has_sun;
    frame.look.ground_variation = 0.0f;  // of no file: five octaves of noise at each pixel of wide ground
    gpu::FrameSettings& settings = frame.settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.samples = std::max(1, options.samples);
    settings.surface_path = options.surface_path;
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

struct Workload {
    gpu::Renderer renderer;
    gpu::Frame frame;
    std::optional<gpu::Frame> other = {};  // drawn before it each time
    std::shared_ptr<const DisplayTransform> display = {};
};

FrameCost timed_render(Workload& work, gpu::RenderResult& result)
{
    FrameCost frame_cost;
    result = {};  // or two pictures were there at a time
    frame_cost.cost = timed([&] {
        result = work.renderer.render(work.frame);
        show(result, work.display.get(), work.frame.settings.dither);
    });
    frame_cost.passes = result.passes;
    frame_cost.patch_light_cpu_ms = result.patch_light_cpu_ms;
    return frame_cost;
}

void print_json(const RenderBenchOptions& options, int samples, const std::string& device,
                const std::vector<FrameCost>& costs, const gpu::RenderResult& result,
                const std::vector<PeerRow>& peers)
{
    nlohmann::ordered_json report;
    if (options.scene.empty()) {
        report["scenario"] = std::filesystem::path(options.scenario).filename().string();
        report["frame"] = options.frame;
    } else {
        report["scene"] = std::filesystem::path(options.scene).filename().string();
    }
    report["device"] = device;
    report["width"] = result.width;
    report["height"] = result.height;
    report["samples"] = samples;
    report["repeat"] = options.repeat;
    report["cpu_ms_per_frame"] = median_of(costs, &Cost::cpu_ms);
    report["wall_ms_per_frame"] = median_of(costs, &Cost::wall_ms);
    if (options.relight) report["patch_light_cpu_ms"] = patch_light_of(costs);
    report["peak_memory_mib"] = peak_memory_mib();
    report["passes"] = nlohmann::ordered_json::array();
    for (const gpu::PassTime& pass : median_passes(costs)) {
        nlohmann::ordered_json row{{"name", pass.name}, {"wall_ms", pass.milliseconds}};
        if (options.apart) row["cpu_ms"] = pass.cpu_milliseconds;
        report["passes"].push_back(row);
    }
    for (const PeerRow& peer : peers) {
        nlohmann::ordered_json row{{"name", peer.name}, {"version", peer.version}};
        if (peer.cost) {
            row["cpu_ms_per_frame"] = peer.cost->cpu_ms;
            row["wall_ms_per_frame"] = peer.cost->wall_ms;
        }
        if (peer.likeness) row["likeness"] = *peer.likeness;
        if (!peer.note.empty()) row["note"] = peer.note;
        report["peers"].push_back(row);
    }
    std::cout << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

void print_text(const RenderBenchOptions& options, int samples, const std::string& device,
                const std::vector<FrameCost>& costs, const gpu::RenderResult& result,
                const std::vector<PeerRow>& peers)
{
    const std::string name = options.scene.empty()
                                 ? (options.scenario.empty() ? "demo" : options.scenario) +
                                       ", frame " + std::to_string(options.frame)
                                 : options.scene;
    std::printf("%s, %d x %d, %d samples, on %s: medians of %d\n", name.c_str(), result.width,
                result.height, samples, device.c_str(), options.repeat);
    std::printf(
        "  cpu_ms_per_frame   %10.2f\n  wall_ms_per_frame  %10.2f\n  peak_memory_mib    %10ld\n",
        median_of(costs, &Cost::cpu_ms), median_of(costs, &Cost::wall_ms), peak_memory_mib());
    if (options.relight) std::printf("  patch_light_cpu_ms %10.2f\n", patch_light_of(costs));
    for (const gpu::PassTime& pass : median_passes(costs)) {
        if (options.apart) {
            std::printf("    %-24s %8.2f ms, CPU %8.2f ms\n", pass.name.c_str(), pass.milliseconds,
                        pass.cpu_milliseconds);
        } else {
            std::printf("    %-24s %8.2f ms\n", pass.name.c_str(), pass.milliseconds);
        }
    }
    if (!peers.empty()) {
        const Cost ours{median_of(costs, &Cost::cpu_ms), median_of(costs, &Cost::wall_ms), 0.0};
        std::cout << peers_text(ours, peers);
    }
}

// Other renderers on the same file, their pictures held against ours.
std::vector<PeerRow> peers_of(const RenderBenchOptions& options, const gpu::RenderResult& result)
{
    Image ours(result.width, result.height, 4, ColorSpace::Data);
    std::copy(result.display.begin(), result.display.end(), ours.pixels.begin());
    for (float& code : ours.pixels) code /= 255.0f;
    std::cerr << "bench: the peers run, for up to " << options.peer_limit_s << " s each\n";
    return compare_peers({.scene = options.scene,
                          .width = result.width,
                          .height = result.height,
                          .repeat = options.repeat,
                          .modules = options.peers,
                          .pictures = options.peer_pictures,
                          .limit_s = options.peer_limit_s},
                         ours);
}

}  // namespace

namespace {

// A renderer with its scene, and the frame to be timed.
Workload plain_workload(const RenderBenchOptions& options)
{
    const ImageSize size = parse_size(options.size.empty() ? "1280x720" : options.size);
    scene::Scene scene = read_scene(options.scene).scene;
    gpu::Renderer renderer({.device = options.device, .passes_apart = options.apart});
    renderer.load(scene, prepare_textures(scene, {.threads = options.threads}));
    return {std::move(renderer), bench_frame(scene, options, size)};
}

Workload scenario_workload(const RenderBenchOptions& options)
{
    Scenario scenario = scenario_of(options.scenario, "bench");
    if (!options.size.empty()) {
        const ImageSize size = parse_size(options.size);
        scenario.output.width = size.width;
        scenario.output.height = size.height;
    }
    if (options.samples > 0) scenario.output.samples = options.samples;
    if (!options.camera.empty()) {
        scenario.camera.name = options.camera;
        scenario.camera.keys.clear();
    }
    if (options.frame >= scenario.output.frames) {
        throw Error("bench: the scenario has frames 0 to " +
                        std::to_string(scenario.output.frames - 1) + ", got " +
                        std::to_string(options.frame),
                    "Give --frame one of them.");
    }
    Sequence sequence = make_sequence(std::move(scenario));
    load_sequence_scene(sequence, options.threads);
    for (const std::string& warning : sequence.scene.warnings)
        std::cerr << "warn scene: " << warning << "\n";
    const int next = options.frame + 1 < sequence.scenario.output.frames ? options.frame + 1 : options.frame - 1;
    if (options.film && next < 0)
        throw Error("bench: --film needs a scenario of two frames, got one", "Set [output] frames.");
    RenderRequest request;
    request.device = options.device;
    request.threads = options.threads;
    request.passes_apart = options.apart;
    request.range = {options.frame, options.frame};
    if (options.film) request.range = {std::min(options.frame, next), std::max(options.frame, next)};
    RenderReport report;
    ScenePlaces places(sequence, request.threads, {}, {}, report.notes);
    Job job{options.frame, options.variant, options.view};
    // The first of those there are, where none is named.
    if (job.variant.empty()) job.variant = sequence.variants.front().name;
    if (job.view.empty()) job.view = sequence.views.front().name;
    const auto frame_of = [&](const Job& which) {
        SequenceFrame frame = frame_at(sequence, which);
        FrameFacts facts;
        places.place(sequence, which, frame, facts);
        if (options.surface_path != gpu::SurfacePath::Auto) frame.frame.settings.surface_path = options.surface_path;
        return std::move(frame.frame);
    };
    gpu::Frame frame = frame_of(job);
    Workload work{sequence_renderer(sequence, request, report), std::move(frame)};
    work.display = sequence.display;
    set_environment_of(work.renderer, sequence, job);
    // As `render` exposes it: how far lamps reach depends on it.
    Meter meter(sequence);
    if (options.film) {
        Job other = job;
        other.frame = next;
        work.other = frame_of(other);
        meter.expose(work.renderer, other, *work.other);
    }
    meter.expose(work.renderer, job, work.frame);
    work.renderer.end_metering();
    return work;
}

}  // namespace

void run_render_bench(const RenderBenchOptions& options)
{
    if (options.compare && std::filesystem::path(options.scene).extension() != ".glb") {
        throw Error("bench: --compare takes a .glb, got " + options.scene,
                    "Peers read no other file whole: save the scene as GLB.");
    }
    if (options.threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    Workload work = options.scene.empty() ? scenario_workload(options) : plain_workload(options);
    gpu::RenderResult result;
    timed_render(work, result);  // warm-up: shaders are compiled on first use
    std::vector<FrameCost> costs;
    for (int i = 0; i < options.repeat; ++i) {
        // Another light for the solver, the same for the eye.
        if (options.relight) work.frame.emissive_scale += 1e-6f;
        if (work.other) work.renderer.render(*work.other);
        costs.push_back(timed_render(work, result));
    }
    if (!options.picture.empty()) {
        texproc::write_png8(options.picture, result.width, result.height, 4, result.display);
    }
    const std::string device = work.renderer.device().name;
    const int samples = work.frame.settings.samples;
    const std::vector<PeerRow> peers =
        options.compare ? peers_of(options, result) : std::vector<PeerRow>{};
    if (options.json) {
        print_json(options, samples, device, costs, result, peers);
    } else {
        print_text(options, samples, device, costs, result, peers);
    }
}

}  // namespace petrichor::cli
