#ifndef PETRICHOR_GPU_DEVICE_SMALL_FUNCTIONS_H
#define PETRICHOR_GPU_DEVICE_SMALL_FUNCTIONS_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// The same shader, all but whose small functions ask not to be inlined. Small ones are called hundreds of times, as
/// those that read the words of a block are: put in place before any constant is known, that is done once and not for
/// every pipeline. What is no SPIR-V comes back as it was.
std::vector<std::uint32_t> with_large_apart(std::span<const std::uint32_t> code);

/// .. and without that wish.
std::vector<std::uint32_t> with_inlining(std::span<const std::uint32_t> code);

}  // namespace petrichor::gpu

#endif
