#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PNG_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_PNG_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace petrichor::texproc::detail {

struct PngImage {
    int width = 0, height = 0;
    int channels = 0;  ///< 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
    int bits = 8;      ///< 8 or 16; 16-bit samples are in the byte order of this machine
    const std::byte* pixels = nullptr;
    /// In place of pixels: rows first .. end - 1, asked for by several threads at once and some rows twice; same bytes each
    /// time.
    std::function<std::vector<std::byte>(std::size_t first, std::size_t end)> rows = {};
};

/// Takes the next bytes of a file.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// A PNG file, piece by piece: at no time more than some 32 MiB of it. Each row takes the cheaper
/// of two filters, the rows are deflated in blocks of a fixed size, on `threads` threads (0: all
/// cores): same bytes for any number.
void encode_png(const PngImage& image,
                const std::vector<std::pair<std::string, std::string>>& texts, int level,
                int threads, const ByteSink& sink);

/// The same in one piece.
std::vector<std::byte> encode_png(const PngImage& image,
                                  const std::vector<std::pair<std::string, std::string>>& texts,
                                  int level = 1, int threads = 0);

}  // namespace petrichor::texproc::detail

#endif
