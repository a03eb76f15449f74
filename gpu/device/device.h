#ifndef PETRICHOR_GPU_DEVICE_DEVICE_H
#define PETRICHOR_GPU_DEVICE_DEVICE_H

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gpu/device/device_info.h"
#include "gpu/device/handle.h"

namespace petrichor::gpu {

/// Throws Error for a failed Vulkan call. `doing` completes the sentence "while ...".
void check(VkResult result, const char* doing);

/// The instance, one device and its one queue. Destroyed last, after all that was made from it.
class Device {
public:
    explicit Device(const RendererOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice handle() const { return device_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// Fragment shaders know the number of their triangle.
    bool primitive_ids() const { return primitive_ids_; }
    /// Samplers look between texels of four floats of 32 bits.
    bool filters_floats() const { return filters_floats_; }
    /// So many invocations of a compute shader can hand each other values.
    std::uint32_t subgroup_size() const { return subgroup_size_; }
    /// Looks of a sampler along what is foreshortened (RendererOptions::texture_anisotropy), as far as the device has them.
    std::uint32_t texture_anisotropy() const { return texture_anisotropy_; }
    /// RendererOptions::passes_apart.
    bool passes_apart() const { return passes_apart_; }
    const DeviceInfo& info() const { return info_; }
    const std::vector<std::string>& validation_messages() const { return *messages_; }

    /// Index of a memory type that has all `wanted` flags. Throws Error when there is none.
    std::uint32_t memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags wanted) const;

    /// Names an object for captures and validation messages.
    void name(VkObjectType type, std::uint64_t object, const std::string& name) const;
    template <class T>
    void name(VkObjectType type, T object, const std::string& text) const
    {
        name(type, reinterpret_cast<std::uint64_t>(object), text);
    }
    void begin_label(VkCommandBuffer commands, const std::string& name) const;
    void end_label(VkCommandBuffer commands) const;

    /// Records with `record`, submits, waits until the device is done.
    void run(const std::function<void(VkCommandBuffer)>& record) const;

private:
    void destroy();

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    VkPhysicalDeviceLimits limits_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    DeviceInfo info_;
    bool primitive_ids_ = false;
    bool filters_floats_ = false;
    std::uint32_t texture_anisotropy_ = 1;
    bool passes_apart_ = false;
    std::uint32_t subgroup_size_ = 1;
    bool debug_utils_ = false;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label_ = nullptr;
    CommandPoolHandle command_pool_;
    FenceHandle fence_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    std::unique_ptr<std::vector<std::string>> messages_;
};

}  // namespace petrichor::gpu

#endif
