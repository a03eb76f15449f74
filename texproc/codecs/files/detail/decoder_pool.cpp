#include "texproc/codecs/files/detail/decoder_pool.h"

#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/limited_child.h"
#include "base/words.h"
#include "texproc/codecs/files/detail/message.h"
#include "texproc/codecs/files/detail/protocol.h"
#include "texproc/codecs/files/detail/sniff.h"

namespace petrichor::texproc::detail {

namespace {

namespace fs = std::filesystem;

constexpr double kPatienceSeconds =
    300.0;  // the child's own CPU limit ends it long before, unless it sleeps
// Of all files that one child reads; for each file it sets a limit that fits its size.
constexpr ChildLimits kLimits{
    .memory_bytes = 3ull << 30, .cpu_seconds = 24 * 3600, .file_bytes = 4ull << 30};

// Beside the program (build tree, portable copy), in its libexec folder (installed), or where this
// library was built.
fs::path decoder_program()
{
    const char* named = std::getenv("PETRICHOR_DECODER");
    if (named && ::access(named, X_OK) == 0) return named;
    return find_helper("petrichor-decode", {PETRICHOR_DECODER_INSTALLED, PETRICHOR_DECODER_BUILT});
}

// One decoder process. The image library takes a fifth of a second to load, so there are two kinds.
class Worker {
public:
    explicit Worker(bool library) : library_(library)
    {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
            throw Error(
                std::string("images: no socket to a decoder process: ") + std::strerror(errno),
                "Close some programs, or raise the limit on open files (ulimit -n).");
        }
        socket_ = ends[0];
        try {
            child_.emplace(
                decoder_program(),
                library ? std::vector<std::string>{"--library"} : std::vector<std::string>{},
                kLimits, std::vector<std::pair<int, int>>{{ends[1], kDecoderSocket}});
        } catch (...) {
            ::close(ends[0]);
            ::close(ends[1]);
            throw;
        }
        ::close(ends[1]);
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() { stop(true); }

    bool library() const { return library_; }

    void send(const Request& request, int fd)
    {
        // A failed send shows as a closed socket in receive().
        (void)send_message(socket_, request, fd);
    }

    // False: the child died or said nothing in time; why() tells.
    bool receive(Reply& reply, int& fd, const StopRequest& stop_request)
    {
        if (!wait_readable(socket_, kPatienceSeconds, stop_request)) {
            stop(true);
            why_ = "the image library gave no answer in time";
            return false;
        }
        iovec data{&reply, sizeof reply};
        alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
        msghdr message{};
        message.msg_iov = &data;
        message.msg_iovlen = 1;
        message.msg_control = control;
        message.msg_controllen = sizeof control;
        const ssize_t got = ::recvmsg(socket_, &message, MSG_CMSG_CLOEXEC);
        fd = -1;
        const cmsghdr* c = CMSG_FIRSTHDR(&message);
        if (got > 0 && c && c->cmsg_type == SCM_RIGHTS) std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
        if (got == sizeof reply) {
            reply.text[kTextBytes - 1] = 0;
            return true;
        }
        stop(false);
        return false;
    }

    const std::string& why() const { return why_; }

private:
    void stop(bool kill)
    {
        if (!child_) return;
        ::close(socket_);
        const ChildEnd end = child_->end(kill);
        child_.reset();
        why_ = "the image library " + end.text();
    }

    bool library_ = false;
    std::optional<LimitedChild> child_;
    int socket_ = -1;
    std::string why_;
};

// Idle decoders of this process. They are operating-system processes, so there is one pool a
// process; it holds no other state, and what a decoder did before never shows in a result.
class Pool {
public:
    std::unique_ptr<Worker> take(bool library)
    {
        std::unique_lock lock(mutex_);
        free_.wait(lock, [&] { return busy_ < limit_; });
        ++busy_;
        // One with the library reads everything.
        const auto fits = [&](const auto& worker) { return worker->library() || !library; };
        const auto found = std::find_if(idle_.begin(), idle_.end(), fits);
        if (found != idle_.end()) {
            auto worker = std::move(*found);
            idle_.erase(found);
            return worker;
        }
        if (busy_ + idle_.size() > limit_ && !idle_.empty()) idle_.pop_back();
        lock.unlock();
        try {
            return std::make_unique<Worker>(library);
        } catch (...) {
            give(nullptr);
            throw;
        }
    }

    void give(std::unique_ptr<Worker> worker)
    {
        const std::lock_guard lock(mutex_);
        --busy_;
        if (worker) idle_.push_back(std::move(worker));
        free_.notify_one();
    }

private:
    std::mutex mutex_;
    std::condition_variable free_;
    std::vector<std::unique_ptr<Worker>> idle_;
    std::size_t busy_ = 0;
    const std::size_t limit_ = std::max(1u, std::thread::hardware_concurrency());
};

Pool& pool()
{
    static Pool the_pool;
    return the_pool;
}

struct Memory {
    int fd = -1;
    Memory(std::span<const std::byte> bytes, std::string_view what)
        : fd(shared_memory_of(bytes, what))
    {
    }
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    ~Memory() { ::close(fd); }
};

struct Outcome {
    bool alive = false;
    Reply reply;
    int fd = -1;
    std::string why;
};

// Gives the worker back, whatever happens; one that did not answer is ended instead.
struct Borrowed {
    std::unique_ptr<Worker> worker;
    bool keep = false;
    explicit Borrowed(bool library) : worker(pool().take(library)) {}
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed()
    {
        if (!keep) worker.reset();
        pool().give(std::move(worker));
    }
};

Outcome ask(const Request& request, int fd, bool library, const StopRequest& stop)
{
    auto outcome = std::make_unique<Outcome>();
    {
        Borrowed borrowed(library);
        borrowed.worker->send(request, fd);
        outcome->alive = borrowed.worker->receive(outcome->reply, outcome->fd, stop);
        outcome->why = borrowed.worker->why();
        borrowed.keep = outcome->alive && !outcome->reply.last;
    }
    if (outcome->alive && !outcome->reply.ok && outcome->reply.needs_library && !library)
        return ask(request, fd, true, stop);
    return std::move(*outcome);
}

void set_text(Request& request, const std::string& text)
{
    if (text.size() >= kTextBytes) {
        throw Error("images: the name " + printable(text.substr(0, 80)) + "... is too long",
                    "Use a path of less than 8 KiB.");
    }
    std::memcpy(request.text, text.c_str(), text.size() + 1);
}

}  // namespace

Decoded::~Decoded()
{
    if (fd_ >= 0) ::close(fd_);
}

void Decoded::read(std::uint64_t offset, std::span<std::byte> to) const
{
    std::size_t done = 0;
    while (done < to.size()) {
        const ssize_t n =
            ::pread(fd_, to.data() + done, to.size() - done, static_cast<off_t>(offset + done));
        if (n <= 0) {
            throw Error("images: the decoder process returned too few pixels",
                        "Report this file: it should not be possible.");
        }
        done += static_cast<std::size_t>(n);
    }
}

namespace {

Decoded decode(Task task, const std::string& name, int file, const ReadOptions& options)
{
    const std::string what = "image " + printable(name);
    std::byte head[32];
    const ssize_t got = ::pread(file, head, sizeof head, 0);
    if (got < 0) throw Error(what + ": " + std::strerror(errno), "Check that it may be read.");
    if (got == 0) throw Error(what + ": it is empty", "Export the file again.");
    const std::string format = sniff({head, static_cast<std::size_t>(got)}, name);
    if (format.empty()) {
        throw Error(what +
                        ": its content is none of PNG, TGA, TIFF, PSD, EXR, HDR, JPEG, WebP, BMP, "
                        "DDS, KTX2, GIF, PNM, SGI",
                    "Check that the file is an image and opens in another program; export it again "
                    "if it is damaged.");
    }
    Request request;
    request.task = task;
    request.max_side = options.max_side;
    request.linear = options.space == ColorSpace::Linear ? 1 : 0;
    request.max_pixels = options.max_pixels;
    request.max_bytes = options.max_bytes;
    std::memcpy(request.format, format.c_str(), format.size() + 1);
    const bool own_reader = format == "png" || format == "dds" || format == "ktx2" ||
                            format == "psd" || format == "sgi";
    const Outcome outcome = ask(request, file, !own_reader, options.stop);
    const Reply& reply = outcome.reply;
    if (!outcome.alive || !reply.ok) {
        const std::string why = outcome.alive ? printable(reply.text) : outcome.why;
        const bool limit = why.find("limit of") != std::string::npos;
        throw Error(what + ": " + why,
                    limit ? "Use a smaller image, or raise the limit (--max-pixels)."
                          : "Check that the file is an image and opens in another program; export "
                            "it again if it is damaged.");
    }
    RawImage shape{
        reply.width, reply.height, reply.channels, static_cast<PixelType>(reply.type), {}, {}};
    // The child is not trusted: its numbers must keep the limits that it was given.
    const double pixels = static_cast<double>(shape.width) * static_cast<double>(shape.height);
    if (outcome.fd < 0 || shape.width < 1 || shape.height < 1 || shape.channels < 1 ||
        reply.type > 3 || pixels > static_cast<double>(options.max_pixels) ||
        pixels * 4.0 * shape.channels > static_cast<double>(options.max_bytes)) {
        if (outcome.fd >= 0) ::close(outcome.fd);
        throw Error(what + ": the decoder process answered nonsense",
                    "Export the file again; it is damaged.");
    }
    std::istringstream names(reply.text);
    for (std::string line; std::getline(names, line);) shape.channel_names.push_back(line);
    return Decoded(outcome.fd, std::move(shape));
}

}  // namespace

Decoded decode_in_child(const std::string& name, int file, const ReadOptions& options)
{
    return decode(Task::Decode, name, file, options);
}

RawImage shape_in_child(const std::string& name, std::span<const std::byte> bytes,
                        const ReadOptions& options)
{
    const Memory memory(bytes, "image " + printable(name));
    return decode(Task::Shape, name, memory.fd, options).shape();
}

Decoded decode_in_child(const std::string& name, std::span<const std::byte> bytes,
                        const ReadOptions& options)
{
    const Memory memory(bytes, "image " + printable(name));
    return decode_in_child(name, memory.fd, options);
}

std::vector<std::byte> encode_in_child(const fs::path& path, const RawImage& image, int quality)
{
    Request request;
    request.task = Task::Encode;
    request.width = image.width;
    request.height = image.height;
    request.channels = image.channels;
    request.type = static_cast<std::uint32_t>(image.type);
    request.quality = static_cast<std::uint32_t>(quality);
    set_text(request, "image" + path.extension().string());
    const std::string what = "output " + printable(path.string());
    const Memory memory(image.bytes, what);
    const Outcome outcome = ask(request, memory.fd, true, {});
    if (!outcome.alive || !outcome.reply.ok) {
        if (outcome.fd >= 0) ::close(outcome.fd);
        throw Error(what + ": it cannot be encoded: " +
                        (outcome.alive ? printable(outcome.reply.text) : outcome.why),
                    "Choose another format: png and exr are written without the image library.");
    }
    const Decoded file(outcome.fd, {});
    std::vector<std::byte> bytes(outcome.reply.bytes);
    file.read(0, bytes);
    return bytes;
}

std::string decoder_confinement()
{
    Request request;
    request.task = Task::Report;
    const Outcome outcome = ask(request, -1, false, {});
    return outcome.alive ? printable(outcome.reply.text) : outcome.why;
}

}  // namespace petrichor::texproc::detail
