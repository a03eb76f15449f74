// What the program and its decoder processes say to each other: one SOCK_SEQPACKET message each
// way, with one file descriptor attached (bytes in, pixels out). Both ends are built together.
#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PROTOCOL_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PROTOCOL_H

#include <cstdint>

namespace petrichor::texproc::detail {

inline constexpr int kDecoderSocket = 3;  // the child's end, by convention of the spawn
inline constexpr std::uint32_t kTextBytes = 8192;

enum class Task : std::uint32_t { Decode = 1, Encode = 2 };

struct Request {
    Task task = Task::Decode;
    std::uint32_t has_fd = 0;     // Decode: the attached descriptor holds the file's bytes.
                                  // Encode: it holds the pixels.
    std::int64_t max_pixels = 0;  // Decode
    std::uint64_t max_bytes = 0;  // Decode: of the decoded pixels, four bytes a number
    std::int32_t width = 0, height = 0, channels = 0;  // Encode
    std::uint32_t type = 0;                            // Encode: PixelType
    std::uint32_t quality = 95;                        // Encode: JPEG
    char text[kTextBytes] = {};                        // path or name, zero-terminated
};

struct Reply {
    std::uint32_t ok = 0;
    std::uint32_t last = 0;  // the child ends after this reply
    std::int32_t width = 0, height = 0, channels = 0;
    std::uint32_t type = 0;
    char text[kTextBytes] = {};  // ok: channel names, one a line; else the problem
};

}  // namespace petrichor::texproc::detail

#endif
