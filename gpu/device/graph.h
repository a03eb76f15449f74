#ifndef PETRICHOR_GPU_DEVICE_GRAPH_H
#define PETRICHOR_GPU_DEVICE_GRAPH_H

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "gpu/device/pipelines.h"

namespace petrichor::gpu {

/// How a pass touches a resource. Barriers and layouts follow from it.
enum class Use {
    ColorTarget,
    DepthTarget,
    Sampled,       ///< image read through a sampler or texelFetch
    StorageRead,   ///< image or buffer in a compute shader
    StorageWrite,  ///< image or buffer in a compute shader, all or part, read allowed
    TexelRead,     ///< buffer through a texel view
    UniformRead,   ///< buffer as a uniform block
    TransferSource,
    TransferTarget,
    HostRead,  ///< after the frame, by the host
};

struct ResourceUse {
    GpuImage* image = nullptr;
    GpuBuffer* buffer = nullptr;
    Use use = Use::Sampled;

    ResourceUse(GpuImage& i, Use u) : image(&i), use(u) {}
    ResourceUse(GpuBuffer& b, Use u) : buffer(&b), use(u) {}
    ResourceUse(const std::unique_ptr<GpuImage>& i, Use u) : image(i.get()), use(u) {}
    ResourceUse(const std::unique_ptr<GpuBuffer>& b, Use u) : buffer(b.get()), use(u) {}
};

/// What a pass records with.
class PassContext {
public:
    PassContext(const Device& device, PipelineCache& pipelines, DescriptorArena& descriptors,
                VkCommandBuffer commands)
        : device_(&device), pipelines_(&pipelines), descriptors_(&descriptors), commands_(commands)
    {
    }

    VkCommandBuffer commands() const { return commands_; }
    PipelineCache& pipelines() const { return *pipelines_; }
    DescriptorArena& descriptors() const { return *descriptors_; }

    void bind_compute(const std::string& shader, const std::vector<Specialization>& specialization,
                      const std::vector<Binding>& bindings);
    /// Pushes a struct of at most 128 bytes; the rest of the range is zero.
    template <class T>
    void push(const T& value)
    {
        static_assert(sizeof(T) <= kPushBytes);
        push_bytes(&value, sizeof(T));
    }
    void dispatch(int groups_x, int groups_y, int groups_z = 1);
    /// Enough groups of tile x tile to cover width x height.
    void dispatch_over(int width, int height, int tile, int depth = 1);
    void use_layout(VkPipelineLayout layout) { layout_ = layout; }

private:
    void push_bytes(const void* bytes, std::size_t size);

    const Device* device_;
    PipelineCache* pipelines_;
    DescriptorArena* descriptors_;
    VkCommandBuffer commands_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

struct Pass {
    std::string name;
    std::vector<ResourceUse> uses;
    std::function<void(PassContext&)> record;
};

/// Passes of one frame, run in the order they were added.
class FrameGraph {
public:
    void add(Pass pass) { passes_.push_back(std::move(pass)); }

    /// Records all passes into one command buffer, submits, waits. Times are summed by pass name.
    std::vector<PassTime> execute(const Device& device, PipelineCache& pipelines,
                                  DescriptorArena& descriptors);
    /// One line a distinct pass: its name, what it reads, what it writes.
    std::string describe() const;

private:
    std::vector<Pass> passes_;
};

/// Fills mips 1.. of every layer from mip 0 by linear blits; the image must be in
/// TransferTarget use and is left in that layout.
void record_mips(VkCommandBuffer commands, const GpuImage& image);

}  // namespace petrichor::gpu

#endif
