#include "gpu/device/graph.h"

#include <algorithm>
#include <array>
#include <map>

namespace petrichor::gpu {

namespace {

struct Needs {
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    bool writes;
};

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
        case Use::TransferSource:
            return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_READ_BIT, false};
        case Use::TransferTarget:
            return {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_TRANSFER_READ_BIT, true};
        case Use::HostRead:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_HOST_BIT,
                    VK_ACCESS_2_HOST_READ_BIT, false};
    }
    return {};
}

bool writes(Use use)
{
    return needs_of(use).writes;
}

const std::string& name_of(const ResourceUse& use)
{
    return use.image ? use.image->name : use.buffer->name;
}

// Barriers that bring every resource of a pass into the state it needs.
struct Barriers {
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;

    void add(const ResourceUse& use)
    {
        const Needs needs = needs_of(use.use);
        ResourceState& state = use.image ? use.image->state : use.buffer->state;
        const bool layout_changes = use.image && state.layout != needs.layout;
        const bool hazard = state.written || (needs.writes && state.stages != 0);
        if (!layout_changes && !hazard) {
            state.stages |= needs.stages;
            state.access |= needs.access;
            state.written = needs.writes;
            return;
        }
        if (use.image) {
            VkImageMemoryBarrier2 barrier{};
            barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
            barrier.srcStageMask = state.stages;
            barrier.srcAccessMask = state.written ? state.access : VkAccessFlags2{0};
            barrier.dstStageMask = needs.stages;
            barrier.dstAccessMask = needs.access;
            barrier.oldLayout = state.layout;
            barrier.newLayout = needs.layout;
            barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.image = use.image->image.get();
            barrier.subresourceRange = {use.image->aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                        VK_REMAINING_ARRAY_LAYERS};
            images.push_back(barrier);
        } else {
            VkBufferMemoryBarrier2 barrier{};
            barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
            barrier.srcStageMask = state.stages;
            barrier.srcAccessMask = state.written ? state.access : VkAccessFlags2{0};
            barrier.dstStageMask = needs.stages;
            barrier.dstAccessMask = needs.access;
            barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.buffer = use.buffer->buffer.get();
            barrier.size = VK_WHOLE_SIZE;
            buffers.push_back(barrier);
        }
        state = {needs.layout, needs.stages, needs.access, needs.writes};
    }

    void record(VkCommandBuffer commands) const
    {
        if (images.empty() && buffers.empty()) return;
        VkDependencyInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
        info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
        info.pImageMemoryBarriers = images.data();
        info.bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers.size());
        info.pBufferMemoryBarriers = buffers.data();
        vkCmdPipelineBarrier2(commands, &info);
    }
};

QueryPoolHandle make_query_pool(const Device& device, std::uint32_t count)
{
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = count;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "creating a query pool");
    vkResetQueryPool(device.handle(), pool, 0, count);
    return {device.handle(), pool};
}

}  // namespace

void PassContext::bind_compute(const std::string& shader,
                               const std::vector<Specialization>& specialization,
                               const std::vector<Binding>& bindings)
{
    const Pipeline& pipeline = pipelines_->compute(shader, specialization, types_of(bindings));
    layout_ = pipeline.layout;
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    const VkDescriptorSet set = descriptors_->set(pipeline.set_layouts[0], bindings);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set,
                            0, nullptr);
}

void PassContext::push_bytes(const void* bytes, std::size_t size)
{
    std::array<std::byte, kPushBytes> block{};
    std::memcpy(block.data(), bytes, size);
    vkCmdPushConstants(
        commands_, layout_,
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0,
        kPushBytes, block.data());
}

void PassContext::dispatch(int groups_x, int groups_y, int groups_z)
{
    vkCmdDispatch(commands_, static_cast<std::uint32_t>(groups_x),
                  static_cast<std::uint32_t>(groups_y), static_cast<std::uint32_t>(groups_z));
}

void PassContext::dispatch_over(int width, int height, int tile, int depth)
{
    dispatch((width + tile - 1) / tile, (height + tile - 1) / tile, depth);
}

std::vector<PassTime> FrameGraph::execute(const Device& device, PipelineCache& pipelines,
                                          DescriptorArena& descriptors)
{
    const auto queries = static_cast<std::uint32_t>(passes_.size() + 1);
    const QueryPoolHandle pool = make_query_pool(device, queries);
    device.run([&](VkCommandBuffer commands) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool.get(), 0);
        std::uint32_t query = 1;
        for (const Pass& pass : passes_) {
            device.begin_label(commands, pass.name);
            Barriers barriers;
            for (const ResourceUse& use : pass.uses) barriers.add(use);
            barriers.record(commands);
            PassContext context(device, pipelines, descriptors, commands);
            if (pass.record) pass.record(context);
            device.end_label(commands);
            vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool.get(),
                                 query++);
        }
    });
    std::vector<std::uint64_t> ticks(queries);
    check(vkGetQueryPoolResults(device.handle(), pool.get(), 0, queries,
                                ticks.size() * sizeof(std::uint64_t), ticks.data(),
                                sizeof(std::uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "reading timestamps");
    std::vector<PassTime> times;
    std::map<std::string, std::size_t> by_name;
    const double to_ms = static_cast<double>(device.limits().timestampPeriod) * 1e-6;
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        const auto [slot, is_new] = by_name.try_emplace(passes_[i].name, times.size());
        if (is_new) times.push_back({passes_[i].name, 0.0});
        times[slot->second].milliseconds += static_cast<double>(ticks[i + 1] - ticks[i]) * to_ms;
    }
    return times;
}

std::string FrameGraph::describe() const
{
    std::string text;
    std::map<std::string, bool> seen;
    for (const Pass& pass : passes_) {
        if (seen[pass.name]) continue;
        seen[pass.name] = true;
        std::string reads;
        std::string written;
        for (const ResourceUse& use : pass.uses) {
            std::string& list = writes(use.use) ? written : reads;
            list += (list.empty() ? "" : ", ") + name_of(use);
        }
        text += pass.name + ": reads " + (reads.empty() ? "nothing" : reads) + "; writes " +
                (written.empty() ? "nothing" : written) + "\n";
    }
    return text;
}

void record_mips(VkCommandBuffer commands, const GpuImage& image)
{
    const auto barrier = [&](int mip, VkImageLayout from, VkImageLayout to) {
        VkImageMemoryBarrier2 b{};
        b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
        b.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        b.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        b.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        b.dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
        b.oldLayout = from;
        b.newLayout = to;
        b.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        b.image = image.image.get();
        b.subresourceRange = {image.aspect(), static_cast<std::uint32_t>(mip), 1, 0,
                              VK_REMAINING_ARRAY_LAYERS};
        VkDependencyInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
        info.imageMemoryBarrierCount = 1;
        info.pImageMemoryBarriers = &b;
        vkCmdPipelineBarrier2(commands, &info);
    };
    const auto corner = [&](int mip) {
        return VkOffset3D{std::max(1, image.width >> mip), std::max(1, image.height >> mip), 1};
    };
    for (int mip = 1; mip < image.mips; ++mip) {
        barrier(mip - 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkImageBlit blit{};
        const auto layers = static_cast<std::uint32_t>(image.layers);
        blit.srcSubresource = {image.aspect(), static_cast<std::uint32_t>(mip - 1), 0, layers};
        blit.srcOffsets[1] = corner(mip - 1);
        blit.dstSubresource = {image.aspect(), static_cast<std::uint32_t>(mip), 0, layers};
        blit.dstOffsets[1] = corner(mip);
        vkCmdBlitImage(commands, image.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                       image.image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit,
                       VK_FILTER_LINEAR);
        barrier(mip - 1, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    }
}

}  // namespace petrichor::gpu
