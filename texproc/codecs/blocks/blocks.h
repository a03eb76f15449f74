#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_BLOCKS_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_BLOCKS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// The block formats of graphics hardware: 4 x 4 texels (ASTC up to 8 x 8) in 8 bytes (BC1, BC4) or 16 (the others).
/// In the order of the rows of block_table.cpp, which tell the rest.
enum class Block {
    Bc1,   ///< RGB 5:6:5, 4 colours a block; alpha 0 or 1
    Bc2,   ///< BC1 and 4 bits of alpha a texel; read only
    Bc3,   ///< BC1 and a BC4 block of alpha
    Bc4,   ///< one channel, 8 values a block
    Bc5,   ///< two BC4 blocks
    Bc6h,  ///< RGB half floats, 14 modes
    Bc7,   ///< RGB or RGBA, eight modes
    Uastc,  ///< RGB or RGBA, 19 modes: Basis Universal's, from which every other format is made
    Astc4,  ///< RGBA, 4 x 4 texels: phones and tablets; by Arm's library (has_astc())
    Astc5,  ///< the same of 5 x 5 texels, 5.12 bits a texel
    Astc6,  ///< of 6 x 6, 3.56 bits
    Astc8,  ///< of 8 x 8, 2 bits
};

/// Texels along each side of a block.
int block_side(Block block);
/// Whether the program was built with a library for ASTC: without it that is neither written nor read.
bool has_astc();

/// Bytes of one block.
std::size_t block_bytes(Block block);
/// Bytes of a level of width x height texels; a block at an edge is stored whole.
std::size_t blocks_size(Block block, int width, int height);
/// Channels that a decoder returns: 4, or 1 (BC4), 2 (BC5), 3 (BC6H).
int channels_of(Block block);
/// Numbers of a decoded level; signed: BlockSign::Signed.
PixelType decoded_type(Block block, bool is_signed = false);

enum class BlockQuality {
    Fast,    ///< what a tool does while you wait
    Normal,  ///< default
    Best,    ///< everything that helps; several times slower
};

struct BlockOptions {
    BlockQuality quality = BlockQuality::Normal;
    /// Weight of the squared error of each channel. Data maps: equal. Alpha counts like the others.
    std::array<float, 4> weights{1.0f, 1.0f, 1.0f, 1.0f};
    bool punch_through = false;  ///< BC1: alpha below one half becomes transparent black
    /// The codes are sRGB: ASTC rounds so. BC7 keeps colours opaque that have no alpha; of other images without alpha,
    /// data, it may store 254, as nobody reads it, for closer channels.
    bool srgb = false;
    bool is_signed = false;      ///< BC6H: negative numbers are kept
    /// All but BC6H and ASTC: error for size. Blocks repeat bytes of blocks before them where that
    /// costs less than this (squared error of 16 texels, mean over the channels, a bit saved), so
    /// that zstd makes a smaller file. 0: none; 0.25 is hardly seen, 4 is.
    float repeat = 0.0f;
    /// How far off a block may get by that, root mean square in codes, > 0; one that is farther off
    /// already stays as it is. 0.5 is 54 dB.
    float repeat_most = std::numeric_limits<float>::infinity();
    int threads = 0;             ///< 0: all cores; the bytes do not depend on it
};

/// Encodes an image of 8-bit codes, row by row of blocks, as the hardware wants them. Codes are
/// taken as they are: an sRGB image is encoded in its codes. Texels past an edge repeat the edge.
///
/// BC6H is made from half floats, so that its squared error is relative to the light.
///
///   image   U8, F16 for BC6H; channels that the format does not have are ignored; missing ones: a
///           single channel stands for red, green and blue, missing blue is 0, missing alpha is 255
///   throws  Error for other numbers, an empty image, and formats that are read only
std::vector<std::byte> encode_blocks(const RawImage& image, Block block,
                                     const BlockOptions& options = {});

/// BC4 or BC5 of numbers 0..1 for a GPU, which interpolates between codes: each block has the least
/// sum of distances, where a texel counts by its weight (one channel, >= 0). Numbers between two
/// codes are reached to about 1/7 of a code where a block is smooth, so that a flat normal (127.5)
/// is flat. Slower than encode_blocks(). Throws Error for other formats and sizes that differ.
std::vector<std::byte> encode_blocks_weighted(const Image& image, const Image& weights, Block block,
                                              int threads = 0);

/// How the numbers of BC4, BC5 and BC6H are to be read.
enum class BlockSign {
    Unsigned,
    Signed,
    /// BC4 and BC5: unsigned with the fractions between codes, F32 in 0..1. What a shader reads:
    /// the definition of BC4_UNORM (Direct3D, "Block Compression") divides floats, and GPUs keep 14
    /// bits or more of it (Giesen 2021, "GPU BCn decoding").
    Exact,
};

/// Decodes a level: U8 with channels_of(block) channels, the integers of the format's definition
/// (BC1 to BC5: the nearest integers to the interpolated values); BC6H gives
/// F16, signed BC4 and BC5 F32 in -1..1.
///
///   bytes   at least blocks_size(); throws Error when there are fewer
///   srgb    ASTC: the texture is marked so, by which hardware rounds its codes
RawImage decode_blocks(std::span<const std::byte> bytes, Block block, int width, int height,
                       BlockSign sign = BlockSign::Unsigned, int threads = 0, bool srgb = false);

// ---- one block, for callers that choose codes themselves ---------------------------------------

/// What each code costs at each texel of a block: cost[texel][code], any unit, smaller is better.
/// A squared difference makes the usual encoder; an error of shading makes one that knows what the
/// numbers are for.
using TexelCosts = std::array<std::array<float, 256>, 16>;

struct Bc4Choice {
    std::array<std::uint8_t, 8> block;    ///< as stored
    std::array<std::uint8_t, 16> values;  ///< as decoded
    double cost = 0.0;                    ///< the sum over the texels
};

/// The BC4 block of least total cost among all endpoint pairs within `reach` codes of the smallest
/// and of the largest best code, in both modes. Deterministic; ties go to the first pair.
Bc4Choice encode_bc4_block(const TexelCosts& costs, int reach = 4);

/// The BC4 block of least squared error that the quality looks for.
std::array<std::uint8_t, 8> encode_bc4_block(const std::array<std::uint8_t, 16>& values,
                                             BlockQuality quality = BlockQuality::Normal);

}  // namespace petrichor::texproc

#endif
