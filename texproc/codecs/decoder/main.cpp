// petrichor-decode: the process that touches untrusted image files. The image library (loaded when
// a file needs it) aborts or loops on some damaged ones, so it runs here, with limits on memory and
// time, and the program only ever sees pixels or a reason. It serves requests on socket 3 until the
// other end closes, one at a time; the program starts several for several files.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "texproc/codecs/decoder/image_library.h"
#include "texproc/codecs/decoder/png.h"
#include "texproc/codecs/decoder/psd.h"
#include "texproc/codecs/decoder/sniff.h"
#include "texproc/codecs/decoder/texture.h"
#include "texproc/codecs/files/detail/message.h"
#include "texproc/codecs/files/detail/protocol.h"

namespace petrichor::texproc::decoder {

namespace {

using detail::Reply;
using detail::Request;

constexpr std::uint64_t kMemory = 1536ull << 20;  // on top of what the libraries map at the start
constexpr std::uint64_t kRecycleBytes = 256ull << 20;  // a process that held more is not kept
constexpr unsigned kBaseSeconds = 4;                   // CPU seconds for any file, plus
constexpr unsigned kMegapixelsASecond = 2;             // time in proportion to its size

void limit_memory()
{
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t base = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    rlimit limit{base + kMemory,
                 RLIM_INFINITY};  // set again when the image library has been loaded
    setrlimit(RLIMIT_AS, &limit);
    rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
}

// From now on the process may use `seconds` more CPU seconds; then the kernel ends it.
void limit_time(unsigned seconds)
{
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    rlimit limit{};
    getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds + 1;
    setrlimit(RLIMIT_CPU, &limit);
}

struct Fd {
    int fd = -1;
    Fd() = default;
    explicit Fd(int value) : fd(value) {}
    Fd(Fd&& other) noexcept : fd(other.fd) { other.fd = -1; }
    Fd& operator=(Fd&& other) noexcept
    {
        std::swap(fd, other.fd);
        return *this;
    }
    ~Fd()
    {
        if (fd >= 0) close(fd);
    }
};

struct Mapping {
    void* at = MAP_FAILED;
    std::size_t size = 0;
    Mapping(int fd, std::size_t bytes, int protection, int sharing = MAP_SHARED) : size(bytes)
    {
        at = mmap(nullptr, bytes, protection, sharing, fd, 0);
        if (at == MAP_FAILED) throw std::bad_alloc();
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping() { munmap(at, size); }
};

void set_text(char (&to)[detail::kTextBytes], const std::string& text)
{
    std::snprintf(to, sizeof to, "%s", text.c_str());
}

// The numbers that a request allows, checked before anything is allocated.
void check_size(const Header& h, const Request& request)
{
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(h.width) * static_cast<std::uint64_t>(h.height);
    if (pixels > static_cast<std::uint64_t>(request.max_pixels)) {
        throw std::runtime_error("it is " + std::to_string(h.width) + " x " +
                                 std::to_string(h.height) + ", more than the limit of " +
                                 std::to_string(request.max_pixels) + " pixels");
    }
    if (pixels * static_cast<std::uint64_t>(h.channels) * 4 > request.max_bytes) {
        throw std::runtime_error("it is " + std::to_string(h.width) + " x " +
                                 std::to_string(h.height) + " with " + std::to_string(h.channels) +
                                 " channels, more than the limit of " +
                                 std::to_string(request.max_bytes >> 20) + " MiB decoded");
    }
    limit_time(kBaseSeconds + static_cast<unsigned>(pixels >> 20) / kMegapixelsASecond);
}

// Other readers where the image library has none, loses channels, takes damaged files for good or
// is slow to start.
void read_pixels(const std::string& path, int fd, const std::string& format, const Request& request,
                 const Accept& accept)
{
    if (format == "dds" || format == "ktx2" || format == "psd") {
        struct stat status {};
        if (fstat(fd, &status) != 0) throw std::runtime_error(std::strerror(errno));
        const Mapping file(fd, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE);
        const std::span<const std::byte> bytes(static_cast<const std::byte*>(file.at), file.size);
        if (format != "psd") {
            read_gpu_texture(bytes, format,
                             {.max_pixels = request.max_pixels, .max_bytes = request.max_bytes},
                             accept);
            return;
        }
        if (read_psd(bytes, accept)) return;
    }
    if (format == "png") {
        read_png(path, accept);
    } else {
        image_library(limit_memory).read(path, format, accept);
    }
}

Fd decode(const Request& request, int input_fd, Reply& reply)
{
    limit_time(kBaseSeconds);
    const std::string name = request.text;
    const std::string path = input_fd >= 0 ? "/proc/self/fd/" + std::to_string(input_fd) : name;
    std::byte head[32];
    Fd file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.fd < 0) throw std::runtime_error(std::strerror(errno));
    const ssize_t got = pread(file.fd, head, sizeof head, 0);
    if (got < 0) throw std::runtime_error(std::strerror(errno));
    if (got == 0) throw std::runtime_error("it is empty");
    const std::string format = sniff({head, static_cast<std::size_t>(got)}, name);
    if (format.empty()) {
        throw std::runtime_error(
            "its content is none of PNG, TGA, TIFF, PSD, EXR, HDR, JPEG, WebP, BMP, DDS, KTX2, "
            "GIF, "
            "PNM, SGI");
    }
    Fd pixels(memfd_create("petrichor-pixels", MFD_CLOEXEC));
    if (pixels.fd < 0) throw std::runtime_error(std::strerror(errno));
    std::unique_ptr<Mapping> mapping;
    const Accept accept = [&](const Header& h) {
        check_size(h, request);
        const std::size_t bytes = h.bytes();
        if (ftruncate(pixels.fd, static_cast<off_t>(bytes)) != 0) throw std::bad_alloc();
        mapping = std::make_unique<Mapping>(pixels.fd, bytes, PROT_READ | PROT_WRITE);
        reply.width = h.width;
        reply.height = h.height;
        reply.channels = h.channels;
        reply.type = static_cast<std::uint32_t>(h.type);
        reply.last = bytes > kRecycleBytes;
        std::string names;
        for (const std::string& n : h.channel_names) names += n + "\n";
        set_text(reply.text, names);
        return static_cast<std::byte*>(mapping->at);
    };
    read_pixels(path, file.fd, format, request, accept);
    return pixels;
}

void encode(const Request& request, int input_fd)
{
    limit_time(600);
    const Header header{
        request.width, request.height, request.channels, static_cast<PixelType>(request.type), {}};
    const Mapping pixels(input_fd, header.bytes(), PROT_READ);
    image_library(limit_memory)
        .write(request.text, header, static_cast<const std::byte*>(pixels.at),
               static_cast<int>(request.quality));
}

bool receive(Request& request, Fd& attached)
{
    iovec data{&request, sizeof request};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    if (recvmsg(detail::kDecoderSocket, &message, 0) != sizeof request) return false;
    request.text[detail::kTextBytes - 1] = 0;
    const cmsghdr* c = CMSG_FIRSTHDR(&message);
    if (c && c->cmsg_type == SCM_RIGHTS) {
        int fd = -1;
        std::memcpy(&fd, CMSG_DATA(c), sizeof fd);
        attached = Fd(fd);
    }
    return true;
}

bool answer(const Reply& reply, int fd)
{
    return detail::send_message(detail::kDecoderSocket, reply, fd);
}

}  // namespace

int serve()
{
    limit_memory();
    Request request;
    for (Fd attached; receive(request, attached); attached = Fd()) {
        Reply reply;
        Fd pixels;
        try {
            if (request.task == detail::Task::Encode) {
                encode(request, attached.fd);
            } else {
                pixels = decode(request, attached.fd, reply);
            }
            reply.ok = 1;
        } catch (const std::bad_alloc&) {
            pixels = Fd();
            reply = Reply{.last = 1};
            set_text(reply.text, "it needs more memory than the limit of " +
                                     std::to_string(kMemory >> 20) + " MiB");
        } catch (const std::exception& error) {
            pixels = Fd();
            reply = Reply{};
            std::string why = error.what();
            std::replace(why.begin(), why.end(), '\n', ' ');
            set_text(reply.text, why);
        }
        if (!answer(reply, pixels.fd) || reply.last) break;
    }
    return 0;
}

}  // namespace petrichor::texproc::decoder

int main()
{
    struct stat socket_status {};
    if (fstat(petrichor::texproc::detail::kDecoderSocket, &socket_status) != 0 ||
        !S_ISSOCK(socket_status.st_mode)) {
        std::fprintf(stderr, "petrichor-decode is started by petrichor; it has no use by hand.\n");
        return 2;
    }
    return petrichor::texproc::decoder::serve();
}
