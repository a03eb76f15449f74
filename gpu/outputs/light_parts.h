#ifndef PETRICHOR_GPU_OUTPUTS_LIGHT_PARTS_H
#define PETRICHOR_GPU_OUTPUTS_LIGHT_PARTS_H

#include <memory>
#include <vector>

#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"

namespace petrichor::gpu {

/// Images of the parts of a picture's light and of its reflection label, a layer each; made in frames
/// that ask for some. Passes that light bind them always and write them only when told to.
struct LightParts {
    bool split = false;  ///< this frame takes its light apart
    bool label = false;  ///< .. labels what is mirrored
    std::unique_ptr<GpuImage> none;   ///< to bind in other frames
    std::unique_ptr<GpuImage> sum;    ///< over samples, as FrameTargets::accumulated
    std::unique_ptr<GpuImage> solid;  ///< behind all blended layers, of one sample
    std::unique_ptr<GpuImage> layer;  ///< of the blended layer at work
    std::unique_ptr<GpuImage> front;  ///< of the layers so far
    std::unique_ptr<GpuImage> mean;   ///< of the first two samples, of frames that shade some pixels twice
    std::unique_ptr<GpuImage> air;    ///< light of what is drawn over the picture; alpha: what it hides
    std::vector<std::unique_ptr<GpuBuffer>> values;  ///< by layer of those asked, read by the host

    GpuImage& sum_or_none() const { return split || label ? *sum : *none; }
    GpuImage& or_none(const std::unique_ptr<GpuImage>& image) const { return split ? *image : *none; }
};

/// Rows of aov_table() that are of the parts or the label, not of the G-buffer.
bool is_light_part(std::size_t row);
/// .. for which the passes keep the light in parts; only the label of reflections needs none.
bool takes_light_apart(std::size_t row);
/// Rows that need the number of the material at each pixel.
bool needs_materials(std::size_t row);

/// Makes what a frame of this size needs that asks for these rows.
///   layered   blended layers are drawn apart
///   adaptive  samples from the third on shade some pixels only
void prepare_light_parts(LightParts& parts, MemoryArena& arena, const std::vector<std::size_t>& rows,
                         int width, int height, bool layered, bool adaptive);

/// Without light.
void clear_light_parts(FrameGraph& graph, GpuImage& image);

// What pixels take that later samples do not shade (gpu/passes/adaptive): the mean of the first two.
//
//   edits    lit, parts.mean: what, PARTS_MEAN_... says
//   asked    with PARTS_MEAN_TAKE: a bit a pixel that is shaded
void add_parts_mean(FrameGraph& graph, const FrameTargets& targets, LightParts& parts, GpuImage& lit,
                    int what, GpuBuffer* asked, const ConstantsRange& constants);

// The asked parts as the host reads them. mirrors: the frame has reflections.
//
//   reads    light_parts, light_parts_air
//   writes   light_part_values
void add_light_parts(FrameGraph& graph, const FrameTargets& targets, LightParts& parts,
                     const ConstantsRange& constants, bool mirrors);

/// The numbers of a row, pixel by pixel, as the last frame wrote them.
std::vector<float> read_light_part(const LightParts& parts, std::size_t row, std::size_t pixels);

}  // namespace petrichor::gpu

#endif
