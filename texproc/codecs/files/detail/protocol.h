// What the program and its decoder processes say to each other: one SOCK_SEQPACKET message each
// way, with one file descriptor attached (bytes in, pixels out). Both ends are built together.
#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PROTOCOL_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PROTOCOL_H

#include <cstdint>

namespace petrichor::texproc::detail {

inline constexpr int kDecoderSocket = 3;  // the child's end, by convention of the spawn
inline constexpr std::uint32_t kTextBytes = 8192;

enum class Task : std::uint32_t { Decode = 1, Encode = 2, Report = 3, Shape = 4 };

struct Request {
    Task task = Task::Decode;   // Report: only how well the child is locked in, as text;
                                // Shape: Decode that stops before the pixels
    std::int32_t max_side = 0;  // Decode: larger images are made smaller on the way; 0: never
    std::uint32_t linear = 0;   // Decode, for that: integers are sRGB codes of light
    std::uint32_t reserved = 0;
    std::int64_t max_pixels = 0;  // Decode; the attached descriptor holds the file
    std::uint64_t max_bytes = 0;  // Decode: of the decoded pixels, four bytes a number
    std::int32_t width = 0, height = 0, channels = 0;  // Encode; the descriptor holds the pixels
    std::uint32_t type = 0;                            // Encode: PixelType
    std::uint32_t quality = 95;                        // Encode: JPEG
    char format[16] = {};                              // Decode: what sniff() found
    char text[kTextBytes] = {};                        // Encode: a name with the extension
};

struct Reply {
    std::uint32_t ok = 0;
    std::uint32_t last = 0;           // the child ends after this reply
    std::uint32_t needs_library = 0;  // not ok: a child with the image library can read it
    std::int32_t width = 0, height = 0, channels = 0;
    std::uint32_t type = 0;
    std::uint64_t bytes = 0;     // Encode: size of the file, which the attached descriptor holds
    char text[kTextBytes] = {};  // ok: channel names, one a line; else the problem
};

}  // namespace petrichor::texproc::detail

#endif
