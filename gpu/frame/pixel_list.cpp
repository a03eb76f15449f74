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
    pass.constants.push_back({PIXEL_LIST_SPEC, pixels != Pixels::All});
    if (pixels != Pixels::Listed) {
        pass.groups = groups_over(targets.width, targets.height, 8);
        graph.add(std::move(pass));
        return;
    }
    DispatchListPass list{.name = std::move(pass.name),
                          .bindings = std::move(pass.bindings),
                          .arguments = targets.pixel_groups.get(),
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
