#include "gpu/device/graph.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <ctime>
#include <map>
#include <stdexcept>

namespace petrichor::gpu {

namespace {

// Barriers that bring every resource of a pass into the state it needs.
struct Barriers {
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;

    void add(GpuImage& image, Use use)
    {
        const auto needed = advance(image.state, use, true);
        if (!needed) return;
        VkImageMemoryBarrier2 barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
        barrier.srcStageMask = needed->from_stages;
        barrier.srcAccessMask = needed->from_access;
        barrier.dstStageMask = needed->to_stages;
        barrier.dstAccessMask = needed->to_access;
        barrier.oldLayout = needed->from_layout;
        barrier.newLayout = needed->to_layout;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.image.get();
        barrier.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                    VK_REMAINING_ARRAY_LAYERS};
        images.push_back(barrier);
    }

    void add(GpuBuffer& buffer, Use use)
    {
        const auto needed = advance(buffer.state, use, false);
        if (!needed) return;
        VkBufferMemoryBarrier2 barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
        barrier.srcStageMask = needed->from_stages;
        barrier.srcAccessMask = needed->from_access;
        barrier.dstStageMask = needed->to_stages;
        barrier.dstAccessMask = needed->to_access;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.buffer = buffer.buffer.get();
        barrier.size = VK_WHOLE_SIZE;
        buffers.push_back(barrier);
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

VkRenderingAttachmentInfo attachment_info(const Attachment& attachment, Use use)
{
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    if (!attachment.image) return info;
    info.imageView = attachment.view ? attachment.view : attachment.image->view.get();
    info.imageLayout = needs_of(use).layout;
    info.loadOp = attachment.keep ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

void record_draws(const DrawPass& pass, VkCommandBuffer commands, PipelineCache& pipelines,
                  DescriptorArena& descriptors)
{
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const Attachment& color : pass.colors) {
        colors.push_back(attachment_info(color, Use::ColorTarget));
    }
    const VkRenderingAttachmentInfo depth = attachment_info(pass.depth, Use::DepthTarget);
    const VkExtent2D extent{static_cast<std::uint32_t>(pass.width),
                            static_cast<std::uint32_t>(pass.height)};
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    rendering.pColorAttachments = colors.data();
    rendering.pDepthAttachment = pass.depth.image ? &depth : nullptr;
    PassContext context(pipelines, descriptors, commands, pass);
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{
        0.0f, 0.0f, static_cast<float>(pass.width), static_cast<float>(pass.height), 0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewportWithCount(commands, 1, &viewport);
    vkCmdSetScissorWithCount(commands, 1, &scissor);
    pass.record(context);
    vkCmdEndRendering(commands);
}

void record_dispatch(const ComputePass& pass, VkCommandBuffer commands, PipelineCache& pipelines,
                     DescriptorArena& descriptors)
{
    const Pipeline& pipeline =
        pipelines.compute(pass.shader, pass.constants, {types_of(pass.bindings)});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    const VkDescriptorSet set = descriptors.set(pipeline.set_layouts[0], pass.bindings);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set,
                            0, nullptr);
    vkCmdPushConstants(commands, pipeline.layout, kAllStages, 0, kPushBytes,
                       pass.push.bytes.data());
    vkCmdDispatch(commands, pass.groups.x, pass.groups.y, pass.groups.z);
}

}  // namespace

void give_back_free_memory()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

Groups groups_over(int width, int height, int tile, int layers)
{
    return {static_cast<std::uint32_t>((width + tile - 1) / tile),
            static_cast<std::uint32_t>((height + tile - 1) / tile),
            static_cast<std::uint32_t>(layers)};
}

PassContext::PassContext(PipelineCache& pipelines, DescriptorArena& descriptors,
                         VkCommandBuffer commands, const DrawPass& pass)
    : pipelines_(&pipelines),
      descriptors_(&descriptors),
      commands_(commands),
      set_types_(types_of(pass.bindings))
{
    if (!pass.bindings.empty()) {
        set_ = descriptors.set(pipelines.set_layout(set_types_), pass.bindings);
    }
    for (const Attachment& color : pass.colors) color_formats_.push_back(color.format());
}

void PassContext::bind(const Pipeline& pipeline)
{
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline.get());
    layout_ = pipeline.layout;
    if (set_) bind_set(0, set_);
}

void PassContext::bind_set(std::uint32_t index, VkDescriptorSet set)
{
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, index, 1, &set, 0,
                            nullptr);
}

void PassContext::push_block(const PushBlock& block)
{
    vkCmdPushConstants(commands_, layout_, kAllStages, 0, kPushBytes, block.bytes.data());
}

DispatchContext::DispatchContext(PipelineCache& pipelines, DescriptorArena& descriptors,
                                 VkCommandBuffer commands, const DispatchListPass& pass)
    : pipelines_(&pipelines),
      descriptors_(&descriptors),
      commands_(commands),
      pass_(&pass),
      set_types_(types_of(pass.bindings)),
      set_(descriptors.set(pipelines.set_layout(set_types_), pass.bindings))
{
}

void DispatchContext::bind(const std::string& shader, const std::vector<Specialization>& constants,
                           const BindingTypes& set1)
{
    std::vector<BindingTypes> sets{set_types_};
    if (!set1.empty()) sets.push_back(set1);
    const Pipeline& pipeline = pipelines_->compute(shader, constants, sets);
    if (&pipeline == pipeline_) return;
    pipeline_ = &pipeline;
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set_,
                            0, nullptr);
}

void DispatchContext::bind_set1(const std::vector<Binding>& bindings)
{
    const VkDescriptorSet set = descriptors_->set(pipeline_->set_layouts[1], bindings);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_->layout, 1, 1,
                            &set, 0, nullptr);
}

void DispatchContext::push_block(const PushBlock& block)
{
    vkCmdPushConstants(commands_, pipeline_->layout, kAllStages, 0, kPushBytes, block.bytes.data());
}

void DispatchContext::dispatch_indirect(std::uint32_t entry)
{
    vkCmdDispatchIndirect(commands_, pass_->arguments->buffer.get(),
                          entry * sizeof(VkDispatchIndirectCommand));
}

// One touch a resource. A pass cannot both read and write one through two bindings, nor see one
// image in two layouts.
void FrameGraph::touch(Pass& pass, const Touch& touch)
{
    for (const Touch& other : pass.touches) {
        if (other.image != touch.image || other.buffer != touch.buffer) continue;
        if (other.use == touch.use) return;
        const Needs a = needs_of(other.use);
        const Needs b = needs_of(touch.use);
        if (a.writes || b.writes || (touch.image && a.layout != b.layout)) {
            throw std::logic_error("pass " + pass.name + " uses " +
                                   (touch.image ? touch.image->name : touch.buffer->name) +
                                   " in two ways that exclude each other");
        }
    }
    pass.touches.push_back(touch);
}

void FrameGraph::touch(Pass& pass, const Bindings& bindings)
{
    for (const Bound& bound : bindings) {
        touch(pass, {bound.binding.image, bound.binding.buffer, bound.binding.use});
    }
}

void FrameGraph::add(ComputePass compute)
{
    Pass pass;
    pass.name = compute.name;
    touch(pass, compute.bindings);
    pass.pipelines = {{compute.shader, compute.constants, {types_of(compute.bindings)}}};
    pass.record = [compute = std::move(compute)](VkCommandBuffer commands, PipelineCache& pipelines,
                                                 DescriptorArena& descriptors) {
        record_dispatch(compute, commands, pipelines, descriptors);
    };
    passes_.push_back(std::move(pass));
}

void FrameGraph::add(DispatchListPass list)
{
    Pass pass;
    pass.name = list.name;
    touch(pass, list.bindings);
    if (list.arguments) touch(pass, {nullptr, list.arguments, Use::IndirectRead});
    pass.pipelines = list.pipelines;
    pass.record = [list = std::move(list)](VkCommandBuffer commands, PipelineCache& pipelines,
                                           DescriptorArena& descriptors) {
        DispatchContext context(pipelines, descriptors, commands, list);
        list.record(context);
    };
    passes_.push_back(std::move(pass));
}

void FrameGraph::add(DrawPass draw)
{
    Pass pass;
    pass.name = draw.name;
    touch(pass, draw.bindings);
    for (const Attachment& color : draw.colors) {
        if (color.image) touch(pass, {color.image, nullptr, Use::ColorTarget});
    }
    if (draw.depth.image) touch(pass, {draw.depth.image, nullptr, Use::DepthTarget});
    pass.record = [draw = std::move(draw)](VkCommandBuffer commands, PipelineCache& pipelines,
                                           DescriptorArena& descriptors) {
        record_draws(draw, commands, pipelines, descriptors);
    };
    passes_.push_back(std::move(pass));
}

void FrameGraph::add(TransferPass transfer)
{
    Pass pass;
    pass.name = transfer.name;
    for (const Transfer& t : transfer.transfers) touch(pass, {t.image, t.buffer, t.use});
    pass.record = [record = std::move(transfer.record)](VkCommandBuffer commands, PipelineCache&,
                                                        DescriptorArena&) {
        if (record) record(commands);
    };
    passes_.push_back(std::move(pass));
}

void FrameGraph::read_back(const std::vector<GpuBuffer*>& buffers)
{
    TransferPass pass{"read_back", {}, {}};
    for (GpuBuffer* buffer : buffers) {
        pass.transfers.push_back({nullptr, buffer, Use::HostRead});
    }
    add(std::move(pass));
}

std::vector<ComputeDesc> FrameGraph::pipelines() const
{
    std::vector<ComputeDesc> wanted;
    for (const Pass& pass : passes_) wanted.insert(wanted.end(), pass.pipelines.begin(), pass.pipelines.end());
    return wanted;
}

std::vector<PassTime> FrameGraph::execute(const Device& device, PipelineCache& pipelines,
                                          DescriptorArena& descriptors)
{
    const auto queries = static_cast<std::uint32_t>(passes_.size() + 1);
    const QueryPoolHandle pool = make_query_pool(device, queries);
    // A driver that compiles at first use takes memory for it: pass by pass what that leaves free is given back before the
    // next one takes its own.
    const bool apart = pipelines.prepare(this->pipelines()) >= PipelineCache::kMany || device.passes_apart();
    const auto stamp = [&](VkCommandBuffer commands, std::size_t query) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool.get(),
                             static_cast<std::uint32_t>(query));
    };
    const auto record = [&](VkCommandBuffer commands, const Pass& pass) {
        device.begin_label(commands, pass.name);
        Barriers barriers;
        for (const Touch& touch : pass.touches) {
            if (touch.image) {
                barriers.add(*touch.image, touch.use);
            } else {
                barriers.add(*touch.buffer, touch.use);
            }
        }
        barriers.record(commands);
        pass.record(commands, pipelines, descriptors);
        device.end_label(commands);
    };
    std::vector<double> cpu_ms(passes_.size(), 0.0);
    bool many_made = false;
    const auto settle = [&] {
        if (!pipelines.made_many()) return;
        many_made = true;
        give_back_free_memory();
    };
    if (apart) {
        device.run([&](VkCommandBuffer commands) { stamp(commands, 0); });
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            const std::clock_t before = std::clock();
            device.run([&](VkCommandBuffer commands) {
                record(commands, passes_[i]);
                stamp(commands, i + 1);
                settle();
            });
            cpu_ms[i] = 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
        }
    } else {
        device.run([&](VkCommandBuffer commands) {
            stamp(commands, 0);
            for (std::size_t i = 0; i < passes_.size(); ++i) {
                record(commands, passes_[i]);
                stamp(commands, i + 1);
            }
            settle();
        });
    }
    if (many_made) give_back_free_memory();
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
        if (is_new) times.push_back({passes_[i].name});
        if (device.passes_apart()) times[slot->second].cpu_milliseconds += cpu_ms[i];
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
        for (const Touch& touch : pass.touches) {
            std::string& list = needs_of(touch.use).writes ? written : reads;
            list +=
                (list.empty() ? "" : ", ") + (touch.image ? touch.image->name : touch.buffer->name);
        }
        text += pass.name + ": reads " + (reads.empty() ? "nothing" : reads) + "; writes " +
                (written.empty() ? "nothing" : written) + "\n";
    }
    return text;
}

void add_rows(FrameGraph& graph, const std::string& name,
              const std::vector<std::pair<GpuImage*, GpuBuffer*>>& images)
{
    TransferPass pass;
    pass.name = name;
    std::vector<std::pair<GpuImage*, GpuBuffer*>> copies;
    for (const auto& [image, rows] : images) {
        const bool shown = rows->shows == image;
        pass.transfers.push_back({.image = image, .use = shown ? Use::SeenAsRows : Use::TransferSource});
        pass.transfers.push_back({.buffer = rows, .use = shown ? Use::RowsOfImage : Use::TransferTarget});
        if (!shown) copies.emplace_back(image, rows);
    }
    pass.record = [copies = std::move(copies)](VkCommandBuffer commands) {
        for (const auto& [image, rows] : copies) {
            VkBufferImageCopy region{};
            region.imageSubresource = {image->aspect(), 0, 0, 1};
            region.imageExtent = {static_cast<std::uint32_t>(image->width),
                                  static_cast<std::uint32_t>(image->height), 1};
            vkCmdCopyImageToBuffer(commands, image->image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   rows->buffer.get(), 1, &region);
        }
    };
    graph.add(std::move(pass));
}

void record_mips(VkCommandBuffer commands, const GpuImage& image, int first)
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
    for (int mip = first + 1; mip < image.mips; ++mip) {
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
