#ifndef PETRICHOR_GPU_UPLOAD_TEXTURE_H
#define PETRICHOR_GPU_UPLOAD_TEXTURE_H

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// How the texels of a texture are stored; kTexelFormats in texel_format.cpp has a row for each.
enum class TexelFormat {
    Rgba8Srgb,    ///< colour, sRGB-encoded bytes
    Rgba8Unorm,   ///< data
    Rg8Unorm,     ///< two-channel data
    R8Unorm,      ///< one-channel data
    Rgba16Float,  ///< linear colour, data
    Rg16Float,
    R16Float,
    Bc1Srgb,  ///< 4 x 4 texels in 8 bytes: colour, alpha 0 or 1
    Bc1Unorm,
    Bc1OpaqueSrgb,  ///< the same without alpha
    Bc1OpaqueUnorm,
    Bc2Srgb,
    Bc2Unorm,
    Bc3Srgb,  ///< 16 bytes: colour and alpha
    Bc3Unorm,
    Bc4Unorm,  ///< one channel in 8 bytes
    Bc5Unorm,  ///< two channels in 16 bytes: normals, z is rebuilt
    Bc6hUfloat,
    Bc6hSfloat,
    Bc7Srgb,
    Bc7Unorm,
};
inline constexpr int kTexelFormatCount = static_cast<int>(TexelFormat::Bc7Unorm) + 1;

/// Bytes of a level of width x height texels; blocks at an edge are stored whole.
std::size_t texel_bytes(TexelFormat format, int width, int height);

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
    /// Of colours in blocks: a level of them in plain texels, for those who read them on the CPU (what glows lights its
    /// surroundings). Of 64 texels a side at most, where there is such a level.
    std::shared_ptr<const Texture> plain = {};
    /// Instead of mips: levels that lie in memory which `holder` keeps.
    std::vector<std::span<const std::byte>> views = {};
    std::shared_ptr<const void> holder = {};

    /// The levels, wherever they lie; none: there are no pixels.
    std::vector<std::span<const std::byte>> levels() const
    {
        return mips.empty() ? views
                            : std::vector<std::span<const std::byte>>(mips.begin(), mips.end());
    }
};

}  // namespace petrichor::gpu

#endif
