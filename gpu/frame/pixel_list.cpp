#include "gpu/frame/pixel_list.h"

#include <utility>

#include "gpu/frame/pixel_list_io.h"

namespace petrichor::gpu {

void add_all_pixels(FrameGraph& graph, FrameTargets& targets)
{
    GpuBuffer& list = *targets.pixel_list;
    graph.add(TransferPass{.name = "adaptive",
                           .transfers = {{nullptr, &list, Use::TransferTarget}},
                           .record = [&list](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, list.buffer.get(), 0, 4, PIXEL_LIST_ALL);
                           }});
}

void add_over_pixels(FrameGraph& graph, FrameTargets& targets, ComputePass pass, Pixels pixels)
{
    if (pixels == Pixels::Listed) {
        add_over_list(graph, std::move(pass), *targets.pixel_groups);
        return;
    }
    pass.constants.push_back({PIXEL_LIST_SPEC, pixels != Pixels::All});
    pass.groups = groups_over(targets.width, targets.height, 8);
    graph.add(std::move(pass));
}

void add_empty_list(FrameGraph& graph, const std::string& pass, GpuBuffer& list)
{
    graph.add(TransferPass{.name = pass,
                           .transfers = {{nullptr, &list, Use::TransferTarget}},
                           .record = [&list](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, list.buffer.get(), 0, 4, 0);
                           }});
}

void add_list_groups(FrameGraph& graph, const std::string& pass, GpuBuffer& list, GpuBuffer& groups)
{
    graph.add(ComputePass{.name = pass,
                          .shader = "list_groups.comp",
                          .constants = {},
                          .bindings = {{LIST_GROUPS_LIST, storage_buffer(list)},
                                       {LIST_GROUPS_GROUPS, storage_buffer(groups)}},
                          .push = {},
                          .groups = {}});
}

void add_over_list(FrameGraph& graph, ComputePass pass, GpuBuffer& groups)
{
    pass.constants.push_back({PIXEL_LIST_SPEC, 1});
    DispatchListPass list{.name = std::move(pass.name),
                          .bindings = std::move(pass.bindings),
                          .arguments = &groups,
                          .pipelines = {},
                          .record = {}};
    list.pipelines.push_back({pass.shader, pass.constants, {types_of(list.bindings)}});
    list.record = [shader = std::move(pass.shader),
                   constants = std::move(pass.constants)](DispatchContext& context) {
        context.bind(shader, constants);
        context.dispatch_indirect(0);
    };
    graph.add(std::move(list));
}

}  // namespace petrichor::gpu
