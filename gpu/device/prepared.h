#ifndef PETRICHOR_GPU_DEVICE_PREPARED_H
#define PETRICHOR_GPU_DEVICE_PREPARED_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// What of cutting a shader down (specialized()) no constant decides: the same for all its pipelines, and half of the
/// work. Our own shaders are prepared when the program is built (device/embed_main.cpp). No driver may see this form.
/// Empty when this build has no SPIRV-Tools or they cannot read the shader.
std::vector<std::uint32_t> prepared(std::span<const std::uint32_t> code);

}  // namespace petrichor::gpu

#endif
