#include "gpu/frame/pixel_list.h"

#include <utility>

#include "gpu/frame/pixel_list_io.h"

namespace petrichor::gpu {

void add_over_pixels(FrameGraph& graph, FrameTargets& targets, ComputePass pass, bool listed)
{
    pass.constants.push_back({PIXEL_LIST_SPEC, listed});
    if (!listed) {
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
