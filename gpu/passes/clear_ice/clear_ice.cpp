#include "gpu/passes/clear_ice/clear_ice.h"

#include <utility>

#include "gpu/passes/clear_ice/clear_ice_io.h"

namespace petrichor::gpu {

void add_clear_ice(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky, const ProbeTable& probes, bool with_probes,
                   const ConstantsRange& constants, std::uint32_t model, bool gusts, const MirrorOutputs& outputs,
                   Pixels pixels)
{
    const PictureAround* around = outputs.around;
    const shared::ClearIcePush push{outputs.window, model};
    add_empty_list(graph, "clear_ice", *targets.ice_list);
    add_over_pixels(graph, targets,
                    ComputePass{.name = "clear_ice",
                                .shader = "ice_list.comp",
                                .constants = {},
                                .bindings = {{ICE_LIST_FRAME, frame_binding(constants)},
                                             {ICE_LIST_MATERIAL, texels(*targets.rows.material)},
                                             {ICE_LIST_DEPTH_ROWS, texels(*targets.rows.depth)},
                                             {ICE_LIST_PIXELS, texels(*targets.pixel_list)},
                                             {ICE_LIST_LIST, storage_buffer(*targets.ice_list)}},
                                .push = PushBlock(push),
                                .groups = {}},
                    pixels);
    ComputePass pass{
        .name = "clear_ice",
        .shader = "clear_ice.comp",
        .constants = {{CLEAR_ICE_SPEC_PROBES, with_probes ? probes.count() : 0u},
                      {CLEAR_ICE_SPEC_SPLIT, outputs.split},
                      {CLEAR_ICE_SPEC_GUSTS, gusts},
                      {CLEAR_ICE_SPEC_WINDOW, around != nullptr}},
        .bindings = {{CLEAR_ICE_FRAME, frame_binding(constants)},
                     {CLEAR_ICE_DEPTH_ROWS, texels(*targets.rows.depth)},
                     {CLEAR_ICE_NORMALS, texels(*targets.rows.normals)},
                     {CLEAR_ICE_MATERIAL, texels(*targets.rows.material)},
                     {CLEAR_ICE_RADIANCE, storage(*targets.radiance)},
                     {CLEAR_ICE_ACCUMULATED, storage(*targets.accumulated)},
                     {CLEAR_ICE_SPECULAR, sampled(*sky.specular, sky.linear)},
                     {CLEAR_ICE_PROBES, texels(probes.rows())},
                     {CLEAR_ICE_PROBE_LIGHT, texels(probes.light())},
                     {CLEAR_ICE_PIXELS, texels(*targets.ice_list)},
                     {CLEAR_ICE_PARTS, storage(*outputs.parts)},
                     {CLEAR_ICE_AROUND_DEPTH, texels(around ? *around->depth : *targets.rows.depth)},
                     {CLEAR_ICE_AROUND_LIGHT, texels(around ? *around->light : *targets.rows.emission)}},
        .push = PushBlock(push),
        .groups = {}};
    add_list_groups(graph, pass.name, *targets.ice_list, *targets.ice_groups);
    add_over_list(graph, std::move(pass), *targets.ice_groups);
}

}  // namespace petrichor::gpu
