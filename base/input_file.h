#ifndef PETRICHOR_BASE_INPUT_FILE_H
#define PETRICHOR_BASE_INPUT_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/interrupted.h"

namespace petrichor {

/// A regular file open for reading. Move-only.
class InputFile {
public:
    InputFile() = default;
    /// `name`: of messages.
    InputFile(int fd, std::uint64_t size, std::string name)
        : fd_(fd), size_(size), name_(std::move(name))
    {
    }
    InputFile(InputFile&& other) noexcept
        : fd_(std::exchange(other.fd_, -1)), size_(other.size_), name_(std::move(other.name_))
    {
    }
    InputFile& operator=(InputFile&& other) noexcept
    {
        std::swap(fd_, other.fd_);
        std::swap(size_, other.size_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~InputFile();

    int fd() const { return fd_; }
    int release() { return std::exchange(fd_, -1); }  ///< the caller closes it from now on
    std::uint64_t size() const { return size_; }      ///< bytes, when it was opened
    /// Reads on, and says how much: less than `to` only at the end of the file. Throws Error.
    std::size_t read(std::span<std::byte> to) const;

private:
    int fd_ = -1;
    std::uint64_t size_ = 0;
    std::string name_;
};

/// The one way to open a file that a user or another file names: links are followed, but a folder,
/// a pipe, a socket or a device is refused without being opened, so nothing waits for ever.
///
///   what    what it is to the reader of a message: "scene", "image"
///   throws  Error that names `what` and the path.
InputFile open_regular_file(const std::filesystem::path& path, std::string_view what);

/// Its whole content.
///
///   max_bytes  larger files are refused before a byte is read
///   throws     Error; Interrupted when `stop` says so (asked every MiB).
std::string read_file(const std::filesystem::path& path, std::string_view what,
                      std::uint64_t max_bytes, const StopRequest& stop = {});

}  // namespace petrichor

#endif
