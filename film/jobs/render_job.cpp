#include "film/jobs/render_job.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "film/data/folders.h"
#include "film/frames/film.h"
#include "film/frames/frame_writer.h"
#include "film/frames/frames_jsonl.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/scene_textures.h"

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
    std::string fingerprint;
};

bool is_kept(const std::map<Job, FrameRecord>& records, const Job& job,
             const std::string& fingerprint, const ScenarioOutput& output, const fs::path& folder)
{
    const auto found = records.find(job);
    if (found == records.end() || found->second.settings != fingerprint) return false;
    const auto has = [&](const char* extension) {
        return found->second.files.count(file_name(job, extension)) != 0;
    };
    return (!output.exr || has("exr")) && (!output.png || has("png")) &&
           files_are_whole(found->second, folder);
}

std::vector<Pending> pending_jobs(const Sequence& sequence, const RenderRequest& request,
                                  const std::vector<Job>& jobs)
{
    std::map<Job, FrameRecord> records;
    if (request.resume) records = read_frame_records(request.folder);
    std::vector<Pending> pending;
    for (const Job& job : jobs) {
        Pending one{job, frame_at(sequence, job), ""};
        one.fingerprint = frame_fingerprint(sequence, one.frame);
        if (is_kept(records, job, one.fingerprint, sequence.scenario.output, request.folder))
            continue;
        pending.push_back(std::move(one));
    }
    return pending;
}

// Frames of a variant and view that are not there as they should be, for its film.
int frames_missing_for_film(const Sequence& sequence, const std::map<Job, FrameRecord>& records,
                            Job job, const fs::path& folder)
{
    int missing = 0;
    for (job.frame = 0; job.frame < sequence.scenario.output.frames; ++job.frame) {
        const auto fingerprint = frame_fingerprint(sequence, frame_at(sequence, job));
        if (!is_kept(records, job, fingerprint, sequence.scenario.output, folder)) ++missing;
    }
    return missing;
}

void finish_film(const Sequence& sequence, const RenderRequest& request, const Job& part,
                 const std::map<Job, FrameRecord>& records, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    const fs::path film = request.folder / ("film" + name_suffix(part) + ".mp4");
    if (report.rendered == 0 && fs::exists(film)) return;
    if (const int missing = frames_missing_for_film(sequence, records, part, request.folder)) {
        // An older film would show other frames than those beside it.
        std::error_code ignored;
        fs::remove(film, ignored);
        report.notes.push_back("no " + film.filename().string() +
                               " yet: " + std::to_string(missing) + " of " +
                               std::to_string(output.frames) + " frames are not rendered");
        return;
    }
    make_film(request.folder, name_suffix(part), 0, output.frames, output.fps, film);
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

void render_frames(Sequence& sequence, const RenderRequest& request,
                   const std::vector<Pending>& pending, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    gpu::Renderer renderer = sequence_renderer(sequence, request, report);
    const int count = static_cast<int>(pending.size());
    if (request.watcher) request.watcher->begin(count, output, renderer.device());
    std::string environment;  // fingerprint of what the renderer holds
    {
        FrameWriter writer(request.folder, {output.exr, output.png});
        for (const Pending& one : pending) {
            if (stopped(request)) break;
            if (one.frame.environment != environment) {
                set_environment_of(renderer, sequence, one.job);
                environment = one.frame.environment;
            }
            gpu::RenderResult result = renderer.render(one.frame.frame);
            FrameFacts facts;
            facts.job = one.job;
            facts.time_s = one.frame.time_s;
            facts.moment = one.frame.moment;
            facts.weather = one.frame.weather_name;
            facts.settings = one.fingerprint;
            facts.input = one.frame.frame;
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
        renderer.set_environment(file.empty() ? gpu::EnvironmentMap{}
                                              : read_environment(sequence.scenario.folder / file));
    }
}

gpu::Renderer sequence_renderer(Sequence& sequence, const RenderRequest& request,
                                RenderReport& report)
{
    gpu::Renderer renderer({.device = request.device,
                            .validation = request.validation,
                            .ripple_texture_size = sequence.scenario.render.ripple_texture_size});
    std::vector<std::string>& warnings = sequence.scene.warnings;
    const auto said = static_cast<std::ptrdiff_t>(warnings.size());
    TextureOptions options;
    options.max_size = sequence.scenario.scene.max_texture;
    options.threads = request.threads;
    options.stop = request.stop;
    options.blocks = block_support(renderer.device());
    options.cache = user_cache();
    const auto textures = prepare_textures(sequence.scene, options);
    report.notes.insert(report.notes.end(), warnings.begin() + said, warnings.end());
    renderer.load(sequence.scene, textures);
    return renderer;
}

RenderReport render_sequence(Sequence& sequence, const RenderRequest& request)
{
    const auto start = std::chrono::steady_clock::now();
    RenderReport report;
    const std::vector<Job> jobs = jobs_of(sequence, request.range, request.shard);
    const int asked = static_cast<int>(jobs.size());
    const auto stop = [&](int done) {
        return Interrupted("interrupted: " + std::to_string(done) + " of " + std::to_string(asked) +
                           " frames are in " + request.folder.string() +
                           "\n  Go on with: " + request.command);
    };
    const auto pending = pending_jobs(sequence, request, jobs);
    report.kept = asked - static_cast<int>(pending.size());
    try {
        if (!pending.empty()) render_frames(sequence, request, pending, report);
        if (stopped(request)) throw stop(report.kept + report.rendered);
        finish_films(sequence, request, report);
    } catch (const std::exception&) {
        // Ctrl-C reaches the image readers and ffmpeg too; what they say then is not the news.
        if (stopped(request)) throw stop(report.kept + report.rendered);
        throw;
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.peak_mib = peak_memory_mib();
    return report;
}

}  // namespace petrichor::film
