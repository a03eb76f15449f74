#ifndef PETRICHOR_GPU_UPLOAD_TEXTURE_H
#define PETRICHOR_GPU_UPLOAD_TEXTURE_H

#include <cstddef>
#include <string>
#include <vector>

#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

enum class TexelFormat {
    Rgba8Srgb,   ///< colour, sRGB-encoded bytes
    Rgba8Unorm,  ///< data
    Rg8Unorm,    ///< two-channel data
    R8Unorm,     ///< one-channel data
    Rgba16Float,
};

/// A texture ready for upload: mips[0] is width x height, each next level floor(half), at least 1.
struct Texture {
    std::string name;
    TexelFormat format = TexelFormat::Rgba8Unorm;
    int width = 0;
    int height = 0;
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    bool nearest = false;
    std::vector<std::vector<std::byte>> mips;
};

}  // namespace petrichor::gpu

#endif
