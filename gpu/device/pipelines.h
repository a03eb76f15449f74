#ifndef PETRICHOR_GPU_DEVICE_PIPELINES_H
#define PETRICHOR_GPU_DEVICE_PIPELINES_H

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gpu/device/resources.h"

namespace petrichor::gpu {

/// What a shader sees at one binding. Bindings of a set are numbered in the order given.
struct Binding {
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    VkDescriptorImageInfo image{};
    VkDescriptorBufferInfo buffer{};
    VkBufferView texels = VK_NULL_HANDLE;
};
Binding sampled(const GpuImage& image, const SamplerHandle& sampler);
Binding storage(const GpuImage& image, int mip = -1);
Binding uniform(const GpuBuffer& buffer, VkDeviceSize offset, VkDeviceSize size);
Binding texels(const GpuBuffer& buffer);
Binding storage_buffer(const GpuBuffer& buffer);

using BindingTypes = std::vector<VkDescriptorType>;
BindingTypes types_of(const std::vector<Binding>& bindings);

/// Value of a specialization constant.
struct Specialization {
    std::uint32_t id = 0;
    std::uint32_t value = 0;
};

inline constexpr std::uint32_t kPushBytes = 128;

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
    bool depth_equal = false;  ///< draws where depth is already its own; does not write it
};

/// Makes pipelines on first use and keeps them, by content.
class PipelineCache {
public:
    explicit PipelineCache(const Device& device) : device_(&device) {}

    const Pipeline& compute(const std::string& shader,
                            const std::vector<Specialization>& specialization,
                            const BindingTypes& bindings);
    const Pipeline& graphics(const GraphicsDesc& desc);
    VkDescriptorSetLayout set_layout(const BindingTypes& types);

private:
    VkPipelineLayout layout(const std::vector<BindingTypes>& sets);
    VkShaderModule module(const std::string& shader);

    const Device* device_;
    std::map<BindingTypes, SetLayoutHandle> set_layouts_;
    std::map<std::vector<BindingTypes>, PipelineLayoutHandle> layouts_;
    std::map<std::string, ShaderModuleHandle> modules_;
    std::map<std::string, std::unique_ptr<Pipeline>> pipelines_;
};

/// Descriptor sets that live until reset().
class DescriptorArena {
public:
    explicit DescriptorArena(const Device& device) : device_(&device) {}

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
