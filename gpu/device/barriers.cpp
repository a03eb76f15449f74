#include "gpu/device/barriers.h"

namespace petrichor::gpu {

Needs needs_of(Use use)
{
    constexpr VkPipelineStageFlags2 shaders = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                              VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                              VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    switch (use) {
        case Use::ColorTarget:
            return {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                    true};
        case Use::DepthTarget:
            return {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                        VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                    true};
        case Use::Sampled:
            return {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, shaders,
                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, false};
        case Use::StorageRead:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                    VK_ACCESS_2_SHADER_STORAGE_READ_BIT, false};
        case Use::StorageWrite:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                    true};
        case Use::TexelRead:
            return {VK_IMAGE_LAYOUT_UNDEFINED, shaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, false};
        case Use::UniformRead:
            return {VK_IMAGE_LAYOUT_UNDEFINED, shaders, VK_ACCESS_2_UNIFORM_READ_BIT, false};
        case Use::IndirectRead:
            return {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false};
        case Use::TransferSource:
            return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_READ_BIT, false};
        case Use::TransferTarget:
            return {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_TRANSFER_READ_BIT, true};
        case Use::HostRead:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_HOST_BIT,
                    VK_ACCESS_2_HOST_READ_BIT, false};
        case Use::SeenAsRows:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                    VK_ACCESS_2_MEMORY_READ_BIT, false};
        case Use::RowsOfImage:
            return {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, true};
    }
    return {};
}

std::optional<Dependency> advance(ResourceState& state, Use use, bool is_image)
{
    const Needs needs = needs_of(use);
    const std::uint32_t bit = 1u << static_cast<std::uint32_t>(use);
    const bool layout_changes = is_image && state.layout != needs.layout;
    const bool written = state.write_stages != VK_PIPELINE_STAGE_2_NONE;

    if (!needs.writes && !layout_changes) {
        // The readers of one write do not wait for each other, but each kind waits for the write:
        // what is visible to a sampler is not yet visible to a uniform block or to the host.
        const bool waits = written && (state.seen_by & bit) == 0;
        const Dependency dependency{state.write_stages, state.write_access, needs.stages,
                                    needs.access,       state.layout,       state.layout};
        state.read_stages |= needs.stages;
        state.seen_by |= bit;
        if (!waits) return std::nullopt;
        return dependency;
    }

    const bool touched = written || state.read_stages != VK_PIPELINE_STAGE_2_NONE;
    const Dependency dependency{state.write_stages | state.read_stages,
                                state.write_access,
                                needs.stages,
                                needs.access,
                                state.layout,
                                is_image ? needs.layout : state.layout};
    constexpr VkAccessFlags2 kWrites =
        VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
        VK_ACCESS_2_MEMORY_WRITE_BIT;
    state.layout = dependency.to_layout;
    state.write_stages = needs.stages;
    // A change of layout for a reader has written by itself: later readers chain to this stage.
    state.write_access = needs.access & kWrites;
    state.read_stages = needs.writes ? VkPipelineStageFlags2{0} : needs.stages;
    state.seen_by = needs.writes ? 0u : bit;
    if (!layout_changes && !touched) return std::nullopt;
    return dependency;
}

}  // namespace petrichor::gpu
