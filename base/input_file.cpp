#include "base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/words.h"

namespace petrichor {

namespace {

std::string named(std::string_view what, const std::filesystem::path& path)
{
    return std::string(what) + " " + printable(path.string());
}

[[noreturn]] void refuse_kind(std::string_view what, const std::filesystem::path& path, mode_t mode)
{
    const char* kind = S_ISDIR(mode)    ? "a folder"
                       : S_ISFIFO(mode) ? "a named pipe"
                       : S_ISSOCK(mode) ? "a socket"
                                        : "a device";
    throw Error(named(what, path) + ": it is " + kind + ", not a file",
                "Name a regular file; what a pipe or device gives can be saved into one first.");
}

}  // namespace

InputFile::~InputFile()
{
    if (fd_ >= 0) ::close(fd_);
}

std::size_t InputFile::read(std::span<std::byte> to) const
{
    std::size_t done = 0;
    while (done < to.size()) {
        const ssize_t got = ::read(fd_, to.data() + done, to.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            throw Error(name_ + ": it cannot be read: " + std::strerror(errno),
                        "Check the disk or the network that it lies on.");
        }
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

InputFile open_regular_file(const std::filesystem::path& path, std::string_view what)
{
    // Looked at first, since opening some devices does something; and again when it is open, since
    // the name may mean another file by then. O_NONBLOCK: opening a pipe must not wait.
    struct stat status {};
    const auto fail = [&] {
        const int why = errno;
        if (why == ENOENT) {
            throw Error(named(what, path) + ": there is no such file",
                        path.is_absolute() ? "Check the path." : "Check the path; it is relative to the folder that you are in.");
        }
        throw Error(named(what, path) + ": it cannot be opened: " + std::strerror(why),
                    "Check that it may be read.");
    };
    if (::stat(path.c_str(), &status) != 0) fail();
    if (!S_ISREG(status.st_mode)) refuse_kind(what, path, status.st_mode);
    InputFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY), 0, {});
    if (file.fd() < 0) fail();
    if (::fstat(file.fd(), &status) != 0) fail();
    if (!S_ISREG(status.st_mode)) refuse_kind(what, path, status.st_mode);
    return {file.release(), static_cast<std::uint64_t>(status.st_size), named(what, path)};
}

std::string read_file(const std::filesystem::path& path, std::string_view what,
                      std::uint64_t max_bytes, const StopRequest& stop)
{
    const InputFile file = open_regular_file(path, what);
    const auto too_large = [&](std::uint64_t bytes) {
        return Error(named(what, path) + ": it has " + std::to_string(bytes) +
                         " bytes or more, over the limit of " + std::to_string(max_bytes),
                     "Check that it is the file you mean; use a smaller one.");
    };
    if (file.size() > max_bytes) throw too_large(file.size());
    std::string content(static_cast<std::size_t>(file.size()), '\0');
    std::size_t done = 0;
    for (;;) {
        if (stop && stop()) throw Interrupted("interrupted while reading " + named(what, path));
        if (done == content.size()) {  // it may have grown; files of /proc say that they are empty
            if (done > max_bytes) throw too_large(done);
            content.resize(done + 4096);
        }
        const std::size_t piece = std::min<std::size_t>(content.size() - done, 1 << 20);
        const std::size_t got =
            file.read(std::as_writable_bytes(std::span(content.data() + done, piece)));
        if (got == 0) break;
        done += got;
    }
    content.resize(done);
    if (done > max_bytes) throw too_large(done);
    return content;
}

}  // namespace petrichor
