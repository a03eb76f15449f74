// The numbers by which DDS (DXGI) and KTX2 (Vulkan) name texel formats.
#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_TEXTURE_CODES_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_TEXTURE_CODES_H

#include <cstdint>
#include <optional>

#include "texproc/codecs/blocks/detail/block_table.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc::detail {

struct LabelledFormat {
    TextureFormat format;
    bool srgb = false;
    bool swap_red_blue = false;  ///< stored blue first
};

/// The format of a label, and the label of a format; null for plain numbers.
TextureFormat format_of(const BlockRow& block, const BlockLabel& label);
const BlockLabel* label_of(const TextureFormat& format);

/// 0 when the container has no such format.
std::uint32_t dxgi_code(const TextureFormat& format, bool srgb);
std::uint32_t vulkan_code(const TextureFormat& format, bool srgb);

/// None for formats that are not read.
std::optional<LabelledFormat> from_dxgi(std::uint32_t code);
std::optional<LabelledFormat> from_vulkan(std::uint32_t code);

/// Exchanges channels 0 and 2 of 8-bit texels.
void swap_red_blue(std::vector<std::byte>& texels, int channels);

/// Refuses what the reader may not decode, before anything is allocated: no pixels, more than
/// max_pixels, more than max_bytes as four bytes a number. Throws std::runtime_error ("it is ...").
void check_texture_size(std::uint64_t width, std::uint64_t height, int channels,
                        const ReadOptions& limits);

}  // namespace petrichor::texproc::detail

#endif
