#include "texproc/codecs/files/detail/decoder_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>
#include <vector>

#include "base/error.h"
#include "texproc/codecs/files/detail/message.h"
#include "texproc/codecs/files/detail/protocol.h"

extern "C" char** environ;

namespace petrichor::texproc::detail {

namespace {

namespace fs = std::filesystem;

constexpr int kPatienceMs =
    300'000;  // the child's own CPU limit ends it long before, unless it sleeps

// The decoder lies beside the program (build tree, portable copy), in its libexec folder
// (installed), or where this library was built.
fs::path decoder_program()
{
    std::vector<fs::path> places;
    if (const char* named = std::getenv("PETRICHOR_DECODER")) places.emplace_back(named);
    std::error_code ignored;
    const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    places.push_back(here / "petrichor-decode");
    places.push_back(here / "../libexec/petrichor/petrichor-decode");
    places.emplace_back(PETRICHOR_DECODER_INSTALLED);
    places.emplace_back(PETRICHOR_DECODER_BUILT);
    for (const fs::path& place : places) {
        if (::access(place.c_str(), X_OK) == 0) return place;
    }
    std::string looked;
    for (const fs::path& place : places) looked += (looked.empty() ? "" : ", ") + place.string();
    throw Error("images: the program petrichor-decode is missing (looked at " + looked + ")",
                "Install it beside petrichor, or set PETRICHOR_DECODER to its path.");
}

class Worker {
public:
    Worker()
    {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("socketpair");
        socket_ = ends[0];
        const std::string program = decoder_program().string();
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        // dup2 onto itself would keep close-on-exec; libc clears the flag in that case.
        posix_spawn_file_actions_adddup2(&actions, ends[1], kDecoderSocket);
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
        // Ctrl-C in the terminal is for the program; it closes the socket and the child ends.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        char name[] = "petrichor-decode";
        char* arguments[] = {name, nullptr};
        const int failed =
            ::posix_spawn(&pid_, program.c_str(), &actions, &attributes, arguments, environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        ::close(ends[1]);
        if (failed) {
            ::close(socket_);
            errno = failed;
            fail("starting " + program);
        }
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() { stop(false); }

    void send(const Request& request, int fd)
    {
        // A failed send shows as a closed socket in receive().
        (void)send_message(socket_, request, fd);
    }

    // False: the child died or said nothing in time; why() tells.
    bool receive(Reply& reply, int& fd)
    {
        pollfd waiting{socket_, POLLIN, 0};
        int ready = 0;
        do {
            ready = ::poll(&waiting, 1, kPatienceMs);
        } while (ready < 0 && errno == EINTR);
        if (ready == 0) {
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
    [[noreturn]] static void fail(const std::string& what)
    {
        throw Error("images: cannot start a decoder process: " + what + ": " + std::strerror(errno),
                    "Close some programs, or raise the limits on processes and open files.");
    }

    void stop(bool kill)
    {
        if (pid_ <= 0) return;
        if (kill) ::kill(pid_, SIGKILL);
        ::close(socket_);
        int status = 0;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
        if (WIFSIGNALED(status)) {
            why_ = WTERMSIG(status) == SIGXCPU
                       ? "the image library did not finish in the time that its size allows"
                       : "the image library crashed on it (signal " +
                             std::to_string(WTERMSIG(status)) + ")";
        } else {
            why_ = "the image library gave up on it";
        }
    }

    pid_t pid_ = -1;
    int socket_ = -1;
    std::string why_;
};

// Idle decoders of this process. They are operating-system processes, so there is one pool a
// process; it holds no other state, and what a decoder did before never shows in a result.
class Pool {
public:
    std::unique_ptr<Worker> take()
    {
        std::unique_lock lock(mutex_);
        free_.wait(lock, [&] { return !idle_.empty() || busy_ < limit_; });
        ++busy_;
        if (!idle_.empty()) {
            auto worker = std::move(idle_.back());
            idle_.pop_back();
            return worker;
        }
        lock.unlock();
        try {
            return std::make_unique<Worker>();
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
    explicit Memory(std::span<const std::byte> bytes)
    {
        fd = ::memfd_create("petrichor-bytes", MFD_CLOEXEC);
        std::size_t done = 0;
        while (fd >= 0 && done < bytes.size()) {
            const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
            if (n <= 0) break;
            done += static_cast<std::size_t>(n);
        }
        if (fd < 0 || done < bytes.size()) {
            throw Error(std::string("images: no shared memory: ") + std::strerror(errno),
                        "Free some memory and try again.");
        }
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

Outcome ask(const Request& request, int fd)
{
    auto worker = pool().take();
    auto outcome = std::make_unique<Outcome>();
    worker->send(request, fd);
    outcome->alive = worker->receive(outcome->reply, outcome->fd);
    outcome->why = worker->why();
    pool().give(outcome->alive && !outcome->reply.last ? std::move(worker) : nullptr);
    return std::move(*outcome);
}

void set_text(Request& request, const std::string& text)
{
    if (text.size() >= kTextBytes) {
        throw Error("images: the name " + text.substr(0, 80) + "... is too long",
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

Decoded decode_in_child(const std::string& name, std::span<const std::byte> bytes,
                        const ReadOptions& options)
{
    Request request;
    request.max_pixels = options.max_pixels;
    request.max_bytes = options.max_bytes;
    set_text(request, name);
    std::unique_ptr<Memory> memory;
    if (!bytes.empty()) {
        memory = std::make_unique<Memory>(bytes);
        request.has_fd = 1;
    }
    const Outcome outcome = ask(request, memory ? memory->fd : -1);
    const Reply& reply = outcome.reply;
    if (!outcome.alive || !reply.ok) {
        const std::string why = outcome.alive ? reply.text : outcome.why;
        const bool limit = why.find("limit of") != std::string::npos;
        throw Error("image " + name + ": " + why,
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
        throw Error("image " + name + ": the decoder process answered nonsense",
                    "Export the file again; it is damaged.");
    }
    std::istringstream names(reply.text);
    for (std::string line; std::getline(names, line);) shape.channel_names.push_back(line);
    return Decoded(outcome.fd, std::move(shape));
}

void encode_in_child(const fs::path& path, const RawImage& image, int quality)
{
    Request request;
    request.task = Task::Encode;
    request.has_fd = 1;
    request.width = image.width;
    request.height = image.height;
    request.channels = image.channels;
    request.type = static_cast<std::uint32_t>(image.type);
    request.quality = static_cast<std::uint32_t>(quality);
    set_text(request, path.string());
    const Memory memory(image.bytes);
    const Outcome outcome = ask(request, memory.fd);
    if (!outcome.alive || !outcome.reply.ok) {
        throw Error("output: cannot write " + path.string() + ": " +
                        (outcome.alive ? outcome.reply.text : outcome.why),
                    "Check that the folder is writable and the disk is not full.");
    }
}

}  // namespace petrichor::texproc::detail
