#ifndef PETRICHOR_GPU_UPLOAD_DETAIL_TEXEL_FORMAT_H
#define PETRICHOR_GPU_UPLOAD_DETAIL_TEXEL_FORMAT_H

#include <vulkan/vulkan.h>

#include "gpu/upload/texture.h"

namespace petrichor::gpu {

/// The format of the device for one of ours.
VkFormat vk_format(TexelFormat format);

/// Throws Error that names the texture when its levels do not have the bytes that its format and
/// size ask for, so that no copy reads past them.
void check_levels(const Texture& texture);

}  // namespace petrichor::gpu

#endif
