#ifndef PETRICHOR_TEXPROC_PREFILTER_STORED_H
#define PETRICHOR_TEXPROC_PREFILTER_STORED_H

#include <vector>

#include "texproc/codecs/blocks/blocks.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

// Chains on their way through lossy files: what a reader gets, and what is best written then.

/// How the levels of a map are compressed.
struct LossyFormat {
    Block block = Block::Bc4;
    BlockQuality quality = BlockQuality::Normal;
    int threads = 0;
};

/// What a reader gets of levels 1.. (level 0 is not looked at, and empty in the result). Channels
/// that the blocks do not hold are left out. weights: as for encode_blocks_weighted(); may be
/// empty.
std::vector<Image> through_blocks(const std::vector<Image>& levels,
                                  const std::vector<Image>& weights, const LossyFormat& format);

/// What being off costs, for encode_blocks_weighted(): levels 1.., one number a texel.
struct LobeWeights {
    std::vector<Image> normal;  ///< 1 / alpha: an error of direction counts in widths of the lobe
    std::vector<Image> roughness;  ///< 1 / p: an error of roughness counts relative to it
};
LobeWeights lobe_weights(const Prefiltered& chain, const PrefilterOptions& options);

/// The roughness, as stored, that fits best to normals as a reader gets them; levels 1.., with
/// options.quick from 3. normal, roughness: level 0. stored: the chain, with three-channel normals
/// that were compressed and read back. A number stays unless another one clearly wins (0.003 of the
/// light). Same bytes at any thread count.
std::vector<Image> aim_roughness(const RawImage& normal, const RawImage& roughness,
                                 const Prefiltered& stored, const PrefilterOptions& options);

}  // namespace petrichor::texproc

#endif
