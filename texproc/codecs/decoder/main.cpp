// petrichor-decode: the process that touches untrusted image files. The image library aborts or
// loops on some damaged ones, so it runs here: with limits on memory and time, and, once it is
// loaded, without the right to open a file, a socket or a program (base/confine.h). The program
// only ever sees pixels or a reason. It serves requests on socket 3 until the other end closes, one
// at a time; the program starts several for several files. `--library`: with the image library.
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/confine.h"
#include "texproc/codecs/decoder/image_library.h"
#include "texproc/codecs/decoder/png.h"
#include "texproc/codecs/decoder/psd.h"
#include "texproc/codecs/decoder/reduce.h"
#include "texproc/codecs/decoder/sgi.h"
#include "texproc/codecs/decoder/texture.h"
#include "texproc/codecs/decoder/tiff.h"
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
// `kept` is what will be in memory of it.
void check_size(const Header& h, const Request& request, const Header& kept)
{
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(h.width) * static_cast<std::uint64_t>(h.height);
    if (pixels > static_cast<std::uint64_t>(request.max_pixels)) {
        throw std::runtime_error("it is " + std::to_string(h.width) + " x " +
                                 std::to_string(h.height) + ", more than the limit of " +
                                 std::to_string(request.max_pixels) + " pixels");
    }
    const std::uint64_t kept_pixels =
        static_cast<std::uint64_t>(kept.width) * static_cast<std::uint64_t>(kept.height);
    if (kept_pixels * static_cast<std::uint64_t>(h.channels) * 4 > request.max_bytes) {
        throw std::runtime_error("it is " + std::to_string(h.width) + " x " +
                                 std::to_string(h.height) + " with " + std::to_string(h.channels) +
                                 " channels, more than the limit of " +
                                 std::to_string(request.max_bytes >> 20) + " MiB decoded");
    }
    limit_cpu(kBaseSeconds + static_cast<unsigned>(pixels >> 20) / kMegapixelsASecond);
}

// A format that only a child with the image library reads.
struct NeedsLibrary {};

// Other readers where the image library has none, loses channels, takes damaged files for good or
// is slow to start.
void read_pixels(std::span<const std::byte> file, const std::string& format, const Request& request,
                 const ImageLibrary* library, const Accept& accept)
{
    if (format == "dds" || format == "ktx2") {
        read_gpu_texture(file, format,
                         {.max_pixels = request.max_pixels,
                          .max_bytes = request.max_bytes,
                          .max_side = request.max_side},
                         accept);
    } else if (format == "png") {
        read_png(file, accept);
    } else if (format == "sgi") {
        read_sgi(file, accept);
    } else if (format != "psd" || !read_psd(file, accept)) {
        if (!library) throw NeedsLibrary{};
        library->read(file, format, accept);
        if (format == "tiff") check_tiff(file);
    }
}

struct ShapeIsEnough {};

// Pixels go into shared memory: as they are, or reduced on the way.
class Taker : public Accept {
public:
    Taker(const Request& request, int fd, Reply& reply) : request_(request), fd_(fd), reply_(reply)
    {
    }

    std::byte* operator()(const Header& h) const override
    {
        if (!Reducer::needed(h, request_.max_side)) return begin(h, h);
        check_size(h, request_, h);
        begin_reduced(h);
        full_.resize(h.bytes());
        return full_.data();
    }
    bool by_rows(const Header& h) const override
    {
        if (!Reducer::needed(h, request_.max_side)) return false;
        begin_reduced(h);
        return true;
    }
    void row(const std::byte* from) const override { reducer_->row(from); }

    // Readers that gave all pixels at once: they are reduced now.
    void finish() const
    {
        if (full_.empty()) return;
        for (std::size_t at = 0; at < full_.size(); at += row_bytes_) reducer_->row(&full_[at]);
    }

private:
    void begin_reduced(const Header& h) const
    {
        reducer_ = std::make_unique<Reducer>(
            h, request_.max_side, request_.linear ? ColorSpace::Linear : ColorSpace::Data);
        row_bytes_ = h.bytes() / static_cast<std::size_t>(h.height);
        reducer_->write_to(begin(h, reducer_->reduced()));
    }
    std::byte* begin(const Header& full, const Header& h) const
    {
        check_size(full, request_, h);
        reply_.width = h.width;
        reply_.height = h.height;
        reply_.channels = h.channels;
        reply_.type = static_cast<std::uint32_t>(h.type);
        if (request_.task == detail::Task::Shape) throw ShapeIsEnough{};
        const std::size_t bytes = h.bytes();
        if (ftruncate(fd_, static_cast<off_t>(bytes)) != 0) throw std::bad_alloc();
        mapping_ = std::make_unique<Mapping>(fd_, bytes, PROT_READ | PROT_WRITE);
        reply_.last = full.bytes() > kRecycleBytes;
        std::string names;
        for (const std::string& n : h.channel_names) names += n + "\n";
        set_text(reply_.text, names);
        return static_cast<std::byte*>(mapping_->at);
    }

    const Request& request_;
    int fd_;
    Reply& reply_;
    mutable std::unique_ptr<Mapping> mapping_;
    mutable std::unique_ptr<Reducer> reducer_;
    mutable std::vector<std::byte> full_;
    mutable std::size_t row_bytes_ = 0;
};

Fd decode(const Request& request, int input_fd, const ImageLibrary* library, Reply& reply)
{
    limit_cpu(kBaseSeconds);
    struct stat status {};
    if (fstat(input_fd, &status) != 0) throw std::runtime_error(std::strerror(errno));
    const Mapping file(input_fd, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE);
    Fd pixels(memfd_create("petrichor-pixels", MFD_CLOEXEC));
    if (pixels.fd < 0) throw std::runtime_error(std::strerror(errno));
    const Taker taker(request, pixels.fd, reply);
    try {
        read_pixels({static_cast<const std::byte*>(file.at), file.size}, request.format, request,
                    library, taker);
        taker.finish();
    } catch (const ShapeIsEnough&) {
    }
    return pixels;
}

Fd encode(const Request& request, int input_fd, const ImageLibrary* library, Reply& reply)
{
    limit_cpu(600);
    if (!library) throw NeedsLibrary{};
    const Header header{
        request.width, request.height, request.channels, static_cast<PixelType>(request.type), {}};
    const Mapping pixels(input_fd, header.bytes(), PROT_READ);
    const std::vector<unsigned char> bytes =
        library->write(request.text, header, static_cast<const std::byte*>(pixels.at),
                       static_cast<int>(request.quality));
    Fd file(memfd_create("petrichor-file", MFD_CLOEXEC));
    if (file.fd < 0 || bytes.empty() || ftruncate(file.fd, static_cast<off_t>(bytes.size())) != 0)
        throw std::bad_alloc();
    const Mapping to(file.fd, bytes.size(), PROT_READ | PROT_WRITE);
    std::memcpy(to.at, bytes.data(), bytes.size());
    reply.bytes = bytes.size();
    return file;
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
    request.format[sizeof request.format - 1] = 0;
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

int serve(bool with_library)
{
    const ImageLibrary* library = nullptr;
    std::string not_loaded;
    try {
        if (with_library) library = &load_image_library();
    } catch (const std::exception& error) {
        not_loaded = error.what();
    }
    limit_memory(kMemory);
    const Confinement confinement = confine();
    Request request;
    for (Fd attached; receive(request, attached); attached = Fd()) {
        Reply reply;
        Fd result;
        try {
            if (request.task == detail::Task::Report) {
                set_text(reply.text, confinement_text(confinement));
            } else if (request.task == detail::Task::Encode) {
                result = encode(request, attached.fd, library, reply);
            } else {
                result = decode(request, attached.fd, library, reply);
            }
            reply.ok = 1;
        } catch (const NeedsLibrary&) {
            result = Fd();
            reply = Reply{};
            reply.needs_library = with_library ? 0 : 1;
            set_text(reply.text, not_loaded);
        } catch (const std::bad_alloc&) {
            result = Fd();
            reply = Reply{};
            reply.last = 1;
            set_text(reply.text, "it needs more memory than the limit of " +
                                     std::to_string(kMemory >> 20) + " MiB");
        } catch (const std::exception& error) {
            result = Fd();
            reply = Reply{};
            std::string why = error.what();
            std::replace(why.begin(), why.end(), '\n', ' ');
            set_text(reply.text, why);
        }
        if (!answer(reply, result.fd) || reply.last) break;
    }
    return 0;
}

}  // namespace petrichor::texproc::decoder

int main(int argc, char** argv)
{
    struct stat socket_status {};
    if (fstat(petrichor::texproc::detail::kDecoderSocket, &socket_status) != 0 ||
        !S_ISSOCK(socket_status.st_mode)) {
        std::fprintf(stderr, "petrichor-decode is started by petrichor; it has no use by hand.\n");
        return 2;
    }
    // Without exit handlers: a library may be in any state.
    _exit(petrichor::texproc::decoder::serve(argc > 1 && std::string_view(argv[1]) == "--library"));
}
