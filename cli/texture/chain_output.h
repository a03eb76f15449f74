#ifndef PETRICHOR_CLI_TEXTURE_CHAIN_OUTPUT_H
#define PETRICHOR_CLI_TEXTURE_CHAIN_OUTPUT_H

#include <filesystem>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"

namespace petrichor::cli {

/// A chain on its way to files.
struct ChainOutput {
    std::string name;    ///< 'out_%d.png', one file a level, or one file for all: out.dds, out.ktx2
    std::string format;  ///< of a texture file, as bc5; empty: plain numbers
    int bits = 16;
    int threads = 0;
    std::vector<Image> texel_weights{};  ///< TextureWriteOptions::texel_weights
    bool dither = false;  ///< levels of 8 bits: by an ordered pattern in place of rounding
};

/// Throws Error when the name can hold no levels: neither a %d nor a texture file.
void check_chain_name(const std::string& name);

/// Writes level 0 and the levels after it (levels[0] is not looked at) in integers of `bits`.
/// Levels have the channels of level 0. source: the file that level 0 was read from, whole and
/// unchanged, or empty; where it is what would be written its bytes are copied, which is faster and
/// exact.
void write_chain(const ChainOutput& output, const texproc::RawImage& level0,
                 const std::filesystem::path& source, const std::vector<Image>& levels);

}  // namespace petrichor::cli

#endif
