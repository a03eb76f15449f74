#ifndef PETRICHOR_GPU_DEVICE_GRAPH_H
#define PETRICHOR_GPU_DEVICE_GRAPH_H

#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device/pipelines.h"

namespace petrichor::gpu {

/// The push constants of a pass: a struct of at most 128 bytes, the rest zero.
struct PushBlock {
    std::array<std::byte, kPushBytes> bytes{};

    PushBlock() = default;
    template <class T>
    explicit PushBlock(const T& value)
    {
        static_assert(sizeof(T) <= kPushBytes);
        std::memcpy(bytes.data(), &value, sizeof(T));
    }
};

/// Workgroups of a dispatch.
struct Groups {
    std::uint32_t x = 1;
    std::uint32_t y = 1;
    std::uint32_t z = 1;
};
/// Enough groups of tile x tile to cover width x height.
Groups groups_over(int width, int height, int tile, int layers = 1);

/// One dispatch. What it reads and writes stands in its bindings, nowhere else.
struct ComputePass {
    std::string name;
    std::string shader;
    std::vector<Specialization> constants;
    Bindings bindings;
    PushBlock push;
    Groups groups;
};

class DispatchContext;

/// Many dispatches that share their bindings (set 0): one a material, for example.
struct DispatchListPass {
    std::string name;
    Bindings bindings;
    GpuBuffer* arguments = nullptr;  ///< group counts of indirect dispatches, if there are any
    std::vector<ComputeDesc> pipelines;  ///< that it will bind, as far as they are known before
    std::function<void(DispatchContext&)> record;
};

/// An image that is drawn into; cleared to zero first, or drawn over.
struct Attachment {
    GpuImage* image = nullptr;          ///< null: what a shader writes there goes nowhere
    VkImageView view = VK_NULL_HANDLE;  ///< one layer of it; null: the whole image
    bool keep = false;                  ///< what it holds stays below what is drawn

    Attachment() = default;
    explicit Attachment(GpuImage& i, VkImageView v = VK_NULL_HANDLE) : image(&i), view(v) {}
    VkFormat format() const { return image ? image->format : VK_FORMAT_UNDEFINED; }
};

class PassContext;

/// Draws into attachments. Textures and vertices of the scene, which no pass writes, need no
/// declaration; whatever a pass of the frame makes stands in `bindings` (set 0).
struct DrawPass {
    std::string name;
    std::vector<Attachment> colors;  ///< by location
    Attachment depth;
    int width = 0;
    int height = 0;
    Bindings bindings;
    std::function<void(PassContext&)> record;  ///< inside the rendering; the viewport is set
};

/// A resource that copies and blits touch; they have no bindings that could say so.
struct Transfer {
    GpuImage* image = nullptr;
    GpuBuffer* buffer = nullptr;
    Use use = Use::TransferTarget;
};
struct TransferPass {
    std::string name;
    std::vector<Transfer> transfers;
    std::function<void(VkCommandBuffer)> record;
};

/// What a draw pass records with.
class PassContext {
public:
    PassContext(PipelineCache& pipelines, DescriptorArena& descriptors, VkCommandBuffer commands,
                const DrawPass& pass);

    VkCommandBuffer commands() const { return commands_; }
    PipelineCache& pipelines() const { return *pipelines_; }
    DescriptorArena& descriptors() const { return *descriptors_; }
    /// The pass's own bindings as set 0, and their types for a pipeline's description.
    VkDescriptorSet set() const { return set_; }
    const BindingTypes& set_types() const { return set_types_; }
    /// Formats of the attachments, for a pipeline's description.
    const std::vector<VkFormat>& color_formats() const { return color_formats_; }

    void bind(const Pipeline& pipeline);
    void bind_set(std::uint32_t index, VkDescriptorSet set);
    template <class T>
    void push(const T& value)
    {
        push_block(PushBlock(value));
    }

private:
    void push_block(const PushBlock& block);

    PipelineCache* pipelines_;
    DescriptorArena* descriptors_;
    VkCommandBuffer commands_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    BindingTypes set_types_;
    std::vector<VkFormat> color_formats_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

/// What a list of dispatches records with.
class DispatchContext {
public:
    DispatchContext(PipelineCache& pipelines, DescriptorArena& descriptors,
                    VkCommandBuffer commands, const DispatchListPass& pass);

    /// The pipeline of a shader with these constants; its set 1, when it has one, is of these
    /// types.
    void bind(const std::string& shader, const std::vector<Specialization>& constants,
              const BindingTypes& set1 = {});
    void bind_set1(const std::vector<Binding>& bindings);
    template <class T>
    void push(const T& value)
    {
        push_block(PushBlock(value));
    }
    /// Groups from the pass's arguments: the entry-th three words.
    void dispatch_indirect(std::uint32_t entry);

private:
    void push_block(const PushBlock& block);

    PipelineCache* pipelines_;
    DescriptorArena* descriptors_;
    VkCommandBuffer commands_;
    const DispatchListPass* pass_;
    BindingTypes set_types_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    const Pipeline* pipeline_ = nullptr;
};

/// To the system. A frame takes its memory beside what the making of its pipelines has left, and so would what
/// comes behind it.
void give_back_free_memory();

/// Passes of one frame, run in the order they were added. Every barrier and layout is derived from
/// what the passes bind, attach and transfer.
class FrameGraph {
public:
    void add(ComputePass pass);
    void add(DispatchListPass pass);
    void add(DrawPass pass);
    void add(TransferPass pass);
    /// Makes what was written visible to the host once the frame is done.
    void read_back(const std::vector<GpuBuffer*>& buffers);

    /// Records all passes into one command buffer, submits, waits; each pass by itself with
    /// RendererOptions::passes_apart, and where many pipelines are to be made. Times are summed by pass name.
    std::vector<PassTime> execute(const Device& device, PipelineCache& pipelines,
                                  DescriptorArena& descriptors);
    bool empty() const { return passes_.empty(); }
    /// The compute pipelines that its passes have said they will ask for.
    std::vector<ComputeDesc> pipelines() const;
    /// One line a distinct pass: its name, what it reads, what it writes.
    std::string describe() const;

private:
    struct Touch {
        GpuImage* image = nullptr;
        GpuBuffer* buffer = nullptr;
        Use use = Use::Sampled;
    };
    struct Pass {
        std::string name;
        std::vector<Touch> touches;
        std::vector<ComputeDesc> pipelines;  ///< that are known before it is recorded
        std::function<void(VkCommandBuffer, PipelineCache&, DescriptorArena&)> record;
    };
    static void touch(Pass& pass, const Touch& touch);
    static void touch(Pass& pass, const Bindings& bindings);

    std::vector<Pass> passes_;
};

/// Brings what was written to images into their rows (MemoryArena::image_in_rows), by copies where they lie elsewhere.
void add_rows(FrameGraph& graph, const std::string& name,
              const std::vector<std::pair<GpuImage*, GpuBuffer*>>& images);

/// Fills the mips behind the first of every layer from that one by linear blits; the image must be in
/// TransferTarget use and is left in that layout.
void record_mips(VkCommandBuffer commands, const GpuImage& image, int first = 0);

}  // namespace petrichor::gpu

#endif
