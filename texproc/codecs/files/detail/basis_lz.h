#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_BASIS_LZ_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_BASIS_LZ_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::texproc::detail {

/// Where the two pictures of an image lie in the bytes of its level.
struct BasisLzImage {
    bool follows_another = false;  ///< a frame of a film that repeats blocks of the one before
    std::uint32_t color_at = 0, color_size = 0;
    std::uint32_t alpha_at = 0, alpha_size = 0;  ///< size 0: there is none
};

/// A Huffman code whose words are stored from their first bit on.
class BasisLzCode {
public:
    /// `lengths` of the words in bits, 0..16; 0 is a symbol without one. Throws std::runtime_error
    /// for lengths that no code has.
    explicit BasisLzCode(std::span<const std::uint8_t> lengths);
    BasisLzCode() = default;

    static constexpr std::size_t kLongest = 16;
    /// Number of words of each length; symbols by length, then by number.
    std::array<std::uint16_t, kLongest + 1> count{};
    std::vector<std::uint16_t> symbols;
};

/// The part of a KTX2 file that all its images share (supercompression 1, BasisLZ): colours with
/// their steps, patterns of 4 x 4 texels, and the codes by which images name them. Untrusted bytes:
/// everything throws std::runtime_error that says what is damaged.
/// Source: KTX 2.0, "BasisLZ Global Data" and "BasisLZ/ETC1S Bitstream Specification"; ETC1S:
/// Khronos Data Format Specification 1.3, 21.1.
class BasisLz {
public:
    /// `images`: levels times layers times faces.
    BasisLz(std::span<const std::byte> global, std::uint64_t images);

    /// Number `index`, counted by level, then layer, then face.
    BasisLzImage image(std::uint64_t index) const;

    /// The texels of one slice, width x height from the top: red, green, blue of each.
    std::vector<std::array<std::uint8_t, 3>> slice(std::span<const std::byte> bytes, int width,
                                                   int height) const;

private:
    /// The four colours of a block.
    using Palette = std::array<std::array<std::uint8_t, 3>, 4>;
    /// The colour of each texel, two bits each, the first lowest.
    using Pattern = std::uint32_t;

    void read_palettes(std::span<const std::byte> bytes, std::size_t count);
    void read_patterns(std::span<const std::byte> bytes, std::size_t count);

    std::span<const std::byte> global_;
    std::vector<Palette> palettes_;
    std::vector<Pattern> patterns_;
    BasisLzCode neighbours_, steps_, choices_, runs_;
    std::size_t history_ = 0;
};

}  // namespace petrichor::texproc::detail

#endif
