#include "film/jobs/render_job.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "film/data/folders.h"
#include "film/frames/film.h"
#include "film/frames/frame_writer.h"
#include "film/frames/frames_jsonl.h"
#include "film/scenes/memory_budget.h"
#include "film/scenes/scene_file.h"
#include "film/scenes/scene_textures.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

bool stopped(const RenderRequest& request)
{
    return request.stop && request.stop();
}

// One frame that still has to be rendered.
struct Pending {
    int index = 0;
    SequenceFrame frame;
    std::string fingerprint;
};

// Reads the pictures again: a file may have been damaged before its hash was taken.
std::string wrong_with_pixels(const FrameRecord& record, const fs::path& folder)
{
    for (const auto& [name, mark] : record.files) {
        try {
            const texproc::RawImage image = texproc::read_raw(folder / name);
            if (fs::path(name).extension() != ".exr" || record.beauty_hash.empty()) continue;
            std::size_t at[4];
            for (std::size_t c = 0; c < 4; ++c) {
                const auto& names = image.channel_names;
                const auto found = std::find(names.begin(), names.end(), std::string(1, "RGBA"[c]));
                if (found == names.end()) return name + " lacks a channel of the beauty";
                at[c] = static_cast<std::size_t>(found - names.begin());
            }
            const std::size_t pixels =
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
            const auto channels = static_cast<std::size_t>(image.channels);
            std::vector<std::uint16_t> beauty(pixels * 4);
            for (std::size_t i = 0; i < pixels; ++i) {
                for (std::size_t c = 0; c < 4; ++c) {
                    // With an AOV of full floats beside it the library gives all channels as
                    // floats.
                    const std::size_t from = i * channels + at[c];
                    if (image.type == texproc::PixelType::F16) {
                        std::memcpy(&beauty[4 * i + c], &image.bytes[2 * from], 2);
                    } else {
                        float value = 0.0f;
                        std::memcpy(&value, &image.bytes[4 * from], 4);
                        beauty[4 * i + c] = glm::packHalf1x16(value);
                    }
                }
            }
            Hasher hasher;
            hasher.add_numbers(std::span<const std::uint16_t>(beauty));
            if (hasher.text() != record.beauty_hash) return name + " holds other pixels";
        } catch (const Error& error) {
            return error.what();
        }
    }
    return "";
}

// "" when the frame can stay, else why not.
std::string why_again(const std::map<int, FrameRecord>& records, int frame,
                      const std::string& fingerprint, const ScenarioOutput& output,
                      const fs::path& folder, bool verify)
{
    const auto found = records.find(frame);
    if (found == records.end()) return "it is not there";
    if (found->second.settings != fingerprint) return "it would come out differently";
    for (const char* extension : {"exr", "png"}) {
        const bool wanted = extension[0] == 'e' ? output.exr : output.png;
        const std::string name = frame_file_name(frame, extension);
        if (wanted && found->second.files.count(name) == 0) return name + " was not asked for then";
    }
    const std::string wrong = wrong_with_files(found->second, folder);
    return wrong.empty() && verify ? wrong_with_pixels(found->second, folder) : wrong;
}

std::vector<Pending> pending_frames(const Sequence& sequence, const RenderRequest& request,
                                    std::vector<std::string>& notes)
{
    std::map<int, FrameRecord> records;
    if (request.resume) records = read_frame_records(request.folder);
    std::vector<Pending> pending;
    constexpr std::size_t kMostNotes = 8;
    std::size_t again = 0;
    for (int i = request.range.first; i <= request.range.last; ++i) {
        if (stopped(request)) throw Interrupted("interrupted while comparing frames");
        Pending one{i, frame_at(sequence, i), ""};
        one.fingerprint = frame_fingerprint(sequence, one.frame.frame);
        const std::string why = why_again(records, i, one.fingerprint, sequence.scenario.output,
                                          request.folder, request.verify);
        if (request.resume && why.empty()) continue;
        if (records.count(i) != 0 && ++again <= kMostNotes)
            notes.push_back("frame " + std::to_string(i) + " is rendered again: " + why);
        pending.push_back(std::move(one));
    }
    if (again > kMostNotes)
        notes.push_back("... and " + std::to_string(again - kMostNotes) + " more");
    return pending;
}

// Frames of the whole sequence that are not there as they should be, for the film.
int frames_missing_for_film(const Sequence& sequence, const RenderRequest& request)
{
    const auto records = read_frame_records(request.folder);
    int missing = 0;
    for (int i = 0; i < sequence.scenario.output.frames; ++i) {
        if (stopped(request)) throw Interrupted("interrupted while comparing frames");
        const auto fingerprint = frame_fingerprint(sequence, frame_at(sequence, i).frame);
        if (!why_again(records, i, fingerprint, sequence.scenario.output, request.folder, false)
                 .empty())
            ++missing;
    }
    return missing;
}

void finish_film(const Sequence& sequence, const RenderRequest& request, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    if (!output.film || !output.png || output.frames < 2) return;
    const fs::path film = request.folder / "film.mp4";
    if (report.rendered == 0 && fs::exists(film)) return;
    if (find_ffmpeg().empty()) {
        report.notes.push_back("no film: ffmpeg is not installed (apt-get install ffmpeg)");
        return;
    }
    if (const int missing = frames_missing_for_film(sequence, request)) {
        // An older film would show other frames than those beside it.
        std::error_code ignored;
        fs::remove(film, ignored);
        report.notes.push_back("no film yet: " + std::to_string(missing) + " of " +
                               std::to_string(output.frames) + " frames are not rendered");
        return;
    }
    make_film(request.folder, 0, output.frames, output.fps, film, request.stop);
    report.film = true;
}

gpu::Renderer make_renderer(Sequence& sequence, const RenderRequest& request, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    check_memory(sequence.scene,
                 {.max_size = sequence.scenario.scene.max_texture,
                  .threads = request.threads,
                  .stop = request.stop},
                 output.width, output.height, request.memory_budget);
    gpu::Renderer renderer({.device = request.device, .validation = request.validation});
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
    if (!sequence.scenario.sky.environment.empty()) {
        renderer.set_environment(
            read_environment(sequence.scenario.folder / sequence.scenario.sky.environment));
    }
    return renderer;
}

void render_frames(Sequence& sequence, const RenderRequest& request,
                   const std::vector<Pending>& pending, RenderReport& report)
{
    const ScenarioOutput& output = sequence.scenario.output;
    gpu::Renderer renderer = make_renderer(sequence, request, report);
    const int count = static_cast<int>(pending.size());
    if (request.watcher) request.watcher->begin(count, output, renderer.device());
    std::uint32_t overflows = 0;
    {
        FrameWriter writer(request.folder, {output.exr, output.png}, 2, request.stop);
        for (const Pending& one : pending) {
            if (stopped(request)) break;
            gpu::RenderResult result = renderer.render(one.frame.frame);
            overflows = std::max(overflows, result.light_list_overflows);
            FrameFacts facts;
            facts.frame = one.index;
            facts.time_s = one.frame.time_s;
            facts.weather = request.weather_name;
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
    if (overflows > 0) {
        report.notes.push_back(
            "up to " + std::to_string(overflows) +
            " tiles of a frame see more lights than a list holds; the faintest are left out");
    }
    report.validation = renderer.validation_messages();
}

long peak_memory_mib()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

}  // namespace

RenderReport render_sequence(Sequence& sequence, const RenderRequest& request)
{
    const auto start = std::chrono::steady_clock::now();
    RenderReport report;
    const int asked = request.range.last - request.range.first + 1;
    const auto stop = [&](int done) {
        return Interrupted("interrupted: " + std::to_string(done) + " of " + std::to_string(asked) +
                           " frames are in " + printable(request.folder.string()) +
                           "\n  Go on with: " + request.command);
    };
    const auto pending = pending_frames(sequence, request, report.notes);
    report.kept = asked - static_cast<int>(pending.size());
    try {
        if (!pending.empty()) render_frames(sequence, request, pending, report);
        if (stopped(request)) throw stop(report.kept + report.rendered);
        finish_film(sequence, request, report);
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
