#ifndef PETRICHOR_GPU_DEVICE_BY_VALUE_H
#define PETRICHOR_GPU_DEVICE_BY_VALUE_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// The same shader with arguments handed over as values where the function only reads them. Compilers of
/// GLSL hand over the address of a copy, which hides constants from who is called, and a function that is
/// inlined then goes through memory for each of its arguments. Takes for granted, as GLSL has it, that no
/// two arguments of a call lie in the same memory. What is no SPIR-V comes back as it was.
std::vector<std::uint32_t> by_value(std::span<const std::uint32_t> code);

}  // namespace petrichor::gpu

#endif
