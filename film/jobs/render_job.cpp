#include "film/jobs/render_job.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/ordered_work.h"
#include "base/words.h"
#include "film/color/shown_picture.h"
#include "film/data/folders.h"
#include "film/frames/film.h"
#include "film/frames/frame_writer.h"
#include "film/frames/frames_jsonl.h"
#include "film/frames/kept.h"
#include "film/jobs/exposure.h"
#include "film/jobs/film_tracks.h"
#include "film/jobs/scene_places.h"
#include "film/jobs/scene_source.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/drip_scene.h"
#include "film/scenes/light_picture.h"
#include "film/scenes/memory_budget.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/scene_probes.h"
#include "film/scenes/scene_textures.h"
#include "film/scenes/snow_scene.h"
#include "film/scenes/transport.h"
#include "film/scenes/weather_textures.h"
#include "film/tiles/tiled_picture.h"
#include "gpu/passes/falling/drips.h"
#include "scene/icicles/icicles.h"
#include "scene/merge.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

bool stopped(const RenderRequest& request)
{
    return request.stop && request.stop();
}

// One picture that still has to be rendered.
struct Pending {
    Job job;
    SequenceFrame frame;
    FrameParts made_from;
};

// Why pictures are made again, said once for all that have the same reason.
class Reasons {
public:
    void add(const Job& job, const std::string& why)
    {
        const auto found = std::find_if(reasons_.begin(), reasons_.end(),
                                        [&](const Reason& reason) { return reason.why == why; });
        if (found != reasons_.end()) {
            ++found->count;
        } else {
            reasons_.push_back({why, std::to_string(job.frame) + name_suffix(job), 1});
        }
    }
    std::vector<std::string> notes() const
    {
        constexpr std::size_t kMost = 8;
        std::vector<std::string> lines;
        for (const Reason& reason : reasons_) {
            if (lines.size() == kMost) {
                lines.push_back("... and " + std::to_string(reasons_.size() - kMost) + " more");
                break;
            }
            const std::string others =
                reason.count == 1 ? " is"
                                  : " and " + std::to_string(reason.count - 1) + " more are";
            lines.push_back("frame " + reason.first + others + " rendered again: " + reason.why);
        }
        return lines;
    }

private:
    struct Reason {
        std::string why, first;
        int count = 0;
    };
    std::vector<Reason> reasons_;
};

std::vector<Pending> pending_jobs(const Sequence& sequence, const RenderRequest& request,
                                  const std::vector<Job>& jobs, std::vector<std::string>& notes)
{
    std::map<Job, FrameRecord> records;
    if (request.resume) records = read_frame_records(request.folder);
    std::vector<Pending> pending;
    const ScenarioOutput& output = sequence.scenario.output;
    Reasons again;
    for (const Job& job : jobs) {
        if (stopped(request)) throw Interrupted(stop_message({}, request));
        Pending one{job, frame_at(sequence, job), {}};
        one.made_from = frame_parts(sequence, one.frame);
        if (request.resume) {
            const std::string why = why_again(records, job, one.made_from, {output.exr, output.png},
                                              request.folder, request.verify);
            if (why.empty()) continue;
            if (records.count(job) != 0) again.add(job, why);
        }
        pending.push_back(std::move(one));
    }
    const auto lines = again.notes();
    notes.insert(notes.end(), lines.begin(), lines.end());
    return pending;
}

// Frames of a variant and view that are not there as they should be, for its film.
int frames_missing_for_film(const Sequence& sequence, const std::map<Job, FrameRecord>& records,
                            Job job, const RenderRequest& request)
{
    const ScenarioOutput& output = sequence.scenario.output;
    int missing = 0;
    for (job.frame = 0; job.frame < output.frames; ++job.frame) {
        if (stopped(request)) throw Interrupted("interrupted while comparing frames");
        const FrameParts parts = frame_parts(sequence, frame_at(sequence, job));
        if (!why_again(records, job, parts, {output.exr, output.png}, request.folder, false)
                 .empty())
            ++missing;
    }
    return missing;
}

void finish_film(const Sequence& sequence, const RenderRequest& request, const Job& part,
                 const std::map<Job, FrameRecord>& records, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    const fs::path film = request.folder / ("film" + name_suffix(part) + ".mp4");
    if (report.rendered == 0 && fs::exists(film)) return;
    if (const int missing = frames_missing_for_film(sequence, records, part, request)) {
        // An older film would show other frames than those beside it.
        std::error_code ignored;
        fs::remove(film, ignored);
        report.notes.push_back("no " + film.filename().string() +
                               " yet: " + std::to_string(missing) + " of " +
                               std::to_string(output.frames) + " frames are not rendered");
        return;
    }
    make_film(request.folder, part, output.frames, output.fps, film, request.stop);
    ++report.films;
}

void finish_films(const Sequence& sequence, const RenderRequest& request, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    if (!output.film || !output.png || output.frames < 2) return;
    if (find_ffmpeg().empty()) {
        report.notes.push_back("no film: ffmpeg is not installed (apt-get install ffmpeg)");
        return;
    }
    const auto records = read_frame_records(request.folder);
    for (const Job& part : jobs_of(sequence, {0, 0}))
        finish_film(sequence, request, part, records, report);
}

scene::PatchProgress tracing_progress(const RenderRequest& request)
{
    if (!request.watcher) return {};
    return [watcher = request.watcher](std::string_view stage, float share) {
        watcher->tracing(traced_share(stage, share));
    };
}

// Whether any frame that is asked for may have snow with a body.
bool may_snow(const Sequence& sequence, const RenderRequest& request)
{
    if (!sequence.scenario.render.snow_body) return false;
    // In the shade it lies longer than in the open.
    constexpr float kWarm_k = 283.15f;
    for (const Job& job : jobs_of(sequence, request.range, request.shard)) {
        const double time_s = frame_time_s(sequence, job.frame);
        for (const SequenceVariant& variant : sequence.variants) {
            if (variant.name != job.variant) continue;
            const shared::WeatherMoment& w = variant.weather.at(time_s).values;
            if (w.snow_amount > 0.0f || (variant.weather.table && w.air_temperature_k < kWarm_k))
                return true;
        }
    }
    return false;
}

// Whether water comes off edges in any frame that is asked for.
bool may_drip(const Sequence& sequence, const RenderRequest& request)
{
    const ScenarioRender& render = sequence.scenario.render;
    if (!render.falling || render.falling_budget <= 0) return false;
    for (const Job& job : jobs_of(sequence, request.range, request.shard)) {
        for (const SequenceVariant& variant : sequence.variants) {
            if (variant.name != job.variant) continue;
            if (gpu::runs_off_kg_m2_s(variant.weather.at(frame_time_s(sequence, job.frame)).values) > 0.0f) return true;
        }
    }
    return false;
}

// Null where no frame of the film has any. drips: those of the scene, if they have been looked for.
std::shared_ptr<const scene::Icicles> prepare_icicles(const Sequence& sequence, std::shared_ptr<const std::vector<scene::DripPoint>> drips,
                                                      std::vector<std::string>& notes)
{
    scene::Icicles named;
    if (!scene::find_icicle_material(sequence.scene, named)) return nullptr;
    if (!drips) drips = prepare_drips(sequence.scene, user_cache(), notes);
    auto icicles = std::make_shared<scene::Icicles>(scene::hang_icicles(*drips, sequence.eyes_m));
    icicles->material = named.material;
    icicles->instance = named.instance;
    notes.push_back("icicles may hang at " + std::to_string(icicles->icicles.size()) + " places, in " +
                    std::to_string(icicles->triangles) + " triangles at most");
    return icicles;
}

// A renderer at work, and the picture that it is at.
struct Worker {
    explicit Worker(gpu::Renderer&& with) : renderer(std::move(with)) {}
    gpu::Renderer renderer;
    std::string environment = {};  // fingerprint of what the renderer holds
    SequenceFrame what = {};
    FrameFacts facts = {};
    gpu::RenderResult result = {};
};

// Renders the worker's picture in tiles and makes its files, beside those of the writer.
void make_in_tiles(Worker& worker, const Pending& one, const Sequence& sequence, const RenderRequest& request,
                   const TilePlan& plan, const fs::path& folder)
{
    const ScenarioOutput& output = sequence.scenario.output;
    FrameFacts& facts = worker.facts;
    facts.job = one.job;
    facts.made_from = one.made_from;
    facts.input.settings.seed = worker.what.frame.settings.seed;
    const TiledFiles files{folder, output.exr ? file_name(one.job, "exr") : "",
                           output.png ? file_name(one.job, "png") : "", frame_metadata(facts)};
    TiledOptions options{sequence.display.get(), request.threads, request.stop, {}};
    if (request.watcher)
        options.tile_done = [&](int tile) { request.watcher->tile(one.job.frame, tile, plan.count()); };
    const TiledPicture made = render_tiled(worker.renderer, worker.what.frame, plan, files, options);
    facts.beauty_hash = made.beauty_hash;
    facts.exposure = made.exposure;
    facts.falling = made.falling;
    facts.light = made.light;
    for (const std::string& name : {files.exr, files.png})
        if (!name.empty()) facts.files[name] = file_mark(folder / name);
}

void render_frames(Sequence& sequence, const RenderRequest& request,
                   const std::vector<Pending>& pending, RenderReport& report, RenderTally& tally)
{
    const ScenarioOutput& output = sequence.scenario.output;
    for (std::string& note : smoothing_notes(sequence)) report.notes.push_back(std::move(note));
    // Before the scene loses its images.
    ScenePlaces places(sequence, request.threads, request.stop, tracing_progress(request),
                       report.notes);
    std::vector<Worker> workers;
    for (gpu::Renderer& renderer :
         sequence_renderers(sequence, request, pending.size(), report)) {
        workers.emplace_back(std::move(renderer));
    }
    std::map<std::string, std::shared_ptr<const gpu::TrackSource>> tracks_of;
    for (const SequenceVariant& variant : sequence.variants)
        if (auto tracks = track_source(sequence, variant.name)) tracks_of[variant.name] = std::move(tracks);
    const int count = static_cast<int>(pending.size());
    if (request.watcher) request.watcher->begin(count, output, workers.front().renderer.device());
    {
        FrameWriter writer(request.folder, {output.exr, output.png},
                           {.stop = request.stop, .published = &tally.there});
        Meter meter(sequence);
        const TilePlan plan = plan_tiles(output.width, output.height, sequence.scenario.render.tile);
        OrderedWork work;
        work.begin = [&](std::size_t worker, std::size_t i) {
            workers[worker].what = pending[i].frame;
            workers[worker].facts = {};
            places.place(sequence, pending[i].job, workers[worker].what, workers[worker].facts);
        };
        work.make = [&](std::size_t number, std::size_t i) {
            Worker& worker = workers[number];
            const Pending& one = pending[i];
            if (one.frame.environment != worker.environment) {
                set_environment_of(worker.renderer, sequence, one.job);
                worker.environment = one.frame.environment;
            }
            if (const auto tracks = tracks_of.find(one.job.variant); tracks != tracks_of.end())
                worker.renderer.set_tracks(tracks->second);
            worker.facts.exposure_by = meter.expose(worker.renderer, one.job, worker.what.frame);
            if (pending.size() - i <= workers.size()) worker.renderer.end_metering();
            if (plan.count() > 1) {
                worker.result = {};
                make_in_tiles(worker, one, sequence, request, plan, writer.scratch());
                return;
            }
            worker.result = worker.renderer.render(worker.what.frame);
            show(worker.result, sequence.display.get(), worker.what.frame.settings.dither);
        };
        work.finish = [&](std::size_t number, std::size_t i) {
            Worker& worker = workers[number];
            const Pending& one = pending[i];
            FrameFacts facts = std::move(worker.facts);
            facts.job = one.job;
            facts.time_s = one.frame.time_s;
            facts.moment = one.frame.moment;
            facts.weather = one.frame.weather_name;
            facts.made_from = one.made_from;
            facts.input = std::move(worker.what.frame);
            writer.write(std::move(facts), std::move(worker.result));
            report.graph = worker.renderer.describe_graph();
            if (request.watcher) request.watcher->written(writer.written());
        };
        run_ordered(workers.size(), pending.size(), request.stop, work);
        writer.finish();
        report.rendered = writer.written();
        if (request.watcher) request.watcher->written(report.rendered);
    }
    for (const Worker& worker : workers) {
        const auto& said = worker.renderer.validation_messages();
        report.validation.insert(report.validation.end(), said.begin(), said.end());
    }
}

// Renderers for so many pictures, within the budget.
std::size_t renderers_for(const RenderRequest& request, const MemoryNeed& need,
                          const gpu::DeviceInfo& device, std::size_t pictures,
                          std::vector<std::string>& notes)
{
    const int wanted = request.in_flight > 0
                           ? request.in_flight
                           : frames_in_flight(device, request.threads, pictures);
    const std::uint64_t budget =
        request.memory_budget > 0 ? request.memory_budget : default_memory_budget();
    const std::uint64_t room = (budget - std::min(budget, need.total())) / need.another() + 1;
    const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(room, pictures));
    const std::size_t count = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1,
                                                      std::max<std::size_t>(most, 1));
    if (request.in_flight > 0 && room < static_cast<std::uint64_t>(wanted)) {
        notes.push_back("frames in flight: " + std::to_string(count) + " instead of " +
                        std::to_string(wanted) + ", for the memory budget (--memory)");
    }
    if (count > 1)
        notes.push_back("frames in flight: " + std::to_string(count) + " at a time, each takes about " +
                        std::to_string(need.another() >> 20) + " MiB (--frames-in-flight)");
    return count;
}

long peak_memory_mib()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

}  // namespace

void set_environment_of(gpu::Renderer& renderer, const Sequence& sequence, const Job& job)
{
    for (const SequenceVariant& variant : sequence.variants) {
        if (variant.name != job.variant) continue;
        const std::string& file = variant.conditions.sky.environment;
        renderer.set_environment(
            file.empty() ? gpu::EnvironmentMap{}
                         : read_light_picture(sequence.scenario.folder / file,
                                              variant.conditions.sky.environment_decode));
    }
}

int frames_in_flight(const gpu::DeviceInfo& device, int threads, std::size_t pictures)
{
    if (device.kind != "cpu") return 1;
    const auto cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const int used = threads > 0 ? std::min(threads, cores) : cores;
    if (used < 2) return 1;
    const int most = std::clamp(used / 4, 2, 4);
    return std::clamp(static_cast<int>(std::min<std::size_t>(pictures / 4, 4)), 1, most);
}

gpu::Renderer sequence_renderer(Sequence& sequence, const RenderRequest& request,
                                RenderReport& report)
{
    return std::move(sequence_renderers(sequence, request, 1, report).front());
}

std::vector<gpu::Renderer> sequence_renderers(Sequence& sequence, const RenderRequest& request,
                                              std::size_t pictures, RenderReport& report)
{
    const Scenario& scenario = sequence.scenario;
    scene::merge_primitives(sequence.scene);
    const TilePlan plan = plan_tiles(scenario.output.width, scenario.output.height, scenario.render.tile);
    const MemoryNeed need = check_memory(
        sequence.scene,
        {.max_size = scenario.scene.max_texture, .threads = request.threads, .stop = request.stop},
        plan.window_width(), plan.window_height(), request.memory_budget);
    gpu::WeatherMaps maps =
        read_weather_textures(scenario.render.weather_textures, scenario.folder);
    maps.tracks = all_tracks(sequence);
    const gpu::RendererOptions device{.device = request.device,
                                      .validation = request.validation,
                                      .passes_apart = request.passes_apart,
                                      .ripple_texture_size = scenario.render.ripple_texture_size};
    std::vector<gpu::Renderer> renderers;
    renderers.emplace_back(device, maps);
    const std::size_t count = renderers_for(request, need, renderers.front().device(), pictures,
                                            report.notes);
    while (renderers.size() < count) renderers.emplace_back(device, maps);
    std::vector<std::string>& warnings = sequence.scene.warnings;
    const auto said = static_cast<std::ptrdiff_t>(warnings.size());
    // Caps of snow are one thread's work of seconds: beside the tracing of patches, which leaves the scene as it is too.
    std::vector<std::string> snow_notes;
    std::future<std::shared_ptr<const scene::SnowCaps>> snow_made =
        std::async(request.threads == 1 ? std::launch::deferred : std::launch::async,
                   [&]() -> std::shared_ptr<const scene::SnowCaps> {
                       if (!may_snow(sequence, request)) return nullptr;
                       return prepare_snow(sequence.scene, sequence.eyes_m, maps.tracks, user_cache(), request.stop,
                                           snow_notes);
                   });
    std::shared_ptr<const gpu::PatchScene> patches;
    if (wants_patches(sequence)) {
        TransportOptions transport;
        transport.patches.threads = request.threads;
        transport.patches.stop = request.stop;
        transport.patches.progress = tracing_progress(request);
        transport.cache = user_cache();
        const auto made = prepare_patch_scene(sequence.scene, transport, report.notes);
        made->probes =
            prepare_probes(sequence.scene, *made, scenario.render.probes, scenario.folder, transport,
                           report.notes);
        // Rays alone start from them.
        made->patches.samples = {};
        made->near.samples = {};
        patches = made;
    } else if (sequence.scenario.render.image_based_light) {
        std::string why = "([render] indirect)";
        if (sequence.scenario.render.indirect != IndirectLight::Ambient) {
            why = "as patches of " + std::to_string(sequence.triangles) +
                  " triangles take minutes and memory ([render] indirect = \"patches\")";
        }
        report.notes.push_back("light between surfaces: ambient " + why);
    }
    std::shared_ptr<const std::vector<scene::DripPoint>> drips;
    if (may_drip(sequence, request)) drips = prepare_drips(sequence.scene, user_cache(), report.notes);
    const std::shared_ptr<const scene::Icicles> icicles = prepare_icicles(sequence, drips, report.notes);
    const std::shared_ptr<const scene::SnowCaps> snow = snow_made.get();
    report.notes.insert(report.notes.end(), snow_notes.begin(), snow_notes.end());
    TextureOptions options;
    options.max_size = scenario.scene.max_texture;
    options.prefilter.rule = scenario.scene.texture_rule;
    options.threads = request.threads;
    options.stop = request.stop;
    options.blocks = block_support(renderers.front().device());
    options.cache = user_cache();
    options.moving_roughness.resize(sequence.scene.materials.size());
    for (const scene::MaterialChange& change :
         material_changes(sequence.scenario.materials, sequence.scene.materials, 0.0)) {
        if (change.property == "roughness_factor") options.moving_roughness[change.material] = true;
    }
    const auto textures = prepare_textures(sequence.scene, options);
    report.notes.insert(report.notes.end(), warnings.begin() + said, warnings.end());
    const auto tracks = track_source(sequence, sequence.variants.front().name);
    for (gpu::Renderer& renderer : renderers) {
        renderer.load(sequence.scene, textures, snow, icicles);
        renderer.set_patches(patches);
        renderer.set_drips(drips);
        if (tracks) renderer.set_tracks(tracks);
    }
    return renderers;
}

std::string stop_message(const RenderTally& tally, const RenderRequest& request)
{
    const std::string far = tally.asked == 0 ? " before the first frame was begun"
                                             : ": " + std::to_string(tally.there) + " of " +
                                                   std::to_string(tally.asked) + " frames are in " +
                                                   printable(request.folder.string());
    return "interrupted" + far + "\n  Go on with: " + request.command;
}

RenderReport render_sequence(Sequence& sequence, const RenderRequest& request)
{
    const auto start = std::chrono::steady_clock::now();
    RenderReport report;
    const std::vector<Job> jobs = jobs_of(sequence, request.range, request.shard);
    const int asked = static_cast<int>(jobs.size());
    RenderTally own_tally;
    RenderTally& tally = request.tally ? *request.tally : own_tally;
    sequence.lighting_models = own_models_fingerprint(sequence.scene);
    const auto pending = pending_jobs(sequence, request, jobs, report.notes);
    report.kept = asked - static_cast<int>(pending.size());
    tally.there = report.kept;
    tally.asked = asked;
    try {
        if (!pending.empty()) render_frames(sequence, request, pending, report, tally);
        if (stopped(request)) throw Interrupted(stop_message(tally, request));
        finish_films(sequence, request, report);
    } catch (const std::exception&) {
        // Ctrl-C reaches the image readers and ffmpeg too; what they say then is not the news.
        if (stopped(request)) throw Interrupted(stop_message(tally, request));
        throw;
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.peak_mib = peak_memory_mib();
    return report;
}

}  // namespace petrichor::film
