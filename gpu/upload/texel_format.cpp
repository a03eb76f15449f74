#include "gpu/upload/detail/texel_format.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>

#include "base/error.h"

namespace petrichor::gpu {
namespace {

struct Row {
    TexelFormat format;
    VkFormat vulkan;
    int side;           // texels along a block; 1: plain numbers
    std::size_t bytes;  // of a block
};

constexpr Row kTexelFormats[] = {
    {TexelFormat::Rgba8Srgb, VK_FORMAT_R8G8B8A8_SRGB, 1, 4},
    {TexelFormat::Rgba8Unorm, VK_FORMAT_R8G8B8A8_UNORM, 1, 4},
    {TexelFormat::Rg8Unorm, VK_FORMAT_R8G8_UNORM, 1, 2},
    {TexelFormat::R8Unorm, VK_FORMAT_R8_UNORM, 1, 1},
    {TexelFormat::Rgba16Float, VK_FORMAT_R16G16B16A16_SFLOAT, 1, 8},
    {TexelFormat::Rg16Float, VK_FORMAT_R16G16_SFLOAT, 1, 4},
    {TexelFormat::R16Float, VK_FORMAT_R16_SFLOAT, 1, 2},
    {TexelFormat::Bc1Srgb, VK_FORMAT_BC1_RGBA_SRGB_BLOCK, 4, 8},
    {TexelFormat::Bc1Unorm, VK_FORMAT_BC1_RGBA_UNORM_BLOCK, 4, 8},
    {TexelFormat::Bc1OpaqueSrgb, VK_FORMAT_BC1_RGB_SRGB_BLOCK, 4, 8},
    {TexelFormat::Bc1OpaqueUnorm, VK_FORMAT_BC1_RGB_UNORM_BLOCK, 4, 8},
    {TexelFormat::Bc2Srgb, VK_FORMAT_BC2_SRGB_BLOCK, 4, 16},
    {TexelFormat::Bc2Unorm, VK_FORMAT_BC2_UNORM_BLOCK, 4, 16},
    {TexelFormat::Bc3Srgb, VK_FORMAT_BC3_SRGB_BLOCK, 4, 16},
    {TexelFormat::Bc3Unorm, VK_FORMAT_BC3_UNORM_BLOCK, 4, 16},
    {TexelFormat::Bc4Unorm, VK_FORMAT_BC4_UNORM_BLOCK, 4, 8},
    {TexelFormat::Bc5Unorm, VK_FORMAT_BC5_UNORM_BLOCK, 4, 16},
    {TexelFormat::Bc6hUfloat, VK_FORMAT_BC6H_UFLOAT_BLOCK, 4, 16},
    {TexelFormat::Bc6hSfloat, VK_FORMAT_BC6H_SFLOAT_BLOCK, 4, 16},
    {TexelFormat::Bc7Srgb, VK_FORMAT_BC7_SRGB_BLOCK, 4, 16},
    {TexelFormat::Bc7Unorm, VK_FORMAT_BC7_UNORM_BLOCK, 4, 16},
};

static_assert(std::size(kTexelFormats) == kTexelFormatCount);

const Row& row_of(TexelFormat format)
{
    const auto at = std::find_if(std::begin(kTexelFormats), std::end(kTexelFormats),
                                 [&](const Row& row) { return row.format == format; });
    assert(at != std::end(kTexelFormats));
    return *at;
}

}  // namespace

VkFormat vk_format(TexelFormat format)
{
    return row_of(format).vulkan;
}

std::size_t texel_bytes(TexelFormat format, int width, int height)
{
    const Row& row = row_of(format);
    const auto blocks = [&](int size) {
        return static_cast<std::size_t>((size + row.side - 1) / row.side);
    };
    return blocks(width) * blocks(height) * row.bytes;
}

void check_levels(const Texture& texture)
{
    const auto levels = texture.levels();
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const int width = std::max(1, texture.width >> k);
        const int height = std::max(1, texture.height >> k);
        const std::size_t needed = texel_bytes(texture.format, width, height);
        if (levels[k].size() == needed &&
            (k == 0 || (texture.width >> (k - 1)) > 1 || (texture.height >> (k - 1)) > 1)) {
            continue;
        }
        throw Error("gpu: level " + std::to_string(k) + " of the texture " + texture.name + " (" +
                        std::to_string(width) + " x " + std::to_string(height) + ") has " +
                        std::to_string(levels[k].size()) + " bytes, " +
                        std::to_string(needed) + " are needed",
                    "Give each level in its format, down to 1 x 1 at most.");
    }
}

}  // namespace petrichor::gpu
