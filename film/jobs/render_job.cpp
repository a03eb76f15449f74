#include "film/jobs/render_job.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "film/frames/film.h"
#include "film/frames/frame_writer.h"
#include "film/frames/frames_jsonl.h"
#include "film/frames/kept.h"
#include "film/jobs/exposure.h"
#include "film/jobs/scene_places.h"
#include "film/jobs/scene_source.h"
#include "film/scenario/material_keys.h"
#include "film/scenes/light_picture.h"
#include "film/scenes/memory_budget.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/scene_probes.h"
#include "film/scenes/scene_textures.h"
#include "film/scenes/snow_scene.h"
#include "film/scenes/snow_tracks.h"
#include "film/scenes/transport.h"
#include "film/scenes/weather_textures.h"
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

void render_frames(Sequence& sequence, const RenderRequest& request,
                   const std::vector<Pending>& pending, RenderReport& report, RenderTally& tally)
{
    const ScenarioOutput& output = sequence.scenario.output;
    // Before the scene loses its images.
    ScenePlaces places(sequence, request.threads, request.stop, tracing_progress(request),
                       report.notes);
    gpu::Renderer renderer = sequence_renderer(sequence, request, report);
    const int count = static_cast<int>(pending.size());
    if (request.watcher) request.watcher->begin(count, output, renderer.device());
    std::string environment;  // fingerprint of what the renderer holds
    {
        FrameWriter writer(request.folder, {output.exr, output.png},
                           {.stop = request.stop, .published = &tally.there});
        Meter meter(sequence);
        for (const Pending& one : pending) {
            if (stopped(request)) break;
            if (one.frame.environment != environment) {
                set_environment_of(renderer, sequence, one.job);
                environment = one.frame.environment;
            }
            FrameFacts facts;
            SequenceFrame what = one.frame;
            const ExposureFacts exposure = meter.expose(renderer, one.job, what.frame);
            places.place(sequence, one.job, what, facts);
            gpu::RenderResult result = renderer.render(what.frame);
            facts.job = one.job;
            facts.time_s = one.frame.time_s;
            facts.moment = one.frame.moment;
            facts.weather = one.frame.weather_name;
            facts.made_from = one.made_from;
            facts.input = std::move(what.frame);
            facts.exposure_by = exposure;
            writer.write(std::move(facts), std::move(result));
            if (request.watcher) request.watcher->written(writer.written());
        }
        writer.finish();
        report.rendered = writer.written();
        if (request.watcher) request.watcher->written(report.rendered);
    }
    report.graph = renderer.describe_graph();
    report.validation = renderer.validation_messages();
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

gpu::Renderer sequence_renderer(Sequence& sequence, const RenderRequest& request,
                                RenderReport& report)
{
    const Scenario& scenario = sequence.scenario;
    scene::merge_primitives(sequence.scene);
    check_memory(
        sequence.scene,
        {.max_size = scenario.scene.max_texture, .threads = request.threads, .stop = request.stop},
        scenario.output.width, scenario.output.height, request.memory_budget);
    gpu::WeatherMaps maps =
        read_weather_textures(scenario.render.weather_textures, scenario.folder);
    maps.tracks = draw_tracks(scenario.ground.tracks);
    gpu::Renderer renderer(
        {.device = request.device,
         .validation = request.validation,
         .ripple_texture_size = scenario.render.ripple_texture_size},
        maps);
    std::vector<std::string>& warnings = sequence.scene.warnings;
    const auto said = static_cast<std::ptrdiff_t>(warnings.size());
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
        patches = made;
    } else if (sequence.scenario.render.image_based_light) {
        std::string why = "([render] indirect)";
        if (sequence.scenario.render.indirect != IndirectLight::Ambient) {
            why = "as patches of " + std::to_string(sequence.triangles) +
                  " triangles take minutes and memory ([render] indirect = \"patches\")";
        }
        report.notes.push_back("light between surfaces: ambient " + why);
    }
    std::shared_ptr<const scene::SnowCaps> snow;
    if (may_snow(sequence, request))
        snow = prepare_snow(sequence.scene, sequence.eyes_m, maps.tracks, user_cache(), report.notes);
    TextureOptions options;
    options.max_size = scenario.scene.max_texture;
    options.threads = request.threads;
    options.stop = request.stop;
    options.blocks = block_support(renderer.device());
    options.cache = user_cache();
    options.moving_roughness.resize(sequence.scene.materials.size());
    for (const scene::MaterialChange& change :
         material_changes(sequence.scenario.materials, sequence.scene.materials, 0.0)) {
        if (change.property == "roughness_factor") options.moving_roughness[change.material] = true;
    }
    const auto textures = prepare_textures(sequence.scene, options);
    report.notes.insert(report.notes.end(), warnings.begin() + said, warnings.end());
    renderer.load(sequence.scene, textures, std::move(snow));
    renderer.set_patches(std::move(patches));
    return renderer;
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
