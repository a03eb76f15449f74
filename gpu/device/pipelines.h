#ifndef PETRICHOR_GPU_DEVICE_PIPELINES_H
#define PETRICHOR_GPU_DEVICE_PIPELINES_H

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device/resources.h"
#include "gpu/device/specialize.h"

namespace petrichor::gpu {

/// What a shader sees at one binding, and how it touches it.
struct Binding {
    GpuImage* image = nullptr;
    GpuBuffer* buffer = nullptr;
    Use use = Use::Sampled;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    VkDescriptorImageInfo image_info{};
    VkDescriptorBufferInfo buffer_info{};
    VkBufferView texel_view = VK_NULL_HANDLE;
};
Binding sampled(GpuImage& image, const SamplerHandle& sampler);
Binding storage(GpuImage& image, int mip = -1);  ///< written, all or part; may be read as well
Binding storage_read(GpuImage& image);
Binding uniform(GpuBuffer& buffer, VkDeviceSize offset, VkDeviceSize size);
Binding texels(GpuBuffer& buffer);
Binding storage_buffer(GpuBuffer& buffer);  ///< written, all or part; may be read as well

/// A binding at its number in the shader (a name from PASS_io.h).
struct Bound {
    std::uint32_t number = 0;
    Binding binding;
};
using Bindings = std::vector<Bound>;  ///< every number from 0 on, in any order

using BindingTypes = std::vector<VkDescriptorType>;
BindingTypes types_of(const Bindings& bindings);
BindingTypes types_of(const std::vector<Binding>& bindings);

inline constexpr std::uint32_t kPushBytes = 128;
inline constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

struct Pipeline {
    PipelineHandle pipeline;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::vector<VkDescriptorSetLayout> set_layouts;
};

struct VertexAttribute {
    std::uint32_t location = 0;
    VkFormat format = VK_FORMAT_R32G32B32_SFLOAT;
    std::uint32_t offset = 0;
};

struct GraphicsDesc {
    std::string vertex;
    std::string fragment;  ///< empty: depth only
    std::vector<Specialization> specialization;
    std::vector<BindingTypes> sets;
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_D32_SFLOAT;
    std::uint32_t stride = 0;
    std::vector<VertexAttribute> attributes;
    bool color_write = true;   ///< false: fills depth only
    bool over = false;         ///< colour is premultiplied and laid over what is there; its alpha stays
    bool over_all = false;     ///< likewise, and its alpha too
    bool depth_equal = false;  ///< draws where depth is already its own; does not write it
};

struct ComputeDesc {
    std::string shader;
    std::vector<Specialization> specialization;
    std::vector<BindingTypes> sets;
};

struct ShaderCode {
    std::span<const std::uint32_t> words;
    std::span<const std::uint32_t> prepared;  ///< of them, where that was done before (gpu/device/prepared.h)
};

/// Makes pipelines on first use and keeps them, by content.
class PipelineCache {
public:
    explicit PipelineCache(const Device& device);
    ~PipelineCache();

    /// What compute() will soon be asked for: threads of its own begin to make what is missing. How many those are.
    std::size_t prepare(const std::vector<ComputeDesc>& wanted);
    const Pipeline& compute(const std::string& shader,
                            const std::vector<Specialization>& specialization,
                            const std::vector<BindingTypes>& sets);
    const Pipeline& graphics(const GraphicsDesc& desc);
    /// Makes SPIR-V known by a name; the same name again replaces it and its pipelines.
    void add_shader(const std::string& name, std::vector<std::uint32_t> code);
    /// The picture that asked for pipelines is done: those that none of the last `kept` asked for are given up. Nothing
    /// that was recorded with one may still run.
    void end_picture(std::uint64_t kept);
    /// Gives up the compute pipelines that the picture at work has not asked for and that are not `wanted` either.
    /// Nothing that was recorded with one may still run.
    void keep_only(const std::vector<ComputeDesc>& wanted);
    std::size_t size() const { return pipelines_.size(); }
    /// Many pipelines were made since this was asked last: their making, and the driver's at their first use, leave
    /// free memory between what is kept.
    bool made_many();
    static constexpr std::size_t kMany = 8;
    VkDescriptorSetLayout set_layout(const BindingTypes& types);

private:
    class Ahead;  // the threads of prepare()
    std::unique_ptr<Pipeline> make_compute(const ComputeDesc& desc, VkPipelineLayout layout) const;
    ShaderCode code(const std::string& shader) const;
    VkPipelineLayout layout(const std::vector<BindingTypes>& sets);

    const Device* device_;
    ContentCache cache_ = user_cache();
    std::map<BindingTypes, SetLayoutHandle> set_layouts_;
    std::map<std::vector<BindingTypes>, PipelineLayoutHandle> layouts_;
    std::map<std::string, std::vector<std::uint32_t>> added_;
    struct Entry {
        std::unique_ptr<Pipeline> pipeline;
        std::uint64_t asked_by = 0;  // the last picture
        bool compute = false;
    };
    std::map<std::string, Entry> pipelines_;
    std::uint64_t picture_ = 0;
    std::size_t made_ = 0;  // since made_many() was asked
    std::unique_ptr<Ahead> ahead_;
};

/// Descriptor sets that live until reset().
class DescriptorArena {
public:
    explicit DescriptorArena(const Device& device) : device_(&device) {}

    VkDescriptorSet set(VkDescriptorSetLayout layout, const Bindings& bindings);
    /// Bindings numbered in the order given.
    VkDescriptorSet set(VkDescriptorSetLayout layout, const std::vector<Binding>& bindings);
    void reset();

private:
    VkDescriptorPool new_pool();

    const Device* device_;
    std::vector<DescriptorPoolHandle> pools_;
    std::size_t current_ = 0;
};

}  // namespace petrichor::gpu

#endif
