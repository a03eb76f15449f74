#include "gpu/device/pipelines.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <future>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "gpu/device/shaders.h"

namespace petrichor::gpu {

namespace {

// A stage of a pipeline: the shader with its constants in it, or both as Vulkan wants them. Must
// outlive the create call.
class Stage {
public:
    Stage(const Device& device, VkShaderStageFlagBits stage, const std::string& name,
          const ShaderCode& code, const std::vector<Specialization>& constants, const ContentCache& cache)
    {
        const std::vector<std::uint32_t> own = specialized(code.words, constants, cache, code.prepared);
        const std::span<const std::uint32_t> words = own.empty() ? code.words : own;
        VkShaderModuleCreateInfo module{};
        module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        module.codeSize = words.size_bytes();
        module.pCode = words.data();
        VkShaderModule made = VK_NULL_HANDLE;
        check(vkCreateShaderModule(device.handle(), &module, nullptr, &made), "creating a shader");
        device.name(VK_OBJECT_TYPE_SHADER_MODULE, made, name);
        module_ = ShaderModuleHandle(device.handle(), made);

        info_.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info_.stage = stage;
        info_.module = made;
        info_.pName = "main";
        if (!own.empty()) return;
        for (const Specialization& constant : constants) {
            entries_.push_back({constant.id,
                                static_cast<std::uint32_t>(values_.size() * sizeof(std::uint32_t)),
                                sizeof(std::uint32_t)});
            values_.push_back(constant.value);
        }
        constants_.mapEntryCount = static_cast<std::uint32_t>(entries_.size());
        constants_.pMapEntries = entries_.data();
        constants_.dataSize = values_.size() * sizeof(std::uint32_t);
        constants_.pData = values_.data();
        info_.pSpecializationInfo = &constants_;
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    const VkPipelineShaderStageCreateInfo& info() const { return info_; }

private:
    ShaderModuleHandle module_;
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<std::uint32_t> values_;
    VkSpecializationInfo constants_{};
    VkPipelineShaderStageCreateInfo info_{};
};

std::string key_of(const std::string& name, const std::vector<Specialization>& specialization)
{
    std::string key = name;
    for (const Specialization& s : specialization) {
        key += ";" + std::to_string(s.id) + "=" + std::to_string(s.value);
    }
    return key;
}

}  // namespace

Binding sampled(GpuImage& image, const SamplerHandle& sampler)
{
    Binding binding;
    binding.image = &image;
    binding.use = Use::Sampled;
    binding.image_info = {sampler.get(), image.view.get(),
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    return binding;
}

Binding storage(GpuImage& image, int mip)
{
    Binding binding;
    binding.image = &image;
    binding.use = Use::StorageWrite;
    binding.type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    const bool slice = mip >= 0 && !image.mip_views.empty();
    const VkImageView view =
        slice ? image.mip_views[static_cast<std::size_t>(mip)].get() : image.view.get();
    binding.image_info = {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
    return binding;
}

Binding storage_read(GpuImage& image)
{
    Binding binding = storage(image);
    binding.use = Use::StorageRead;
    return binding;
}

Binding uniform(GpuBuffer& buffer, VkDeviceSize offset, VkDeviceSize size)
{
    Binding binding;
    binding.buffer = &buffer;
    binding.use = Use::UniformRead;
    binding.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    binding.buffer_info = {buffer.buffer.get(), offset, size};
    return binding;
}

Binding texels(GpuBuffer& buffer)
{
    Binding binding;
    binding.buffer = &buffer;
    binding.use = Use::TexelRead;
    binding.type = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    binding.texel_view = buffer.texel_view.get();
    return binding;
}

Binding storage_buffer(GpuBuffer& buffer)
{
    Binding binding;
    binding.buffer = &buffer;
    binding.use = Use::StorageWrite;
    binding.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    binding.buffer_info = {buffer.buffer.get(), 0, VK_WHOLE_SIZE};
    return binding;
}

BindingTypes types_of(const Bindings& bindings)
{
    BindingTypes types(bindings.size());
    std::vector<bool> given(bindings.size(), false);
    for (const Bound& bound : bindings) {
        if (bound.number >= given.size() || given[bound.number]) {
            throw std::logic_error("binding " + std::to_string(bound.number) +
                                   " is given twice, or one before it is missing");
        }
        given[bound.number] = true;
        types[bound.number] = bound.binding.type;
    }
    return types;
}

BindingTypes types_of(const std::vector<Binding>& bindings)
{
    BindingTypes types;
    for (const Binding& binding : bindings) types.push_back(binding.type);
    return types;
}

VkDescriptorSetLayout PipelineCache::set_layout(const BindingTypes& types)
{
    auto& slot = set_layouts_[types];
    if (slot) return slot.get();
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (std::size_t i = 0; i < types.size(); ++i) {
        bindings.push_back({static_cast<std::uint32_t>(i), types[i], 1, kAllStages, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device_->handle(), &info, nullptr, &layout),
          "creating a descriptor set layout");
    slot = SetLayoutHandle(device_->handle(), layout);
    return layout;
}

VkPipelineLayout PipelineCache::layout(const std::vector<BindingTypes>& sets)
{
    auto& slot = layouts_[sets];
    if (slot) return slot.get();
    std::vector<VkDescriptorSetLayout> set_handles;
    for (const BindingTypes& types : sets) set_handles.push_back(set_layout(types));
    const VkPushConstantRange push{kAllStages, 0, kPushBytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = static_cast<std::uint32_t>(set_handles.size());
    info.pSetLayouts = set_handles.data();
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout made = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device_->handle(), &info, nullptr, &made),
          "creating a pipeline layout");
    slot = PipelineLayoutHandle(device_->handle(), made);
    return made;
}

void PipelineCache::add_shader(const std::string& name, std::vector<std::uint32_t> code)
{
    auto& slot = added_[name];
    if (slot == code) return;
    ahead_ = nullptr;
    slot = std::move(code);
    // A graphics pipeline names its fragment shader second.
    std::erase_if(pipelines_, [&](const auto& entry) { return entry.first.find(name) != std::string::npos; });
}

void PipelineCache::end_picture(std::uint64_t kept)
{
    ++picture_;
    std::erase_if(pipelines_, [&](const auto& entry) { return entry.second.asked_by + kept < picture_; });
}

void PipelineCache::keep_only(const std::vector<ComputeDesc>& wanted)
{
    std::set<std::string> keys;
    for (const ComputeDesc& desc : wanted) keys.insert(key_of(desc.shader, desc.specialization));
    std::erase_if(pipelines_, [&](const auto& entry) {
        return entry.second.compute && entry.second.asked_by < picture_ && !keys.contains(entry.first);
    });
}

bool PipelineCache::made_many()
{
    return std::exchange(made_, 0) >= kMany;
}

ShaderCode PipelineCache::code(const std::string& shader) const
{
    if (const auto added = added_.find(shader); added != added_.end()) return {added->second, {}};
    const EmbeddedShader* embedded = find_embedded_shader(shader);
    if (!embedded) throw std::logic_error("no embedded shader " + shader);
    return {embedded->code, embedded->prepared};
}

// A list of pipelines that threads work through, and so does who waits for one.
class PipelineCache::Ahead {
public:
    struct Task {
        std::string key;
        ComputeDesc desc;
        VkPipelineLayout layout;
        std::atomic_flag taken;
        std::promise<std::unique_ptr<Pipeline>> promise;
        std::future<std::unique_ptr<Pipeline>> made = promise.get_future();
    };

    Ahead(const PipelineCache& cache, std::vector<std::unique_ptr<Task>> tasks)
        : cache_(&cache), tasks_(std::move(tasks))
    {
        const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
        for (std::size_t i = 0; i < std::min(cores - 1, tasks_.size()); ++i) {
            threads_.emplace_back([this] {
                while (work()) {}
            });
        }
    }
    ~Ahead()
    {
        for (const auto& task : tasks_) task->taken.test_and_set();
        for (std::thread& thread : threads_) thread.join();
    }
    Ahead(const Ahead&) = delete;
    Ahead& operator=(const Ahead&) = delete;

    // Null when it is not on the list.
    std::unique_ptr<Pipeline> take(const std::string& key)
    {
        for (const auto& task : tasks_) {
            if (task->key != key || !task->made.valid()) continue;
            if (!task->taken.test_and_set()) make(*task);
            while (task->made.wait_for(std::chrono::seconds(0)) != std::future_status::ready &&
                   work()) {}
            return task->made.get();
        }
        return nullptr;
    }

private:
    void make(Task& task) const
    {
        try {
            task.promise.set_value(cache_->make_compute(task.desc, task.layout));
        } catch (...) {
            task.promise.set_exception(std::current_exception());
        }
    }
    // One that nobody has begun; false when there is none.
    bool work() const
    {
        for (const auto& task : tasks_) {
            if (task->taken.test_and_set()) continue;
            make(*task);
            return true;
        }
        return false;
    }

    const PipelineCache* cache_;
    std::vector<std::unique_ptr<Task>> tasks_;
    std::vector<std::thread> threads_;
};

PipelineCache::PipelineCache(const Device& device) : device_(&device)
{
}
PipelineCache::~PipelineCache() = default;

std::size_t PipelineCache::prepare(const std::vector<ComputeDesc>& wanted)
{
    ahead_ = nullptr;
    std::vector<std::unique_ptr<Ahead::Task>> tasks;
    std::set<std::string> keys;
    for (const ComputeDesc& desc : wanted) {
        std::string key = key_of(desc.shader, desc.specialization);
        if (pipelines_.contains(key) || !keys.insert(key).second) continue;
        tasks.push_back(std::make_unique<Ahead::Task>());
        tasks.back()->key = std::move(key);
        tasks.back()->desc = desc;
        tasks.back()->layout = layout(desc.sets);
    }
    // The long ones first.
    std::stable_sort(tasks.begin(), tasks.end(), [this](const auto& a, const auto& b) {
        return code(a->desc.shader).words.size() > code(b->desc.shader).words.size();
    });
    const std::size_t missing = tasks.size();
    if (missing > 0) ahead_ = std::make_unique<Ahead>(*this, std::move(tasks));
    return missing;
}

std::unique_ptr<Pipeline> PipelineCache::make_compute(const ComputeDesc& desc,
                                                      VkPipelineLayout layout) const
{
    auto made = std::make_unique<Pipeline>();
    const Stage stage(*device_, VK_SHADER_STAGE_COMPUTE_BIT, desc.shader, code(desc.shader),
                      desc.specialization, cache_);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage.info();
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device_->handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "creating a compute pipeline");
    device_->name(VK_OBJECT_TYPE_PIPELINE, pipeline, desc.shader);
    made->pipeline = PipelineHandle(device_->handle(), pipeline);
    made->layout = layout;
    return made;
}

const Pipeline& PipelineCache::compute(const std::string& shader,
                                       const std::vector<Specialization>& specialization,
                                       const std::vector<BindingTypes>& sets)
{
    const std::string key = key_of(shader, specialization);
    Entry& entry = pipelines_[key];
    entry.asked_by = picture_;
    entry.compute = true;
    std::unique_ptr<Pipeline>& slot = entry.pipeline;
    if (slot) return *slot;
    ++made_;
    auto made = ahead_ ? ahead_->take(key) : nullptr;
    if (!made) made = make_compute({shader, specialization, sets}, layout(sets));
    for (const BindingTypes& set : sets) made->set_layouts.push_back(set_layout(set));
    slot = std::move(made);
    return *slot;
}

const Pipeline& PipelineCache::graphics(const GraphicsDesc& desc)
{
    std::string key = key_of(desc.vertex + "+" + desc.fragment, desc.specialization);
    for (const VkFormat format : desc.colors) key += "|" + std::to_string(format);
    key += "|" + std::to_string(desc.depth) + "|" + std::to_string(desc.color_write) +
           std::to_string(desc.depth_equal) + std::to_string(desc.over) +
           std::to_string(desc.over_all);
    Entry& entry = pipelines_[key];
    entry.asked_by = picture_;
    std::unique_ptr<Pipeline>& slot = entry.pipeline;
    if (slot) return *slot;
    ++made_;
    auto made = std::make_unique<Pipeline>();
    const Stage vertex(*device_, VK_SHADER_STAGE_VERTEX_BIT, desc.vertex, code(desc.vertex),
                       desc.specialization, cache_);
    std::vector<VkPipelineShaderStageCreateInfo> stages{vertex.info()};
    std::optional<Stage> fragment;
    if (!desc.fragment.empty()) {
        fragment.emplace(*device_, VK_SHADER_STAGE_FRAGMENT_BIT, desc.fragment, code(desc.fragment),
                         desc.specialization, cache_);
        stages.push_back(fragment->info());
    }

    const VkVertexInputBindingDescription stream{0, desc.stride, VK_VERTEX_INPUT_RATE_VERTEX};
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const VertexAttribute& a : desc.attributes) {
        attributes.push_back({a.location, 0, a.format, a.offset});
    }
    VkPipelineVertexInputStateCreateInfo vertex_input{};
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    // What reads no vertices asks for no buffer of them.
    vertex_input.vertexBindingDescriptionCount = attributes.empty() ? 0u : 1u;
    vertex_input.pVertexBindingDescriptions = &stream;
    vertex_input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    vertex_input.pVertexAttributeDescriptions = attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;

    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.lineWidth = 1.0f;

    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;

    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    const bool has_depth = desc.depth != VK_FORMAT_UNDEFINED;
    depth.depthTestEnable = has_depth;
    depth.depthWriteEnable = has_depth && !desc.depth_equal;
    // Reversed depth: 1 near, 0 far.
    depth.depthCompareOp = desc.depth_equal ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER;

    std::vector<VkPipelineColorBlendAttachmentState> attachments(desc.colors.size());
    for (std::size_t i = 0; i < attachments.size(); ++i) {
        const bool kept = desc.colors[i] != VK_FORMAT_UNDEFINED;
        attachments[i].colorWriteMask = desc.color_write && kept ? 0xfu : 0u;
        if (!desc.over && !desc.over_all) continue;
        attachments[i].blendEnable = VK_TRUE;
        attachments[i].srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
        attachments[i].dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        attachments[i].srcAlphaBlendFactor =
            desc.over_all ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
        attachments[i].dstAlphaBlendFactor =
            desc.over_all ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    }
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    blend.pAttachments = attachments.data();

    const VkDynamicState dynamic_states[] = {
        VK_DYNAMIC_STATE_VIEWPORT_WITH_COUNT, VK_DYNAMIC_STATE_SCISSOR_WITH_COUNT,
        VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 4;
    dynamic.pDynamicStates = dynamic_states;

    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(desc.colors.size());
    rendering.pColorAttachmentFormats = desc.colors.data();
    rendering.depthAttachmentFormat = desc.depth;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout(desc.sets);
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(
        vkCreateGraphicsPipelines(device_->handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "creating a graphics pipeline");
    device_->name(VK_OBJECT_TYPE_PIPELINE, pipeline, desc.vertex + "+" + desc.fragment);
    made->pipeline = PipelineHandle(device_->handle(), pipeline);
    made->layout = info.layout;
    for (const BindingTypes& types : desc.sets) made->set_layouts.push_back(set_layout(types));
    slot = std::move(made);
    return *slot;
}

VkDescriptorPool DescriptorArena::new_pool()
{
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2048}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 512},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 512},          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 256},
        {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 512},
    };
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = 256;
    info.poolSizeCount = 5;
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_->handle(), &info, nullptr, &pool),
          "creating a descriptor pool");
    pools_.emplace_back(device_->handle(), pool);
    return pool;
}

VkDescriptorSet DescriptorArena::set(VkDescriptorSetLayout layout,
                                     const std::vector<Binding>& bindings)
{
    Bindings numbered;
    for (const Binding& binding : bindings) {
        numbered.push_back({static_cast<std::uint32_t>(numbered.size()), binding});
    }
    return set(layout, numbered);
}

VkDescriptorSet DescriptorArena::set(VkDescriptorSetLayout layout, const Bindings& bindings)
{
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet made = VK_NULL_HANDLE;
    for (;;) {
        info.descriptorPool = current_ < pools_.size() ? pools_[current_].get() : new_pool();
        const VkResult result = vkAllocateDescriptorSets(device_->handle(), &info, &made);
        if (result == VK_SUCCESS) break;
        if (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL) {
            check(result, "allocating descriptors");
        }
        ++current_;
    }
    std::vector<VkWriteDescriptorSet> writes;
    for (const Bound& bound : bindings) {
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = made;
        write.dstBinding = bound.number;
        write.descriptorCount = 1;
        write.descriptorType = bound.binding.type;
        write.pImageInfo = &bound.binding.image_info;
        write.pBufferInfo = &bound.binding.buffer_info;
        write.pTexelBufferView = &bound.binding.texel_view;
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(device_->handle(), static_cast<std::uint32_t>(writes.size()),
                           writes.data(), 0, nullptr);
    return made;
}

void DescriptorArena::reset()
{
    for (const auto& pool : pools_) {
        check(vkResetDescriptorPool(device_->handle(), pool.get(), 0), "resetting descriptors");
    }
    current_ = 0;
}

}  // namespace petrichor::gpu
