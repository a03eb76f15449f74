#ifndef PETRICHOR_GPU_FRAME_CONSTANTS_RANGE_H
#define PETRICHOR_GPU_FRAME_CONSTANTS_RANGE_H

#include "gpu/device/pipelines.h"
#include "gpu/frame/frame_io.h"

namespace petrichor::gpu {

/// Where a sample's constants lie in the frame's uniform buffer.
struct ConstantsRange {
    GpuBuffer* buffer = nullptr;
    VkDeviceSize offset = 0;
};
inline Binding frame_binding(const ConstantsRange& constants)
{
    return uniform(*constants.buffer, constants.offset, sizeof(shared::FrameConstants));
}

}  // namespace petrichor::gpu

#endif
