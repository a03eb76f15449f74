#ifndef PETRICHOR_TEXPROC_MATERIAL_RECIPE_H
#define PETRICHOR_TEXPROC_MATERIAL_RECIPE_H

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "texproc/filter/bake.h"
#include "texproc/filter/mips.h"
#include "texproc/material/chains.h"
#include "texproc/material/material_names.h"
#include "texproc/material/pack.h"

namespace petrichor::texproc {

/// What a bit of a packed texture may cost, and how far off a block may get: BlockOptions::repeat.
inline constexpr float kRdo = 1.0f, kRdoMost = 1.0f;

/// One file that a recipe makes.
struct OutputRule {
    std::string folder;           ///< below the output folder: the engine, where there are several
    std::string file = "{name}";  ///< without extension; {name} becomes the name of the material
    PackPreset channels;          ///< what goes where; srgb_channels: RGB is written as sRGB colour
    std::string format = "png";   ///< png, tga, tif, exr, dds, ktx2
    std::string compression = "none";  ///< dds, ktx2: none, bc1, bc3, bc4, bc5, bc7; ktx2: uastc, astc-4x4 ..
    /// Blocks that repeat bytes of others, for smaller files: BlockOptions::repeat, 0 for none, and
    /// repeat_most. By default of what is packed by zstd, normals left out.
    std::optional<float> rdo;
    float rdo_most = kRdoMost;
    int bits = 8;                      ///< 8 or 16; exr: 16 or 32
    bool mips = true;                  ///< dds, ktx2, exr: all levels
    bool level_files = false;          ///< the others: one file a level, {file}_0, {file}_1, ...
    int size = 0;           ///< start with the level whose sides are at most this; 0: level 0
    bool blue_first = false;  ///< dds without compression: B8G8R8A8 with the extended header
    std::string import;  ///< whose settings files go beside it: unity, godot; empty: none
    bool prefilter = true;  ///< roughness, smoothness and normals from the prefiltered chain

    /// It is stored under zstd, which its readers know.
    bool is_packed() const { return format == "ktx2" && compression == "uastc"; }
    /// BlockOptions::repeat. Normals that repeat would show in what they mirror: only when asked for.
    float price_of_a_bit() const
    {
        return rdo.value_or(is_packed() && !holds_normals() ? kRdo : 0.0f);
    }
    bool holds_normals() const
    {
        return std::any_of(channels.channels.begin(), channels.channels.end(), [](const auto& text) {
            return text.find("normal") != std::string::npos;
        });
    }
    /// Blocks that can repeat bytes of others.
    bool has_rdo() const { return compression.starts_with("bc") || compression == "uastc"; }
    /// There is no DDS of it.
    bool in_ktx2_alone() const { return compression == "uastc" || compression.starts_with("astc"); }
    bool srgb() const { return !channels.srgb_channels.empty(); }
    bool has_levels() const
    {
        return level_files || (mips && (format == "dds" || format == "ktx2" || format == "exr"));
    }
};

/// What to make of the maps of a material.
struct Recipe {
    std::string name;            ///< of the material; empty: from the file or folder
    std::filesystem::path file;  ///< where it was read; empty: none
    std::vector<std::string> engines;
    std::filesystem::path folder;            ///< instead of inputs: every material found there
    std::map<std::string, InputMap> inputs;  ///< by role
    Green green = Green::Auto;               ///< Auto: what the name says, else what the map says
    std::string layout = "rgb";              ///< of the normal map
    PrefilterChoice prefilter;
    bool score = true;                        ///< measure the lobe error for the manifest
    MipOptions mips{.alpha_weighted = true};  ///< filter, wrap, alpha_cutoff
    std::vector<std::string> bake{"porosity", "puddle",
                                  "cavity"};  ///< roles made where none is given
    BakeOptions baking;
    std::vector<OutputRule> outputs;
};

/// Everything that decides the bytes of the outputs, as text: equal texts, equal outputs.
std::string options_text(const Recipe& recipe);
std::string options_text(const OutputRule& output);

}  // namespace petrichor::texproc

#endif
