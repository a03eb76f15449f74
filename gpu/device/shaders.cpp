#include "gpu/device/shaders.h"

namespace petrichor::gpu {

std::span<const std::uint32_t> embedded_shader(const std::string& name)
{
    for (const EmbeddedShader& shader : embedded_shaders()) {
        if (shader.name == name) return shader.code;
    }
    return {};
}

}  // namespace petrichor::gpu
