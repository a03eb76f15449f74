#include "film/frames/frame_writer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <exception>
#include <glm/gtc/packing.hpp>
#include <map>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using Metadata = std::vector<std::pair<std::string, std::string>>;

std::vector<texproc::ExrChannel> exr_channels(const gpu::RenderResult& result)
{
    std::vector<texproc::ExrChannel> channels;
    const std::size_t pixels =
        static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
        texproc::ExrChannel channel{names[c], std::vector<std::uint16_t>(pixels), {}};
        for (std::size_t i = 0; i < pixels; ++i) channel.half_bits[i] = result.beauty[i * 4 + c];
        channels.push_back(std::move(channel));
    }
    for (const gpu::AovImage& aov : result.aovs) {
        const gpu::AovInfo& info = gpu::aov_table()[gpu::aov_row(aov.name)];
        const bool floats = info.precision == gpu::AovPrecision::FLOAT;
        const auto count = static_cast<std::size_t>(aov.channels);
        for (std::size_t c = 0; c < count; ++c) {
            texproc::ExrChannel channel{aov.name + "." + info.channels[c], {}, {}};
            for (std::size_t i = 0; i < pixels; ++i) {
                const float value = aov.pixels[i * count + c];
                if (floats) {
                    channel.floats.push_back(value);
                } else {
                    channel.half_bits.push_back(glm::packHalf1x16(value));
                }
            }
            channels.push_back(std::move(channel));
        }
    }
    return channels;
}

struct WrittenFrame {
    std::string line;  // for frames.jsonl
    std::vector<std::string> files;
};

WrittenFrame write_frame(const fs::path& folder, const WrittenKinds& kinds, FrameFacts facts,
                         const gpu::RenderResult& result)
{
    if (!facts.files.empty()) {  // they are made
        WrittenFrame made{frame_line(facts), {}};
        for (const auto& [name, mark] : facts.files) made.files.push_back(name);
        return made;
    }
    Hasher hasher;
    hasher.add_numbers(std::span<const std::uint16_t>(result.beauty));
    facts.beauty_hash = hasher.text();
    facts.exposure = result.exposure;
    facts.falling = result.falling;
    facts.light = result.light;
    const Metadata metadata = frame_metadata(facts);
    if (kinds.exr) {
        const std::string name = file_name(facts.job, "exr");
        texproc::write_exr(folder / name, result.width, result.height, exr_channels(result),
                           metadata);
        facts.files[name] = file_mark(folder / name);
    }
    if (kinds.png) {
        const std::string name = file_name(facts.job, "png");
        // The picture is opaque: three channels.
        std::vector<std::uint8_t> rgb;
        rgb.reserve(result.display.size() / 4 * 3);
        for (std::size_t i = 0; i + 3 < result.display.size(); i += 4) {
            rgb.insert(rgb.end(),
                       {result.display[i], result.display[i + 1], result.display[i + 2]});
        }
        texproc::write_png8(folder / name, result.width, result.height, 3, rgb, metadata);
        facts.files[name] = file_mark(folder / name);
    }
    WrittenFrame written{frame_line(facts), {}};
    for (const auto& [name, mark] : facts.files) written.files.push_back(name);
    return written;
}

}  // namespace

Metadata frame_metadata(const FrameFacts& facts)
{
    return {{"software", "petrichor " PETRICHOR_VERSION},
            {"petrichor:frame", std::to_string(facts.job.frame) + name_suffix(facts.job)},
            {"petrichor:seed", std::to_string(facts.input.settings.seed)},
            {"petrichor:settings", fingerprint_of(facts.made_from)}};
}

// Pictures are made in a folder of their own inside `folder` and appear with their lines in
// frames.jsonl. That file is written anew for it, so with many lines several frames wait for each
// other, for a second at most.
struct FrameWriter::Impl {
    using Clock = std::chrono::steady_clock;

    fs::path folder;
    WrittenKinds kinds;
    FrameWriterOptions options;
    ScratchFolder scratch;
    std::mutex guard;
    std::condition_variable changed;
    std::deque<std::pair<FrameFacts, gpu::RenderResult>> queue;
    std::exception_ptr problem;
    bool closing = false;
    std::atomic<int> written{0};
    // The thread's own: what is made and not yet published.
    std::map<Job, std::string> lines;
    std::vector<std::string> files;
    Clock::time_point last = Clock::now();
    Clock::duration wait{0};
    std::thread thread;

    Impl(fs::path into, WrittenKinds what, FrameWriterOptions how)
        : folder(std::move(into)), kinds(what), options(std::move(how)), scratch(folder)
    {
    }

    bool stopped() const { return options.stop && options.stop(); }

    void publish()
    {
        if (lines.empty()) return;
        const auto begin = Clock::now();
        const int count = static_cast<int>(lines.size());
        {
            const KeptTogether together;
            scratch.publish(files);
            files.clear();
            merge_frame_lines(folder, lines);
            lines.clear();
        }
        written += count;
        if (options.published) *options.published += count;
        last = Clock::now();
        wait = std::min<Clock::duration>(std::chrono::seconds(1), 10 * (last - begin));
    }

    // People know the folder they named, not the one that files pass through.
    std::string in_folder(std::string text) const
    {
        const std::string scratch_name = scratch.path().filename().string() + "/";
        const std::size_t at = text.find(scratch_name);
        return at == text.npos ? text : text.erase(at, scratch_name.size());
    }

    void publish_or_note()
    {
        try {
            publish();
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!problem) problem = std::current_exception();
        }
    }

    void run()
    {
        for (;;) {
            std::unique_lock lock(guard);
            const auto ready = [&] { return closing || !queue.empty(); };
            if (!changed.wait_for(lock, std::chrono::milliseconds(50), ready)) {
                // Who asked for a stop may not wait until the frame at hand is rendered.
                lock.unlock();
                if (stopped() || Clock::now() - last > wait) publish_or_note();
                continue;
            }
            if (queue.empty()) break;
            auto [facts, result] = std::move(queue.front());
            queue.pop_front();
            const bool give_up = problem != nullptr;
            lock.unlock();
            changed.notify_all();
            if (give_up) continue;
            try {
                const Job job = facts.job;
                WrittenFrame frame = write_frame(scratch.path(), kinds, std::move(facts), result);
                lines[job] = std::move(frame.line);
                files.insert(files.end(), frame.files.begin(), frame.files.end());
                if (stopped() || Clock::now() - last > wait) publish();
            } catch (const Error& error) {
                lock.lock();
                problem = std::make_exception_ptr(Error(in_folder(error.what()), error.fix()));
            } catch (...) {
                lock.lock();
                problem = std::current_exception();
            }
        }
        publish_or_note();  // frames that are made stay known even when a later one failed
    }

    void close()
    {
        {
            const std::lock_guard lock(guard);
            closing = true;
        }
        changed.notify_all();
        if (thread.joinable()) thread.join();
    }
};

FrameWriter::FrameWriter(fs::path folder, WrittenKinds kinds, FrameWriterOptions options)
    : impl_(std::make_unique<Impl>(std::move(folder), kinds, std::move(options)))
{
    impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
}

FrameWriter::~FrameWriter()
{
    impl_->close();
}

void FrameWriter::write(FrameFacts facts, gpu::RenderResult result)
{
    std::unique_lock lock(impl_->guard);
    impl_->changed.wait(
        lock, [&] { return impl_->problem || impl_->queue.size() < impl_->options.waiting; });
    if (impl_->problem) std::rethrow_exception(impl_->problem);
    impl_->queue.emplace_back(std::move(facts), std::move(result));
    lock.unlock();
    impl_->changed.notify_all();
}

void FrameWriter::finish()
{
    impl_->close();
    if (impl_->problem) std::rethrow_exception(impl_->problem);
}

const fs::path& FrameWriter::scratch() const
{
    return impl_->scratch.path();
}

int FrameWriter::written() const
{
    return impl_->written;
}

}  // namespace petrichor::film
