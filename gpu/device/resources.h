#ifndef PETRICHOR_GPU_DEVICE_RESOURCES_H
#define PETRICHOR_GPU_DEVICE_RESOURCES_H

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device/barriers.h"
#include "gpu/device/device.h"

namespace petrichor::gpu {

struct GpuImage {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    int width = 0;
    int height = 0;
    int mips = 1;
    int layers = 1;
    bool cube = false;
    ImageHandle image;
    ImageViewHandle view;  ///< all mips and layers; a cube when `cube`
    std::vector<ImageViewHandle>
        mip_views;  ///< one mip, all layers as a 2D array (when mips > 1 or layers > 1)
    ResourceState state;

    VkImageAspectFlags aspect() const;
};

struct GpuBuffer {
    std::string name;
    VkDeviceSize size = 0;
    BufferHandle buffer;
    BufferViewHandle texel_view;  ///< when made with a texel format
    std::byte* mapped = nullptr;  ///< host-visible buffers only
    const GpuImage* shows = nullptr;  ///< the image whose memory it is; null: it has its own
    ResourceState state;
};

/// An image, and its texels row by row in a buffer: the same memory, or that of a copy (add_rows).
struct ImageInRows {
    std::unique_ptr<GpuImage> image;
    std::unique_ptr<GpuBuffer> rows;
};

struct ImageDesc {
    std::string name;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    int width = 1;
    int height = 1;
    int mips = 1;
    int layers = 1;
    bool cube = false;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
};

struct BufferDesc {
    std::string name;
    VkDeviceSize size = 4;
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkFormat texel_format = VK_FORMAT_UNDEFINED;  ///< makes a texel view over the whole buffer
    bool host = false;                            ///< mapped, coherent
};

/// Memory in blocks, given back all at once: resources of one life (a scene, a frame size) share an
/// arena and die with it. Resources must be destroyed before their arena.
class MemoryArena {
public:
    explicit MemoryArena(const Device& device) : device_(&device) {}

    std::unique_ptr<GpuImage> image(const ImageDesc& desc);
    std::unique_ptr<GpuBuffer> buffer(const BufferDesc& desc);
    /// An image of one level, and a buffer with a view of its texels. A CPU's images can lie row by row, so
    /// that a pass that writes one has written the other.
    /// host: the buffer is mapped.
    ImageInRows image_in_rows(const ImageDesc& desc, VkDeviceSize texel_bytes, bool host = false);
    VkDeviceSize bytes() const { return bytes_; }

private:
    struct Block {
        MemoryHandle memory;
        std::byte* mapped = nullptr;
        VkDeviceSize size = 0;
        VkDeviceSize used = 0;
        std::uint32_t type = 0;
        bool images = false;  // images and buffers never share a block (granularity)
        bool host = false;
    };
    struct Place {
        VkDeviceMemory memory;
        VkDeviceSize offset;
        std::byte* mapped;
    };
    Place place(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags, bool image);
    std::unique_ptr<GpuImage> unbound_image(const ImageDesc& desc, VkImageTiling tiling) const;
    std::unique_ptr<GpuBuffer> unbound_buffer(const BufferDesc& desc) const;
    void bind(GpuImage& image, const Place& where) const;
    void bind(GpuBuffer& buffer, const Place& where, const BufferDesc& desc) const;
    bool lies_in_rows(const ImageDesc& desc) const;

    const Device* device_;
    std::vector<Block> blocks_;
    VkDeviceSize bytes_ = 0;
};

/// Copies bytes into a device-local resource through a staging buffer; waits until done.
void upload_buffer(const Device& device, GpuBuffer& target, std::span<const std::byte> bytes,
                   VkDeviceSize offset = 0);

/// Host memory that uploads go through, as large as the largest of them.
class Staging {
public:
    explicit Staging(const Device& device) : device_(&device) {}
    GpuBuffer& of(VkDeviceSize bytes);

private:
    const Device* device_;
    std::unique_ptr<MemoryArena> arena_;
    std::unique_ptr<GpuBuffer> buffer_;
};

/// Uploads all mips (tightly packed levels) and leaves the image ready for sampling.
void upload_image(const Device& device, GpuImage& target,
                  const std::vector<std::vector<std::byte>>& mips);
/// The same through memory that other uploads use too.
void upload_image(const Device& device, GpuImage& target,
                  const std::vector<std::span<const std::byte>>& mips, Staging& through);

SamplerHandle make_sampler(const Device& device, VkFilter filter, VkSamplerAddressMode wrap_u,
                           VkSamplerAddressMode wrap_v, bool compare = false, float mip_bias = 0.0f,
                           bool mip_nearest = false, std::uint32_t anisotropy = 1);

}  // namespace petrichor::gpu

#endif
