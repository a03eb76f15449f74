#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_DECODER_POOL_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_DECODER_POOL_H

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "texproc/codecs/files/io.h"
#include "texproc/image/raw_image.h"

namespace petrichor::texproc::detail {

/// Pixels that a decoder process left in shared memory.
class Decoded {
public:
    Decoded(int fd, RawImage shape) : fd_(fd), shape_(std::move(shape)) {}
    Decoded(const Decoded&) = delete;
    Decoded& operator=(const Decoded&) = delete;
    Decoded(Decoded&& other) noexcept : fd_(other.fd_), shape_(std::move(other.shape_))
    {
        other.fd_ = -1;
    }
    ~Decoded();

    const RawImage& shape() const { return shape_; }  ///< without bytes
    /// Copies `to.size()` bytes from `offset`. Read, not mapped: a process that shrinks its memory
    /// cannot fault us. Throws Error when they are not there.
    void read(std::uint64_t offset, std::span<std::byte> to) const;

private:
    int fd_;
    RawImage shape_;
};

/// Has one of the decoder processes (started when needed, kept for the next file, at most one a
/// core) decode a file that is open for reading. Waits for a free one. `name` is for messages, and
/// for TGA, which has no signature. Throws Error for every failure, a crash or a hang of the
/// process included; Interrupted when options.stop says so.
Decoded decode_in_child(const std::string& name, int file, const ReadOptions& options);

/// The same for a file in memory.
Decoded decode_in_child(const std::string& name, std::span<const std::byte> bytes,
                        const ReadOptions& options);

/// The same without pixels.
RawImage shape_in_child(const std::string& name, std::span<const std::byte> bytes,
                        const ReadOptions& options);

/// The bytes of a file that a decoder process made from pixels with the image library (JPEG, TIFF,
/// TGA, by the extension of `path`).
std::vector<std::byte> encode_in_child(const std::filesystem::path& path, const RawImage& image,
                                       int quality);

/// How well decoder processes are locked in on this machine, in words.
std::string decoder_confinement();

}  // namespace petrichor::texproc::detail

#endif
