#ifndef PETRICHOR_CLI_DEMO_PNG_ENCODER_H
#define PETRICHOR_CLI_DEMO_PNG_ENCODER_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::cli {

/// Encodes 8-bit pixels as a PNG file in memory, fast rather than small.
///
///   channels  1 grey, 3 RGB or 4 RGBA, interleaved, row 0 at the top
///   throws    Error when the sizes do not fit each other.
std::vector<std::byte> encode_png(int width, int height, int channels,
                                  std::span<const std::uint8_t> pixels);

}  // namespace petrichor::cli

#endif
