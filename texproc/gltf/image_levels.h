#ifndef PETRICHOR_TEXPROC_GLTF_IMAGE_LEVELS_H
#define PETRICHOR_TEXPROC_GLTF_IMAGE_LEVELS_H

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "texproc/codecs/files/texture.h"
#include "texproc/filter/area.h"
#include "texproc/gltf/image_plan.h"
#include "texproc/material/chains.h"
#include "texproc/material/material.h"
#include "texproc/material/recipe.h"
#include "texproc/prefilter/stored_guard.h"

namespace petrichor::texproc {

/// Whether surfaces are made for what they are, paint or metal (PrefilterOptions::surface).
inline bool fits_by_class(const PrefilterChoice& choice)
{
    return choice.rule == "picture" && !choice.quick;
}

struct ImageMakingOptions {
    PrefilterChoice prefilter;
    bool bake_roughness =
        true;  ///< factors go into the images; else the images are divided by them
    std::string format = "uastc";  ///< or a name of texture_format(): "bc7"
    BlockQuality quality = BlockQuality::Normal;
    std::optional<float> rdo;   ///< BlockOptions::repeat; none: kRdo, 0 of normals
    float rdo_most = kRdoMost;  ///< repeat_most
    int size = 0;     ///< no side longer than this; 0: as the source
    int threads = 0;  ///< 0: all cores; the bytes do not depend on it
};

/// Lit floors of a surface with its normals, and what is known of both in one size.
struct PairPictures {
    PictureBench bench;
    std::vector<LevelSize> sizes;
    std::vector<Image> base_share;
    /// The level of the chain that a level of an image is; sizes.size(): none.
    std::size_t level_of(int width, int height) const;
};

/// Makes the images of a plan: level 0 as the source has it, smaller ones filtered by what they
/// hold, roughness and base colour with the normals that belong to them. Sides are multiples of
/// four, which KHR_texture_basisu asks for: others are resampled to the next smaller one.
class ImageMaker {
public:
    /// Both references must outlive this.
    ImageMaker(const GltfFile& file, const ImagePlan& plan, ImageMakingOptions options);
    ~ImageMaker();

    /// Throws Error that names an image that cannot be read. plain: levels of plain mips.
    MipTexture make(std::size_t recipe, bool plain = false) const;

    /// Pictures of a surface with the normals that belong to it; nothing where they are not
    /// filtered together.
    std::optional<PairPictures> pictures(std::size_t surface) const;
    /// What a viewer reads of a surface and its normals as they were made.
    ///   darkened     the base colour carries what the normals lose
    ///   second_made  of a surface of two lobes; null: of one
    Prefiltered as_read(std::size_t surface, const PairPictures& pictures,
                        const MipTexture& surface_made, const MipTexture& normals_made,
                        bool darkened, const MipTexture* second_made = nullptr) const;

    /// True when the source of a recipe was resampled.
    bool is_resampled(std::size_t recipe) const;

private:
    struct Pair;
    Image decode(std::size_t image, ColorSpace space, int channels) const;
    std::vector<Image> color_levels(const ImageRecipe& recipe) const;
    std::vector<Image> surface_levels(const ImageRecipe& recipe, bool plain) const;
    std::vector<Image> normal_levels(const ImageRecipe& recipe) const;
    std::vector<Image> second_levels(const ImageRecipe& recipe, bool plain) const;
    Image surface_of(const ImageRecipe& recipe) const;
    const Prefiltered& chains(const ImageRecipe& recipe, const Pair& pair) const;
    SecondLobe second_as_read(const MipTexture& made, const PairPictures& pictures, const ImageRecipe& recipe,
                              std::size_t count) const;
    MipOptions mip_options(const ImageRecipe& recipe) const;

    const GltfFile& file_;
    const ImagePlan& plan_;
    ImageMakingOptions options_;
    // What was filtered last, of one and of two lobes: images of one material ask for the same.
    struct Chains;
    mutable std::unique_ptr<Chains[]> last_;
};

/// The encoded bytes of an image of a scene.
std::vector<std::byte> image_bytes(const GltfFile& file, std::size_t image);

}  // namespace petrichor::texproc

#endif
