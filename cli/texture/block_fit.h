#ifndef PETRICHOR_CLI_TEXTURE_BLOCK_FIT_H
#define PETRICHOR_CLI_TEXTURE_BLOCK_FIT_H

#include <optional>
#include <vector>

#include "texproc/codecs/blocks/blocks.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::cli {

/// How the chains of a prefilter are stored.
struct StoredFormats {
    std::optional<texproc::Block> normal, roughness;  ///< none: plain numbers
    int bits = 16;                                    ///< of plain numbers
    int normal_channels = 3;                          ///< of the file of normals
    bool keeps_normals = true;                        ///< false: only the roughness is written
    bool fit = true;                                  ///< false: blocks by squared error alone
};

/// Chains made for lossy files.
struct BlockFit {
    texproc::Prefiltered read;  ///< what a reader of the files gets; without normals if not kept
    /// For TextureWriteOptions::texel_weights; empty where blocks are not weighted.
    std::vector<Image> normal_weights, roughness_weights;
};

/// Compresses the normals, then aims the roughness of `chains` at the normals that came out
/// (texproc/prefilter/stored.h), and reads both back. `chains` is what is to be written then.
BlockFit fit_to_blocks(const texproc::RawImage& normal, const texproc::RawImage& roughness,
                       const texproc::PrefilterOptions& options, const StoredFormats& formats,
                       texproc::Prefiltered& chains);

}  // namespace petrichor::cli

#endif
