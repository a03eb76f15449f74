#ifndef PETRICHOR_TEXPROC_MATERIAL_PACK_H
#define PETRICHOR_TEXPROC_MATERIAL_PACK_H

#include <map>
#include <string>
#include <vector>

#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// Where the numbers of one packed channel come from: the first alternative whose map is there and
/// has that channel.
///
/// Text form, alternatives separated by '|':  "smoothness | 1 - roughness | 0.5"
///   role, role.g   a map by role, its first channel or the one named (r g b a)
///   1 - role       the same, inverted (exact: the code is subtracted from the largest)
///   0.5            a constant in 0..1, always there
struct PackSource {
    std::string role;  ///< empty: a constant
    int channel = 0;
    bool invert = false;
    double constant = 0.0;
};
using PackChannel = std::vector<PackSource>;

/// Reads the text form. Throws Error that names the text.
PackChannel parse_pack_channel(const std::string& text);

struct PackPreset {
    std::string name;
    std::string note;
    std::vector<std::string> channels;       ///< text form, 1..4 of them
    std::vector<std::string> srgb_channels;  ///< names of the packed channels that hold sRGB codes
};

/// The presets of the project: unity-hdrp-mask, gltf-orm, ...
const std::vector<PackPreset>& pack_presets();
/// Throws Error that lists the names.
const PackPreset& pack_preset(const std::string& name);

/// Packs maps by role into one image. Codes of the same depth are copied, never recomputed.
///
///   maps     all the same size; Throws Error when not, or when a channel has no source
///   bits     8 or 16, 32 for floats (codes become 0..1); 0: 16 when a map has more than 8, else 8
///   threads  0: all cores; the bytes do not depend on it
RawImage pack(const PackPreset& preset, const std::map<std::string, RawImage>& maps, int bits = 0,
              int threads = 0);

/// The inverse: one single-channel image for each role that a channel of the preset names first
/// (inverted back where the preset inverts). Throws Error when channels are missing.
std::map<std::string, RawImage> unpack(const PackPreset& preset, const RawImage& packed);

/// One channel of an image, in the same numbers. Throws Error when it has no such channel.
RawImage channel_of(const RawImage& image, int channel);

}  // namespace petrichor::texproc

#endif
