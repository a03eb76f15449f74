#ifndef PETRICHOR_GPU_DEVICE_SPECIALIZE_H
#define PETRICHOR_GPU_DEVICE_SPECIALIZE_H

#include <cstdint>
#include <span>
#include <vector>

#include "base/content_cache.h"

namespace petrichor::gpu {

/// Value of a specialization constant: the bits of a 32-bit number, or 0 and 1.
struct Specialization {
    std::uint32_t id = 0;
    std::uint32_t value = 0;
};

/// The shader with its specialization constants made constants (those that are not given keep their
/// defaults), without what no branch reaches then, as one function whose variables are values.
/// Drivers work through the whole of a shader several times before they drop what is switched off,
/// which is most of the time that a pipeline takes. What constants decide is computed here: last
/// bits may differ from those of a build without SPIRV-Tools.
///
/// `prepared` is what prepared() makes of the shader, where that is at hand. Kept in `cache` by content. Empty when this build has no SPIRV-Tools or they cannot read the
/// shader: the driver does it all then.
std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> code,
                                       const std::vector<Specialization>& constants,
                                       const ContentCache& cache = {},
                                       std::span<const std::uint32_t> prepared = {});

/// True when this build was made with SPIRV-Tools.
bool can_specialize();

}  // namespace petrichor::gpu

#endif
