#include "film/frames/frame_writer.h"

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

#include "base/hash.h"
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

}  // namespace

std::string frame_file_name(int frame, const std::string& extension)
{
    char name[48];
    std::snprintf(name, sizeof name, "frame_%04d.%s", frame, extension.c_str());
    return name;
}

std::string write_frame(const fs::path& folder, const WrittenKinds& kinds, FrameFacts facts,
                        const gpu::RenderResult& result)
{
    Hasher hasher;
    hasher.add_numbers(std::span<const std::uint16_t>(result.beauty));
    facts.beauty_hash = hasher.text();
    facts.exposure = result.exposure;
    const Metadata metadata{{"software", "petrichor " PETRICHOR_VERSION},
                            {"petrichor:frame", std::to_string(facts.frame)},
                            {"petrichor:seed", std::to_string(facts.input.settings.seed)},
                            {"petrichor:settings", facts.settings}};
    if (kinds.exr) {
        const std::string name = frame_file_name(facts.frame, "exr");
        texproc::write_exr(folder / name, result.width, result.height, exr_channels(result),
                           metadata);
        facts.files[name] = file_mark(folder / name);
    }
    if (kinds.png) {
        const std::string name = frame_file_name(facts.frame, "png");
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
    return frame_line(facts);
}

struct FrameWriter::Impl {
    fs::path folder;
    WrittenKinds kinds;
    std::size_t waiting = 2;
    StopRequest stop;
    std::mutex guard;
    std::condition_variable changed;
    std::deque<std::pair<FrameFacts, gpu::RenderResult>> queue;
    std::exception_ptr problem;
    bool closing = false;
    std::atomic<int> written{0};
    std::map<int, std::string> lines;  // not yet in frames.jsonl; the thread's own
    std::thread thread;

    void flush()
    {
        if (lines.empty()) return;
        merge_frame_lines(folder, lines);
        lines.clear();
    }

    void flush_or_note()
    {
        try {
            flush();
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!problem) problem = std::current_exception();
        }
    }

    void run()
    {
        auto last_flush = std::chrono::steady_clock::now();
        for (;;) {
            std::unique_lock lock(guard);
            const auto ready = [&] { return closing || !queue.empty(); };
            if (!changed.wait_for(lock, std::chrono::milliseconds(100), ready)) {
                // Who asked for a stop may not wait until the frame at hand is done.
                lock.unlock();
                if (stop && stop()) flush_or_note();
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
                const int frame = facts.frame;
                lines[frame] = write_frame(folder, kinds, std::move(facts), result);
                ++written;
                if ((stop && stop()) ||
                    std::chrono::steady_clock::now() - last_flush > std::chrono::seconds(1)) {
                    flush();
                    last_flush = std::chrono::steady_clock::now();
                }
            } catch (...) {
                lock.lock();
                problem = std::current_exception();
            }
        }
        flush_or_note();  // frames that are on the disk stay known even when a later one failed
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

FrameWriter::FrameWriter(fs::path folder, WrittenKinds kinds, int waiting, StopRequest stop)
    : impl_(std::make_unique<Impl>())
{
    impl_->folder = std::move(folder);
    impl_->kinds = kinds;
    impl_->stop = std::move(stop);
    impl_->waiting = static_cast<std::size_t>(waiting);
    impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
}

FrameWriter::~FrameWriter()
{
    impl_->close();
}

void FrameWriter::write(FrameFacts facts, gpu::RenderResult result)
{
    std::unique_lock lock(impl_->guard);
    impl_->changed.wait(lock,
                        [&] { return impl_->problem || impl_->queue.size() < impl_->waiting; });
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

int FrameWriter::written() const
{
    return impl_->written;
}

}  // namespace petrichor::film
