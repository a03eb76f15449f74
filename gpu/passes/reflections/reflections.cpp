#include "gpu/passes/reflections/reflections.h"

#include <utility>

#include "gpu/frame/frame_words_io.h"
#include "gpu/passes/reflections/reflections_io.h"

namespace petrichor::gpu {

void clear_mirrors(FrameGraph& graph, FrameTargets& targets)
{
    GpuImage& image = *targets.mirror_weight;
    graph.add(TransferPass{.name = "reflections",
                           .transfers = {{&image, nullptr, Use::TransferTarget}},
                           .record = [&image](VkCommandBuffer commands) {
                               const VkClearColorValue nothing{};
                               const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
                               vkCmdClearColorImage(commands, image.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                                    &nothing, 1, &all);
                           }});
}

void add_reflections(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                     const ProbeTable& probes, bool with_probes, const ConstantsRange& constants,
                     const MirrorOutputs& outputs, Pixels pixels)
{
    const SamplerHandle& nearest = targets.nearest;
    FrameTargets& shown = outputs.solid ? *outputs.solid : targets;
    ComputePass pass{
        .name = "reflections",
        .shader = "reflections.comp",
        .constants = {{FRAME_SPEC_LANES, targets.lanes},
                      {REFLECTIONS_SPEC_PROBES, with_probes ? probes.count() : 0u},
                      {REFLECTIONS_SPEC_SPLIT, outputs.split},
                      {REFLECTIONS_SPEC_LABEL, outputs.label ? targets.weather_kept() : 0u},
                      {REFLECTIONS_SPEC_PICTURE, outputs.picture},
                      {REFLECTIONS_SPEC_GLOWS, outputs.glows},
                      {REFLECTIONS_SPEC_WINDOW, outputs.around != nullptr}},
        .bindings = {{REFLECTIONS_FRAME, frame_binding(constants)},
                     {REFLECTIONS_DEPTH_ROWS, texels(*shown.rows.depth)},
                     {REFLECTIONS_OWN_DEPTH, texels(*targets.rows.depth)},
                     {REFLECTIONS_RADIANCE, sampled(*shown.radiance, nearest)},
                     {REFLECTIONS_MIRROR_WEIGHT, sampled(*targets.mirror_weight, nearest)},
                     {REFLECTIONS_MIRROR_SHAPE, sampled(*targets.mirror_shape, nearest)},
                     {REFLECTIONS_SPECULAR, sampled(*sky.specular, sky.linear)},
                     {REFLECTIONS_ACCUMULATED, storage(*targets.accumulated)},
                     {REFLECTIONS_PROBES, texels(probes.rows())},
                     {REFLECTIONS_PROBE_LIGHT, texels(probes.light())},
                     {REFLECTIONS_PIXELS, texels(outputs.label ? *targets.pixel_list : *targets.mirror_list)},
                     {REFLECTIONS_WEATHER, texels(shown.weather_rows())},
                     {REFLECTIONS_EMISSION, texels(*shown.rows.emission)},
                     {REFLECTIONS_PARTS, storage(*outputs.parts)},
                     {REFLECTIONS_LABEL, storage(*outputs.labels)},
                     {REFLECTIONS_AROUND_DEPTH, texels(outputs.around ? *outputs.around->depth : *targets.rows.depth)},
                     {REFLECTIONS_AROUND_LIGHT, texels(outputs.around ? *outputs.around->light : *targets.rows.emission)},
                     {REFLECTIONS_AROUND_GLOW, texels(outputs.around ? *outputs.around->glow : *targets.rows.emission)}},
        .push = PushBlock(outputs.window),
        .groups = {}};
    if (outputs.label) {  // where nothing is mirrored that is said, too
        add_over_pixels(graph, targets, std::move(pass), pixels);
        return;
    }
    add_list_groups(graph, pass.name, *targets.mirror_list, *targets.mirror_groups);
    add_over_list(graph, std::move(pass), *targets.mirror_groups);
}

}  // namespace petrichor::gpu
