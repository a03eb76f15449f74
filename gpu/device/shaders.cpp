#include "gpu/device/shaders.h"

namespace petrichor::gpu {

const EmbeddedShader* find_embedded_shader(const std::string& name)
{
    for (const EmbeddedShader& shader : embedded_shaders()) {
        if (shader.name == name) return &shader;
    }
    return nullptr;
}

std::span<const std::uint32_t> embedded_shader(const std::string& name)
{
    const EmbeddedShader* shader = find_embedded_shader(name);
    return shader ? shader->code : std::span<const std::uint32_t>();
}

}  // namespace petrichor::gpu
