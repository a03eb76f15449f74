#ifndef PETRICHOR_GPU_DEVICE_SHADERS_H
#define PETRICHOR_GPU_DEVICE_SHADERS_H

#include <cstdint>
#include <span>
#include <string>

namespace petrichor::gpu {

/// SPIR-V of a shader compiled at build time; the name is its file without ".glsl", as
/// "lighting.comp".
struct EmbeddedShader {
    std::string name;
    std::span<const std::uint32_t> code;
    std::span<const std::uint32_t> prepared;  ///< prepared() of it; empty in a build without SPIRV-Tools
};
std::span<const EmbeddedShader> embedded_shaders();
/// Null when there is none.
const EmbeddedShader* find_embedded_shader(const std::string& name);
/// Its code; empty when there is none.
std::span<const std::uint32_t> embedded_shader(const std::string& name);

}  // namespace petrichor::gpu

#endif
