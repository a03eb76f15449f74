#ifndef PETRICHOR_GPU_DEVICE_DEVICE_INFO_H
#define PETRICHOR_GPU_DEVICE_DEVICE_INFO_H

#include <string>
#include <vector>

namespace petrichor::gpu {

/// One Vulkan device of this machine, as `petrichor doctor` lists it.
struct DeviceInfo {
    std::string name;
    std::string driver;
    std::string kind;         ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;  ///< "1.3.230"
    bool usable = false;
    std::string why_not;          ///< what is missing, when not usable
    bool block_textures = false;  ///< samples BC1 to BC7
};

/// All Vulkan devices, best first. Empty when there is no loader or no driver; never throws for
/// that.
std::vector<DeviceInfo> list_devices();

struct RendererOptions {
    std::string device;       ///< part of a device name or an index; empty: best GPU, else CPU
    bool validation = false;  ///< load the validation layer and collect its messages
    bool passes_apart = false;  ///< each pass is waited for, so that its CPU time is known; slower
    int texture_anisotropy = 0;  ///< looks of a texture's sampler along what is foreshortened, 1..16; 0: 8, and 1 on a CPU, which pays for them
    int ripple_texture_size = 512;  ///< texels a side of the map of rings: a power of two, 64..4096
};

struct PassTime {
    std::string name;
    double milliseconds = 0.0;  ///< of the device, all samples of the frame together
    double cpu_milliseconds = 0.0;  ///< of all threads, with RendererOptions::passes_apart; 0 without
};

}  // namespace petrichor::gpu

#endif
