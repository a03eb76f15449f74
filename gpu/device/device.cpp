#include "gpu/device/device.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "base/error.h"

namespace petrichor::gpu {

namespace {

const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::string result_name(VkResult result)
{
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory";
        case VK_ERROR_DEVICE_LOST:
            return "device lost";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no driver found";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "layer not present";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "extension not present";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "feature not present";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialisation failed";
        default:
            return "error " + std::to_string(result);
    }
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data,
                                               void* user)
{
    static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
    return VK_FALSE;
}

bool has_layer(const char* name)
{
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

bool has_instance_extension(const char* name)
{
    std::uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr) != VK_SUCCESS)
        return false;
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>* messages)
{
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = collect_message;
    info.pUserData = messages;
    return info;
}

/// The first instance of the process, never destroyed, keeps the drivers loaded. Without it each list of devices and each
/// renderer loads them anew: slow, and a driver that takes thread-local storage is not found any more after some dozen
/// times (seen with NVIDIA's).
void keep_drivers_loaded()
{
    static const VkInstance kept = [] {
        VkApplicationInfo application{};
        application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        application.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &application;
        VkInstance instance = VK_NULL_HANDLE;
        return vkCreateInstance(&info, nullptr, &instance) == VK_SUCCESS ? instance : VK_NULL_HANDLE;
    }();
    static_cast<void>(kept);
}

VkInstance create_instance(bool validation, bool* debug_utils, std::vector<std::string>* messages)
{
    keep_drivers_loaded();
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "petrichor";
    application.apiVersion = VK_API_VERSION_1_3;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;

    std::vector<const char*> extensions;
    *debug_utils = has_instance_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME) || validation;
    if (*debug_utils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();

    VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages);
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    if (validation) {
        if (!has_layer(kValidationLayer)) {
            throw Error("gpu: the validation layer was asked for but is not installed",
                        "Install the package vulkan-validationlayers, or leave validation off.");
        }
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        messenger.pNext = &features;
        info.pNext = &messenger;
    }
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result != VK_SUCCESS) {
        throw Error("gpu: Vulkan cannot start: " + result_name(result),
                    "Install a Vulkan driver; on a machine without a GPU the package "
                    "mesa-vulkan-drivers renders on the CPU.");
    }
    return instance;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance)
{
    std::uint32_t count = 0;
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance, &count, devices.data());
    devices.resize(count);
    return devices;
}

// The features that the renderer needs, linked into one chain.
struct Features {
    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan13Features v13{};

    Features()
    {
        core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        core.pNext = &v12;
        v12.pNext = &v13;
    }
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;
};

VkPhysicalDeviceVulkan11Properties subgroups(VkPhysicalDevice device)
{
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &v11;
    vkGetPhysicalDeviceProperties2(device, &properties);
    return v11;
}

std::string missing_features(VkPhysicalDevice device)
{
    Features has;
    vkGetPhysicalDeviceFeatures2(device, &has.core);
    std::string missing;
    const auto need = [&missing](VkBool32 present, const char* name) {
        if (!present) missing += (missing.empty() ? "" : ", ") + std::string(name);
    };
    need(has.v12.scalarBlockLayout, "scalarBlockLayout");
    need(has.v12.hostQueryReset, "hostQueryReset");
    need(has.v13.dynamicRendering, "dynamicRendering");
    need(has.v13.synchronization2, "synchronization2");
    need(has.v13.maintenance4, "maintenance4");
    need(has.core.features.shaderStorageImageExtendedFormats, "shaderStorageImageExtendedFormats");
    need(has.core.features.independentBlend, "independentBlend");
    need(has.v12.subgroupBroadcastDynamicId, "subgroupBroadcastDynamicId");
    need(subgroups(device).subgroupSupportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT, "ballot in subgroups");
    need(subgroups(device).subgroupSupportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle in subgroups");
    return missing;
}

std::int32_t graphics_queue_family(VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        const VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        if ((families[i].queueFlags & both) == both) return static_cast<std::int32_t>(i);
    }
    return -1;
}

DeviceInfo describe(VkPhysicalDevice device)
{
    VkPhysicalDeviceVulkan12Properties v12{};
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &v12;
    vkGetPhysicalDeviceProperties2(device, &properties);
    const VkPhysicalDeviceProperties& p = properties.properties;

    DeviceInfo info;
    info.name = p.deviceName;
    info.api_version = std::to_string(VK_API_VERSION_MAJOR(p.apiVersion)) + "." +
                       std::to_string(VK_API_VERSION_MINOR(p.apiVersion)) + "." +
                       std::to_string(VK_API_VERSION_PATCH(p.apiVersion));
    switch (p.deviceType) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            info.kind = "discrete";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            info.kind = "integrated";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            info.kind = "virtual";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            info.kind = "cpu";
            break;
        default:
            info.kind = "other";
    }
    if (p.apiVersion < VK_API_VERSION_1_3) {
        info.why_not = "offers Vulkan " + info.api_version + ", 1.3 is needed";
        return info;
    }
    info.driver = std::string(v12.driverName) + " " + v12.driverInfo;
    VkPhysicalDeviceFeatures core{};
    vkGetPhysicalDeviceFeatures(device, &core);
    info.block_textures = core.textureCompressionBC == VK_TRUE;
    const std::string missing = missing_features(device);
    if (!missing.empty()) {
        info.why_not = "lacks " + missing;
    } else if (graphics_queue_family(device) < 0) {
        info.why_not = "has no queue for graphics and compute";
    } else {
        info.usable = true;
    }
    return info;
}

int rank(const DeviceInfo& info)
{
    if (!info.usable) return 9;
    if (info.kind == "discrete") return 0;
    if (info.kind == "virtual") return 1;
    if (info.kind == "integrated") return 2;
    if (info.kind == "cpu") return 4;
    return 3;
}

struct Candidate {
    VkPhysicalDevice device;
    DeviceInfo info;
};

std::vector<Candidate> candidates(VkInstance instance)
{
    std::vector<Candidate> all;
    for (VkPhysicalDevice device : physical_devices(instance)) {
        all.push_back({device, describe(device)});
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
        return rank(a.info) < rank(b.info);
    });
    return all;
}

Candidate choose(VkInstance instance, const std::string& wanted)
{
    const auto all = candidates(instance);
    std::string found;
    for (std::size_t i = 0; i < all.size(); ++i) {
        found += (i ? "; " : "") + std::to_string(i) + " " + all[i].info.name +
                 (all[i].info.usable ? "" : " (" + all[i].info.why_not + ")");
    }
    if (all.empty()) found = "none";
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool fits = wanted.empty() || wanted == std::to_string(i) ||
                          all[i].info.name.find(wanted) != std::string::npos;
        if (fits && all[i].info.usable) return all[i];
    }
    throw Error("gpu: no Vulkan 1.3 device" +
                    (wanted.empty() ? "" : " matches \"" + wanted + "\"") + "; found: " + found,
                wanted.empty() ? "Install a Vulkan driver; on a machine without a GPU the package "
                                 "mesa-vulkan-drivers renders on the CPU."
                               : "Name one of the devices found, or its number, after --device.");
}

}  // namespace

void check(VkResult result, const char* doing)
{
    if (result == VK_SUCCESS) return;
    throw Error(
        std::string("gpu: ") + result_name(result) + " while " + doing,
        "Use a smaller picture or scene, or another --device; `petrichor doctor` lists them.");
}

std::vector<DeviceInfo> list_devices()
{
    bool debug_utils = false;
    std::vector<std::string> messages;
    std::vector<DeviceInfo> infos;
    try {
        VkInstance instance = create_instance(false, &debug_utils, &messages);
        for (const Candidate& candidate : candidates(instance)) infos.push_back(candidate.info);
        vkDestroyInstance(instance, nullptr);
    } catch (const Error&) {
        return {};
    }
    return infos;
}

Device::Device(const RendererOptions& options)
    : messages_(std::make_unique<std::vector<std::string>>())
{
    passes_apart_ = options.passes_apart;
    instance_ = create_instance(options.validation, &debug_utils_, messages_.get());
    try {
        const auto load = [this](const char* name) {
            return debug_utils_ ? vkGetInstanceProcAddr(instance_, name) : nullptr;
        };
        if (options.validation) {
            const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
                load("vkCreateDebugUtilsMessengerEXT"));
            const auto info = messenger_info(messages_.get());
            check(create(instance_, &info, nullptr, &messenger_), "creating the message callback");
        }
        const Candidate chosen = choose(instance_, options.device);
        physical_ = chosen.device;
        info_ = chosen.info;
        queue_family_ = static_cast<std::uint32_t>(graphics_queue_family(physical_));

        Features wanted;
        wanted.core.features.shaderStorageImageExtendedFormats = VK_TRUE;
        wanted.core.features.independentBlend = VK_TRUE;
        wanted.core.features.textureCompressionBC = info_.block_textures ? VK_TRUE : VK_FALSE;
        // Triangle numbers in a fragment shader come with this feature.
        Features has;
        vkGetPhysicalDeviceFeatures2(physical_, &has.core);
        wanted.core.features.geometryShader = has.core.features.geometryShader;
        wanted.core.features.samplerAnisotropy = has.core.features.samplerAnisotropy;
        primitive_ids_ = has.core.features.geometryShader == VK_TRUE;
        wanted.v12.scalarBlockLayout = VK_TRUE;
        wanted.v12.hostQueryReset = VK_TRUE;
        wanted.v12.subgroupBroadcastDynamicId = VK_TRUE;
        wanted.v13.dynamicRendering = VK_TRUE;
        wanted.v13.synchronization2 = VK_TRUE;
        wanted.v13.maintenance4 = VK_TRUE;

        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueFamilyIndex = queue_family_;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkDeviceCreateInfo device{};
        device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        device.pNext = &wanted.core;
        device.queueCreateInfoCount = 1;
        device.pQueueCreateInfos = &queue;
        check(vkCreateDevice(physical_, &device, nullptr, &device_), "creating the device");
        vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(physical_, &properties);
        limits_ = properties.limits;
        const int looks = options.texture_anisotropy > 0 ? options.texture_anisotropy : info_.kind == "cpu" ? 1 : 8;
        if (has.core.features.samplerAnisotropy == VK_TRUE)
            texture_anisotropy_ = static_cast<std::uint32_t>(std::clamp(static_cast<float>(looks), 1.0f, limits_.maxSamplerAnisotropy));
        VkFormatProperties floats{};
        vkGetPhysicalDeviceFormatProperties(physical_, VK_FORMAT_R32G32B32A32_SFLOAT, &floats);
        filters_floats_ = (floats.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
        subgroup_size_ = subgroups(physical_).subgroupSize;
        vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);

        set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            load("vkSetDebugUtilsObjectNameEXT"));
        begin_label_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
            load("vkCmdBeginDebugUtilsLabelEXT"));
        end_label_ =
            reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(load("vkCmdEndDebugUtilsLabelEXT"));

        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.queueFamilyIndex = queue_family_;
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        VkCommandPool command_pool = VK_NULL_HANDLE;
        check(vkCreateCommandPool(device_, &pool, nullptr, &command_pool),
              "creating a command pool");
        command_pool_ = CommandPoolHandle(device_, command_pool);

        VkCommandBufferAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        allocate.commandPool = command_pool;
        allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        allocate.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device_, &allocate, &commands_), "allocating commands");

        VkFenceCreateInfo fence_info{};
        fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence fence = VK_NULL_HANDLE;
        check(vkCreateFence(device_, &fence_info, nullptr, &fence), "creating a fence");
        fence_ = FenceHandle(device_, fence);
    } catch (...) {
        destroy();
        throw;
    }
}

Device::~Device()
{
    destroy();
}

void Device::destroy()
{
    fence_.reset();
    command_pool_.reset();
    if (device_) vkDestroyDevice(device_, nullptr);
    device_ = VK_NULL_HANDLE;
    if (messenger_) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    messenger_ = VK_NULL_HANDLE;
    if (instance_) vkDestroyInstance(instance_, nullptr);
    instance_ = VK_NULL_HANDLE;
}

std::uint32_t Device::memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags wanted) const
{
    // What the CPU maps it reads as well, which is slow past its caches (docs/gpus.md).
    const bool mapped = (wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
    for (const VkMemoryPropertyFlags better : {mapped ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT} : 0u, 0u}) {
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const bool allowed = (allowed_bits & (1u << i)) != 0;
            const VkMemoryPropertyFlags all = wanted | better;
            if (allowed && (memory_.memoryTypes[i].propertyFlags & all) == all) return i;
        }
    }
    throw Error("gpu: the device has no memory of the kind needed", "Choose another --device.");
}

void Device::name(VkObjectType type, std::uint64_t object, const std::string& text) const
{
    if (!set_name_) return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = text.c_str();
    set_name_(device_, &info);
}

void Device::begin_label(VkCommandBuffer commands, const std::string& text) const
{
    if (!begin_label_) return;
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = text.c_str();
    begin_label_(commands, &label);
}

void Device::end_label(VkCommandBuffer commands) const
{
    if (end_label_) end_label_(commands);
}

void Device::run(const std::function<void(VkCommandBuffer)>& record) const
{
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "beginning commands");
    record(commands_);
    check(vkEndCommandBuffer(commands_), "ending commands");

    VkCommandBufferSubmitInfo submitted{};
    submitted.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    submitted.commandBuffer = commands_;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &submitted;
    const VkFence fence = fence_.get();
    check(vkQueueSubmit2(queue_, 1, &submit, fence), "submitting commands");
    check(vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX), "waiting for the device");
    check(vkResetFences(device_, 1, &fence), "resetting a fence");
}

}  // namespace petrichor::gpu
