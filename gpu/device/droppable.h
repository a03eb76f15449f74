#ifndef PETRICHOR_GPU_DEVICE_DROPPABLE_H
#define PETRICHOR_GPU_DEVICE_DROPPABLE_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// The same shader with words that lanes hand each other (OpGroupNonUniformShuffle) written as an instruction that
/// passes drop where nothing needs its result. SPIRV-Tools take a shuffle for something that acts, so every word of
/// the constants of a frame would stay, three fifths of a surface, while a shader needs a few of them. No driver may see
/// this form. What is no SPIR-V, or has no shuffles, comes back as it was.
std::vector<std::uint32_t> with_droppable_shuffles(std::span<const std::uint32_t> code);

/// .. and the shuffles that are left, as shuffles again.
std::vector<std::uint32_t> with_shuffles_again(std::span<const std::uint32_t> code);

}  // namespace petrichor::gpu

#endif
