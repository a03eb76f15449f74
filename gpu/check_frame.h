#ifndef PETRICHOR_GPU_CHECK_FRAME_H
#define PETRICHOR_GPU_CHECK_FRAME_H

#include "gpu/frame/frame.h"

struct VkPhysicalDeviceLimits;

namespace petrichor::gpu {

inline constexpr int kMaxSamples = 256;  ///< a pixel

/// Throws Error for a frame that cannot be rendered on a device with these limits.
void check_frame(const Frame& frame, const VkPhysicalDeviceLimits& limits);

}  // namespace petrichor::gpu

#endif
