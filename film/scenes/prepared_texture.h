#ifndef PETRICHOR_FILM_SCENES_PREPARED_TEXTURE_H
#define PETRICHOR_FILM_SCENES_PREPARED_TEXTURE_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu/renderer.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::film {

// Textures that come with their own mip levels (DDS, KTX2): loaded as they are.

/// True for a DDS or KTX2 file with more levels than one (or of 1 x 1 texels). A file with one
/// level is a picture like any other.
bool has_own_levels(std::span<const std::byte> bytes);

/// Block formats that a device samples as fast as plain numbers; others are decoded when loaded.
enum class BlockSupport {
    All,   ///< GPUs
    Fast,  ///< a CPU device: BC1 to BC5, within 5 % of plain texels; BC7 and BC6H cost 5 times
    None,  ///< a device without block textures
};
BlockSupport block_support(const gpu::DeviceInfo& device);

/// What a texture is read as.
enum class TextureMeaning { Color, Normal, Data };

struct LoadedTexture {
    gpu::Texture texture;            ///< format, size and levels
    bool as_stored = true;           ///< no number was changed
    std::vector<std::string> notes;  ///< what differs from the label of the file, a line each
};

/// The levels of a prepared texture for the device, in the numbers of the file where the device
/// reads them. Colour is sRGB in 8 bits and blocks, linear in half floats; other meanings are never
/// sRGB: a label that says otherwise is noted. Throws Error for a normal map with one channel.
LoadedTexture load_prepared(const texproc::MipTexture& file, TextureMeaning meaning,
                            BlockSupport blocks, bool labelled, int threads);

/// True when the file says by itself whether it is sRGB (KTX2, DDS with a DX10 header).
bool says_color_space(std::span<const std::byte> bytes);

}  // namespace petrichor::film

#endif
