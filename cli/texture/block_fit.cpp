#include "cli/texture/block_fit.h"

#include <utility>

#include "texproc/material/normal_channels.h"
#include "texproc/prefilter/stored.h"
#include "texproc/study/score.h"

namespace petrichor::cli {

namespace {

using texproc::Block;

bool takes_weights(std::optional<Block> block)
{
    return block == Block::Bc4 || block == Block::Bc5;
}

// The channels that a reader of the blocks looks at, as a number 0..1 each.
std::vector<Image> first_channel(std::vector<Image> levels)
{
    for (Image& level : levels) {
        if (level.channels <= 1) continue;
        Image one(level.width, level.height, 1, level.space);
        for (std::size_t i = 0; i < one.pixels.size(); ++i) {
            one.pixels[i] = level.pixels[i * static_cast<std::size_t>(level.channels)];
        }
        level = std::move(one);
    }
    return levels;
}

std::vector<Image> normals_through(const std::vector<Image>& normals,
                                   const std::vector<Image>& weights,
                                   texproc::PrefilterOptions options, const StoredFormats& formats)
{
    std::vector<Image> laid_out(normals.size());
    for (std::size_t k = 1; k < normals.size(); ++k) {
        laid_out[k] = texproc::lay_out_normals(normals[k], options, formats.normal_channels);
    }
    std::vector<Image> read =
        texproc::through_blocks(laid_out, weights, {*formats.normal, {}, options.threads});
    options.rebuild_z = options.rebuild_z || formats.normal == Block::Bc5;
    for (std::size_t k = 1; k < read.size(); ++k) {
        read[k] = texproc::read_out_normals(read[k], options, static_cast<int>(k));
    }
    return read;
}

}  // namespace

BlockFit fit_to_blocks(const texproc::RawImage& normal, const texproc::RawImage& roughness,
                       const texproc::PrefilterOptions& options, const StoredFormats& formats,
                       texproc::Prefiltered& chains)
{
    BlockFit fit;
    const bool blocks = formats.normal || formats.roughness;
    // Other rules say what a number must be; only the rule that minimises the error may move it.
    const bool aims = blocks && formats.fit && options.rule == "overlap" && !options.anisotropic;
    texproc::Prefiltered stored = chains;
    texproc::quantize(stored, formats.bits);
    texproc::LobeWeights weights;
    if (aims) weights = texproc::lobe_weights(chains, options);
    if (takes_weights(formats.roughness)) fit.roughness_weights = std::move(weights.roughness);
    if (formats.normal && formats.keeps_normals) {
        if (takes_weights(formats.normal)) fit.normal_weights = std::move(weights.normal);
        stored.normal = normals_through(stored.normal, fit.normal_weights, options, formats);
    }
    if (aims) {
        texproc::Prefiltered seen{
            formats.keeps_normals ? stored.normal : chains.normal, chains.roughness, {}, {}, {}};
        chains.roughness = texproc::aim_roughness(normal, roughness, seen, options);
        texproc::Prefiltered rounded{{}, chains.roughness, {}, {}, {}};
        texproc::quantize(rounded, formats.bits);
        stored.roughness = std::move(rounded.roughness);
    }
    if (formats.roughness) {
        stored.roughness = first_channel(texproc::through_blocks(
            stored.roughness, fit.roughness_weights, {*formats.roughness, {}, options.threads}));
    }
    if (!formats.keeps_normals) stored.normal.clear();
    fit.read = std::move(stored);
    return fit;
}

}  // namespace petrichor::cli
