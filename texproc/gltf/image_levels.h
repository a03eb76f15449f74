#ifndef PETRICHOR_TEXPROC_GLTF_IMAGE_LEVELS_H
#define PETRICHOR_TEXPROC_GLTF_IMAGE_LEVELS_H

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "texproc/codecs/files/texture.h"
#include "texproc/gltf/image_plan.h"
#include "texproc/material/chains.h"
#include "texproc/material/material.h"

namespace petrichor::texproc {

struct ImageMakingOptions {
    PrefilterChoice prefilter;
    bool bake_roughness =
        true;  ///< factors go into the images; else the images are divided by them
    std::string format = "uastc";  ///< or a name of texture_format(): "bc7"
    BlockQuality quality = BlockQuality::Normal;
    int size = 0;     ///< no side longer than this; 0: as the source
    int threads = 0;  ///< 0: all cores; the bytes do not depend on it
};

/// Makes the images of a plan: level 0 as the source has it, smaller ones filtered by what they
/// hold, roughness and base colour with the normals that belong to them. Sides are multiples of
/// four, which KHR_texture_basisu asks for: others are resampled to the next smaller one.
class ImageMaker {
public:
    /// Both references must outlive this.
    ImageMaker(const GltfFile& file, const ImagePlan& plan, ImageMakingOptions options);
    ~ImageMaker();

    /// Throws Error that names an image that cannot be read.
    MipTexture make(std::size_t recipe) const;

    /// How far lit floors are from the truth with a surface and the normals that belong to it as
    /// they were made, and with plain mips. Nothing where they are not filtered together.
    ///   darkened  the base colour carries what the normals lose
    std::optional<PictureError> picture_error(std::size_t surface, const MipTexture& surface_made,
                                              const MipTexture& normals_made, bool darkened) const;

    /// True when the source of a recipe was resampled.
    bool is_resampled(std::size_t recipe) const;

private:
    struct Pair;
    Image decode(std::size_t image, ColorSpace space, int channels) const;
    std::vector<Image> color_levels(const ImageRecipe& recipe) const;
    std::vector<Image> surface_levels(const ImageRecipe& recipe) const;
    std::vector<Image> normal_levels(const ImageRecipe& recipe) const;
    MipOptions mip_options(const ImageRecipe& recipe) const;

    const GltfFile& file_;
    const ImagePlan& plan_;
    ImageMakingOptions options_;
};

/// The encoded bytes of an image of a scene.
std::vector<std::byte> image_bytes(const GltfFile& file, std::size_t image);

}  // namespace petrichor::texproc

#endif
