#ifndef PETRICHOR_GPU_DEVICE_DECIDED_H
#define PETRICHOR_GPU_DEVICE_DECIDED_H

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/specialize.h"

namespace petrichor::gpu {

struct Decided {
    std::vector<std::uint32_t> words;
    bool all = false;  ///< no constant of specialization is left
};

/// A shader in which constants of specialization have these values (or their own), and what they alone decide is gone: branches
/// that are never taken, functions that nothing calls. SPIRV-Tools' passes do the same, but keep account of who uses what while
/// they do, which is two thirds of what cutting a shader down takes; here it is one walk over the words. Where a
/// branch could not go without more thought it stays, and a shader of another form comes back as it was: passes do the rest.
Decided with_constants(std::span<const std::uint32_t> code, const std::vector<Specialization>& constants);

}  // namespace petrichor::gpu

#endif
