#ifndef PETRICHOR_GPU_DEVICE_BARRIERS_H
#define PETRICHOR_GPU_DEVICE_BARRIERS_H

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace petrichor::gpu {

/// How a pass touches a resource. A binding or an attachment carries it; barriers and layouts
/// follow.
enum class Use : std::uint8_t {
    ColorTarget,
    DepthTarget,
    Sampled,       ///< image read through a sampler or texelFetch
    StorageRead,   ///< image or buffer in a compute shader
    StorageWrite,  ///< image or buffer in a compute shader, all or part, read allowed
    TexelRead,     ///< buffer through a texel view
    UniformRead,   ///< buffer as a uniform block
    IndirectRead,  ///< buffer with the group counts of a dispatch
    TransferSource,
    TransferTarget,  ///< written by copies and blits, which may read it too (mip levels)
    HostRead,        ///< after the frame, by the host
    SeenAsRows,      ///< image whose memory a buffer shows from here on (GpuBuffer::shows)
    RowsOfImage,     ///< that buffer: what was written to the image is in it
};

/// What a use needs of the device.
struct Needs {
    VkImageLayout layout;  ///< images only
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    bool writes;
};
Needs needs_of(Use use);

/// What is known of a resource between two passes.
struct ResourceState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 write_stages = VK_PIPELINE_STAGE_2_NONE;  ///< last write or layout change
    VkAccessFlags2 write_access = VK_ACCESS_2_NONE;
    VkPipelineStageFlags2 read_stages = VK_PIPELINE_STAGE_2_NONE;  ///< who has read since
    std::uint32_t seen_by = 0;  ///< uses, a bit each, that the last write is already visible to
};

/// One dependency: the second scope waits for the first and sees what it wrote.
struct Dependency {
    VkPipelineStageFlags2 from_stages;
    VkAccessFlags2 from_access;
    VkPipelineStageFlags2 to_stages;
    VkAccessFlags2 to_access;
    VkImageLayout from_layout;  ///< images only, as below
    VkImageLayout to_layout;
};

/// Moves `state` on to `use`; what must be waited for before, if anything:
///   read after write    once for each use that reads; a second kind of read waits for itself
///   write after write   always
///   write after read    for the readers' stages
///   change of layout    as a write, before whatever reads or writes next
///   read after read     nothing
std::optional<Dependency> advance(ResourceState& state, Use use, bool is_image);

}  // namespace petrichor::gpu

#endif
