#include "gpu/device/resources.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace petrichor::gpu {

namespace {

constexpr VkDeviceSize kBlockBytes = 32ull << 20;

VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

VkMemoryPropertyFlags memory_flags(const BufferDesc& desc)
{
    return desc.host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                     : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
}

ImageViewHandle make_view(const Device& device, const GpuImage& image, VkImageViewType type,
                          std::uint32_t first_mip, std::uint32_t mips)
{
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image.image.get();
    info.viewType = type;
    info.format = image.format;
    info.subresourceRange = {image.aspect(), first_mip, mips, 0,
                             static_cast<std::uint32_t>(image.layers)};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle(), &info, nullptr, &view), "creating an image view");
    return {device.handle(), view};
}

}  // namespace

VkImageAspectFlags GpuImage::aspect() const
{
    const bool depth = format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
    return depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

MemoryArena::Place MemoryArena::place(const VkMemoryRequirements& needs,
                                      VkMemoryPropertyFlags flags, bool image)
{
    const std::uint32_t type = device_->memory_type(needs.memoryTypeBits, flags);
    const bool host = (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
    for (Block& block : blocks_) {
        const VkDeviceSize offset = align_up(block.used, needs.alignment);
        const bool fits = block.type == type && block.images == image && block.host == host;
        if (!fits || offset + needs.size > block.size) continue;
        block.used = offset + needs.size;
        return {block.memory.get(), offset, block.mapped ? block.mapped + offset : nullptr};
    }
    Block block;
    block.type = type;
    block.images = image;
    block.host = host;
    block.size = std::max(kBlockBytes, needs.size);
    // Large things get a block of their own, so that little is wasted.
    if (needs.size > kBlockBytes / 2) block.size = needs.size;
    block.used = needs.size;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = block.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device_->handle(), &info, nullptr, &memory), "allocating device memory");
    block.memory = MemoryHandle(device_->handle(), memory);
    if (host) {
        void* mapped = nullptr;
        check(vkMapMemory(device_->handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped),
              "mapping memory");
        block.mapped = static_cast<std::byte*>(mapped);
    }
    bytes_ += block.size;
    blocks_.push_back(std::move(block));
    return {memory, 0, blocks_.back().mapped};
}

std::unique_ptr<GpuImage> MemoryArena::unbound_image(const ImageDesc& desc, VkImageTiling tiling) const
{
    const auto limit = static_cast<int>(device_->limits().maxImageDimension2D);
    if (desc.width < 1 || desc.height < 1 || desc.width > limit || desc.height > limit) {
        throw Error("gpu: image " + desc.name + " of " + std::to_string(desc.width) + " x " +
                        std::to_string(desc.height) + " is not possible; sides of 1 to " +
                        std::to_string(limit) + " are",
                    "Choose a smaller size.");
    }
    auto made = std::make_unique<GpuImage>();
    made->name = desc.name;
    made->format = desc.format;
    made->width = desc.width;
    made->height = desc.height;
    made->mips = desc.mips;
    made->layers = desc.layers;
    made->cube = desc.cube;

    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags =
        desc.cube ? static_cast<VkImageCreateFlags>(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0u;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {static_cast<std::uint32_t>(desc.width), static_cast<std::uint32_t>(desc.height),
                   1};
    info.mipLevels = static_cast<std::uint32_t>(desc.mips);
    info.arrayLayers = static_cast<std::uint32_t>(desc.layers);
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = tiling;
    info.usage = desc.usage;
    VkImage image = VK_NULL_HANDLE;
    check(vkCreateImage(device_->handle(), &info, nullptr, &image), "creating an image");
    made->image = ImageHandle(device_->handle(), image);
    device_->name(VK_OBJECT_TYPE_IMAGE, image, desc.name);
    return made;
}

void MemoryArena::bind(GpuImage& made, const Place& where) const
{
    check(vkBindImageMemory(device_->handle(), made.image.get(), where.memory, where.offset),
          "binding an image");
    const auto mips = static_cast<std::uint32_t>(made.mips);
    const VkImageViewType whole = made.cube         ? VK_IMAGE_VIEW_TYPE_CUBE
                                  : made.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                    : VK_IMAGE_VIEW_TYPE_2D;
    made.view = make_view(*device_, made, whole, 0, mips);
    device_->name(VK_OBJECT_TYPE_IMAGE_VIEW, made.view.get(), made.name);
    if (made.mips > 1 || made.layers > 1) {
        const VkImageViewType slice =
            made.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
        for (std::uint32_t mip = 0; mip < mips; ++mip) {
            made.mip_views.push_back(make_view(*device_, made, slice, mip, 1));
        }
    }
}

std::unique_ptr<GpuImage> MemoryArena::image(const ImageDesc& desc)
{
    auto made = unbound_image(desc, VK_IMAGE_TILING_OPTIMAL);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device_->handle(), made->image.get(), &needs);
    bind(*made, place(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, true));
    return made;
}

std::unique_ptr<GpuBuffer> MemoryArena::unbound_buffer(const BufferDesc& desc) const
{
    auto made = std::make_unique<GpuBuffer>();
    made->name = desc.name;
    made->size = std::max<VkDeviceSize>(desc.size, 16);

    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = made->size;
    info.usage = desc.usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device_->handle(), &info, nullptr, &buffer), "creating a buffer");
    made->buffer = BufferHandle(device_->handle(), buffer);
    device_->name(VK_OBJECT_TYPE_BUFFER, buffer, desc.name);
    return made;
}

void MemoryArena::bind(GpuBuffer& made, const Place& where, const BufferDesc& desc) const
{
    check(vkBindBufferMemory(device_->handle(), made.buffer.get(), where.memory, where.offset),
          "binding a buffer");
    made.mapped = desc.host ? where.mapped : nullptr;

    if (desc.texel_format != VK_FORMAT_UNDEFINED) {
        VkBufferViewCreateInfo view_info{};
        view_info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
        view_info.buffer = made.buffer.get();
        view_info.format = desc.texel_format;
        view_info.range = VK_WHOLE_SIZE;
        VkBufferView view = VK_NULL_HANDLE;
        check(vkCreateBufferView(device_->handle(), &view_info, nullptr, &view),
              "creating a buffer view");
        made.texel_view = BufferViewHandle(device_->handle(), view);
    }
}

std::unique_ptr<GpuBuffer> MemoryArena::buffer(const BufferDesc& desc)
{
    auto made = unbound_buffer(desc);
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_->handle(), made->buffer.get(), &needs);
    bind(*made, place(needs, memory_flags(desc), false), desc);
    return made;
}

bool MemoryArena::lies_in_rows(const ImageDesc& desc) const
{
    // Elsewhere such images are slow to draw into. Depth may change places with another.
    if (device_->info().kind != "cpu" || desc.format == VK_FORMAT_D32_SFLOAT) return false;
    VkImageFormatProperties can{};
    return vkGetPhysicalDeviceImageFormatProperties(device_->physical(), desc.format, VK_IMAGE_TYPE_2D,
                                                    VK_IMAGE_TILING_LINEAR, desc.usage, 0, &can) == VK_SUCCESS &&
           can.maxExtent.width >= static_cast<std::uint32_t>(desc.width) &&
           can.maxExtent.height >= static_cast<std::uint32_t>(desc.height);
}

ImageInRows MemoryArena::image_in_rows(const ImageDesc& desc, VkDeviceSize texel_bytes, bool host)
{
    const auto width = static_cast<VkDeviceSize>(std::max(desc.width, 0));
    const BufferDesc rows{.name = desc.name + "_rows",
                          .size = width * static_cast<VkDeviceSize>(std::max(desc.height, 0)) * texel_bytes,
                          .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                   VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                          .texel_format = desc.format == VK_FORMAT_D32_SFLOAT ? VK_FORMAT_R32_SFLOAT : desc.format,
                          .host = host};
    if (!lies_in_rows(desc)) return {image(desc), buffer(rows)};
    auto own = unbound_image(desc, VK_IMAGE_TILING_LINEAR);
    const VkImageSubresource first{own->aspect(), 0, 0};
    VkSubresourceLayout lies{};
    vkGetImageSubresourceLayout(device_->handle(), own->image.get(), &first, &lies);
    if (lies.offset != 0 || lies.rowPitch != width * texel_bytes) return {image(desc), buffer(rows)};
    auto shown = unbound_buffer(rows);
    VkMemoryRequirements needs{};
    VkMemoryRequirements besides{};
    vkGetImageMemoryRequirements(device_->handle(), own->image.get(), &needs);
    vkGetBufferMemoryRequirements(device_->handle(), shown->buffer.get(), &besides);
    if ((needs.memoryTypeBits & besides.memoryTypeBits) == 0) return {image(desc), buffer(rows)};
    needs.memoryTypeBits &= besides.memoryTypeBits;
    needs.size = std::max(needs.size, besides.size);
    needs.alignment = std::max(needs.alignment, besides.alignment);
    const Place where = place(needs, memory_flags(rows), false);
    bind(*own, where);
    bind(*shown, where, rows);
    shown->shows = own.get();
    return {std::move(own), std::move(shown)};
}

void upload_buffer(const Device& device, GpuBuffer& target, std::span<const std::byte> bytes,
                   VkDeviceSize offset)
{
    if (bytes.empty()) return;
    if (target.mapped) {
        std::memcpy(target.mapped + offset, bytes.data(), bytes.size());
        return;
    }
    MemoryArena arena(device);
    const auto staging = arena.buffer({.name = "staging for " + target.name,
                                       .size = bytes.size(),
                                       .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                       .host = true});
    std::memcpy(staging->mapped, bytes.data(), bytes.size());
    device.run([&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, offset, bytes.size()};
        vkCmdCopyBuffer(commands, staging->buffer.get(), target.buffer.get(), 1, &region);
        VkMemoryBarrier2 barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT;
        VkDependencyInfo dependency{};
        dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
    });
}

GpuBuffer& Staging::of(VkDeviceSize bytes)
{
    if (!buffer_ || buffer_->size < bytes) {
        buffer_ = nullptr;
        arena_ = std::make_unique<MemoryArena>(*device_);
        buffer_ = arena_->buffer({.name = "staging",
                                  .size = bytes,
                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  .host = true});
    }
    return *buffer_;
}

void upload_image(const Device& device, GpuImage& target,
                  const std::vector<std::vector<std::byte>>& mips)
{
    Staging staging(device);
    upload_image(device, target, {mips.begin(), mips.end()}, staging);
}

void upload_image(const Device& device, GpuImage& target,
                  const std::vector<std::span<const std::byte>>& mips, Staging& through)
{
    VkDeviceSize total = 0;
    for (const auto& level : mips) total += align_up(level.size(), 16);
    GpuBuffer* const staging = &through.of(total);
    std::vector<VkBufferImageCopy> regions;
    VkDeviceSize offset = 0;
    for (std::size_t mip = 0; mip < mips.size(); ++mip) {
        std::memcpy(staging->mapped + offset, mips[mip].data(), mips[mip].size());
        VkBufferImageCopy region{};
        region.bufferOffset = offset;
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<std::uint32_t>(mip), 0,
                                   static_cast<std::uint32_t>(target.layers)};
        region.imageExtent = {static_cast<std::uint32_t>(std::max(1, target.width >> mip)),
                              static_cast<std::uint32_t>(std::max(1, target.height >> mip)), 1};
        regions.push_back(region);
        offset += align_up(mips[mip].size(), 16);
    }
    device.run([&](VkCommandBuffer commands) {
        VkImageMemoryBarrier2 barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_NONE;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.image = target.image.get();
        barrier.subresourceRange = {target.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                    VK_REMAINING_ARRAY_LAYERS};
        VkDependencyInfo dependency{};
        dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
        vkCmdCopyBufferToImage(commands, staging->buffer.get(), target.image.get(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               static_cast<std::uint32_t>(regions.size()), regions.data());
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        vkCmdPipelineBarrier2(commands, &dependency);
    });
    target.state = {};
    target.state.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    target.state.write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    target.state.seen_by = 1u << static_cast<std::uint32_t>(Use::Sampled);
}

SamplerHandle make_sampler(const Device& device, VkFilter filter, VkSamplerAddressMode wrap_u,
                           VkSamplerAddressMode wrap_v, bool compare, float mip_bias,
                           bool mip_nearest, std::uint32_t anisotropy)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = filter;
    info.minFilter = filter;
    info.mipmapMode = mip_nearest ? VK_SAMPLER_MIPMAP_MODE_NEAREST : VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = wrap_u;
    info.addressModeV = wrap_v;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.mipLodBias = mip_bias;
    info.anisotropyEnable = anisotropy > 1;
    info.maxAnisotropy = static_cast<float>(anisotropy);
    info.maxLod = VK_LOD_CLAMP_NONE;
    info.compareEnable = compare;
    info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "creating a sampler");
    return {device.handle(), sampler};
}

}  // namespace petrichor::gpu
